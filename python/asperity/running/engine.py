# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The engine in a loop of your own: Simulation steps a dynamic scene, and Statics relaxes a quasi-static one."""

from __future__ import annotations

import contextlib
import importlib.machinery
import importlib.util
import operator
import os
import sys
import tomllib
import warnings
import weakref
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import h5py
import numpy

from ..arguments import checks_calls
from ..errors import Error, InputOutputError, SceneError, UnknownName
from ..files import store
from ..terminal import Progress, number, sleep_soon
from ..units import GIGAPASCAL
from . import lock, program
from .scene import Overrides, SceneLike, scene_given

NAME = "asperity._engine"


def load() -> Any:
    """Loads the compiled module, from this package or from the build of the program. Raises ImportError."""
    if NAME in sys.modules:
        return sys.modules[NAME]
    folders = [Path(__file__).parents[1]]
    try:
        folders.append(Path(program.path()).resolve().parents[1] / "python")
    except (InputOutputError, IndexError):
        pass
    for folder in folders:
        for ending in importlib.machinery.EXTENSION_SUFFIXES:
            file = folder / ("_engine" + ending)
            if not file.is_file():
                continue
            sleep_soon(os.environ)
            spec = importlib.util.spec_from_file_location(NAME, file)
            assert spec and spec.loader
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            sys.modules[NAME] = module
            return module
    raise ImportError(
        "asperity.Simulation and asperity.Statics need the compiled module asperity._engine, which was not found\n"
        f"    why: this build has none for Python {sys.version_info.major}.{sys.version_info.minor} "
        f"(looked in {', '.join(map(str, folders))})\n"
        "    fix: install pybind11-dev, python3-pybind11 and python3-dev, and build Asperity again", name=NAME)


if TYPE_CHECKING:
    from .. import _engine
else:
    _engine = load()
RestState = _engine.RestState
SiteMaps = _engine.SiteMaps
Energies = _engine.Energies
Point = _engine.Point
State = _engine.State
quantity = _engine.quantity


class Components(NamedTuple):
    """Three components of a field, each an array [y, x]. numpy.stack(field, -1) copies them to [y, x, 3]."""

    x: numpy.ndarray
    y: numpy.ndarray
    z: numpy.ndarray


def _set_what_is_there(self: object, name: str, value: Any) -> None:
    """Sets an existing attribute. Raises an error for other names, which would have no effect."""
    if not name.startswith("_") and not hasattr(type(self), name):
        there = [n for n in dir(type(self)) if not n.startswith("_") and isinstance(getattr(type(self), n), property)]
        raise UnknownName.among(type(self).__name__, name, there)
    object.__setattr__(self, name, value)


class Top:
    """Rigid top plane of the block. The scene's drive moves it until a velocity is given."""

    __setattr__ = _set_what_is_there

    def __init__(self, simulation: Simulation):
        self._simulation = simulation

    def __repr__(self) -> str:
        return f"<Top: position {self.position:.4g} Å, velocity {self.velocity:.4g} m/s>"

    @property
    def position(self) -> float:
        """Displacement since the start, Å. A written value (a number or "-1 nm") takes effect in the next step."""
        return self._simulation._top_position

    @position.setter
    def position(self, z: float | str) -> None:
        self._simulation._top_position = z

    @property
    def velocity(self) -> float:
        """Velocity in the next step, m/s; positive moves away. A written value (a number or "2 m/s") replaces the scene's path
        until another value is written; None resumes the scene's path."""
        return self._simulation._top_velocity

    @velocity.setter
    def velocity(self, v: float | str | None) -> None:
        self._simulation._top_velocity = v


class Substrate(NamedTuple):
    """Rigid substrate."""

    height: numpy.ndarray
    """Heights of the atoms, Å, a read-only view [y, x]."""
    edge: float
    """Edge of the periodic box, Å."""

    def __repr__(self) -> str:
        return f"<Substrate: {len(self.height)} x {len(self.height)} heights, edge {self.edge:.6g} Å>"


