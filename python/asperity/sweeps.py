# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Sweeps: one scene (or several), several values of one or more of its keys, one table.

Every point is a scene of its own; all are read and checked before the first is run. A point is simulated by
a process of its own (pool.py) in a directory of its own inside that of the sweep, so the same call resumes
a sweep that was stopped, and adds points to those that are there. A Sweep is what sweep.json holds.
"""

from __future__ import annotations

import contextlib
import math
import os
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import program
from .errors import Error, InputOutputError, SceneError
from .grid import Axis, axes_of, is_seed, points_of, shown
from .pool import DONE, FAILED, STOPPED, Job, Outcome, Pool, PoolOptions, look_at
from .result import Result, Values, read_json
from .scene import SceneLike, assignments, scene_file
from .tables import RENAMED, Table, print_table, write_tables

OVER_FLAT = ("binding_energy", "work_of_adhesion.approach", "work_of_adhesion.pull_off", "work_of_adhesion.pairwise",
             "jkr.in", "jkr.out", "jkr.in_averaged", "jkr.out_averaged", "sphere.maugis_images",
             "states.first.binding_energy", "states.deepest.binding_energy")
"""Energies of a result that also have a column of their ratio to the flat reference."""


@dataclass
class Sweep:
    """The points of one scene. `points` and `theory` (the theory's curves, more finely) are dictionaries as in
    sweep.json: set {key: value}, delta_gamma, theory {...}; of a simulated point directory, status, failure
    and result {column: value}. Energies in meV/Å², lengths in Å."""

    name: str
    scene: dict[str, Any]
    axes: list[str]
    points: list[dict[str, Any]]
    theory: list[dict[str, Any]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    simulated: bool = False
    run: dict[str, Any] = field(default_factory=dict)
    directory: Path = Path()

    @property
    def table(self) -> Table:
        """Its columns by name as numpy arrays, one value a point; table.units, table.frame()."""
        return Table.of_points(self.axes, self.points, self.simulated)

    @property
    def means(self) -> Table:
        """The same with the seeds averaged: mean, .deviation and .count of every column."""
        return self.table.means()

    def results(self) -> list[Result | None]:
        """The Result of each point; None of one without."""
        places = [self.directory / str(p.get("directory", "")) for p in self.points]
        return [Result(place) if self.simulated and (place / "result.json").exists() else None for place in places]

    def plot(self, name: str = "gamma", ax=None):
        """A plot: gamma, area, separation, radius, pull-off or hysteresis over the swept key."""
        from .plots.sweep import draw

        return draw([self], name, ax)

    def report(self) -> Path:
        """Writes report.html into the directory; its path."""
        from .report_sweep import write_sweep_page

        return write_sweep_page(self.directory).path

    def __repr__(self) -> str:
        done = sum(p.get("status") == DONE for p in self.points)
        return f"<Sweep {self.name}: {len(self.points)} points over {', '.join(self.axes)}" + (
            f", {done} done>" if self.simulated else ">")


def load_sweep(directory: str | os.PathLike) -> Sweep:
    """The sweep in a directory. Raises InputOutputError where there is none."""
    path = Path(directory) / "sweep.json"
    found = Values(read_json(path))

    def listed(name: str) -> list[dict[str, Any]]:
        value = found.find(name)
        points = [p for p in value if isinstance(p, dict)] if isinstance(value, list) else []
        for point in points:  # what a hand or another program wrote may lack parts
            for part in ("set", "theory"):
                if not isinstance(point.get(part), dict):
                    point[part] = {}
            if not isinstance(point.get("result", {}), dict):
                del point["result"]
        return points

    if not isinstance(found.find("points"), list):
        raise InputOutputError(str(path), "is no sweep", "it has no list of points",
                               "run the sweep again into another directory")
    points = listed("points")
    scene, axes, notes, run = (found.find(n) for n in ("scene", "axes", "notes", "run"))
    return Sweep(found.text("name") or Path(directory).resolve().name, scene if isinstance(scene, dict) else {},
                 [a for a in axes if isinstance(a, str)] if isinstance(axes, list) else [], points, listed("theory"),
                 [str(n) for n in notes] if isinstance(notes, list) else [],
                 any("result" in p or p.get("directory") for p in points), run if isinstance(run, dict) else {},
                 Path(directory))


def load_sweeps(directory: Path) -> list[Sweep]:
    """The directory's own sweep, or those of several scenes in its folders."""
    if (directory / "sweep.json").exists():
        return [load_sweep(directory)]
    return [load_sweep(p.parent) for p in sorted(directory.glob("*/sweep.json"))]


def columns_of(result: Values) -> dict[str, float]:
    """The numbers of a result.json that a table holds, by column."""
    flat = result.number("delta_gamma")
    found: dict[str, float] = {}
    if isinstance(states := result.find("states.all"), list):
        found["states.count"] = len(states)
    for path, value in result.numbers().items():
        if path.split(".")[0] in ("scene", "units", "failure", "theory") or not math.isfinite(value):
            continue
        if path.startswith("run.") and path != "run.wall_seconds":
            continue
        found[RENAMED.get(path, path)] = value
        if path in OVER_FLAT and flat:
            found[path + "_ratio"] = value / flat
    return found


@dataclass
class _Plan:
    """A scene and its points, read and checked."""

    file: str
    base: dict[str, Any]
    axes: list[Axis]
    fixed: list[str]
    grid: list[list[str]]
    points: list[dict[str, Any]]
    note: str = ""

    @property
    def places(self) -> dict[str, str]:
        return {axis.key: axis.where for axis in self.axes if axis.where}


def _default_axis(file: str, fixed: list[str]) -> Axis:
    """Without a --set of several values: 100 roughnesses to a good way past the end of adhesion."""
    step = 0.1
    with contextlib.suppress(Error):  # no such end, or a scene without roughness
        wanted = 1.4 * Values(program.theory(file, fixed)).number("theory.critical_rms") / 100
        decade = 10.0 ** math.floor(math.log10(wanted))
        step = min((m * decade for m in (1.0, 2.0, 2.5, 5.0, 10.0)), key=lambda s: abs(math.log(s / wanted)))
    return Axis("surface.rms", [f"{i * step:.12g}" for i in range(1, 101)], "surface.rms")


def _plan(file: str, given: list[str], theory_only: bool) -> _Plan:
    axes, fixed = axes_of(given, program.check(file)["sweep"])
    base = program.check(file, fixed)
    if theory_only and not base["theory_needs_surface"]:
        axes = [axis for axis in axes if not axis.is_seed]  # the theory of a target spectrum knows no seeds
    note = ""
    if not axes:
        nothing = "there is nothing to sweep"
        if not theory_only:
            raise SceneError(file, nothing, "neither its [sweep] nor a --set gives several values",
                             "for example --set surface.rms=1,2,3; for a single run: asperity run")
        if base["scene"]["surface"]["kind"] == "flat":
            raise SceneError("asperity sweep", nothing, "no --set gives several values, and a flat surface has no "
                             "roughness to vary", "for example --set drive.load=-100,0,100")
        if any(f.startswith("surface.rms=") for f in fixed):
            raise SceneError("asperity sweep", nothing, "no --set gives several values",
                             "for example --set surface.rms=1,2,3 or surface.rms=0.1:10:0.1")
        axes = [_default_axis(file, fixed)]
        note = (f"no --set gives several values: sweeping surface.rms from {axes[0].values[0]} to "
                f"{axes[0].values[-1]} Å")
    grid = points_of(axes)
    plan = _Plan(file, base, axes, fixed, grid, [], note)
    plan.points = program.theory_points(file, [fixed + point for point in grid], runnable=not theory_only)
    program.complaints(plan.points, plan.places)
    return plan


def _point(axes: list[Axis], point: dict[str, Any]) -> dict[str, Any]:
    """A point of sweep.json from the program's answer."""
    scene = Values(point["scene"])
    return {"set": {axis.key: scene.find(axis.key) for axis in axes},
            "delta_gamma": point.get("delta_gamma"), "theory": point["theory"]}


def plotted_axis(axes: Sequence[str], points: list[dict[str, Any]]) -> str | None:
    """The key along x: of those with numbers the one with the most values."""
    best, most = None, 0
    for key in axes:
        values = [p["set"].get(key) for p in points]
        numbers = all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in values)
        if numbers and not is_seed(key) and len(set(values)) > most:
            best, most = key, len(set(values))
    return best


