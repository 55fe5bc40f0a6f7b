# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A scene varied in one of its settings at a time, by rule from the scene, and the runs of these variations. `cost` and
`estimate` are two views of these runs: errors against time, and numbers with their errors.

Each run is a process of its own in a directory of its own; those that are there are not run again.
"""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from ..errors import SceneError, UnknownName
from ..files import store
from ..results.result import Values
from ..running import program
from ..running.pool import DONE, WAITING, Job, Outcome, Pool, PoolOptions, look_at, look_at_all
from ..running.scene import inputs_of
from .forecast import START, Forecast, seconds_of

NAN = float("nan")
Setting = list[str]
"""Keys of the scene and what they are set to: "section.key=value"."""
Choice = tuple[str, Setting]
"""A value in words, and the setting that makes it."""
AT_REST = ["drive.mode=quasistatic"]
LENGTHS = {"lennard-jones": "interface.r0", "morse": "interface.morse_r_min"}
"""The keys of the lengths of potentials that have a tail."""


def joined(first: Setting, then: Setting) -> Setting:
    """Returns the settings joined; later settings of a key replace earlier ones."""
    later = {one.partition("=")[0] for one in then}
    return [one for one in first if one.partition("=")[0] not in later] + then


@dataclass(eq=False)
class Variation:
    """A setting to run and what came of it."""

    parameter: str
    label: str
    setting: Setting
    scene: str = field(default="", kw_only=True)  # the file of a scene of its own; "": the scene that is varied
    outcome: Outcome = field(default_factory=Outcome, kw_only=True)
    seconds: float = field(default=NAN, kw_only=True)  # of the processor

    def take(self, outcome: Outcome) -> None:
        """Takes the outcome of the run, and its time if the run is done."""
        self.outcome = outcome
        if outcome.status == DONE:
            self.seconds = outcome.result.number("run.processor_seconds", NAN)


class Variations:
    """The settings of a scene that can be varied, and to what."""

    def __init__(self, keys: dict[str, Any], longest_timestep: float):
        """Sets the scene. keys: the scene as it is used; longest_timestep: its stability limit, fs. Raises SceneError for a
        scene whose runs cannot be compared."""
        self.scene = scene = Values(keys)
        self._refuse((("drive.temperature", scene.number("drive.temperature"),
                       "differences between runs would be those of their noise", "measure the same scene at 0 K"),
                      ("drive.max_steps", scene.number("drive.max_steps"), "runs that are cut off cannot be compared",
                       "leave it out")))
        path = scene.find("drive.path")
        self.dynamic = scene.text("drive.mode") == "dynamic" and "relax" not in path
        self.moves = "approach" in path or "pull-off" in path
        self.finite = scene.text("block.strain") == "finite"
        self.wall = scene.text("interface.kind") == "wall"
        self.sites, self.thickness = int(self.own("surface.sites")), int(self.own("block.thickness"))
        self.edge = self.sites * self.own("surface.spacing")
        self.continuous = self.wall and scene.text("interface.law") != "smeared"  # without atoms, and without a cutoff
        self.length = (not self.continuous) * self.own(LENGTHS.get(scene.text("interface.potential"), ""))
        self.mixed = (not self.wall and scene.text("surface.kind") != "atoms"
                      and self.own("surface.lattice_ratio") == 1 and scene.text("interface.potential") != "table")
        self.second_solid = scene.text("surface.counter") not in ("", "none")
        self.longest_timestep = longest_timestep

    def _refuse(self, cases: tuple) -> None:
        problems = [{"where": "", "what": f"{key} = {self.scene.find(key)}", "why": why, "fix": fix}
                    for key, wrong, why, fix in cases if wrong]
        if problems:
            raise SceneError.of(problems)

    def refuse_finite_strain(self, fix: str) -> None:
        """Refuses a scene at finite strain, with this remedy. Raises SceneError."""
        self._refuse((("block.strain", self.finite, "errors are measured against the quasi-static path, and there is "
                       "none at finite strain", fix),))

    def own(self, key: str) -> float:
        """Returns a number of the scene, or that of its word; 0: it has none."""
        word = self.scene.text(key)
        if key == "surface.q_max" and word == "nyquist":
            return float(self.sites // 2)
        if key == "interface.cutoff" and word == "4 r0":
            return 4 * self.zero
        return self.scene.number(key, 0.0)

    @property
    def zero(self) -> float:
        """Zero of the potential, Å; 0 for a table."""
        shift = math.log(2) / self.own("interface.morse_a") if self.scene.text("interface.potential") == "morse" else 0.0
        return self.own(LENGTHS.get(self.scene.text("interface.potential"), "")) - shift

    @staticmethod
    def worded(key: str, value: float) -> str:
        """Spells a value of a key with its unit."""
        return f"{value:.6g} {program.schema()[key].get('unit') or 'layers' * (key == 'block.thickness')}".strip()

    def at(self, key: str, *values: float) -> list[Choice]:
        """Returns choices of a key."""
        return [(self.worded(key, v), [f"{key}={v:.6g}"]) for v in values]

    def scaled(self, key: str, *factors: float) -> list[Choice]:
        """Returns choices of a key as multiples of the scene's value."""
        return self.at(key, *(f * self.own(key) for f in factors))

    def stable(self, *factors: float) -> list[Choice]:
        """Returns the time steps below the limit."""
        return self.scaled("drive.timestep", *(f for f in factors
                                               if f * self.own("drive.timestep") < 0.9 * self.longest_timestep))

    def cut(self, tail: bool, *cutoffs: float) -> list[Choice]:
        """Returns choices of the cutoff."""
        return [(label + " + tail" * tail, [*setting, f"interface.tail={str(tail).lower()}"])
                for label, setting in self.at("interface.cutoff", *cutoffs)]

    def spaced(self, factor: float) -> Setting:
        """Returns the setting of the same surface and block at a multiple of the spacing."""
        own = self.own
        waves = [f"surface.q_max={min(own('surface.q_max'), self.sites // 2):.10g}"] if self.scene.text("surface.kind") == "self-affine" else []
        points = ["surface.resample=band-limited"] * self.second_solid  # its map keeps its points
        return [f"surface.spacing={factor * own('surface.spacing'):.10g}", f"surface.sites={self.sites / factor:.0f}",
                f"block.thickness={self.thickness / factor:.0f}", *waves, *points]

    def meshes(self, *factors: float) -> list[Choice]:
        """Returns choices of the spacing of a block over a wall, as a lattice and as a continuum, from coarse to fine; none that
        does not show all waves of the surface."""
        waves = self.own("surface.q_max") if self.scene.text("surface.kind") == "self-affine" else 0.0
        fit = [factor for factor in factors if self.sites % max(1, factor) == 0 and 2 * factor * waves <= self.sites]
        return [(f"{self.worded('surface.spacing', factor * self.own('surface.spacing'))}, {model}",
                 [*self.spaced(factor), f"block.model={model}"]) for factor in fit for model in ("lattice", "continuum")]

    def layers(self, *counts: int) -> list[Choice]:
        """Returns choices of the layers per level of a multiscale block."""
        return [(f"{m} a level", [f"block.layers_per_level={m}", "block.model=multiscale"]) for m in counts]

    @property
    def lattice(self) -> list[Choice]:
        """Choice of a block without coarse levels."""
        return [("lattice", ["block.model=lattice"])]

    def precisions(self, *words: str) -> list[Choice]:
        """Returns choices of numerics.precision."""
        return [(word, ["numerics.precision=" + word]) for word in words]