class NamedArrays(dict):
    """Arrays by name; a wrong name raises UnknownName with the existing ones."""

    def __missing__(self, name: object) -> numpy.ndarray:
        raise UnknownName.among("series", name, self)


MPA = 1e3 / GIGAPASCAL
"""Number of MPa in an eV/Å³."""
MAPS = {"gap": "Å", "contact": "1", "pressure": "GPa"}
SERIES: dict[str, tuple[str, Callable[[Simulation], float]]] = {
    "step": ("1", lambda s: s.steps - 1), "time": ("ps", lambda s: s.time),
    "segment": ("1", lambda s: s._segment_number), "top_displacement": ("Å", lambda s: s._top_then), "force": ("eV/Å", lambda s: s.force),
    "top_force": ("eV/Å", lambda s: s.top_force), "mean_height": ("Å", lambda s: s.mean_height),
    "contact_fraction": ("1", lambda s: s.contact), "repulsive_fraction": ("1", lambda s: s.repulsive_fraction),
    "balance_error": ("1", lambda s: s.energy.balance_error)}
"""Columns of the engine in Simulation.series beside the energies, as in run.h5: unit, value. segment: -1 while the top is led by
hand."""


@contextlib.contextmanager
def _bar(steps: int) -> Iterator[Callable[[Simulation, int], None]]:
    """Shows progress: a bar of tqdm (in a notebook its notebook form), or lines of text. Yields a function to call with the number
    of steps made."""
    bar, text = None, Progress()
    with contextlib.suppress(ImportError), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a notebook without ipywidgets has bars of text
        from tqdm.auto import tqdm

        bar = tqdm(total=steps, unit="step")

    def tell(simulation: Simulation, made: int) -> None:
        said = f"{number(simulation.time, 1)} ps, {simulation.stress:.4g} MPa, contact {simulation.contact:.3f}"
        if bar is not None:
            bar.set_postfix_str(said, refresh=False)
            bar.update(made - bar.n)
        elif text.due() or made == steps:
            text.update(f"{made} of {steps} steps, {said}")

    try:
        yield tell
    finally:
        (text.finish if bar is None else bar.close)()


def _number(comm: Any) -> int | None:
    """Returns the number of mpi4py's communicator for the engine. Raises SceneError for another object, or if its MPI is not that of
    the engine."""
    if comm is None:
        return None
    if not (hasattr(comm, "py2f") and hasattr(comm, "size")):
        raise SceneError("comm", f"is {comm!r:.60}", "it is no communicator of mpi4py", "give one, MPI.COMM_WORLD for example, or leave it out")
    from mpi4py import MPI

    theirs, ours = MPI.Get_library_version().splitlines()[0], program.mpi()
    if not set(ours.split()) <= set(theirs.replace(",", " ").split()):
        raise SceneError("comm", f"is of {theirs}", f"the engine was built with {ours}",
                         "install an mpi4py of the same MPI")
    if comm.size > 1:
        _end_all_with(comm)
    return comm.py2f()


def _end_all_with(comm: Any) -> None:
    """Aborts all ranks of comm if an error ends this rank, because the others would wait for it."""
    before = sys.excepthook
    if before.__module__ == __name__:
        return

    def ends_all(kind: type[BaseException], error: BaseException, trace: Any) -> None:
        before(kind, error, trace)
        sys.stderr.flush()
        comm.Abort(error.code if isinstance(error, Error) else 1)

    sys.excepthook = ends_all


