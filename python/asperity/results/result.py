# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A result directory: the values of result.json as attributes, and the arrays of run.h5, read on demand.

A failed run leaves the reason and possibly an incomplete series; `asperity theory` leaves no run.h5. Missing parts are absent or
empty; a damaged run.h5 is reported in `notes`, and the rest is used.
"""

from __future__ import annotations

import contextlib
import functools
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from ..above import from_above
from ..arguments import checks_call, checks_calls
from ..errors import InputOutputError, meant
from ..files import store
from ..terminal import html_table
from .frames import Frames, data_frame, data_set
from .run_file import RunFile
from .values import Attributes, Values, finite as finite

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .names import Numbers, Scene, Segment, SeriesArrays, StateMaps, SubstrateMaps, Units
else:
    Numbers = SeriesArrays = StateMaps = SubstrateMaps = object

def load_words(scene: Any, swept: bool = False) -> tuple[str, str]:
    """Returns the load of a scene's state and the load of its theory as text. They differ after an approach, whose state is without load."""
    keys = Values({"scene": scene}).part("scene")
    load = keys.number("drive.load", 0.0)
    under = "under the load" if swept else f"under a load of {load:.4g} MPa".replace("-", "−")
    carried = (load or swept) and keys.listed("drive.path")[:1] == ["relax"]
    return under if carried else "at zero load", f" {under}" if load and not swept else ""


def read_json(path: Path) -> Values:
    """Reads a file with a JSON object and checks its digest, if it has one. Raises InputOutputError for anything else."""
    def refuse(why: str, remedy: str = "was it damaged, or written by hand?") -> InputOutputError:
        return InputOutputError(str(path), "cannot be read", why, remedy)
    try:
        content = store.contents(path)
        value = store.json_of(content, Values)
    except OSError as error:
        raise InputOutputError(str(path), "cannot be read", error.strerror or str(error),
                               "check the path and its permissions") from None
    except ValueError as error:
        raise refuse(f"it is not JSON: {error}") from None
    if not isinstance(value, Values):
        return Values()
    if "digest" in value and not store.json_is_whole(content):
        raise refuse("its content does not match its digest: it was damaged or changed",
                     "take a copy that is whole; of a file changed on purpose, remove the member \"digest\"")
    return value


def expect(directory: Path, *files: str) -> None:
    """Checks that a directory contains one of several files. Raises InputOutputError."""
    example = "name a directory that a run has written, for example results/first-contact"
    if not directory.is_dir():
        raise InputOutputError(str(directory), "is no result directory",
                               "it is a file" if directory.exists() else "there is no such directory", meant(directory) or example)
    if any((directory / file).exists() for file in files):
        return
    own = [file for file in kinds_in(directory) if file != "result.json"]  # without run.h5: of a theory, or unfinished
    runs = [place for place, kinds in results_below(directory).items() if "result.json" in kinds and place != directory]
    which = " or ".join(map(str, runs[:LISTED])) + f", one of {len(runs)}" * (len(runs) > LISTED)
    if own:
        whole = "; in Python asperity.load_sweep() takes it whole" if own[0] == "sweep.json" else ""
        raise InputOutputError(str(directory), f"holds {KINDS[own[0]]}, not the result of one run", f"{own[0]} is in it",
                               f"name one of its runs: {which}{whole}" if runs else "run it again: it holds no finished run")
    if runs:
        raise InputOutputError(str(directory), "holds no result of its own", "results are in directories below it", f"name one of them: {which}")
    raise InputOutputError(str(directory), "holds no result",
                           f"{' and '.join(files)} {'is' if len(files) == 1 else 'are'} not in it",
                           example + "; a run that was killed leaves no result.json before it is resumed")


KINDS = {"result.json": "a run", "sweep.json": "a sweep", "estimate.json": "an estimate", "tip.json": "the force curve of a tip",
         "states.json": "stable states", "cost.csv": "a cost"}
"""What a directory with this file holds."""
LISTED = 8
"""Results of a directory that a message names."""


def kinds_in(directory: Path) -> list[str]:
    """Returns the files of KINDS in a directory."""
    return [file for file in KINDS if (directory / file).exists()]


def results_below(directory: Path) -> dict[Path, list[str]]:
    """Returns the directories with results in a directory and, where that has none, in the directories in it, each with its files of
    KINDS."""
    found: dict[Path, list[str]] = {}
    for place in sorted(one for one in directory.iterdir() if one.is_dir()):
        kinds = kinds_in(place)
        found |= {place: kinds} if kinds else {one: some for one in sorted(place.glob("*/")) if (some := kinds_in(one))}
    return found