class Runs:
    """Settings that make the same scene are one run."""

    def __init__(self, scene: str, overrides: list[str], directory: Path, options: PoolOptions,
                 say: Callable[[str], None] = functools.partial(print, flush=True)):
        self.scene, self.directory, self.options, self.say = scene, directory, options, say
        self.common = joined(overrides, ["output.fields=relaxed", "output.trajectory=none"])  # those would be timed too
        self.made: dict[str, Job] = {}
        self.known: dict[tuple[str, ...], Job] = {}

    def jobs(self, rows: Sequence[Variation]) -> list[Job]:
        """Returns the run of each row, checked. Raises SceneError with all mistakes."""
        new = {(row.scene, *row.setting): row for row in rows if (row.scene, *row.setting) not in self.known}
        for file in dict.fromkeys(row.scene for row in new.values()):
            some = {key: row for key, row in new.items() if row.scene == file}
            place, common = file or self.scene, [] if file else self.common
            overrides = [joined(common, row.setting) for row in some.values()]
            points = program.theory_points(place, overrides, runnable=True)
            program.complaints(points)
            for (key, row), given, point in zip(some.items(), overrides, points):
                parts = [Path(file).stem] * bool(file) + [one.partition(".")[2] for one in sorted(row.setting)]
                name = ",".join(parts) or "scene"
                self.known[key] = self.made.setdefault(json.dumps(point["scene"]),
                                                       Job(name, self.directory / name, place, given, point))
        return [self.known[(row.scene, *row.setting)] for row in rows]

    def run(self, rows: Sequence[Variation]) -> bool:
        """Runs the rows and hands them their outcomes. False: stopped before the end."""
        of_row = self.jobs(rows)
        jobs = list({id(job): job for job in of_row}.values())
        outcomes = look_at_all(jobs, self.say)
        there = sum(o.status != WAITING for o in outcomes)
        self.say(f"{len(jobs)} run{'s' * (len(jobs) != 1)} in {self.directory}" + f"; {there} are there already" * (there > 0))
        complete = Pool(jobs, outcomes, self.options, self.directory).run()
        of_job = {id(job): outcome for job, outcome in zip(jobs, outcomes)}
        for row, job in zip(rows, of_row):
            row.take(of_job[id(job)])
        return complete


