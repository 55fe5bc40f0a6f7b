# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Sweeps: one or several scenes with several values of one or more keys, and their table.

Every point is a separate scene; all are read and checked before the first run. A point is simulated by a separate process
(running/pool.py) in a separate directory inside that of the sweep, so that the same call resumes a stopped sweep and adds points to
a finished one. A Sweep has the contents of sweep.json.
"""

from __future__ import annotations

import contextlib
import math
import os
import re
import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from .. import terminal
from ..above import from_above
from ..arguments import checks_call, checks_calls
from ..errors import Error, InputOutputError, Named, SceneError
from ..files import store
from ..results.result import Result, Values, read_json
from ..running import lock, program
from ..running.pool import DONE, FAILED, WAITING, Job, Pool, PoolOptions, look_at_all, refuse_jobs
from ..running.scene import SceneLike, inputs_of, scene_file
from ..theories import combined
from .forecast import Forecast, seconds_of_all
from .grid import Axis, axes_of, in_decades, is_seed, points_of, shown
from .tables import Columns, Table, columns_of, text_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TABLES = "sweep.csv, sweep.json, sweep.h5"
ROUGHNESSES = 100
"""Number of values of a sweep of the theory that is given none."""
CURVE = 31
"""Number of values of a theory's curve between the points."""
TABLE_FILES = ("sweep.csv", "sweep-mean.csv", "sweep.h5", "sweep.json")


