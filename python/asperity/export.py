# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity export DIR --to xyz|lammps|xdmf|vtk|png`: what run.h5 holds, for other programs.

    xyz, lammps   DIR/export/<state>.xyz (.dump): the atoms of the substrate and of the block's lowest layer, for
                  every state with maps, with what is known of each atom as columns; DIR/export/trajectory.xyz
                  (.dump): the frames of the trajectory. With lammps, DIR/export/<state>.data to start from
    xdmf          DIR/run.xdmf: opens run.h5 in ParaView
    vtk           DIR/export/<state>.vti, substrate.vti: the maps as images of VTK, each a file of its own
    png           DIR/export/<map>-<state>.png, .pdf, .svg: gap, pressure and contact from above

These files are the export's own: a second export writes them anew.
"""

from __future__ import annotations

import base64
import struct
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import IO, Any
from xml.sax.saxutils import quoteattr

import h5py
import jinja2
import numpy as np

from . import files
from .errors import InputOutputError, SceneError
from .page import file_name
from .plots import style as figures
from .plots.run import map_of
from .result import Result, State, expect

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
        """Labels that every reader of XYZ knows: X, which stands for no element, and Au for the block."""
        return np.where(self.types == self.types.max(), "Au", "X")

    @property
    def box_z(self) -> tuple[float, float]:
        z = self.positions[:, 2]
        return z.min() - 1.0, z.max() + 1.0


def _rows(file: IO[str], atoms: Atoms, before: list[np.ndarray], after: list[np.ndarray]) -> None:
    """Lines of columns: those before the positions, these with more digits, and those behind."""
    forms, columns = [], []
    for values in [*before, atoms.positions, *after]:
        form = {"U": "%s", "f": "%.8g" if values is atoms.positions else "%.6g"}.get(values.dtype.kind, "%d")
        for column in values.T if values.ndim == 2 else [values]:
            forms.append(form)
            columns.append(column.tolist())
    line = " ".join(forms) + "\n"
    file.writelines(line % row for row in zip(*columns))


def _xyz_columns(atoms: Atoms) -> dict[str, np.ndarray]:
    """Velocities under the names that readers take for them: velo (Å/ps) is OVITO's; ASE makes its own of momenta
    and masses, in its units."""
    columns = dict(atoms.columns)
    velocity = columns.pop("velocity", None)
    if velocity is not None:
        columns |= {"velo": velocity, "masses": np.full(len(atoms.types), atoms.mass),
                    "momenta": atoms.mass * ASE_TIME * velocity}
    return columns


def write_xyz(file: IO[str], atoms: Atoms) -> None:
    """A frame of extended XYZ: the lattice, what the columns are, and what else is known."""
    low, high = atoms.box_z
    columns = _xyz_columns(atoms)
    head = (f'{len(atoms.types)}\nLattice="{atoms.edge:.8g} 0 0 0 {atoms.edge:.8g} 0 0 0 {high - low:.8g}" '
            f'Origin="0 0 {low:.8g}" pbc="T T F" Properties=species:S:1:pos:R:3:type:I:1')
    for name, values in columns.items():
        head += f":{name}:{'I' if values.dtype.kind in 'iub' else 'R'}:{3 if values.ndim == 2 else 1}"
    file.write(f"{head} step={atoms.step} time={atoms.time:.8g}\n")
    _rows(file, atoms, [atoms.species], [atoms.types, *columns.values()])


LAMMPS_NAMES = {"velocity": ("vx", "vy", "vz")}


def write_dump(file: IO[str], atoms: Atoms) -> None:
    """A frame of a LAMMPS dump; velocities under LAMMPS' own names."""
    low, high = atoms.box_z
    names = "id type element x y z"
    for name, values in atoms.columns.items():
        vector = LAMMPS_NAMES.get(name, tuple(f"{name}[{k + 1}]" for k in range(3)))
        names += " " + (" ".join(vector) if values.ndim == 2 else name)
    # The order of `dump_modify time yes`: LAMMPS' reader refuses a time behind the step.
    file.write(f"ITEM: TIME\n{atoms.time:.8g}\nITEM: TIMESTEP\n{atoms.step}\n"
               f"ITEM: NUMBER OF ATOMS\n{len(atoms.types)}\nITEM: BOX BOUNDS pp pp ff\n0 {atoms.edge:.8g}\n"
               f"0 {atoms.edge:.8g}\n{low:.8g} {high:.8g}\nITEM: ATOMS {names}\n")
    _rows(file, atoms, [np.arange(1, len(atoms.types) + 1), atoms.types, atoms.species], list(atoms.columns.values()))