class Varied(Protocol):
    """A group of variations by a name that can be asked for: a part of an error, a parameter."""

    @property
    def name(self) -> str:
        """Name of the group on the command line."""


class Study:
    """A scene, checked, with its variations and their runs in a directory."""

    def __init__(self, scene: str, overrides: list[str], out: str | None, kind: str, options: PoolOptions,
                 say: Callable[[str], None], files: Iterable[str], notes: Iterable[str] | None = None):
        """Checks the scene and its directory. kind: "cost", the end of the default directory's name; files: those that the study
        will write there; notes: what was said of a scene that a study wrote; None: those of `check` are said. Raises SceneError."""
        self.answer = program.check(scene, overrides)
        self.keys, self.name = self.answer["scene"], self.answer["name"]
        self.varied = Variations(self.keys, self.answer.get("longest_timestep", 0.0))
        if self.answer["problems"]:
            raise SceneError.of(self.answer["problems"])
        self.notes: list[str] = list(self.answer["notes"] if notes is None else notes)
        self.said = tuple(self.notes)
        for note in self.said if notes is None else ():
            say(f"note: {note}")
        self.place, self.inputs = store.chosen(out, f"results/{self.name}-{kind}"), inputs_of(scene, self.keys)
        store.require_free({self.place: files}, inputs=self.inputs)
        self.runs = Runs(scene, overrides, self.place, options, say)

    def forecast_of(self, rows: Sequence[Variation], beyond: str = "") -> Forecast:
        """Returns the runs of some rows that are left, and their time."""
        once = {id(job): (job, row) for job, row in zip(self.runs.jobs(rows), rows)}
        left = [row for job, row in once.values() if look_at(job).status == WAITING]
        base: dict[tuple[str, ...], float] = {}
        work = 0.0
        for row in left:
            key = ("drive.mode=quasistatic",) * ("drive.mode=quasistatic" in row.setting and self.varied.dynamic)
            if key not in base:
                base[key] = seconds_of(self.runs.scene, [*self.runs.common, *key])
            factor = {"mirrored": 4.0, "finer": 4.0, "quarter": 0.25}.get(row.parameter, 1.0) * work_of(row.setting, self.varied)
            work += START + factor * base[key]
        return Forecast(self.name, self.place, len(once), len(left), work / max(1, self.runs.options.jobs), beyond)

    @staticmethod
    def require_known(names: Iterable[str], groups: Iterable[Varied], option: str) -> None:
        """Checks that groups of these names exist. Raises SceneError."""
        there = [group.name for group in groups]
        for name in names:
            if name not in there:
                raise UnknownName(f"{option} {name}", "is none of them", "this scene has " + ", ".join(there),
                                 f"name some of these, or leave {option} out for all of them")


def work_of(setting: Setting, scene: Variations) -> float:
    """Estimates the run time of a setting relative to that of the scene."""
    set_to = dict(one.split("=", 1) for one in setting)

    def ratio(key: str) -> float:
        return float(set_to[key]) / scene.own(key) if key in set_to and scene.own(key) else 1.0

    return (ratio("surface.sites") ** 2 * max(1.0, ratio("interface.cutoff")) * max(1.0, ratio("drive.displacement_step") ** -0.5)
            / (ratio("drive.timestep") * ratio("drive.velocity")))
