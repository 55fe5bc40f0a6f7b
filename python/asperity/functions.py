# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Functions for commands of the program that need no run. Each returns the content that its command prints."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from .arguments import checks_call
from .errors import Named, SceneError
from .results.frames import data_set
from .results.result import Values
from .running import program
from .running.scene import Overrides, SceneLike, scene_given
from .studies.estimates import surface_made
from .terminal import duration, html_table

if TYPE_CHECKING:
    from .results.names import Scene

__all__ = ["Checked", "Planned", "Surface", "check", "defaults", "plan", "surface"]


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
    with scene_given(scene, overrides) as (file, sets):
        found = _values(program.check(file, sets))
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
    with scene_given(scene, overrides) as (file, sets):
        found = _values(program.plan(file, sets))
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
    with scene_given(scene, overrides) as (file, sets):
        made = surface_made(file, sets)
        keys = Values(program.check(file, sets)["scene"])
        edge = keys.number("surface.sites", 0.0) * keys.number("surface.spacing", 0.0)
    return Surface(made.heights, made.rms, made.slope, made.doubts, edge)


@checks_call
def defaults() -> dict[str, dict[str, Any]]:
    """Returns all keys of a scene by name ("surface.rms"), each with kind, unit, default, explanation (doc) and choices."""
    return {key: dict(about) for key, about in program.schema().items()}
