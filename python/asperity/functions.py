# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Functions for the commands that need no run, and `cost`. Each returns the content that its command prints."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from .arguments import checks_call
from .commands.theory import computed
from .errors import BY_CODE, InternalError, Named, SceneError, Stopped
from .maps.convert import convert
from .reports import cost as report_cost
from .reports.export import export as write_exports
from .results.frames import data_set
from .results.result import Values
from .running import lock, program
from .running.pool import FAILED, PoolOptions, refuse_jobs
from .running.scene import Overrides, SceneLike, assignments, scene_file
from .studies.cost import Cost, Costing, target_of
from .studies.estimates import surface_made
from .terminal import duration, html_table

if TYPE_CHECKING:
    from .results.names import Scene, Theory

__all__ = ["Checked", "Planned", "Surface", "TheoryOfScene", "check", "convert", "cost", "defaults", "export", "plan", "surface", "theory"]


@dataclass
class Checked(Named):
    """A checked scene: its keys with defaults, notes, the longest stable time step of dynamic paths (fs), and the factor by which a
    coarse spacing increases the pull-off force of a sphere."""

    name: str
    scene: Scene
    notes: list[str]
    longest_timestep: float
    edge_pinning: float

    def _repr_html_(self) -> str:
        rows = [(key, str(value)) for section, keys in self.scene.items() if isinstance(keys, dict) for key, value in
                ((f"{section}.{name}", keys[name]) for name in keys)]
        return html_table(self.name, ("key", "value"), rows, "; ".join(self.notes))


@dataclass
class Planned(Named):
    """Estimated cost of a run: number of steps, memory (bytes) and wall time (s) by part, with the sum as "altogether"; and the
    effects, each with "on" and the reason, "because"."""

    name: str
    steps: float
    bytes: dict[str, float]
    seconds: dict[str, float]
    effects: dict[str, dict[str, Any]]
    notes: list[str]

    def _repr_html_(self) -> str:
        rows = [(part, f"{self.bytes.get(part, 0.0) / 1e6:.4g}", duration(self.seconds[part]) if part in self.seconds else "")
                for part in dict.fromkeys([*self.bytes, *self.seconds])]
        return html_table(self.name, ("part", "MB", "time"), rows, "; ".join(self.notes))


@dataclass
class Surface(Named):
    """Surface of a scene: heights [y, x] (Å), their rms (Å), rms slope from neighbouring heights, possible mistakes in the file of
    a map (doubts), and the edge of the box (Å)."""

    heights: np.ndarray
    rms: float
    slope: float
    doubts: list[str]
    edge: float = 0.0

    def _repr_html_(self) -> str:
        rows = [("points", " x ".join(map(str, self.heights.shape))), ("rms, Å", f"{self.rms:.5g}"), ("rms slope", f"{self.slope:.5g}")]
        return html_table("Surface", (), rows, "; ".join(self.doubts))

    def to_xarray(self):
        """Returns the heights as an xarray Dataset over y and x (Å)."""
        return data_set({"heights": (("y", "x"), self.heights)}, {"heights": "Å"}, {"y": self.edge, "x": self.edge})


@dataclass
class TheoryOfScene(Named):
    """Theories of a scene: numbers by their names in result.json (energies in meV/Å²), Δγ (meV/Å²), notes, and the text that the
    command prints."""

    name: str
    theory: Theory
    delta_gamma: float
    notes: list[str]
    text: str

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return html_table(self.name, (), [(name, f"{value:.6g}") for name, value in self.theory.numbers().items()], "; ".join(self.notes))


def _values(found: dict[str, Any]) -> Values:
    """Returns an object of JSON whose members are attributes on every level."""
    return json.loads(json.dumps(found), object_hook=Values)


@checks_call
def check(scene: SceneLike, overrides: Overrides | None = None) -> Checked:
    """Checks a scene without running it.

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.

    Returns
    -------
    Checked
        The scene with its defaults filled in, and notes on it.

    Raises
    ------
    SceneError
        The scene has mistakes; the error lists all.
    """
    with scene_file(scene, overrides=overrides) as file:
        found = _values(program.check(file, assignments(overrides)))
        if found["problems"]:
            raise SceneError.of(found["problems"])
    return Checked(found.text("name"), cast("Scene", found["scene"]), found.listed("notes", str), found.number("longest_timestep", 0.0),
                   found.number("edge_pinning", 1.0))


@checks_call
def plan(scene: SceneLike, overrides: Overrides | None = None) -> Planned:
    """Estimates memory and time of a run of a scene on this machine, from runs of small pieces.

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.

    Returns
    -------
    Planned
        Memory (bytes), wall time (s) and effects.

    Raises
    ------
    SceneError
        The scene is refused.
    """
    with scene_file(scene, overrides=overrides) as file:
        found = _values(program.plan(file, assignments(overrides)))
    return Planned(found.text("name"), found.number("steps", 0.0), found.part("bytes").numbers(), found.part("seconds").numbers(),
                   dict(found.part("effects")), found.listed("notes", str))