def write_data(file: IO[str], atoms: Atoms, name: str, mass: float) -> None:
    """A LAMMPS data file, atom_style atomic, units metal."""
    low, high = atoms.box_z
    types = atoms.types.max()
    masses = "".join(f"{t} {mass:.8g} # {'substrate' if t < types else 'block'}\n" for t in range(1, types + 1))
    file.write(f"{name} (asperity export)\n\n{len(atoms.types)} atoms\n{types} atom types\n\n"
               f"0 {atoms.edge:.8g} xlo xhi\n0 {atoms.edge:.8g} ylo yhi\n{low:.8g} {high:.8g} zlo zhi\n\n"
               f"Masses\n\n{masses}\nAtoms # atomic\n\n")
    _rows(file, atoms, [np.arange(1, len(atoms.types) + 1), atoms.types], [])


def _text(template: str, **values: Any) -> str:
    loader = jinja2.FileSystemLoader(Path(__file__).parent / "templates")
    environment = jinja2.Environment(loader=loader, trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True)
    environment.filters |= {"quoted": quoteattr, "short": "{:.9g}".format, "long": "{:.12g}".format}
    return environment.get_template(template).render(**values)


def image_text(spacing: float, origin: float, maps: dict[str, np.ndarray]) -> str:
    """VTK's XML image of one layer: maps [y, x], or [y, x, 3] for vectors; values as base64, lengths first."""
    arrays = []
    for name, values in maps.items():
        kind, form = ("Float64", "<f8") if values.dtype.kind == "f" else ("UInt8", "u1")
        data = np.ascontiguousarray(values, form).tobytes()
        arrays.append((kind, name, values.ndim * 2 - 3, base64.b64encode(struct.pack("<Q", len(data)) + data).decode()))
    return _text("image.vti", n=len(next(iter(maps.values()))), spacing=spacing, origin=origin, arrays=arrays)