@checks_calls
class Group(Attributes, Mapping):
    """Arrays of a group of run.h5, read on demand.

    Maps are square, [y, x]; the names in `lists` have one dimension and are read by other members.
    """

    lists: tuple[str, ...] = ()

    def __init__(self, file: RunFile, path: str, edge: float = 0.0):
        """Lists the arrays of a group. edge: width of the box of maps, Å; 0 if unknown."""
        self._file, self.edge = file, edge
        self._called = self._path = path
        self._all = file.members(path)
        self._read: dict[str, np.ndarray | None] = dict.fromkeys(name for name in self._all if name not in self.lists)

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._read:
            raise self._file.lacks(self._path, name, self, "array")
        if (values := self._read[name]) is None:
            values = self._read[name] = self._file.array(f"{self._path}/{name}", 2)
            if values.shape[0] != values.shape[1] or not values.size:
                raise InputOutputError(str(self._file.path), f"{self._path}/{name} is no square map",
                                       f"its shape is {values.shape}", "was the file written by another program?")
        return values

    def __contains__(self, name: object) -> bool:  # without reading it
        return name in self._read

    def __iter__(self) -> Iterator[str]:
        return iter(self._read)

    def __len__(self) -> int:
        return len(self._read)

    def unit(self, name: str) -> str:
        """Returns the unit of an array; "" for pure numbers."""
        return str(self._file.attribute(f"{self._path}/{name}", "unit") or "")

    def to_xarray(self):
        """Returns the maps as an xarray Dataset over y and x (Å); attrs["units"] of each has its unit."""
        maps = {name: self[name] for name in self}
        return data_set({name: (("y", "x"), values) for name, values in maps.items()}, {name: self.unit(name) for name in self},
                        {axis: self.edge for axis in ("y", "x")})

    def _lists(self, *names: str) -> list[np.ndarray] | None:
        """Returns arrays of one dimension; None unless all exist."""
        return [self._file.array(f"{self._path}/{n}", 1) for n in names] if set(names) <= set(self._all) else None

    def _repr_html_(self) -> str:
        rows = [(name, self.unit(name), " x ".join(map(str, self[name].shape))) for name in self]
        return html_table(self._called.strip("/"), ("array", "unit", "shape"), rows)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self._called}: {', '.join(self)}>"


@checks_calls
class Series(Group, SeriesArrays):
    """The path of a run: columns of equal length."""

    def __init__(self, file: RunFile):
        super().__init__(file, "/series")
        columns = {name: file.array(f"/series/{name}", 1).astype(float) for name in self}
        rows = min((len(c) for c in columns.values()), default=0)
        self._read = {name: column[:rows] for name, column in columns.items()}

    def frame(self):
        """Returns the columns as a pandas DataFrame; its attrs["units"] has the unit of each column."""
        return data_frame(self._read, {name: self.unit(name) for name in self})

    def to_xarray(self):
        """Returns the columns as an xarray Dataset along "row"; attrs["units"] of each has its unit."""
        return data_set({name: (("row",), self[name]) for name in self}, {name: self.unit(name) for name in self})


class State(Group, StateMaps):
    """The maps of one state: gap, distance, u_x, u_y, u_z (Å), pressure (GPa), contact."""

    lists = ("gap_edges", "gap_density")

    def __init__(self, file: RunFile, name: str, edge: float = 0.0):
        super().__init__(file, f"/fields/{name}", edge)
        self.name = name

    def _number(self, key: str) -> float:
        value = self._file.attribute(self._path, key)
        return float(value) if isinstance(value, (float, int, np.number)) else 0.0

    @functools.cached_property
    def slide(self) -> tuple[float, float]:
        """Place of the block over the substrate along x and y, Å; 0 without a slide."""
        return self._number("slide_x"), self._number("slide_y")

    @functools.cached_property
    def reference_height(self) -> float:
        """Height z of undisplaced sites, Å."""
        return self._number("reference_height")

    @property
    def gap_distribution(self) -> list[np.ndarray] | None:
        """Distribution of gaps P(u): edges of the bins (Å) and density (1/Å)."""
        found = self._lists(*self.lists)
        return found if found and len(found[0]) == len(found[1]) + 1 else None


