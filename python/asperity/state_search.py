# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity states`: the stable states of a contact under its load P, as far as a path leads to them.

A path at a held mean height goes inwards from beyond the interaction range; where its force F passes P the block is set free. From an
instability the new branch is followed outwards, too. At the inner end full contact is pressed on, and the way back is
followed. Where it ends, and what it may miss: docs/explanation/relaxation.md.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import sys
import time
import tomllib
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy

from . import files, program
from .engine import State, Statics
from .errors import PhysicsError, SceneError
from .scene import Overrides, SceneLike, assignments, inputs_of
from .terminal import Progress, millijoules, table
from .units import MILLIJOULE

LEAST_LOSS = 3e-3  # of the range of energies met: an instability that loses less is not followed outwards
PRESS = 0.125  # of the contact modulus: how far full contact is pressed
SAVE_EVERY = 5.0  # s
MEGAPASCAL = 6.241509074e-6  # eV/Å³
NUMBERS = ("binding_energy", "elastic_energy", "mean_height", "contact_fraction", "repulsive_fraction")
UNITS = dict(zip((*NUMBERS, "barrier", "approach_less_run", "step", "innermost", "pressed_to"),
                 "meV/Å^2 meV/Å^2 Å 1 1 MPa meV/Å^2 Å Å MPa".split()))
RESULT, UNFINISHED = "states.json", "states-unfinished.npz"