class Export:
    """The files that are made from one result."""

    def __init__(self, directory: Path):
        self.run = Result(directory)
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
        self.rigid = self.run.substrate.atoms
        if self.rigid is None:
            self.rigid = np.column_stack([x * self.run.edge / n, y * self.run.edge / n, height.ravel()])
        self.types = self.run.substrate.types
        if self.types is None:
            self.types = np.ones(len(self.rigid), int)
        if len(self.types) != len(self.rigid):
            raise self._strange(f"has {len(self.types)} types of {len(self.rigid)} atoms",
                                "each atom of the substrate has one")

    def _strange(self, what: str, why: str) -> InputOutputError:
        return InputOutputError(str(self.run.file.path), what, why, "was the file written by another program?")

    def _path(self, name: str) -> Path:
        return files.directory(self.run.directory / "export") / name

    def _frames(self) -> int:
        steps = self.run.file.members(TRAJECTORY + "/position")
        return len(self.run.file.array(TRAJECTORY + "/position/step", 1)) if "step" in steps else 0

    def _sites(self, state: State) -> int:
        """Of the state's maps, which must be of one size."""
        sizes = {len(state[name]) for name in state}
        if len(sizes) != 1:
            raise self._strange(f'state "{state.name}" cannot be exported', f"its maps have the sizes {sorted(sizes)}")
        return sizes.pop()

    def _atoms(self, layer: np.ndarray, *more: Any) -> Atoms:
        """Of the substrate, and of the block's lowest layer."""
        types = np.concatenate([self.types, np.full(len(layer), self.types.max() + 1)])
        return Atoms(np.vstack([self.rigid, layer]), types, self.run.edge, *more)

    def _state_atoms(self, state: State) -> Atoms:
        """Both layers with the maps as columns, zero for the substrate. Sites stand over its hollows."""
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

    def _trajectory(self) -> Iterator[Atoms]:
        file = self.run.file
        steps, times = (file.array(f"{TRAJECTORY}/position/{n}", 1) for n in ("step", "time"))
        moving = "velocity" in file.members(TRAJECTORY)
        for frame in range(len(steps)):
            layer = file.array(TRAJECTORY + "/position/value", 2, frame).astype(float)
            columns = {}
            if moving:
                v = file.array(TRAJECTORY + "/velocity/value", 2, frame).astype(float)
                columns["velocity"] = np.vstack([np.zeros_like(self.rigid), v])
            yield self._atoms(layer, columns, int(steps[frame]), float(times[frame]), self._mass)

    def atoms(self, xyz: bool) -> list[Path]:
        """Every state, and the trajectory."""
        write, end = (write_xyz, ".xyz") if xyz else (write_dump, ".dump")
        written = []

        def save(name: str, frames: Iterable[Atoms], write: Callable[[IO[str], Atoms], None]) -> None:
            path = self._path(name)
            with files.replacing(path) as beside, open(beside, "w", encoding="utf-8") as file:
                for frame in frames:
                    write(file, frame)
            written.append(path)

        for state in self.run.fields.values():
            atoms, name = self._state_atoms(state), file_name(state.name)
            save(name + end, [atoms], write)
            if not xyz:
                save(name + ".data", [atoms], partial(write_data, name=state.name, mass=self._mass))
        if self._frames():
            save("trajectory" + end, self._trajectory(), write)
        return written

    def pictures(self) -> list[Path]:
        written = []
        for state in self.run.fields.values():
            for name in ("gap", "pressure", "contact"):
                fig = figures.make(partial(map_of, self.run, state, name))
                if fig is not None:
                    written += figures.save(fig, self._path(f"{name}-{file_name(state.name)}"))
        return written

    def images(self) -> list[Path]:
        n = len(self.run.substrate.height)
        texts = {"substrate": image_text(self.run.edge / n, 0.0, {"height (Å)": self.run.substrate.height})}
        for state in self.run.fields.values():
            self._sites(state)
            maps = {_title(name): state[name] for name in state if not name.startswith("u_")}
            if set(DISPLACEMENT) <= set(state):
                maps["displacement (Å)"] = np.dstack([state[name] for name in DISPLACEMENT])
            texts[file_name(state.name)] = image_text(self.spacing, 0.5 * self.spacing, maps)
        for name, text in texts.items():
            files.write(self._path(name + ".vti"), text)
        return [self._path(name + ".vti") for name in texts]

    def xdmf(self) -> list[Path]:
        """run.xdmf beside run.h5; frames one by one in export/trajectory.h5."""
        n = len(self.run.substrate.height)
        grids = [("substrate", n, self.run.edge / n, 0.0, [("height (Å)", "/substrate/height", False)])]
        for state in self.run.fields.values():
            maps = [(_title(name), f"/fields/{state.name}/{name}", name == "contact") for name in state]
            if maps:
                grids.append((state.name, self._sites(state), self.spacing, 0.5 * self.spacing, maps))
        path, frames, times, points = self.run.directory / "run.xdmf", [], [], 0
        if self._frames():
            frames = [self._path("trajectory.h5")]
            times = self.run.file.array(TRAJECTORY + "/position/time", 1).tolist()
            with files.replacing(frames[0]) as beside, h5py.File(beside, "w") as copy:
                for number in range(len(times)):
                    values = self.run.file.array(TRAJECTORY + "/position/value", 2, number).astype("f4")
                    copy[f"position-{number}"] = values
                    points = len(values)
        files.write(path, _text("run.xdmf", grids=grids, points=points, times=times))
        return [*frames, path]


def _title(name: str) -> str:
    """Of a map, with its unit."""
    return name if name == "contact" else f"{name} ({'GPa' if name == 'pressure' else 'Å'})"


FORMATS: dict[str, Callable[[Export], list[Path]]] = {
    "xyz": partial(Export.atoms, xyz=True), "lammps": partial(Export.atoms, xyz=False), "xdmf": Export.xdmf,
    "vtk": Export.images, "png": Export.pictures}


def export(directory: Path, kind: str) -> list[Path]:
    """The files that were written. Raises InputOutputError for a directory with nothing to export."""
    if kind not in FORMATS:
        raise SceneError(f"--to {kind}", "is no format of export", "formats: " + ", ".join(FORMATS),
                         f"for example: asperity export {directory} --to xyz")
    written = FORMATS[kind](Export(directory))
    if not written:
        raise InputOutputError(str(directory / "run.h5"), "has nothing to export",
                               "it holds neither maps of a state nor a trajectory",
                               "a run that reaches its state at zero load has maps; output.trajectory asks for frames")
    return written
