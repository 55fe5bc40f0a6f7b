# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The engine in a loop of your own: Simulation, a scene that is stepped, and Statics, one without time."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
import sys
import weakref
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy

from . import program
from .errors import InputOutputError, SceneError
from .scene import Overrides, SceneLike, assignments, scene_file

NAME = "asperity._engine"


def load() -> Any:
    """The compiled module: of this package, or of the build that the program is of. Raises ImportError."""
    if NAME in sys.modules:
        return sys.modules[NAME]
    folders = [Path(__file__).parent]
    try:
        folders.append(Path(program.path()).resolve().parents[1] / "library")
    except (InputOutputError, IndexError):
        pass
    for folder in folders:
        for ending in importlib.machinery.EXTENSION_SUFFIXES:
            file = folder / ("_engine" + ending)
            if not file.is_file():
                continue
            if "OMP_WAIT_POLICY" not in os.environ:  # threads that wait sleep soon, as with the script `asperity`
                os.environ.setdefault("GOMP_SPINCOUNT", "3000")
            spec = importlib.util.spec_from_file_location(NAME, file)
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            sys.modules[NAME] = module
            return module
    raise ImportError(
        "asperity.Simulation and asperity.Statics need the compiled module asperity._engine, which was not found\n"
        f"    why: this build has none for Python {sys.version_info.major}.{sys.version_info.minor} "
        f"(looked in {', '.join(map(str, folders))})\n"
        "    fix: install pybind11-dev, python3-pybind11 and python3-dev, and build Asperity again", name=NAME)


_engine = load()
RestState, SiteMaps, Energies, Point = _engine.RestState, _engine.SiteMaps, _engine.Energies, _engine.Point


class Components(NamedTuple):
    """The three components of a field, each an array [y, x]. numpy.stack(field, -1) copies them to [y, x, 3]."""

    x: numpy.ndarray
    y: numpy.ndarray
    z: numpy.ndarray


class Top:
    """The block's rigid top plane. The scene's drive leads it until a velocity is given."""

    def __init__(self, simulation: Simulation):
        self._simulation = simulation

    @property
    def position(self) -> float:
        """Displacement since the start, Å. Written: the plane stands there in the next step, at once."""
        return self._simulation._top_position

    @position.setter
    def position(self, z: float) -> None:
        self._simulation._top_position = z

    @property
    def velocity(self) -> float:
        """Velocity in the next step, m/s; positive moves away. Written: kept from then on, and the scene's path
        ends nowhere; None: back to the scene's drive, where that was."""
        return self._simulation._top_velocity

    @velocity.setter
    def velocity(self, v: float | None) -> None:
        if v is None:
            self._simulation._release_top()
        else:
            self._simulation._top_velocity = v


class Substrate:
    """The rigid substrate."""

    def __init__(self, simulation: Simulation):
        self._simulation = simulation

    @property
    def height(self) -> numpy.ndarray:
        """Heights of its atoms, Å, a view [y, x] to be read."""
        return self._simulation._substrate_height

    @property
    def edge(self) -> float:
        """Edge of the periodic box, Å."""
        return self._simulation._substrate_edge


class Simulation(_engine.Simulation):
    """A scene's path in time, a step at a time.

        sim = asperity.Simulation("scene.toml", {"surface.rms": 2.0})
        while not sim.done:
            sim.step(100)
            print(sim.time, sim.force, sim.contact)

    scene      a TOML file, or a dictionary of its sections: {"surface": {"sites": 64}}
    overrides  {"surface.rms": 2.0, "drive.load": "100 MPa"}; numbers are in the units of docs/reference/scene.md

    The path starts and turns as `asperity run` has it, to the same bits. A step takes forces at its start and
    then moves the sites: time, force and energies are of that start, as in the rows of a run's series, and u has
    moved on by one step. Energies and contacts are summed in observed steps: the last of each step(), each
    output.series-th, and those of observers.

    One process, on all its threads (OMP_NUM_THREADS). Raises SceneError for a scene that has no time, or that a
    run would refuse.
    """

    def __init__(self, scene: SceneLike, overrides: Overrides | None = None):
        with scene_file(scene) as file:
            super().__init__(file, assignments(overrides))
        self._observers: list[Callable] = []

    @classmethod
    def resume(cls, file: str | os.PathLike) -> Simulation:
        """The simulation that save() wrote, which goes on to the same bits. Observers are given anew."""
        simulation = cls.__new__(cls)
        _engine.Simulation.__init__(simulation, os.fspath(file))
        simulation._observers = []
        return simulation

    @property
    def top(self) -> Top:
        """The top plane: .position (Å) and .velocity (m/s), to be read and written."""
        return Top(self)

    @property
    def substrate(self) -> Substrate:
        """The substrate: .height (Å, [y, x]) and .edge (Å)."""
        return Substrate(self)

    def every(self, n: int, observer: Callable[[Simulation], Any]) -> None:
        """Calls observer(simulation) after each step whose number divides by n, the first one included.

        It looks and writes as a script does between two steps, but does not step. What it raises ends step().
        """
        if not callable(observer):
            raise SceneError("every", "is given no function", f"{observer!r} cannot be called",
                             "give a function of the simulation")
        # The engine must not keep alive what keeps the engine alive.
        itself, number = weakref.ref(self), len(self._observers)
        self._every(n, lambda: itself()._observers[number](itself()))
        self._observers.append(observer)


class Statics(_engine.Statics):
    """A scene without time: its solids in force balance, where a script leads them.

        statics = asperity.Statics("scene.toml")
        for height in (6.0, 4.0, 3.0, 4.0, 6.0):
            statics.mean_height = height
            point = statics.relax()
            print(point.mean_height, point.force, point.dissipated)

    It starts out of reach. What is found depends on the way there, as on a path of `asperity run`, and what is
    lost on it is counted. The mean height is held, or the top plane: the first one that is written decides (a
    load holds what drive.hold of the scene says). Of a scene in time the same solids are taken, as if
    drive.mode were "quasistatic". scene and overrides are as for Simulation.
    """

    def __init__(self, scene: SceneLike, overrides: Overrides | None = None):
        with scene_file(scene) as file:
            super().__init__(file, assignments(overrides))

    @property
    def load(self) -> None:
        """Load where the next relax() leads it, written as MPa or "100 MPa"; positive presses.

        Reached where the force comes to it: from below on the way in, from above on the way out. Read
        point.force.
        """
        raise AttributeError("a load is written, not read: the force of a point is point.force, eV/Å")

    @load.setter
    def load(self, pressure: float | str) -> None:
        self._load(pressure)