class Substrate(Group, SubstrateMaps):
    """The rigid surface: height [y, x] (Å), and spectrum: q (1/Å), realised and target C(q) (Å^4). A substrate of atoms also has
    atoms [atom, 3] (Å) and types [atom] (from 1, as in interface.pairs); otherwise both are None."""

    lists = ("spectrum_q", "spectrum", "spectrum_target", "own_spectrum", "counter_spectrum", "atoms", "type")

    def __init__(self, file: RunFile, edge: float = 0.0):
        super().__init__(file, "/substrate", edge)

    @property
    def spectrum(self) -> list[np.ndarray] | None:
        """Radially averaged power spectrum: wave numbers and values (unit of the file); None if the file has none."""
        found = self._lists(*self.lists[:3])
        return found if found and len({len(c) for c in found}) == 1 else None

    @property
    def pair_spectra(self) -> list[np.ndarray] | None:
        """Power spectra of the block's surface and of the second solid's, at the wave numbers of spectrum; None without surface.counter."""
        return self._lists("own_spectrum", "counter_spectrum")

    @functools.cached_property
    def atoms(self) -> np.ndarray | None:
        """Positions of the substrate's atoms, Å, [atom, xyz]; None for a wall."""
        return self._file.array(f"{self._path}/atoms", 2).astype(float) if "atoms" in self._all else None

    @functools.cached_property
    def types(self) -> np.ndarray | None:
        """Type of each atom of the substrate, from 1."""
        if self.atoms is None:
            return None
        if "type" not in self._all:
            return np.ones(len(self.atoms), int)
        return self._file.array(f"{self._path}/type", 1).astype(int)


class States(dict[str, "State"]):
    """States of a run file by name."""

    def __init__(self, file: RunFile, edge: float = 0.0):
        super().__init__({name: State(file, name, edge) for name in file.members("/fields")})
        self._file = file

    def __missing__(self, name: str) -> State:
        raise self._file.lacks("/fields", name, self, "state")


class Plots:
    """Plots of a result, result.plot: each method draws into axes, or makes new ones, and returns them."""

    if TYPE_CHECKING:
        def separation(self, ax: Axes | None = None) -> Axes: ...
        def loading(self, ax: Axes | None = None) -> Axes: ...
        def contact(self, ax: Axes | None = None) -> Axes: ...
        def friction(self, ax: Axes | None = None) -> Axes: ...
        def energy(self, ax: Axes | None = None) -> Axes: ...
        def balance(self, ax: Axes | None = None) -> Axes: ...
        def spectrum(self, ax: Axes | None = None) -> Axes: ...
        def roughness(self, ax: Axes | None = None) -> Axes: ...
        def sliding(self, ax: Axes | None = None) -> Axes: ...
        def height(self, ax: Axes | None = None) -> Axes: ...
        def gaps(self, ax: Axes | None = None, state: str | None = None) -> Axes: ...
        def pressures(self, ax: Axes | None = None, state: str | None = None) -> Axes: ...
        def map(self, name: str, ax: Axes | None = None, state: str | None = None) -> Axes: ...