@checks_call
def surface(scene: SceneLike, overrides: Overrides | None = None) -> Surface:
    """Makes the surface of a scene without simulating it.

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.

    Returns
    -------
    Surface
        Heights (Å) and their statistics.

    Raises
    ------
    SceneError
        The scene is refused.
    """
    with scene_file(scene, overrides=overrides) as file:
        made = surface_made(file, assignments(overrides))
        keys = Values(program.check(file, assignments(overrides))["scene"])
        edge = keys.number("surface.sites", 0.0) * keys.number("surface.spacing", 0.0)
    return Surface(made.heights, made.rms, made.slope, made.doubts, edge)


@checks_call
def defaults() -> dict[str, dict[str, Any]]:
    """Returns all keys of a scene by name ("surface.rms"), each with kind, unit, default, explanation (doc) and choices."""
    return {key: dict(about) for key, about in program.schema().items()}


@checks_call
def theory(scene: SceneLike, overrides: Overrides | None = None) -> TheoryOfScene:
    """Computes the theories of a scene without simulating it.

        found = asperity.theory("scene.toml", {"surface.rms": 2.0})
        found.theory.persson.gamma_eff, found.theory.renormalised.contact_fraction

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.

    Returns
    -------
    TheoryOfScene
        Numbers of Persson's theory, of the renormalised theory, and of smooth spheres.

    Raises
    ------
    SceneError
        The scene is refused.
    """
    with scene_file(scene, overrides=overrides) as file:
        found = computed(file, assignments(overrides))
    return TheoryOfScene(found.values.text("name"), cast("Theory", found.values.part("theory")), found.values.number("delta_gamma", 0.0),
                         found.notes, found.text)


@checks_call
def cost(scene: SceneLike, overrides: Overrides | None = None, out: str | os.PathLike | None = None, jobs: int = 1,
         parameters: Iterable[str] = (), target: str | float | None = None) -> Cost:
    """Measures error and run time of the scene for numerical settings: one setting varied at a time, and combinations. Existing
    runs are reused; writes cost.csv and figures.

        found = asperity.cost("scene.toml", target="1%")
        found.chosen.setting, found.chosen.seconds      # ["drive.timestep=40"], s; chosen is None if no setting meets the target

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.
    out : str or os.PathLike, optional
        Directory; None: results/<scene>-cost.
    jobs : int
        Number of simultaneous runs, one thread each.
    parameters : iterable of str
        Settings to vary, ["timestep", "layers"]; by default all.
    target : str or float, optional
        Largest relative error, "1%" or 0.01, from numerical settings alone.

    Returns
    -------
    Cost
        Rows with settings, times (s) and relative errors; the first row is the reference, the second the scene itself.

    Raises
    ------
    SceneError
        The scene or an argument is refused, or files would be replaced.
    Stopped
        The runs stopped early; the same call continues.
    Error
        The run of the reference failed.
    """
    program.refuse_ranks()
    refuse_jobs(jobs)
    with scene_file(scene, overrides=overrides) as file:
        costing = Costing(file, assignments(overrides), None if out is None else str(out), PoolOptions(jobs, 1, progress="off"), parameters,
                          None if target is None else target_of(str(target)), lambda _: None, report_cost.FILES)
        with lock.in_use(costing.place):
            complete = costing.carry_out()
            failed = costing.reference.status == FAILED
            if complete and not failed:
                report_cost.write(costing.cost, costing.place)
    if not complete:
        raise Stopped(f"{costing.place}: the runs stopped early", fix="the same call goes on from here")
    if failed:
        raise BY_CODE.get(costing.reference.exit_code, InternalError)(str(costing.place), "the reference failed", costing.reference.reason)
    return costing.cost


@checks_call
def export(directory: str | os.PathLike, to: str, out: str | os.PathLike | None = None) -> list[Path]:
    """Writes the maps and the trajectory of a run for other programs.

    Parameters
    ----------
    directory : str or os.PathLike
        Result directory of a run.
    to : str
        "xyz" (OVITO, ASE), "vtk" (ParaView) or "png".
    out : str or os.PathLike, optional
        Directory of the files; None: export in the directory of the run.

    Returns
    -------
    list of Path
        The written files.

    Raises
    ------
    InputOutputError
        The directory has no maps and no trajectory.
    SceneError
        The format is unknown.
    """
    return write_exports(Path(directory), to, None if out is None else os.fspath(out))