@checks_calls
class Simulation(_engine.Simulation):
    """Dynamic path of a scene, one step at a time.

        sim = asperity.Simulation("scene.toml", {"surface.rms": 2.0})
        while not sim.done:
            sim.step(100)
            print(sim.time, sim.force, sim.contact)

    The path is that of `asperity run`, with bitwise identical results. A step computes forces at its start and then moves the
    sites: time, force and energies belong to the start of the step, as in a run's series, while u belongs to its end. Energies
    and contacts are computed in observed steps: the last step of each call, every output.series-th step, and the steps of
    observers. A simulation uses all threads of its process or rank (OMP_NUM_THREADS). Notes on a scene are warnings (SceneWarning).

    Parameters
    ----------
    scene : str, Path or dict
        TOML file, or dictionary of the scene's sections: {"surface": {"sites": 64}}.
    overrides : dict, optional
        Values by key, {"surface.rms": 2.0, "drive.load": "100 MPa"}; numbers in the units of docs/reference/scene.md.
    comm : mpi4py.MPI.Comm, optional
        Ranks that share the simulation, MPI.COMM_WORLD; each has a `tile` of the sites. All ranks must make the same calls with the
        same arguments; each writes to its own sites. An error that ends one rank ends all.

    Raises
    ------
    SceneError
        If the scene is quasi-static, or a run would refuse it.
    """

    __setattr__ = _set_what_is_there
    _made = False

    def __repr__(self) -> str:
        if not self._made:  # the engine has nothing to show then
            return "<Simulation that could not be made>"
        return (f"<Simulation {self._name}: {self.segment}, step {self.steps}, {self.time:.4g} ps, "
                f"{self.stress:.4g} MPa, contact {self.contact:.4g}>")

    def __init__(self, scene: SceneLike, overrides: Overrides | None = None, comm: Any = None):
        """Places a scene at the start of its path."""
        try:
            with scene_given(scene, overrides) as (file, sets):
                super().__init__(file, sets, _number(comm))
        except BaseException:
            del self  # or a debugger would look into what the engine has not made
            raise
        self._begin(comm)

    def _begin(self, comm: Any) -> None:
        self._made = True
        self._comm = comm
        self._observers: list[tuple[Callable, str]] = []
        self._rows: list[dict[str, float]] = []

    @classmethod
    def resume(cls, file: str | os.PathLike, comm: Any = None) -> Simulation:
        """Resumes a simulation from a file of save(), with bitwise identical results. Observers must be given anew.

        Parameters
        ----------
        file : str or Path
            File of save().
        comm : mpi4py.MPI.Comm, optional
            Ranks that share the simulation; any number.

        Returns
        -------
        Simulation
            The simulation.

        Raises
        ------
        InputOutputError, SceneError
            If the file cannot be read or is no saved simulation.
        """
        simulation = cls.__new__(cls)
        _engine.Simulation.__init__(simulation, os.fspath(file), _number(comm))
        simulation._begin(comm)
        return simulation

    def step(self, n: int = 1, progress: bool = False) -> int:
        """Makes n steps, or fewer at the end of the scene's path (`done`).

        Other Python threads continue to run; Ctrl-C stops between two steps.

        Parameters
        ----------
        n : int
            Number of steps.
        progress : bool
            Show a bar (tqdm's, if it is installed).

        Returns
        -------
        int
            Number of steps made.

        Raises
        ------
        PhysicsError
            If a guard stops the simulation; no step can follow.
        """
        n = operator.index(n)
        if not progress:
            return self._step(n, None)
        with _bar(n) as tell:
            before = self.steps
            made = self._step(n, lambda: tell(self, self.steps - before))
            tell(self, made)
        return made

    @property
    def top(self) -> Top:
        """Top plane with .position (Å) and .velocity (m/s), readable and writable."""
        return Top(self)

    @property
    def substrate(self) -> Substrate:
        """Substrate with .height (Å, [y, x]) and .edge (Å)."""
        return Substrate(self._substrate_height, self._substrate_edge)

    @property
    def edge(self) -> float:
        """Edge of the periodic box, Å."""
        return self._substrate_edge

    @property
    def area(self) -> float:
        """Nominal area, Å²."""
        return self._substrate_edge**2

    @property
    def stress(self) -> float:
        """Force over the nominal area, MPa; positive is repulsion."""
        return self.force / self.area * MPA

    def every(self, n: int, observer: Callable[[Simulation], Any], name: str | None = None) -> None:
        """Registers an observer, which is called after every n-th step, beginning with the first.

        The observer may read and write as a script may between two steps, but must not call step(). An exception of the
        observer ends step().

        Parameters
        ----------
        n : int
            Period, steps.
        observer : callable
            Function of the simulation. A number that it returns is added to a column of `series`; the numbers of a returned
            dictionary are added to the columns named by its keys.
        name : str, optional
            Name of the column; by default the function's name.

        Raises
        ------
        SceneError
            If the observer cannot be called.
        """
        if not callable(observer):
            raise SceneError("every", "is given no function", f"{observer!r} cannot be called",
                             "give a function of the simulation")
        # The engine must not keep alive what keeps the engine alive.
        itself, number = weakref.ref(self), len(self._observers)

        def observe() -> None:
            if (simulation := itself()) is not None:
                simulation._observe(number)

        self._every(n, observe)
        self._observers.append((observer, name or getattr(observer, "__name__", "value").replace("<lambda>", "value")))

    def _observe(self, number: int) -> None:
        observer, name = self._observers[number]
        found = observer(self)
        if found is None:
            return
        if not self._rows or self._rows[-1]["step"] != self.steps - 1:
            self._rows.append({column: float(value(self)) for column, (_, value) in SERIES.items()} | self._energies)
        for column, value in (found if isinstance(found, Mapping) else {name: found}).items():
            if column in self._units:
                raise SceneError("every", f"an observer returned a column {column}", "the engine has one of that name",
                                 "give it another name: every(n, observer, name)")
            try:
                self._rows[-1][column] = float(value)
            except (TypeError, ValueError):
                raise SceneError("every", f"an observer returned {value!r:.60} for the column {column}",
                                 "columns are made of numbers", "return a number, a dictionary of numbers, or None"
                                 ) from None

    @property
    def _units(self) -> dict[str, str]:
        """Units of the engine's columns in series, by name."""
        return {name: unit for name, (unit, _) in SERIES.items()} | dict.fromkeys(self._energies, "eV")

    @property
    def series(self) -> dict[str, numpy.ndarray]:
        """Columns by name: the values of observers, with one row for each step at which an observer returned a value, and the
        engine's columns (step, time, force, ..., with names and units of run.h5). NaN: no value at this step."""
        names = dict.fromkeys([*self._units, *(name for row in self._rows for name in row)])
        return NamedArrays((name, numpy.array([row.get(name, numpy.nan) for row in self._rows])) for name in names)

    def write(self, directory: str | os.PathLike) -> Path:
        """Writes a result directory for asperity.load(): the scene, `series`, and the present maps of the sites as the state "now".
        With `comm` the first rank writes its own series and the maps of all ranks.

        Parameters
        ----------
        directory : str or Path
            Directory without a result.

        Returns
        -------
        Path
            The directory.

        Raises
        ------
        SceneError
            If the directory holds a result already.
        """
        maps, comm = self.maps(), self._comm
        mine = {name: getattr(maps, name) for name in MAPS}
        if comm is None:
            return self._write(directory, mine)
        whole = {name: numpy.empty(self.substrate.height.shape, values.dtype) for name, values in mine.items()}
        for tile, part in comm.gather((self.tile, mine)) or []:
            for name, values in part.items():
                whole[name][tile] = values
        place = failed = None
        if comm.rank == 0:
            try:
                place = self._write(directory, whole)
            except Exception as error:
                failed = error
        place, failed = comm.bcast((place, failed))
        if failed:
            raise failed
        return place

    def _write(self, directory: str | os.PathLike, maps: dict[str, numpy.ndarray]) -> Path:
        place = store.chosen(os.fspath(directory), "")
        units = self._units
        with lock.in_use(place):
            if (place / "result.json").exists():
                raise SceneError(str(place), "already holds a result, result.json", "results are not written over",
                                 "name another directory, or remove this one")
            with store.outputs(place, ("run.h5", "result.json"), renew=False) as written:
                self._write_files(written, maps, units)
        return place

    def _write_files(self, written: store.Outputs, maps: dict[str, numpy.ndarray], units: dict[str, str]) -> None:
        with written.replacing("run.h5") as beside, h5py.File(beside, "w") as file:
            parts = {**{f"series/{name}": (values, units.get(name)) for name, values in self.series.items()},
                     **{f"fields/now/{name}": (maps[name], unit) for name, unit in MAPS.items()},
                     "substrate/height": (self.substrate.height, "Å")}
            for name, (values, unit) in parts.items():
                file[name] = values
                if unit:
                    file[name].attrs["unit"] = unit
            file["substrate"].attrs["edge"] = self.substrate.edge
        written.write("result.json", store.sealed_json({
            "name": self._name, "run": {"version": _engine.version, "steps": self.steps},
            "scene": tomllib.loads(self._scene)}))


