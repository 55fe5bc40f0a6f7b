# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity export DIR --to xyz|vtk|png`: writes the contents of run.h5 for other programs to DIR/export or the directory of --out.

    xyz    DIR/export/<state>.xyz: the atoms of the substrate and of the block's lowest layer, for every state with
           maps, with what is known of each atom as columns; DIR/export/trajectory.xyz: the frames of the trajectory
    vtk    DIR/export/<state>.vti, substrate.vti: the maps as images, each a file of its own; DIR/export/trajectory.pvd:
           the frames of the trajectory with their times, each in trajectory/ as points
    png    DIR/export/<map>-<state>.png, .pdf, .svg: gap, pressure and contact from above

A second export replaces these files.
"""

from __future__ import annotations

import base64
import struct
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import IO, Any
from xml.sax.saxutils import quoteattr

import jinja2
import numpy as np

from ..errors import InputOutputError, SceneError, UnknownName
from ..files import store
from ..plots import style as figures
from ..plots.run import map_of
from ..results.result import Result, State, expect
from .page import file_name

TRAJECTORY = "/particles/trajectory"
ASE_TIME = 0.010180505671156723
"""ASE's unit of time, Å sqrt(u/eV), in ps."""
DISPLACEMENT = ("u_x", "u_y", "u_z")


@dataclass
class Atoms:
    """One frame. positions [atom, 3] (Å); types: the substrate's from 1, the last one is the block's; columns: [atom]
    or [atom, 3] by name."""

    positions: np.ndarray
    types: np.ndarray
    edge: float
    columns: dict[str, np.ndarray] = field(default_factory=dict)
    step: int = 0
    time: float = 0.0
    """ps"""
    mass: float = 1.0
    """u"""

    @property
    def species(self) -> np.ndarray:
        """Labels that every reader of XYZ accepts: X (no element) for the substrate, and Au for the block."""
        return np.where(self.types == self.types.max(), "Au", "X")

    @property
    def box_z(self) -> tuple[float, float]:
        """Lower and upper end of the box along z, Å."""
        z = self.positions[:, 2]
        return z.min() - 1.0, z.max() + 1.0


def _rows(file: IO[str], atoms: Atoms, before: list[np.ndarray], after: list[np.ndarray]) -> None:
    """Returns lines of columns: those before the positions, the positions with more digits, and those behind."""
    forms, columns = [], []
    for values in [*before, atoms.positions, *after]:
        form = {"U": "%s", "f": "%.8g" if values is atoms.positions else "%.6g"}.get(values.dtype.kind, "%d")
        for column in values.T if values.ndim == 2 else [values]:
            forms.append(form)
            columns.append(column.tolist())
    line = " ".join(forms) + "\n"
    file.writelines(line % row for row in zip(*columns))


def _xyz_columns(atoms: Atoms) -> dict[str, np.ndarray]:
    """Returns the columns. Velocities have the names that readers expect: velo (Å/ps) for OVITO; ASE computes its own from
    momenta and masses, in its units."""
    columns = dict(atoms.columns)
    velocity = columns.pop("velocity", None)
    if velocity is not None:
        columns |= {"velo": velocity, "masses": np.full(len(atoms.types), atoms.mass),
                    "momenta": atoms.mass * ASE_TIME * velocity}
    return columns


def write_xyz(file: IO[str], atoms: Atoms) -> None:
    """Writes a frame of extended XYZ: the lattice, the meaning of the columns, and further properties."""
    low, high = atoms.box_z
    columns = _xyz_columns(atoms)
    head = (f'{len(atoms.types)}\nLattice="{atoms.edge:.8g} 0 0 0 {atoms.edge:.8g} 0 0 0 {high - low:.8g}" '
            f'Origin="0 0 {low:.8g}" pbc="T T F" Properties=species:S:1:pos:R:3:type:I:1')
    for name, values in columns.items():
        head += f":{name}:{'I' if values.dtype.kind in 'iub' else 'R'}:{3 if values.ndim == 2 else 1}"
    file.write(f"{head} step={atoms.step} time={atoms.time:.8g}\n")
    _rows(file, atoms, [atoms.species], [atoms.types, *columns.values()])