def _theory_curves(plan: _Plan, points: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The theory between the points: the same axes, one seed, and 61 values along x."""
    x = plotted_axis([a.key for a in plan.axes], points)
    if x is None:
        return []
    axes = []
    for axis in plan.axes:
        values = axis.values[:1] if axis.is_seed else axis.values
        if axis.key == x and program.schema()[x]["kind"] == "number":
            numbers = [p["set"][x] for p in points]
            low, high = min(numbers), max(numbers)
            values = [f"{low + (high - low) * i / 60:.12g}" for i in range(61)]
        axes.append(Axis(axis.key, values))
    found = program.theory_points(plan.file, [plan.fixed + point for point in points_of(axes)])
    program.complaints(found)
    return [_point(axes, point) for point in found]


def _point_name(point: dict[str, Any]) -> str:
    """The directory of a point: "rms=3,seed=1". Sections only where two keys share a name."""
    last = [key.partition(".")[2] for key in point["set"]]
    parts = [f"{key if last.count(short) > 1 else short}={shown(value)}"
             for (key, value), short in zip(point["set"].items(), last)]
    return ",".join(parts).replace("/", "_").replace(" ", "_")


def _fill_in(sweep: Sweep, outcomes: list[Outcome]) -> None:
    for point, outcome in zip(sweep.points, outcomes):
        point["status"] = outcome.status
        point.pop("failure", None)
        if outcome.exit_code:
            point["failure"] = {"exit_code": outcome.exit_code, "reason": outcome.reason}
        point["result"] = columns_of(outcome.result)


@dataclass
class SweepOptions:
    scenes: list[str]
    sets: list[str] = field(default_factory=list)
    out: str = ""
    theory_only: bool = False
    pool: PoolOptions = field(default_factory=PoolOptions)


def _free_directory(asked: str, name: str) -> tuple[Path, str]:
    """Where a sweep of the theory goes, and a note if that is not the expected place."""
    if asked:
        place = Path(asked)
        if place.exists() and not place.is_dir():
            raise SceneError(f"--out {asked}", "is not a directory", "a file of that name is there",
                             "name another directory")
        if (place / "sweep.json").exists():
            raise SceneError(f"--out {asked}", "already holds a sweep", "results are not written over",
                             "name another directory, or remove this one")
        return place, ""
    first = place = Path("results") / f"{name}-theory-sweep"
    number = 2
    while (place / "sweep.json").exists():
        place, number = first.with_name(f"{first.name}-{number}"), number + 1
    return place, "" if place == first else f"{first} already holds a sweep; this one goes to {place}"


def _prepare(options: SweepOptions) -> tuple[list[_Plan], list[Sweep], Path, str]:
    """Plans and tables of all scenes, the directory, and a note about it."""
    plans: list[_Plan] = []
    sweeps: list[Sweep] = []
    for file in options.scenes:
        plan = _plan(file, options.sets, options.theory_only)
        name = plan.base["name"]
        if any(s.name == name for s in sweeps):
            raise SceneError(file, "has the name of another scene of the sweep",
                             "the points of a scene go to a folder of its name", "rename one of the files")
        notes = list(dict.fromkeys(note for point in plan.points for note in point["notes"]))
        sweeps.append(Sweep(name, plan.base["scene"], [a.key for a in plan.axes],
                            [_point(plan.axes, p) for p in plan.points], notes=notes,
                            simulated=not options.theory_only))
        plans.append(plan)
    name, note = "+".join(s.name for s in sweeps), ""
    if options.theory_only:
        place, note = _free_directory(options.out, name)
    else:
        place = Path(options.out or f"results/{name}-sweep")
    for sweep in sweeps:
        sweep.directory = place / sweep.name if len(sweeps) > 1 else place
    return plans, sweeps, place, note


def _jobs(plans: list[_Plan], sweeps: list[Sweep]) -> list[Job]:
    jobs: list[Job] = []
    for plan, sweep in zip(plans, sweeps):
        for point, overrides, found in zip(sweep.points, plan.grid, plan.points):
            point["directory"] = name = _point_name(point)
            place = sweep.directory / name
            if any(job.directory == place for job in jobs):
                raise SceneError("asperity sweep", f"two points are the same: {name}",
                                 "every point has a directory of its own", "give every value once")
            jobs.append(Job(f"{sweep.name}/{name}" if len(sweeps) > 1 else name, place, plan.file,
                            plan.fixed + overrides, found["scene"]))
    return jobs


@dataclass
class _Done:
    """What became of the points. complete: all of them were run."""

    place: Path
    sweeps: list[Sweep]
    jobs: list[Job] = field(default_factory=list)
    outcomes: list[Outcome] = field(default_factory=list)
    complete: bool = True


def carry_out(options: SweepOptions, say: Callable[[str], None]) -> _Done:
    """Runs what is missing and keeps the tables up to date; the theory alone needs no runs."""
    start = time.monotonic()
    plans, sweeps, place, moved = _prepare(options)
    for note in [*(plan.note for plan in plans), moved]:
        if note:
            say(f"note: {note}")
    done = _Done(place, sweeps)
    written = 0.0

    def tables(_: int = -1) -> None:
        nonlocal written
        if _ >= 0 and time.monotonic() - written < 1.0:
            return  # short points; the last call comes at the end
        written = time.monotonic()
        first = 0
        for sweep in sweeps:
            if sweep.simulated:
                _fill_in(sweep, done.outcomes[first:first + len(sweep.points)])
                first += len(sweep.points)
            sweep.run["wall_seconds"] = time.monotonic() - start
            write_tables(sweep)

    if not options.theory_only:
        done.jobs = _jobs(plans, sweeps)
        for plan, sweep in zip(plans, sweeps):
            sweep.theory = _theory_curves(plan, sweep.points)
        done.outcomes = [look_at(job) for job in done.jobs]
        there, failed = (sum(o.status == s for o in done.outcomes) for s in (DONE, FAILED))
        say(f"{len(done.jobs)} points in {place}" + (f"; {there} are there already" if there else "")
            + (f"; {failed} failed before, and are left alone" if failed else ""))
        done.complete = Pool(done.jobs, done.outcomes, options.pool).run(tables)
    tables()
    return done


def sweep_command(options: SweepOptions) -> int:
    """`asperity sweep`: its exit code, 75 if stopped before the end, else that of the first failure."""
    from .plots.sweep import write_plots

    if not options.theory_only and "OMPI_COMM_WORLD_SIZE" in os.environ:
        raise SceneError("asperity sweep", "a sweep of simulations is not started under mpirun",
                         "it starts its points itself, each as a run of its own",
                         'asperity sweep SCENE --launch "mpirun -n 2" gives every point two ranks')

    def say(text: str) -> None:
        print(text, flush=True)

    done = carry_out(options, say)
    plots, note = write_plots(done.place, done.sweeps)
    for sweep in done.sweeps:
        say("")
        print_table(sweep)
        for said in sweep.notes:
            say(f"note: {said}")
    if note:
        say(f"note: {note}")
    code = 0
    for job, outcome in zip(done.jobs, done.outcomes):
        if outcome.status == FAILED:
            say(f"failed: {job.name} (exit {outcome.exit_code}): {outcome.reason}")
            code = code or outcome.exit_code
    if options.theory_only:
        say(f"{sum(len(s.points) for s in done.sweeps)} points in {done.place}")
    else:
        say(f"{sum(o.status == DONE for o in done.outcomes)} of {len(done.jobs)} points are done, in {done.place}")
    say("tables: sweep.csv, sweep.json, sweep.h5; plots:" + "".join(f" {p.name}" for p in plots))
    if not done.complete:
        say("Stopped early: the same command goes on from here.")
        return STOPPED
    return code


def sweep(scene: SceneLike, values: Mapping[str, Any] | None = None, out: str | os.PathLike | None = None,
          jobs: int = 1, theory_only: bool = False) -> Sweep:
    """Simulates a scene for every combination of the values; returns its Sweep, whose table has all points.

    values     {"surface.rms": [0.5, 1, 2], "surface.seed": "1:3:1", "drive.load": 0}; beside the scene's [sweep]
    out        the directory; None: results/<scene>-sweep. Points that are there are not run again.
    jobs       points side by side; they share the processors
    theory_only   the theory alone, no simulation
    """
    given = [f"{key}={','.join(shown(v) for v in value) if isinstance(value, (list, tuple)) else value}"
             if not isinstance(value, (int, float)) else f"{key}={shown(value)}"
             for key, value in (values or {}).items()]
    with scene_file(scene) as file:
        options = SweepOptions([file], assignments(given), str(out or ""), theory_only,
                               PoolOptions(jobs=jobs, progress="off"))
        return carry_out(options, lambda text: None).sweeps[0]