class Search:
    """Point by point. With the numbers and texts of `log` and its displacements a search goes on later."""

    def __init__(self, statics: Statics, starts: int):
        self.statics, self.case, self.starts = statics, statics._case, starts
        self.log: dict[str, Any] = {"stage": "inwards", "states": [], "points": [], "branch": 0, "tried": 0, "failed": 0}
        self.kept: dict[str, State] = {}  # "turn": where it turned outwards; "best": the deepest state
        self._dissipated = 0.0  # at the last point of the path under way

    @property
    def now(self) -> dict[str, float]:
        return self.log["points"][-1]

    def spread(self) -> float:
        return float(numpy.ptp([p["energy"] for p in self.log["points"]]))

    def put(self, state: State) -> None:
        self.statics.restore(state)
        self._dissipated = 0.0

    def go(self, **to: float) -> float:
        """Leads the path to a mean height or a load: a point more. The energy lost on the way, eV."""
        for name, value in to.items():
            setattr(self.statics, name, value)
        p, load = self.statics.relax(), self.case["load"]
        self.log["points"].append({"z": p.mean_height, "force": p.force - load, "contact": p.contact,
                                   "energy": p.energy + load * p.mean_height, "branch": self.log["branch"]})
        lost, self._dissipated = p.dissipated - self._dissipated, p.dissipated
        return lost

    def free(self, found: str, start: State | None = None) -> None:
        """The state that the sites come to from `start`, or from where they are, where they are again afterwards."""
        here = self.statics.copy()
        if start:
            self.put(start)
        branch = None if found in ("run", "random start") else self.log["branch"]
        try:
            if branch is not None:  # to where the force is the load
                self.statics.load = self.case["load"] / self.case["area"] / MEGAPASCAL
                with contextlib.suppress(PhysicsError):
                    self.statics.relax()
            rest = self.statics.free()
        except PhysicsError:
            self.log["failed"] += 1
            return self.put(here)
        for known in self.log["states"]:
            if (abs(known["mean_height"] - rest.mean_height) < 0.5 * self.case["step"] and
                    abs(known["binding_energy"] - rest.binding_energy) <= 1e-4 * self.case["scale"]):
                known["found"] += [found] * (found not in known["found"])
                known["branch"] = branch if known["branch"] is None else known["branch"]
                break
        else:
            if all(rest.binding_energy > known["binding_energy"] for known in self.log["states"]):
                self.kept["best"] = self.statics.copy()
            self.log["states"].append({**{name: getattr(rest, name) for name in NUMBERS}, "found": [found],
                                       "branch": branch})
        self.put(here)

    def advance(self) -> bool:
        """A point more, and the state beside it. False: the search is over."""
        if not self.log["points"]:
            self.free("run")
            self.go(mean_height=self.statics.mean_height)
        getattr(self, "_" + self.log["stage"])()
        return self.log["stage"] != "done"

    def _inwards(self) -> None:
        before = self.now
        try:
            lost = self.go(mean_height=before["z"] - self.case["step"])
        except PhysicsError as error:
            if before["force"] < 0.0:  # a state may lie before the next point
                self.free(self._way())
            return self._end("the next point inwards failed: " + str(error).splitlines()[0])
        if before["force"] < 0.0 <= self.now["force"]:
            self.free(self._way())
        apart, push = self.case["area"] * (1.0 - self.now["contact"]), self.now["force"]
        climb = self.now["energy"] - min(p["energy"] for p in self.log["points"])
        if push > self.case["tension"] * apart:
            self._end("no area left to attract")
        elif push > 0.0 and climb > self.case["deepest"] * apart:
            self._end("no deeper state further in on this path")
        elif lost > LEAST_LOSS * self.spread() and self.log["states"]:
            self._turn_outwards(lost, "inwards")

    def _way(self) -> str:
        """How the next state on the way inwards is found."""
        return "inwards" if any(s["branch"] is not None for s in self.log["states"]) else "approach"

    def _end(self, why: str) -> None:
        press = PRESS * self.case["modulus"]
        if self.now["contact"] == 1.0 and self.now["force"] < press * self.case["area"]:
            with contextlib.suppress(PhysicsError):
                self.go(load=(press + self.case["load"] / self.case["area"]) / MEGAPASCAL)
        self.log.update(ended=why, pressed_to=self.now["force"] / self.case["area"] / MEGAPASCAL)
        self._turn_outwards(0.0, "random")

    def _turn_outwards(self, lost: float, then: str) -> None:
        self.kept["turn"] = self.statics.copy()
        self.log.update(stage="outwards", branch=1 + max(p["branch"] for p in self.log["points"]), turned=self.now,
                        lost=lost, then=then)

    def _outwards(self) -> None:
        """To the next height of the way inwards, until that is joined, or beyond all states."""
        before, inner, points = self.now, self.statics.copy(), self.log["points"]
        ahead = sorted((p["z"], p["energy"]) for p in points if p["branch"] == 0 and p["z"] > before["z"] + 1e-6)
        over = True  # nothing is ahead, or no equilibrium is found there
        with contextlib.suppress(PhysicsError, IndexError):
            z, energy = ahead[0]
            self.go(mean_height=z)
            if before["force"] >= 0.0 > self.now["force"]:
                self.free("outwards", inner)
            over = (self.now["force"] < 0.0 and all(z > s["mean_height"] for s in self.log["states"])) or (
                abs(self.now["energy"] - energy) <= max(0.1 * self.log["lost"], 1e-3 * self.spread()))
        if over:
            self.put(self.kept["turn"])
            points.append(self.log["turned"])
            self.log.update(stage=self.log["then"], branch=0)

    def _random(self) -> None:
        """From the deepest state, the sites displaced sideways by up to half a spacing."""
        if not self.case["lateral"] or "best" not in self.kept or self.log["tried"] == self.starts:
            self.log["stage"] = "done"
            return
        self.log["tried"] += 1
        start, draw = State(self.kept["best"].u, self.kept["best"].top), numpy.random.default_rng(self.log["tried"])
        start.u[:2] += self.case["spacing"] * draw.uniform(-0.5, 0.5, start.u[:2].shape)
        self.free("random start", start)

    def _barrier(self, outer: dict[str, Any], inner: dict[str, Any]) -> float | None:
        """The largest pressure on the way to the next state, MPa: on the branch of the first to its inner end, and
        inwards from there, to the instability that the branch of the second begins with."""
        points, first = self.log["points"], outer["branch"]
        end = min([inner["mean_height"]] + [p["z"] for p in points if 0 != p["branch"] == inner["branch"] != first])
        turn = min(p["z"] for p in points if p["branch"] == first)
        largest = max((p["force"] for p in points if end <= p["z"] < outer["mean_height"]
                       and p["branch"] == (0 if p["z"] < turn else first)), default=0.0)
        return largest / self.case["area"] / MEGAPASCAL if largest > 0.0 else None

    def result(self) -> dict[str, Any]:
        log, states = self.log, sorted(self.log["states"], key=lambda s: -s["mean_height"])
        if not states:
            raise PhysicsError(f"{self.case['name']}: no state was found under this load")
        on_path = [s for s in states if s["branch"] is not None]
        for outer, inner in zip(on_path, on_path[1:]):
            outer["barrier"] = self._barrier(outer, inner)
        energy = {name: s["binding_energy"] for s in states for name in s["found"]}
        innermost, random = min(p["z"] for p in log["points"]), sum(s["found"] == ["random start"] for s in states)
        misses = [f"states whose force passes the load and comes back within {self.case['step']:.3g} Å",
                  f"branches that no instability of this path leads to, or one that loses less than {LEAST_LOSS:.1%} "
                  "of the energies met", f"states below a mean height of {innermost:.2f} Å"]
        misses += [f"states in which sites rest in other hollows: {log['tried']} random starts led to "
                   f"{random or 'none'} of which the path leads to none"] * self.case["lateral"]
        misses += [f"the ends of {log['failed']} relaxations that did not reach drive.tolerance"] * (log["failed"] > 0)
        return {"states": [{**{name: s[name] for name in NUMBERS}, "barrier": s.get("barrier"), "found": s["found"]}
                           for s in states],
                "deepest": max(range(len(states)), key=lambda i: states[i]["binding_energy"]),
                "approach_less_run": energy["approach"] - energy["run"] if {"approach", "run"} <= {*energy} else None,
                "points": len(log["points"]), "step": self.case["step"], "innermost": innermost,
                "pressed_to": log["pressed_to"], "ended": log["ended"], "may_miss": misses, "units": UNITS}

    def save(self, out: files.Outputs) -> None:
        states = {**self.kept, "here": self.statics.copy()}
        with out.replacing(UNFINISHED) as beside, open(beside, "wb") as file:
            numpy.savez(file, log=json.dumps([self.case["scene"], self.log, {n: s.top for n, s in states.items()}]),
                        **{name: state.u for name, state in states.items()})

    def resume(self, place: Path) -> None:
        try:
            with numpy.load(place) as kept:
                scene, log, tops = json.loads(str(kept["log"]))
                states = {name: State(kept[name], top) for name, top in tops.items()}
        except (OSError, ValueError, KeyError) as error:
            raise SceneError(str(place), "cannot be read", str(error), "remove it to begin anew") from None
        if scene != self.case["scene"]:
            raise SceneError(str(place), "is of another scene", "a search goes on with the scene that it began with",
                             "name another directory, or remove it")
        self.put(states.pop("here"))
        self.log, self.kept = log, states