def _text(template: str, **values: Any) -> str:
    loader = jinja2.FileSystemLoader(Path(__file__).parent / "templates")
    environment = jinja2.Environment(loader=loader, trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True)
    environment.filters |= {"quoted": quoteattr, "long": "{:.12g}".format}
    return environment.get_template(template).render(**values)


def _packed(values: np.ndarray, form: str) -> str:
    """Returns an array in the form of VTK's XML: base64, the length in bytes first."""
    data = np.ascontiguousarray(values, form).tobytes()
    return base64.b64encode(struct.pack("<Q", len(data)) + data).decode()


def image_text(spacing: float, origin: float, maps: dict[str, np.ndarray]) -> str:
    """Returns VTK's XML image of one layer."""
    arrays = []
    for name, values in maps.items():
        kind, form = ("Float64", "<f8") if values.dtype.kind == "f" else ("UInt8", "u1")
        arrays.append((kind, name, values.ndim * 2 - 3, _packed(values, form)))
    n = len(next(iter(maps.values())))
    return _image((n, n, 1), (spacing,) * 3, (origin, origin, 0.0), arrays)


def volume_text(spacing: tuple[float, float, float], origin: tuple[float, float, float], fields: dict[str, np.ndarray]) -> str:
    """Returns VTK's XML image of a volume in single precision."""
    nz, ny, nx = next(iter(fields.values())).shape
    return _image((nx, ny, nz), spacing, origin, [("Float32", name, 1, _packed(values, "<f4")) for name, values in fields.items()])


def _image(size: Iterable[int], spacing: Iterable[float], origin: Iterable[float], arrays: list[tuple[str, str, int, str]]) -> str:
    """Returns VTK's XML image. arrays: type, name, number of components and packed values."""
    def words(numbers: Iterable[float]) -> str:
        return " ".join(f"{number:.12g}" for number in numbers)
    return _text("image.vti", extent=" ".join(f"0 {n - 1}" for n in size), spacing=words(spacing), origin=words(origin), arrays=arrays)


def points_text(points: np.ndarray, vectors: dict[str, np.ndarray]) -> str:
    """Returns VTK's XML of points, each a vertex."""
    n = len(points)
    return _text("points.vtp", n=n, points=_packed(points, "<f4"), vertices=_packed(np.arange(n), "<i8"),
                 ends=_packed(np.arange(1, n + 1), "<i8"),
                 arrays=[(name, _packed(values, "<f4")) for name, values in vectors.items()])