@checks_calls
class Result(Values, Numbers):
    """Result of one run: the keys of result.json are attributes.

    Parameters
    ----------
    directory : str or Path
        Result directory.

    Attributes
    ----------
    series : Series
        Columns along the path: series["force"] (eV/Å).
    fields : States
        Maps of states, arrays [y, x]: fields["relaxed"].pressure (GPa).
    substrate : Substrate
        Heights (Å) and spectrum of the substrate.
    frames : Frames
        Positions of the lowest layer at the steps of output.trajectory: frames[0] (Å, [site, xyz]), frames.times (ps).
    units : Values
        Units of the numbers, by the same names.
    plot : Plots
        Plots into axes: plot.separation(ax), plot.map("gap", ax=ax), ...
    notes : list of str
        Parts that could not be read.

    Raises
    ------
    InputOutputError
        If the directory holds no result.
    """

    if TYPE_CHECKING:
        scene: Scene

    def __init__(self, directory: str | os.PathLike):
        self.directory = Path(directory)
        expect(self.directory, "result.json")
        super().__init__(read_json(self.directory / "result.json"))
        self.notes: list[str] = []
        try:
            if self._of_another_run():
                raise InputOutputError("", "", "result.json was written with another one")
            self._open("run.h5")
        except InputOutputError as error:
            self.notes.append(f"run.h5 cannot be read to its end ({error.listed[0]['why']}).")
            self._open("no run.h5", self.notes[-1])

    def _of_another_run(self) -> bool:
        """Returns True if the digest of run.h5 differs from that in result.json."""
        known, path = self.text("run.file_digest"), self.directory / "run.h5"
        with contextlib.suppress(OSError):
            there = store.hdf5_digest(path)
            return bool(known) and there is not None and known != store.digest_text(there)
        return False

    def _open(self, name: str, unread: str = "") -> None:
        file = self.file = RunFile(self.directory / name, unread)
        self.series, self.substrate, self.fields = Series(file), Substrate(file, self.edge), States(file, self.edge)
        self.frames = Frames(file)

    @property
    def units(self) -> Units:
        """Units of the numbers, by the same names."""
        return cast("Units", self.part("units"))

    @property
    def segments(self) -> list[Segment]:
        """Segments that have ended, with their numbers: result.segments[0].work_of_drive (meV/Å²)."""
        return [cast("Segment", Values(s)) for s in self.listed("segments") if isinstance(s, dict)]

    @property
    def segment_names(self) -> list[str]:
        """Texts of the segments in drive.path; series["segment"] has their indices, from 0."""
        return [str(s) for s in self.listed("scene.drive.path")]

    def unit(self, name: str) -> str:
        """Returns the unit of a number by its path.

        Parameters
        ----------
        name : str
            Path of the value, "theory.persson.gamma_eff".

        Returns
        -------
        str
            The unit; "" if the file gives none.
        """
        return self.units.text(name)

    def key(self, name: str, otherwise: Any = None) -> Any:
        """Returns a key of the scene of the run.

        Parameters
        ----------
        name : str
            The key, "surface.sites".
        otherwise : object, optional
            Returned if the scene has no such key.

        Returns
        -------
        object
            The value, in the unit of docs/reference/scene.md.
        """
        value = self.find("scene." + name)
        return otherwise if value is None else value

    @property
    def load_words(self) -> tuple[str, str]:
        """Load of the state and of its theory, as text."""
        return load_words(self.find("scene"))

    @property
    def edge(self) -> float:
        """Width of the box, Å; 0 without a scene."""
        return self.number("scene.surface.sites", 0.0) * self.number("scene.surface.spacing", 0.0)

    @property
    def has_free_edges(self) -> bool:
        """True for a box without periodic images."""
        return self.text("scene.surface.boundary") == "free"

    @property
    def in_newtons(self) -> bool:
        """True for spheres and free edges, for which forces are given in nN, lengths in nm and total energies in aJ."""
        return self.curved or self.has_free_edges

    @property
    def curved(self) -> bool:
        """True for a sphere."""
        return self.radius is not None

    @property
    def radius(self) -> float | None:
        """Radius of the spherical cap, Å; None if the substrate is not curved."""
        return self.number("scene.surface.radius")

    @property
    def failure_text(self) -> str:
        """Reason why the run failed; "" if it did not."""
        if "failure" not in self:
            return ""
        return self.text("failure.reason") or json.dumps(self["failure"])[:2000]

    @property
    def stopped(self) -> str:
        """Reason why the run ended early ("signal", "wall_limit", "max_steps"); "" if it did not."""
        return self.text("run.stopped")

    @property
    def title(self) -> str:
        """Scene in one line; the directory's name for a result without a scene."""
        name = self.text("name")
        sites = self.number("scene.surface.sites")
        if not name or not sites:
            return name or self.directory.resolve().name
        kind, rms = self.text("scene.surface.kind"), self.number("scene.surface.rms")
        if kind == "flat":
            what = "flat"
        elif rms is None:
            what = {"file": "as measured", "atoms": "atoms from a file"}.get(kind, "rough")
        else:
            what = f"rms {rms:.4g} Å" if rms > 0 else "smooth"
        radius = f", R = {self.radius:.4g} Å" if self.radius else ""
        return f"{name}: {what}, {sites:.0f} × {sites:.0f}{radius}"

    @property
    def plot(self) -> Plots:
        """Plots of the run: result.plot.separation(ax), .energy, .map("gap"), ..."""
        return from_above("plots.run.RunPlots")(self)

    def report(self, out: str | os.PathLike | None = None) -> Path:
        """Writes report.html into a directory.

        Parameters
        ----------
        out : str or Path, optional
            Directory of the page; None: that of the run.

        Returns
        -------
        Path
            The file.
        """
        return from_above("reports.run.write_run_page")(self, out=store.named(out)).path

    def _repr_html_(self) -> str:
        rows = [(n.name, f"{n.value} {n.unit}".strip(), n.note) for n in from_above("reports.sentences.key_numbers")(self)]
        return html_table(self.title, (), rows, self.failure_text or ("stopped early: " + self.stopped if self.stopped else ""))

    def __repr__(self) -> str:
        found = ", ".join(f"{k}={v:.4g}" for k in ("binding_energy", "contact_fraction", "delta_gamma")
                          if (v := self.number(k)) is not None)
        return f"<Result {self.directory}: {found}>"


@checks_call
def load(directory: str | os.PathLike) -> Result:
    """Loads the result of a run.

    Parameters
    ----------
    directory : str or Path
        Result directory.

    Returns
    -------
    Result
        The result.

    Raises
    ------
    InputOutputError
        If the directory holds no result.
    """
    return Result(directory)