def states(scene: SceneLike, overrides: Overrides | None = None, out: str | os.PathLike | None = None, starts: int = 3,
           report: Callable[[str], None] | None = None) -> dict[str, Any]:
    """Searches for the stable states of a scene under its load. Returns a dictionary:

        states      inwards: binding_energy, elastic_energy (meV/Å²), mean_height (Å), contact_fraction,
                    repulsive_fraction, barrier (MPa: the largest pressure on the path to the next), found (how)
        deepest     the number of the one that binds most
        may_miss    what such a search does not find

    out: a directory for states.json, where a search that was stopped goes on. starts: random lateral displacements
    that are tried. report is told how far it is.
    """
    program.refuse_ranks()
    place = None if out is None else files.chosen(os.fspath(out), "")
    with contextlib.ExitStack() as stack:
        if place:
            stack.enter_context(files.in_use(place))
        if place and (place / RESULT).exists():
            raise SceneError(str(place), "already holds a result, states.json", "results are not written over",
                             "name another directory, or remove this one")
        relaxed = [*assignments(overrides), "block.prony=[]", "drive.path=relax"]  # the block has relaxed
        search, saved = Search(Statics(scene, relaxed), starts), time.monotonic()
        if place:
            inputs = () if isinstance(scene, Mapping) else inputs_of(str(scene), tomllib.loads(search.case["scene"]))
            out = stack.enter_context(files.outputs(place, (RESULT, UNFINISHED), renew=False, inputs=inputs))
        if place and (place / UNFINISHED).exists():
            search.resume(place / UNFINISHED)
        while search.advance():
            if report:
                report(f"{search.log['stage']}, {search.now['z']:.2f} Å, states: {len(search.log['states'])}")
            if place and time.monotonic() - saved >= SAVE_EVERY:
                search.save(out)
                saved = time.monotonic()
        found = search.result()
        if place:
            out.write(RESULT, files.sealed_json({"name": search.case["name"], **found}))
            (place / UNFINISHED).unlink(missing_ok=True)
    return found


def states_command(scene: str, sets: list[str], out: str | None, starts: int, progress: str) -> int:
    """`asperity states`: its exit code."""
    warnings.showwarning = lambda message, *_: print(f"note: {message}", file=sys.stderr)
    place, shown = Path(out if out is not None else f"results/{Path(scene).stem}-states"), Progress(progress)
    try:
        found = states(scene, sets, place, starts, lambda text: shown.update(text) if shown.due() else None)
    except KeyboardInterrupt:
        print("Stopped early: the same command goes on from here.")
        return 75
    finally:
        shown.finish()
    def cell(state: dict, name: str) -> str:
        return f"{state[name]:.4g}" + f" ({millijoules(state[name])})" * (name in ("binding_energy", "elastic_energy"))

    rows = [[*(cell(s, name) for name in NUMBERS), f"{s['barrier']:.3g}" if s["barrier"] else "-",
             ", ".join(s["found"])] for s in found["states"]]
    print(table(["binding energy, meV/Å² (mJ/m²)", "elastic, meV/Å² (mJ/m²)", "mean height, Å", "contact", "repulsive",
                 "to the next, MPa", "found by"], rows, left=(6,)))
    deepest = found["states"][found["deepest"]]["binding_energy"]
    print(f"The deepest state has a binding energy of {deepest:.4g} meV/Å² ({millijoules(deepest)} mJ/m²). The path went in to a "
          f"mean height of {found['innermost']:.2f} Å and {found['pressed_to']:.4g} MPa; it ended because: {found['ended']}.")
    if found["approach_less_run"]:
        less = found["approach_less_run"]
        print(f"The state after an approach binds by {less:+.3g} meV/Å² ({less * MILLIJOULE:+.3g} mJ/m²) relative to that of a run.")
    print("May be missed: " + "; ".join(found["may_miss"]) + f".\n{place / RESULT}")
    return 0