class Export:
    """The files that are made from one result."""

    def __init__(self, directory: Path, out: Path | None = None):
        self.run = Result(directory)
        self.place, self.folder = (directory, "export/") if out is None else (out, "")
        expect(directory, "run.h5")
        for note in self.run.notes:
            print(f"note: {note}")
        self.spacing = self.run.number("scene.surface.spacing", 0.0)
        self._mass = self.run.number("scene.block.atom_mass") or 1.0
        if not self.run.substrate or not self.spacing > 0:
            raise InputOutputError(str(directory / "run.h5"), "has nothing to export",
                                   "it holds no substrate, or result.json no scene",
                                   "name the directory of a run that got past its start")
        height = self.run.substrate.height
        n = len(height)
        y, x = np.divmod(np.arange(n * n), n)
        atoms, types = self.run.substrate.atoms, self.run.substrate.types
        lattice = [x * self.run.edge / n, y * self.run.edge / n, height.ravel()]
        self.rigid: np.ndarray = np.column_stack(lattice) if atoms is None else atoms
        self.types: np.ndarray = np.ones(len(self.rigid), int) if types is None else types
        if len(self.types) != len(self.rigid):
            raise self._strange(f"has {len(self.types)} types of {len(self.rigid)} atoms",
                                "each atom of the substrate has one")

    def _strange(self, what: str, why: str) -> InputOutputError:
        return InputOutputError(str(self.run.file.path), what, why, "was the file written by another program?")

    def _outputs(self, names: Iterable[str]) -> AbstractContextManager[store.Outputs]:
        return store.outputs(self.place, [self.folder + name for name in names], inputs=[str(self.run.file.path)])

    def _paths(self, names: Iterable[str]) -> list[Path]:
        return [self.place / (self.folder + name) for name in names]

    def _frames(self) -> int:
        steps = self.run.file.members(TRAJECTORY + "/position")
        return len(self.run.file.array(TRAJECTORY + "/position/step", 1)) if "step" in steps else 0

    def _sites(self, state: State) -> int:
        """Returns the number of sites of the state's maps, which must be of one size."""
        sizes = {len(state[name]) for name in state}
        if len(sizes) != 1:
            raise self._strange(f'state "{state.name}" cannot be exported', f"its maps have the sizes {sorted(sizes)}")
        return sizes.pop()

    def _atoms(self, layer: np.ndarray, *more: Any) -> Atoms:
        """Returns the atoms of the substrate and of the block's lowest layer."""
        types = np.concatenate([self.types, np.full(len(layer), self.types.max() + 1)])
        return Atoms(np.vstack([self.rigid, layer]), types, self.run.edge, *more)

    def _state_atoms(self, state: State) -> Atoms:
        """Returns both layers with the maps as columns, zero for the substrate. Sites stand over its hollows."""
        for name in DISPLACEMENT:
            if name not in state:
                raise self._strange(f'state "{state.name}" cannot be exported', f"it has no map {name}")
        n = self._sites(state)
        u = np.column_stack([state[name].ravel() for name in DISPLACEMENT])
        y, x = np.divmod(np.arange(n * n), n)
        rest = np.column_stack([self.spacing * (x + 0.5) + state.slide[0], self.spacing * (y + 0.5) + state.slide[1],
                                np.full(n * n, state.reference_height)])
        rigid = len(self.rigid)
        columns = {"displacement": np.vstack([np.zeros((rigid, 3)), u])}
        for name in ("pressure", "contact", "gap", "distance"):
            if name in state:
                values = state[name].ravel()
                if values.dtype.kind == "f":
                    values = np.where(np.isfinite(values), values, -1.0)  # no atom in reach
                columns[name] = np.concatenate([np.zeros(rigid, values.dtype), values])
        return self._atoms(rest + u, columns)

    def _trajectory(self) -> Iterator[tuple[int, float, np.ndarray, dict[str, np.ndarray]]]:
        """Yields step, time (ps), the lowest layer [site, 3], and further arrays of each frame."""
        file = self.run.file
        steps, times = (file.array(f"{TRAJECTORY}/position/{n}", 1) for n in ("step", "time"))
        moving = "velocity" in file.members(TRAJECTORY)
        for frame in range(len(steps)):
            layer = file.array(TRAJECTORY + "/position/value", 2, frame).astype(float)
            more = {"velocity": file.array(TRAJECTORY + "/velocity/value", 2, frame).astype(float)} if moving else {}
            yield int(steps[frame]), float(times[frame]), layer, more

    def _trajectory_atoms(self) -> Iterator[Atoms]:
        for step, time, layer, more in self._trajectory():
            columns = {name: np.vstack([np.zeros_like(self.rigid), values]) for name, values in more.items()}
            yield self._atoms(layer, columns, step, time, self._mass)

    def atoms(self) -> list[Path]:
        """Writes every state and the trajectory."""
        frames: dict[str, Callable[[], Iterable[Atoms]]] = {
            file_name(state.name) + ".xyz": partial(lambda one: [self._state_atoms(one)], state)
            for state in self.run.fields.values()}
        if self._frames():
            frames["trajectory.xyz"] = self._trajectory_atoms
        with self._outputs(frames) as out:
            for name, of_file in frames.items():
                with out.replacing(self.folder + name) as beside, open(beside, "w", encoding="utf-8") as file:
                    for frame in of_file():
                        write_xyz(file, frame)
        return self._paths(frames)

    def pictures(self) -> list[Path]:
        """Writes maps of all states as PNG. Returns the files."""
        made = {f"{name}-{file_name(state.name)}": (state, name) for state in self.run.fields.values()
                for name in ("gap", "pressure", "contact")}
        written = []
        with self._outputs(file for stem in made for file in figures.files_of(stem)) as out:
            for stem, (state, name) in made.items():
                fig = figures.make(partial(map_of, self.run, state, name))
                if fig is not None:
                    figures.save(fig, out, self.folder + stem)
                    written += figures.files_of(stem)
        return self._paths(written)

    def images(self) -> list[Path]:
        """Writes maps of the substrate and of all states for ParaView. Returns the files."""
        n = len(self.run.substrate.height)
        texts = {"substrate": image_text(self.run.edge / n, 0.0, {"height (Å)": self.run.substrate.height})}
        for state in self.run.fields.values():
            self._sites(state)
            maps = {_title(name): state[name] for name in state if not name.startswith("u_")}
            if set(DISPLACEMENT) <= set(state):
                maps["displacement (Å)"] = np.dstack([state[name] for name in DISPLACEMENT])
            texts[file_name(state.name)] = image_text(self.spacing, 0.5 * self.spacing, maps)
        film = self._frames() > 0
        frames = [f"trajectory/{number:05}.vtp" for number in range(self._frames())]
        written = [name + ".vti" for name in texts] + ["trajectory.pvd"] * film
        with self._outputs([*written, *frames]) as out:
            for name, text in texts.items():
                out.write(f"{self.folder}{name}.vti", text)
            if film:
                self._film(out, frames)
        return self._paths(written)

    def _film(self, out: store.Outputs, names: list[str]) -> None:
        """Writes the frames as points, and trajectory.pvd, which has their times."""
        frames = []
        for name, (_, time, layer, more) in zip(names, self._trajectory()):
            frames.append((time, name))
            out.write(self.folder + name, points_text(layer, {f"{key} (Å/ps)": values for key, values in more.items()}))
        out.write(self.folder + "trajectory.pvd", _text("trajectory.pvd", frames=frames))