@checks_calls
class Statics(_engine.Statics):
    """Quasi-static path of a scene: a script prescribes positions or loads, and the solids relax to force balance.

        statics = asperity.Statics("scene.toml")
        for height in (6.0, 4.0, 3.0, 4.0, 6.0):
            statics.mean_height = height
            point = statics.relax()
            print(point.mean_height, point.force, point.dissipated)

    The path starts beyond the interaction range. The state at a point depends on the points before, as in `asperity run`;
    dissipated energy is counted. Either the mean height or the top plane is held, whichever a script writes first (a load holds the
    quantity of drive.control). A dynamic scene is treated as if its drive.mode were "quasistatic".

    free() relaxes with top plane and mean height free; copy() copies a state, and restore() restores the copy:

        statics.mean_height = 3.1
        statics.relax()
        held = statics.copy()
        print(statics.free().binding_energy)
        statics.restore(held)

    Parameters
    ----------
    scene : str, Path or dict
        TOML file, or dictionary of the scene's sections.
    overrides : dict, optional
        Values by key; numbers in the units of docs/reference/scene.md.

    Raises
    ------
    SceneError
        If a run would refuse the scene.
    """

    __setattr__ = _set_what_is_there
    _made = False

    def __repr__(self) -> str:
        if not self._made:
            return "<Statics that could not be made>"
        return (f"<Statics {self._case['name']}: point {self.now.number}, mean height {self.now.mean_height:.4g} Å, "
                f"{self.stress:.4g} MPa, contact {self.now.contact:.4g}>")

    @property
    def area(self) -> float:
        """Nominal area, Å²."""
        return self._case["area"]

    @property
    def edge(self) -> float:
        """Edge of the periodic box, Å."""
        return self.area**0.5

    @property
    def spacing(self) -> float:
        """Distance of neighbouring sites, Å."""
        return self._case["spacing"]

    @property
    def substrate(self) -> Substrate:
        """Substrate with .height (Å, [y, x]) and .edge (Å)."""
        return Substrate(self._substrate_height, self.edge)

    @property
    def stress(self) -> float:
        """Force of the last point over the nominal area, MPa; positive is repulsion."""
        return self.now.force / self.area * MPA

    def __init__(self, scene: SceneLike, overrides: Overrides | None = None):
        """Places the solids of a scene beyond the interaction range."""
        try:
            with scene_given(scene, overrides) as given:
                super().__init__(*given)
        except BaseException:
            del self
            raise
        self._made = True

    @property
    def load(self) -> None:
        """Load for the next relax(), written in MPa or as "100 MPa"; positive presses.

        The block moves down until the force rises to the load, or up until the force falls to the load. Write only; point.force is
        the force of a point.
        """
        raise AttributeError("a load can be written, not read: the force of a point is point.force, eV/Å")

    @load.setter
    def load(self, pressure: float | str) -> None:
        self._load(pressure)

    def hold(self, time: float | str) -> _engine.Point:
        """Holds the present position while the block relaxes (block.prony). After an interruption relax() continues.

        Parameters
        ----------
        time : float or str
            Duration, ps, or a text with a unit: "20 ns".

        Returns
        -------
        Point
            The point at the end.

        Raises
        ------
        SceneError
            If the scene has no block.prony.
        """
        self._hold(time)
        return self.relax()