@checks_calls
@dataclass
class Sweep(Named):
    """Points of a sweep over one scene.

    Attributes
    ----------
    name : str
        Name of the scene.
    scene : dict
        Sections of the scene.
    axes : list of str
        Swept keys.
    points : list of dict
        Points as in sweep.json: set {key: value}, delta_gamma and theory {...}; simulated points also have directory,
        status, failure and result {column: value}. Energies in meV/Å², lengths in Å.
    theory : list of dict
        Points of the theory's curves, closer than the simulated points.
    notes : list of str
        Notes on the scene.
    simulated : bool
        True unless only the theory was computed.
    run : dict
        Version, compiler and machine of the program.
    directory : Path
        Directory of the sweep.
    """

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
        """Columns by name as numpy arrays, one value per point, with units: table.units, table.frame()."""
        return Table(self.axes, self.points, self.simulated)

    def frame(self):
        """Returns the table as a pandas DataFrame with one row per point; attrs["units"] has the unit of each column."""
        return self.table.frame()

    def to_xarray(self):
        """Returns the table as an xarray Dataset along "point"; attrs["units"] of each variable has its unit."""
        return self.table.to_xarray()

    @property
    def curves(self) -> Table:
        """Columns of the theory's curves; without curves, columns of the points."""
        return Table(self.axes, self.theory, False) if self.theory else self.table

    @property
    def means(self) -> Columns:
        """Columns averaged over the seeds: mean, .deviation and .count of every column."""
        return self.table.means()

    def results(self) -> list[Result | None]:
        """Loads the results of the points.

        Returns
        -------
        list of Result or None
            One result for each point; None for a point without a result.
        """
        places = [self.directory / str(p.get("directory", "")) for p in self.points]
        return [Result(place) if self.simulated and (place / "result.json").exists() else None for place in places]

    def _repr_html_(self) -> str:
        heads, rows, meaning = text_of(self.table)
        return terminal.html_table(self.name, heads, rows, meaning)

    def json(self, table: Table) -> dict[str, Any]:
        """Returns the content of sweep.json, from which the report and the plots of a sweep are made.

        Parameters
        ----------
        table : Table
            Table of the sweep.

        Returns
        -------
        dict
            The content.
        """
        # In a fixed order, whatever was filled in when.
        order = ("set", "delta_gamma", "theory", "directory", "status", "failure", "result")
        found: dict[str, Any] = {"name": self.name, "scene": self.scene, "axes": self.axes,
                                 "points": [{n: p[n] for n in order if n in p} for p in self.points]}
        if self.theory:
            found["theory"] = self.theory
        if self.simulated:
            found["means"] = means = [{"set": values} for values, _ in table.groups]
            for name, average in table.averages().items():
                for line, mean, deviation, count in zip(means, *map(np.ndarray.tolist, average)):
                    if count:
                        line[name] = {"mean": mean, **({"deviation": deviation} if count > 1 else {}), "count": count}
        if self.notes:
            found["notes"] = self.notes
        return {**found, "run": {**self.run, **{name: program.info()[name] for name in ("version", "git", "compiler", "flags")}}}

    def write(self) -> None:
        """Writes the tables to the directory of the sweep."""
        with store.outputs(self.directory, TABLE_FILES) as out:
            self.write_to(out)

    def write_to(self, out: store.Outputs) -> None:
        """Writes the present tables; sweep.json last.

        Parameters
        ----------
        out : store.Outputs
            Writer of the directory's files.
        """
        table = self.table
        means = table.means()

        def csv(columns: Mapping, last: str, words: list[str]) -> str:
            return store.csv_text([[*columns, last], *(
                [*(shown(column[row]) if name in self.axes else column[row] for name, column in columns.items()), word]
                for row, word in enumerate(words))])

        out.write("sweep.csv", csv(table, "status", table.status))
        if self.simulated and any(is_seed(key) for key in self.axes):
            done = [str(sum(table.status[i] == DONE for i in rows)) for _, rows in table.groups]
            out.write("sweep-mean.csv", csv({n: c for n, c in means.items() if not n.endswith(".count")}, "points", done))
        with out.replacing("sweep.h5") as beside, h5py.File(beside, "w") as file:
            for group, columns in (("points", table), ("means", means)):
                made, units = file.create_group(group), columns.units
                for name, values in columns.items():
                    if isinstance(values, list):
                        made.attrs[name] = np.array(values, dtype=h5py.string_dtype())
                    else:
                        made.create_dataset(name, data=np.asarray(values, float)).attrs["unit"] = units[name]
        out.write("sweep.json", store.sealed_json(self.json(table)))

    def text(self) -> str:
        """Returns the table as text, at most about 25 lines, evenly selected; the files have all points."""
        heads, rows, meaning = text_of(self.table)
        stride = max(1, (len(rows) + 19) // 25)
        lines = [f"{self.name}: {meaning}"] if meaning else []
        lines.append(terminal.table(heads, [r for i, r in enumerate(rows) if i % stride == 0 or i + 1 == len(rows)],
                                     (0, len(heads) - 1), tuple(i for i, head in enumerate(heads) if head in self.axes)))
        if stride > 1:
            lines.append(f"  (every {stride}th of {len(rows)} lines; all are in the files)")
        return "\n".join(lines)

    def plot(self, name: str = "gamma", ax: Axes | None = None) -> Axes:
        """Draws a plot over the swept key.

        Parameters
        ----------
        name : str
            "gamma", "area", "separation", "radius", "pull-off", "friction", "sliding-area" or "hysteresis".
        ax : matplotlib Axes, optional
            Axes to draw into; by default new ones.

        Returns
        -------
        Axes
            The axes with the plot.
        """
        return from_above("plots.sweep.draw")([self], name, ax)

    def report(self, out: str | os.PathLike | None = None) -> Path:
        """Writes report.html into a directory.

        Parameters
        ----------
        out : str or Path, optional
            Directory of the page; None: that of the sweep.

        Returns
        -------
        Path
            The file.
        """
        return from_above("reports.sweep.write_sweep_page")(self.directory, out=store.named(out)).path

    def __repr__(self) -> str:
        done = sum(p.get("status") == DONE for p in self.points)
        return f"<Sweep {self.name}: {len(self.points)} points over {', '.join(self.axes)}" + (
            f", {done} done>" if self.simulated else ">")


@checks_call
def load_sweep(directory: str | os.PathLike) -> Sweep:
    """Loads a sweep.

    Parameters
    ----------
    directory : str or Path
        Directory of the sweep.

    Returns
    -------
    Sweep
        The sweep.

    Raises
    ------
    InputOutputError
        If the directory contains no sweep, or sweeps of several scenes.
    """
    path = Path(directory) / "sweep.json"
    if not path.exists() and (several := sorted(path.parent.glob("*/sweep.json"))):
        raise InputOutputError(str(directory), "holds a sweep for each of several scenes",
                               ", ".join(p.parent.name for p in several), f"load one of them: {several[0].parent}")
    if not path.exists():
        raise InputOutputError(str(directory), "holds no sweep", f"{path.name} is not in it" if path.parent.is_dir() else
                               "there is no such directory",
                               "name a directory that asperity sweep has written; of a single run: asperity.load()")
    found = read_json(path)
    if not isinstance(found.find("points"), list):
        raise InputOutputError(str(path), "is no sweep", "it has no list of points",
                               "run the sweep again into another directory")

    def listed(name: str) -> list[dict[str, Any]]:  # what a hand or another program wrote may lack parts
        parts = ("set", "theory", "result")
        return [{**point, **{part: point.part(part) for part in parts if part in point or part != "result"}}
                for point in found.listed(name, dict)]

    points = listed("points")
    return Sweep(found.text("name") or Path(directory).resolve().name, found.part("scene"), found.listed("axes", str),
                 points, listed("theory"), [str(n) for n in found.listed("notes")],
                 any("result" in p or p.get("directory") for p in points), found.part("run"), Path(directory))


def load_sweeps(directory: Path) -> list[Sweep]:
    """Loads the directory's own sweep, or those of several scenes in its folders."""
    if (directory / "sweep.json").exists():
        return [load_sweep(directory)]
    return [load_sweep(p.parent) for p in sorted(directory.glob("*/sweep.json"))]


# From scenes to sweeps.

def _default_axis(file: str, fixed: list[str]) -> Axis:
    """Returns the default axis, without a --set of several values: roughnesses beyond the end of adhesion."""
    step = 0.1
    with contextlib.suppress(Error):  # no such end, or a scene without roughness
        found = program.theory_points(file, [fixed], profile=True)[0]
        wanted = 1.4 * Values(found).number("theory.persson.critical_rms", ROUGHNESSES * step / 1.4) / ROUGHNESSES
        decade = 10.0 ** math.floor(math.log10(wanted))
        step = min((m * decade for m in (1.0, 2.0, 2.5, 5.0, 10.0)), key=lambda s: abs(math.log(s / wanted)))
    return Axis("surface.rms", [f"{i * step:.12g}" for i in range(1, ROUGHNESSES + 1)], "surface.rms")


def _axes(file: str, sets: list[str], of_scene: list[dict[str, str]], theory_only: bool,
          say: Callable[[str], None]) -> tuple[list[Axis], list[str], dict]:
    """Returns the axes, the overrides of every point, and the scene as the program reads it with these and the first values of
    the axes (the file alone need be no scene: it may lack what is swept)."""
    axes, fixed = axes_of(sets, of_scene)
    base = program.check(file, fixed + points_of(axes)[0])
    if theory_only and not base["theory_needs_surface"]:
        axes = [axis for axis in axes if not is_seed(axis.key)]  # the theory of a target spectrum knows no seeds
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
        say(f"note: no --set gives several values: sweeping surface.rms from {axes[0].values[0]} to "
            f"{axes[0].values[-1]} Å")
    return axes, fixed, base


def _point(axes: list[Axis], point: dict[str, Any]) -> dict[str, Any]:
    """Returns a point of sweep.json from the output of theory_points()."""
    scene = Values(point["scene"])
    return {"set": {axis.key: scene.find(axis.key) for axis in axes},
            "delta_gamma": point.get("delta_gamma"), "theory": point["theory"]}


def _theory_curves(file: str, axes: list[Axis], fixed: list[str], points: list[dict[str, Any]],
                   needs_surface: bool) -> list[dict[str, Any]]:
    """Returns the theory between the points: the same axes, CURVE values along x, and one seed unless the surface matters."""
    x = Table([a.key for a in axes], points, False).along
    if x is None or not any("gamma_eff" in p["theory"].get("persson", {}) for p in points):  # none applies to these scenes
        return []
    finer = []
    for axis in axes:
        one = is_seed(axis.key) and not (needs_surface and axis.key == "surface.seed")
        values = axis.values[:1] if one else axis.values
        if axis.key == x and program.schema()[x]["kind"] == "number":
            low, high = (pick(p["set"][x] for p in points) for pick in (min, max))
            between = np.geomspace if in_decades((low, high)) else np.linspace
            values = [f"{value:.12g}" for value in between(low, high, CURVE)]
        finer.append(Axis(axis.key, values))
    found = combined.points(file, [fixed + point for point in points_of(finer)], quick=True)
    return [_point(finer, point) for point in found if "problems" not in point]  # where it has no number


def _told_once(notes: list[list[str]]) -> list[str]:
    """Returns the notes of all points, each once; of those that differ in their numbers alone the first one."""
    alike: dict[str, list[str]] = {}
    for note in (note for of_point in notes for note in dict.fromkeys(of_point)):
        alike.setdefault(re.sub(r"\d[\d.e+-]*", "0", note), []).append(note)
    return [f"{some[0]} (and with other numbers at {len(some) - 1} more points)" if len(set(some)) > 1 else some[0]
            for some in alike.values()]


def _point_name(point: dict[str, Any]) -> str:
    """Returns the directory of a point: "rms=3,seed=1". Sections only where two keys share a name."""
    last = [key.partition(".")[2] for key in point["set"]]
    parts = [f"{key if last.count(short) > 1 else short}={shown(value)}"
             for (key, value), short in zip(point["set"].items(), last)]
    return ",".join(parts).replace("/", "_").replace(" ", "_")


def _prepare(file: str, found: dict[str, Any], sets: list[str], place: Path, prefix: str, theory_only: bool,
             say: Callable[[str], None]) -> tuple[Sweep, list[Job]]:
    """Returns a scene's points, read and checked, and the runs that they need. prefix: of their names."""
    axes, fixed, base = _axes(file, sets, found["sweep"], theory_only, say)
    before = [] if theory_only else _points_before(place, base["scene"], [axis.key for axis in axes])
    overrides = [fixed + point for point in points_of(axes)]
    # So many points of a theory are a curve.
    answers = combined.points(file, overrides, runnable=not theory_only, quick=theory_only and len(overrides) > 40)
    program.complaints(answers, {axis.key: axis.where for axis in axes if axis.where})
    notes = _told_once([answer["notes"] for answer in answers])
    sweep = Sweep(base["name"], base["scene"], [a.key for a in axes], [_point(axes, a) for a in answers], notes=notes,
                  simulated=not theory_only, directory=place)
    jobs: dict[str, Job] = {}
    if theory_only:
        return sweep, []
    for point, given, answer in zip(sweep.points, overrides, answers):
        point["directory"] = name = _point_name(point)
        if name in jobs:
            raise SceneError("asperity sweep", f"two points are the same: {name}",
                             "every point has a directory of its own", "give every value once")
        jobs[name] = Job(prefix + name, place / name, file, given, answer)
    before = [point for point in before if point["directory"] not in jobs]
    if before:
        say(f"note: {len(before)} more points of an earlier call are in {place}: they stay in its tables")
    sweep.points[:0] = before
    sweep.theory = _theory_curves(file, axes, fixed, sweep.points, base["theory_needs_surface"])
    return sweep, list(jobs.values())


def _points_before(place: Path, scene: dict[str, Any], axes: list[str]) -> list[dict[str, Any]]:
    """Returns the finished points of an earlier sweep in the directory. Raises SceneError, before anything is computed, if that
    sweep has another scene or other keys."""
    if not (place / "sweep.json").exists():
        return []
    try:
        there = load_sweep(place)
    except InputOutputError:
        return []  # damaged: the directories of the points are asked
    remedy = "name another directory (--out), or remove this one"
    if not there.simulated:
        raise SceneError(str(place), "holds a sweep of the theory alone", "results are not written over", remedy)
    if set(there.axes) != set(axes):
        raise SceneError(str(place), f"holds a sweep over {', '.join(there.axes)}",
                         f"this one is over {', '.join(axes)}, and the points of a table have the same keys", remedy)

    def fixed(keys: dict[str, Any]) -> dict[str, Any]:
        """Returns the set keys that are no axes."""
        sections = {name: dict(section) if isinstance(section, dict) else section for name, section in keys.items()}
        for section, _, key in (axis.partition(".") for axis in axes):
            if isinstance(sections.get(section), dict):
                sections[section].pop(key, None)
        return sections

    old, new = fixed(there.scene), fixed(scene)
    for section in dict.fromkeys([*new, *old]):
        a, b = (keys.get(section) for keys in (old, new))
        if a != b:
            known, wanted = (part if isinstance(part, dict) else {} for part in (a, b))
            key = next((k for k in dict.fromkeys([*wanted, *known]) if known.get(k) != wanted.get(k)), "")
            raise SceneError(str(place), "holds a sweep of another scene",
                             f"{section}.{key} is {shown(known.get(key))} there and {shown(wanted.get(key))} here"
                             if key else f"they differ in {section}", remedy)
    return [point for point in there.points if point.get("status") == DONE and point.get("directory")]


# Carrying them out.

def _directory(asked: str | None, name: str, theory_only: bool, say: Callable[[str], None]) -> Path:
    """Returns the directory of the sweep. The theory alone resumes nothing: it has a directory of its own."""
    place = store.chosen(asked, f"results/{name}{'-theory' * theory_only}-sweep")
    if not theory_only or not (place / "sweep.json").exists():
        return place
    if asked is not None:
        raise SceneError(f"--out {asked}", "already holds a sweep, sweep.json", "results are not written over",
                         "name another directory, or remove this one")
    free = store.numbered(place, lambda one: (one / "sweep.json").exists())
    say(f"note: {place} already holds a sweep; this one goes to {free}")
    return free


def _checked(scenes: list[str], sets: list[str]) -> dict[str, tuple[str, dict[str, Any]]]:
    """Returns files of scenes and the answers of the program to them, by the names of the scenes. Raises SceneError for two of one name."""
    axes, fixed = axes_of(sets, [])
    answers = [program.check(file, fixed + points_of(axes)[0]) for file in scenes]
    found: dict[str, tuple[str, dict[str, Any]]] = {}
    for file, answer in zip(scenes, answers):
        if answer["name"] in found:
            raise SceneError(file, "has the name of another scene of the sweep",
                             "the points of a scene go to a folder of its name", "rename one of the files")
        found[answer["name"]] = file, answer
    return found


def _place_of(name: str, place: Path, scenes: Mapping[str, Any]) -> Path:
    """Returns the directory of a scene's points: that of the sweep, or a folder in it for each of several scenes."""
    return place / name if len(scenes) > 1 else place


def forecast(scenes: list[str], sets: list[str], out: str | None, theory_only: bool, options: PoolOptions,
             say: Callable[[str], None]) -> Forecast:
    """Returns the runs of sweeps that are left, and their time. Raises SceneError."""
    found = _checked(scenes, sets)
    name = "+".join(found)
    place = _directory(out, name, theory_only, say)
    prepared = [_prepare(file, answer, sets, _place_of(one, place, found), "", theory_only, say) for one, (file, answer) in found.items()]
    for note in dict.fromkeys(note for sweep, _ in prepared for note in sweep.notes):
        say(f"note: {note}")
    jobs = [job for _, some in prepared for job in some]
    left = [job for job, outcome in zip(jobs, look_at_all(jobs, say)) if outcome.status == WAITING]
    return Forecast(name, place, len(jobs), len(left), seconds_of_all(left) / max(1, options.jobs),
                    f"{sum(len(sweep.points) for sweep, _ in prepared)} points of the theory" * theory_only)


class Carried:
    """Finished sweeps of several scenes. complete: True if every point was run."""

    def __init__(self, scenes: list[str], sets: list[str], out: str | None, theory_only: bool, options: PoolOptions,
                 say: Callable[[str], None], also: Iterable[str] = ()):
        """Prepares the points of the scenes. also: names of files that the caller will write."""
        found = _checked(scenes, sets)
        self.place = _directory(out, "+".join(found), theory_only, say)
        self.start, self.written = time.monotonic(), 0.0
        inputs = [one for file, answer in found.values() for one in inputs_of(file, answer["scene"])]
        places = [_place_of(name, self.place, found) for name in found]
        with contextlib.ExitStack() as stack:
            stack.enter_context(lock.in_use(self.place))
            tables = {place: [*TABLE_FILES, *also] for place in (self.place, *places)}
            store.require_free(tables, renew=not theory_only, inputs=inputs)
            self.outputs = [stack.enter_context(store.outputs(place, TABLE_FILES)) for place in places]
            prepared = [_prepare(file, answer, sets, place, f"{name}/" * (len(found) > 1), theory_only, say)
                        for place, (name, (file, answer)) in zip(places, found.items())]
            self.sweeps = [sweep for sweep, _ in prepared]
            self.counts = [len(jobs) for _, jobs in prepared]  # the last points of each sweep
            self.jobs = [job for _, jobs in prepared for job in jobs]
            self.outcomes = look_at_all(self.jobs, say)
            self.complete = True
            if self.jobs:
                there, failed = (sum(o.status == s for o in self.outcomes) for s in (DONE, FAILED))
                say(f"{len(self.jobs)} points in {self.place}" + (f"; {there} are there already" if there else "")
                    + (f"; {failed} failed before, and are left alone" if failed else ""))
                self.complete = Pool(self.jobs, self.outcomes, options, self.place).run(self._write_sometimes)
            self._write()

    def _write_sometimes(self) -> None:
        if time.monotonic() - self.written >= 1.0:  # else points are short; all are written at the end
            self._write()

    def _write(self) -> None:
        """Writes the tables of the finished points."""
        self.written = time.monotonic()
        outcomes = iter(self.outcomes)
        for sweep, count, out in zip(self.sweeps, self.counts, self.outputs):
            programs: Counter[str] = Counter()
            for point, outcome in zip(sweep.points[len(sweep.points) - count:], outcomes):
                point["status"] = outcome.status
                point.pop("failure", None)
                if outcome.exit_code:
                    point["failure"] = {"exit_code": outcome.exit_code, "reason": outcome.reason}
                point["result"] = columns_of(outcome.result)
                if git := outcome.result.text("run.git"):
                    programs[git] += 1
            sweep.run["programs"] = dict(programs)
            sweep.run["wall_seconds"] = time.monotonic() - self.start
            sweep.write_to(out)


def _values(given: Any) -> str:
    """Returns the texts of values for --set: of each member of a sequence, or of a single value."""
    given = given.tolist() if hasattr(given, "tolist") else given  # numpy's
    if isinstance(given, (str, bytes, os.PathLike)) or not isinstance(given, Iterable):
        given = [given]
    plain = (v.item() if hasattr(v, "item") else v for v in given)
    return ",".join(str(v) if isinstance(v, os.PathLike) else shown(v) for v in plain)


@checks_call
def sweep(scene: SceneLike, values: Mapping[str, Any] | None = None, out: str | os.PathLike | None = None,
          jobs: int = 1, theory_only: bool = False, executor: Executor | None = None,
          progress: bool | None = None) -> Sweep:
    """Simulates a scene for every combination of values.

    Parameters
    ----------
    scene : str, Path or dict
        TOML file, or dictionary of the scene's sections.
    values : dict, optional
        Values by key, in addition to the scene's [sweep]: {"surface.rms": np.linspace(0.5, 2, 4), "surface.seed": range(1, 4),
        "surface.hurst": [0.7, 0.8], "drive.load": "0:100:20", "surface.radius": 200}.
    out : str or Path, optional
        Directory; by default results/<scene>-sweep. Existing points are reused.
    jobs : int
        Number of simultaneous runs, which share the processors.
    theory_only : bool
        Compute the theory without simulations.
    executor : concurrent.futures.Executor, optional
        Executor whose workers run the points, one thread each unless their OMP_NUM_THREADS is larger:
        mpi4py.futures.MPIPoolExecutor(), Dask's client.get_executor(). They need this package, the program and the same
        file system.
    progress : bool, optional
        Show progress; by default on a terminal and in a notebook.

    Returns
    -------
    Sweep
        The sweep, whose table has all points.

    Raises
    ------
    SceneError, InputOutputError
        If the scene, a value or the directory is wrong. Points that fail are marked in the table instead.
    """
    refuse_jobs(jobs)
    if executor is None:
        program.refuse_ranks()
    elif not isinstance(executor, Executor):
        raise SceneError(f"executor = {executor!r:.80}", "is no executor", f"it is {type(executor).__name__}, and not of "
                         "concurrent.futures.Executor", "for example mpi4py.futures.MPIPoolExecutor(), or "
                         "client.get_executor() of Dask")
    if values is not None and not isinstance(values, Mapping):
        raise SceneError("values", f"are {values!r:.60}", "keys with their values are needed",
                         'for example {"surface.rms": [1, 2, 3]}')
    given = [f"{key}={_values(value)}" for key, value in (values or {}).items()]
    with scene_file(scene, "" if executor is None else ".") as file:  # workers elsewhere have no /tmp of ours
        return Carried([file], given, None if out is None else str(out), theory_only,
                        PoolOptions(jobs=jobs, progress="auto" if terminal.progress_shown(progress) else "off",
                                                         executor=executor), lambda text: None).sweeps[0]