def _title(name: str) -> str:
    """Returns the title of a map, with its unit."""
    return name if name == "contact" else f"{name} ({'GPa' if name == 'pressure' else 'Å'})"


FORMATS: dict[str, Callable[[Export], list[Path]]] = {"xyz": Export.atoms, "vtk": Export.images, "png": Export.pictures}
GONE = {"lammps": "its atoms are in --to xyz, which OVITO and ASE convert for LAMMPS",
        "xdmf": "ParaView opens what --to vtk writes: maps and the trajectory"}
"""Formats of earlier versions, and what to use instead."""


def export(directory: Path, kind: str, out: str | None = None) -> list[Path]:
    """Exports the maps and the trajectory of a run. Raises InputOutputError, SceneError."""
    if kind in GONE:
        raise SceneError(f"--to {kind}", "is not written any more", GONE[kind],
                         f"asperity export {directory} --to {'xyz' if kind == 'lammps' else 'vtk'}")
    if kind not in FORMATS:
        raise UnknownName(f"--to {kind}", "is no format of export", "formats: " + ", ".join(FORMATS),
                         f"for example: asperity export {directory} --to xyz")
    written = FORMATS[kind](Export(directory, store.named(out)))
    if not written:
        raise InputOutputError(str(directory / "run.h5"), "has nothing to export",
                               "it holds neither maps of a state nor a trajectory",
                               "a run that reaches its state at zero load has maps; output.trajectory asks for frames")
    return written
