# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity states`: the stable states of a contact under its load P that can be reached along a path.

A path at a held mean height moves inwards from beyond the interaction range; whenever its force F passes P, the block is relaxed.
After an instability the new branch is also followed outwards. At the inner end the solids are pressed to full contact, and the path
back is followed. Then random starts are relaxed. docs/explanation/relaxation.md describes the end of the path and the states that
it may miss.
"""

from __future__ import annotations

import contextlib
import json
import os
import time
import tomllib
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy

from ..arguments import checks_call
from ..errors import PhysicsError, SceneError, SceneWarning
from ..files import store
from ..results.result import Values
from ..running import lock, program
from ..running.engine import State, Statics
from ..running.scene import Overrides, SceneLike, assignments, inputs_of, scene_file
from ..terminal import html_table
from ..units import MEGAPASCAL

LEAST_LOSS = 3e-3  # of the range of energies met: an instability that loses less is not followed outwards
NEAR = 0.01  # of the deepest energy found: a random start that ends within it counts as ending there
PRESS = 0.125  # of the contact modulus: how far full contact is pressed
SAVE_EVERY = 5.0  # s
NUMBERS = ("binding_energy", "elastic_energy", "mean_height", "contact_fraction", "repulsive_fraction")
UNITS = dict(zip((*NUMBERS, "barrier", "approach_less_run", "step", "innermost", "pressed_to", "start_energies"),
                 "meV/Å^2 meV/Å^2 Å 1 1 MPa meV/Å^2 Å Å MPa meV/Å^2".split()))
RESULT, UNFINISHED = "states.json", "states-unfinished.npz"


class Search:
    """A search, point by point. save() writes the numbers and texts of `log` and the displacements, from which resume()
    continues."""

    def __init__(self, statics: Statics, starts: int):
        self.statics, self.case, self.starts = statics, statics._case, starts
        self.log: dict[str, Any] = {"stage": "inwards", "states": [], "points": [], "branch": 0, "tried": 0, "failed": 0,
                                    "ends": []}  # binding energies that random starts led to
        self.kept: dict[str, State] = {}  # "turn": where it turned outwards
        self._dissipated = 0.0  # at the last point of the path under way

    @property
    def now(self) -> dict[str, float]:
        """The last point of the search."""
        return self.log["points"][-1]

    def spread(self) -> float:
        """Returns the range of the binding energies met so far, meV/Å²."""
        return float(numpy.ptp([p["energy"] for p in self.log["points"]]))

    def put(self, state: State) -> None:
        """Sets the sites to a state and restarts the count of dissipated energy."""
        self.statics.restore(state)
        self._dissipated = 0.0

    def go(self, **to: float) -> float:
        """Leads the path to a mean height or a load. Returns the energy lost, eV."""
        for name, value in to.items():
            setattr(self.statics, name, value)
        p, load = self.statics.relax(), self.case["load"]
        self.log["points"].append({"z": p.mean_height, "force": p.force - load, "contact": p.contact,
                                   "energy": p.energy + load * p.mean_height, "branch": self.log["branch"]})
        lost, self._dissipated = p.dissipated - self._dissipated, p.dissipated
        return lost

    def free(self, found: str, start: State | None = None) -> float | None:
        """Relaxes the sites under the load, and restores the sites afterwards."""
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
            self.put(here)
            return None
        for known in self.log["states"]:
            if (abs(known["mean_height"] - rest.mean_height) < 0.5 * self.case["step"] and
                    abs(known["binding_energy"] - rest.binding_energy) <= 1e-4 * self.case["scale"]):
                known["found"] += [found] * (found not in known["found"])
                known["branch"] = branch if known["branch"] is None else known["branch"]
                break
        else:
            self.log["states"].append({**{name: getattr(rest, name) for name in NUMBERS}, "found": [found],
                                       "branch": branch})
        self.put(here)
        return rest.binding_energy

    def advance(self) -> bool:
        """Makes a further point and relaxes from it. Returns False if the search is complete."""
        if not self.log["points"]:
            self.free("run")
            self.go(mean_height=self.statics.mean_height)
            self.log["datum"] = self.now["z"] - float(self.statics.copy().u[2].mean())
        getattr(self, "_" + self.log["stage"])()
        return self.log["stage"] != "done"

    def _inwards(self) -> None:
        before = self.now
        try:
            lost = self.go(mean_height=before["z"] - self.case["step"])
        except PhysicsError as error:
            if before["force"] < 0.0:  # a state may lie before the next point
                self.free(self._way())
            problem = error.listed[0]
            return self._end("the next point inwards failed: " + problem["what"] + f" ({problem['why']})" * bool(problem["why"]))
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
        """Returns the way on which the next state inwards is found."""
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
        """Moves to the next height of the way inwards, until the branch joins that way or is beyond all states."""
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
        """Relaxes one more random start. The starts are independent of each other and of the path."""
        if self.log["tried"] == self.starts or not self.case["scale"]:  # without attraction there is one state
            self.log["stage"] = "done"
            return
        self.log["tried"] += 1
        end = self.free("random start", self.laid(numpy.random.default_rng(self.log["tried"])))
        self.log["ends"] += [] if end is None else [end]

    def laid(self, draw: numpy.random.Generator) -> State:
        """Returns a flat layer at a random height, between lying on the whole substrate and on its highest atom.

        Sites that would be closer to the substrate than flat solids at rest are raised to that distance, so that no site is inside
        the substrate. The sites are displaced laterally at random, by up to a random part of half a spacing.
        """
        here, apart = self.statics.copy(), self.case["separation"] - self.log["datum"]
        u, heights = numpy.zeros_like(here.u), numpy.asarray(self.statics.substrate.height)
        level = draw.uniform(heights.min(), heights.max())
        if self.case["lateral"]:
            u[:2] = draw.uniform(0.0, 0.5) * self.case["spacing"] * draw.uniform(-1.0, 1.0, u[:2].shape)
        u[2] = numpy.maximum(level, self._heights_below(u[:2], heights)) + apart
        return State(u, float(u[2].mean()))

    def _heights_below(self, sideways: numpy.ndarray, heights: numpy.ndarray) -> numpy.ndarray:
        """Returns the height of the substrate below each site, Å, [y, x]: of a wall, or between four atoms."""
        if self.case["wall"]:
            return heights
        sites, atoms = sideways.shape[-1], len(heights)
        row, column = numpy.indices((sites, sites)) + 0.5
        x, y = (place * atoms / sites for place in (column + sideways[0] / self.case["spacing"],
                                                    row + sideways[1] / self.case["spacing"]))
        west, south = numpy.floor(x).astype(int), numpy.floor(y).astype(int)
        x, y = x - west, y - south
        low, high = ((1.0 - x) * heights[j % atoms, west % atoms] + x * heights[j % atoms, (west + 1) % atoms]
                     for j in (south, south + 1))
        return (1.0 - y) * low + y * high

    def _barrier(self, outer: dict[str, Any], inner: dict[str, Any]) -> float | None:
        """Returns the largest pressure on the way to the next state, MPa: on the branch of the first to its inner end, and
        inwards from there, to the instability with which the branch of the second begins."""
        points, first = self.log["points"], outer["branch"]
        end = min([inner["mean_height"]] + [p["z"] for p in points if 0 != p["branch"] == inner["branch"] != first])
        turn = min(p["z"] for p in points if p["branch"] == first)
        largest = max((p["force"] for p in points if end <= p["z"] < outer["mean_height"]
                       and p["branch"] == (0 if p["z"] < turn else first)), default=0.0)
        return largest / self.case["area"] / MEGAPASCAL if largest > 0.0 else None

    def result(self) -> dict[str, Any]:
        """Returns the content of states.json. Raises PhysicsError if no state was found."""
        log = self.log
        if not log["states"]:
            raise PhysicsError(f"{self.case['name']}: no state was found under this load")
        best = max(log["states"], key=lambda s: s["binding_energy"])
        states = sorted((s for s in log["states"] if s is best or s["found"] != ["random start"]),
                        key=lambda s: -s["mean_height"])
        on_path = [s for s in states if s["branch"] is not None]
        for outer, inner in zip(on_path, on_path[1:]):
            outer["barrier"] = self._barrier(outer, inner)
        energy = {name: s["binding_energy"] for s in states for name in s["found"]}
        innermost, made = min(p["z"] for p in log["points"]), len(log["ends"])
        misses = [f"states whose force passes the load and comes back within {self.case['step']:.3g} Å",
                  f"branches that no instability of this path leads to, or one that loses less than {LEAST_LOSS:.1%} "
                  "of the energies met", f"states below a mean height of {innermost:.2f} Å"]
        misses += [f"deeper states: a further random start ends in one with a probability of at most "
                   f"{1.0 / (made + 1):.2g}"] * (made > 0)
        misses += [f"the ends of {log['failed']} relaxations that did not reach drive.tolerance"] * (log["failed"] > 0)
        return {"states": [{**{name: s[name] for name in NUMBERS}, "barrier": s.get("barrier"), "found": s["found"]}
                           for s in states],
                "deepest_found": states.index(best), "starts": made, "start_energies": log["ends"],
                "starts_at_deepest": sum(best["binding_energy"] - end <= NEAR * abs(best["binding_energy"])
                                         for end in log["ends"]),
                "deeper_next": 1.0 / (made + 1),
                "approach_less_run": energy["approach"] - energy["run"] if {"approach", "run"} <= {*energy} else None,
                "points": len(log["points"]), "step": self.case["step"], "innermost": innermost,
                "pressed_to": log["pressed_to"], "ended": log["ended"], "may_miss": misses, "units": UNITS}

    def save(self, out: store.Outputs) -> None:
        """Writes the search, so that resume() continues it."""
        states = {**self.kept, "here": self.statics.copy()}
        with out.replacing(UNFINISHED) as beside, open(beside, "wb") as file:
            arrays: dict[str, Any] = {name: state.u for name, state in states.items()}
            numpy.savez(file, log=json.dumps([self.case["scene"], self.log, {n: s.top for n, s in states.items()}]), **arrays)

    def resume(self, place: Path) -> None:
        """Reads a search that save() wrote. Raises SceneError if the file cannot be read or is of another scene."""
        try:
            with store.opened(place) as file, numpy.load(file) as kept:
                scene, log, tops = store.json_of(str(kept["log"]).encode())
                states = {name: State(kept[name], top) for name, top in tops.items()}
        except Exception as error:  # zipfile, zlib and numpy have their own
            raise SceneError(str(place), "cannot be read", str(error), "remove it to begin anew") from None
        if scene != self.case["scene"]:
            raise SceneError(str(place), "is of another scene", "a search goes on with the scene that it began with",
                             "name another directory, or remove it")
        self.put(states.pop("here"))
        self.log, self.kept = log, states


class FoundStates(Values):
    """States of a contact, as returned by states()."""

    _called = "the states"

    def _repr_html_(self) -> str:
        rows = [[f"{state[name]:.4g}" for name in NUMBERS] for state in self["states"]]
        return html_table("Stable states", NUMBERS, rows, f"the path ended because: {self['ended']}")


def _statics(scene: SceneLike, overrides: list[str]) -> Statics:
    """Returns the contact at rest. Notes on the scene as it is written are warnings; those on the keys that are set here are none."""
    relaxed = [*overrides, "block.prony=[]", "drive.path=relax"]  # the block has relaxed
    with scene_file(scene) as file:
        answer = program.check(file, overrides)
    with warnings.catch_warnings():
        if not answer["problems"]:
            warnings.simplefilter("ignore", SceneWarning)
        statics = Statics(scene, relaxed)
    for note in answer["notes"]:
        warnings.warn(note, SceneWarning, stacklevel=4)
    return statics


@checks_call
def states(scene: SceneLike, overrides: Overrides | None = None, out: str | os.PathLike | None = None, starts: int = 20,
           report: Callable[[str], None] | None = None) -> dict[str, Any]:
    """Searches for the stable states of a scene under its load. The dictionary that is returned has

        states      inwards: binding_energy, elastic_energy (meV/Å²), mean_height (Å), contact_fraction,
                    repulsive_fraction, barrier (MPa: the largest pressure on the path to the next), found (how); of those
                    that only random starts led to, the deepest
        deepest_found       the number of the one that binds most among those found
        starts              random starts that were relaxed to a state; start_energies: its binding energy, of each
        starts_at_deepest   how many of them ended within 1 % of its binding energy
        deeper_next         the largest probability that a further start ends deeper
        may_miss            what such a search does not find

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.
    out : str or os.PathLike, optional
        Directory for states.json, in which a search that was stopped continues.
    starts : int
        Number of flat layers, laid on the substrate at random heights, that are relaxed.
    report : callable, optional
        Called with a text on the progress.

    Returns
    -------
    dict
        The states and numbers above.

    Raises
    ------
    SceneError
        The scene is refused, or the directory holds a result or the search of another scene.
    """
    program.refuse_ranks()
    if starts < 0:
        raise SceneError(f"starts = {starts}", "is no number of starts", "", "take 0 or more")
    place = store.named(out)
    written: store.Outputs | None = None
    with contextlib.ExitStack() as stack:
        if place:
            stack.enter_context(lock.in_use(place))
        if place and (place / RESULT).exists():
            raise SceneError(str(place), "already holds a result, states.json", "results are not written over",
                             "name another directory, or remove this one")
        search, saved = Search(_statics(scene, assignments(overrides)), starts), time.monotonic()
        if place:
            inputs = () if isinstance(scene, Mapping) else inputs_of(str(scene), tomllib.loads(search.case["scene"]))
            written = stack.enter_context(store.outputs(place, (RESULT, UNFINISHED), renew=False, inputs=inputs))
        if place and (place / UNFINISHED).exists():
            search.resume(place / UNFINISHED)
        while search.advance():
            if report:
                report(f"{search.log['stage']}, {search.now['z']:.2f} Å, states: {len(search.log['states'])}")
            if written and time.monotonic() - saved >= SAVE_EVERY:
                search.save(written)
                saved = time.monotonic()
        found = search.result()
        if place and written:
            written.write(RESULT, store.sealed_json({"name": search.case["name"], **found}))
            (place / UNFINISHED).unlink(missing_ok=True)
    return FoundStates(found)
