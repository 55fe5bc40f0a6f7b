# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity convert IN OUT.h5`: a map of heights or the atoms of a substrate, as the HDF5 that a scene names.

    text             a matrix with the headers of Gwyddion or SPIP, ESRI grid, XYZ (three columns)
    LAMMPS data      read here: ASE 3.22 and 3.29 leave out xlo and ylo, and make up or drop atoms that are not counted
    extended XYZ     by ASE (python3-ase)
    all others       maps, by SurfaceTopography (PyPI): Gwyddion .gwy, SDF, X3P, netCDF and those of many instruments

OUT of a map: /heights [y][x], numbers and unit as IN has them (attributes unit, scale; size_x, size_y in
size_unit or else in unit), NaN where a height is missing. OUT of atoms: /position [atom][3] from the box's lower
corner along x and y, /type [atom] (attribute names), /box [2]; in Å. Both end in a digest, by which the program
notices damage.
"""

from __future__ import annotations

import contextlib
import re
from pathlib import Path

import h5py
import numpy

from . import files
from .errors import Error, InputOutputError, to_install

LENGTHS = {"Å": 0, "\u212b": 0, "A": 0, "Ang": 0, "angstrom": 0, "Angstrom": 0, "fm": -5, "pm": -2, "nm": 1, "um": 4,
           "\u00b5m": 4, "\u03bcm": 4, "mm": 7, "cm": 8, "m": 10, "km": 13}
"""Powers of ten of units of length, in Å."""
STYLES = {"atomic": (1, 2, 5), "charge": (1, 3, 6), "bond": (2, 3, 6), "angle": (2, 3, 6), "molecular": (2, 3, 6),
          "full": (2, 4, 7)}
"""LAMMPS' atom styles: the column of the type, that of x, and how many there are without image flags."""
SIZE = r"([-+]?[\d.,]+(?:[eE][-+]?\d+)?)\s*(.*)"
HEADERS = ("width", "height", "edge", "x-length", "y-length", "value units", "x-unit", "y-unit", "z-unit", "bit2nm")
"""Of which _matrix() takes sizes and units."""
PICTURES = {"PNG": b"\x89PNG", "JPEG": b"\xff\xd8\xff", "GIF": b"GIF8", "BMP": b"BM"}
"""How files of colours begin. TIFF is one of the formats of instruments."""
FARTHEST = 1e7
"""Å; coordinates beyond (1 mm) lose the digits that forces need."""


def _refuse(where, what: str, why: object = "", fix: str = "correct it, or write it again") -> InputOutputError:
    return InputOutputError(str(where), what, str(why), fix)


class _Text:
    """A map as text: (number of the line, line) without comments, and what those say: "# name: value"."""

    def __init__(self, path: Path, content: str):
        self.path, self.header, self.lines, self.separators = path, {}, [], str.maketrans(",;\t", "   ")
        for number, line in enumerate(content.split("\n"), 1):
            line, _, comment = line.partition("#")
            if said := re.match(r"([^:=：]*)[:=：](.*)", comment):
                self.header.setdefault(said[1].strip().lower(), said[2].strip())
            if line.strip():
                self.lines.append((number, line.strip()))

    def take_commas(self) -> None:
        """As decimal points, where all of them can be and tabs or semicolons separate the numbers."""
        body = "\n".join(line for _, line in self.lines)
        if "," not in body or re.search(r"(?<!\d),|,(?!\d)|,[^\s;,]*,", body) or not re.search(r"[ \t;]", body):
            return
        if not re.search(r"[\t;]", body) or "." in body:
            raise _refuse(self.path, "the commas may be decimal points or separate numbers",
                          "there are blanks or points as well",
                          "write decimal points, or separate the numbers by tabs or semicolons")
        self.separators = str.maketrans(",;\t", ".  ")

    def rows(self) -> list[tuple[int, list[float]]]:
        found = []
        for number, line in self.lines:
            words = line.translate(self.separators).split()
            try:
                found.append((number, [numpy.nan if w.lower() in ("bad", "void") else float(w) for w in words]))
            except ValueError as error:
                raise _refuse(f"{self.path}:{number}", "the line is no row of numbers", error,
                              "take headings out of the file, or put a # before them") from None
        return [(number, row) for number, row in found if row]

    def matrix(self, said: dict, counts: tuple[str, str]) -> numpy.ndarray:
        rows = self.rows()
        for number, row in rows:
            if len(row) != len(rows[0][1]):
                raise _refuse(f"{self.path}:{number}", "the rows of the map are not of one length",
                              f"this line has {len(row)} numbers, line {rows[0][0]} has {len(rows[0][1])}")
        heights = numpy.array([row for _, row in rows], ndmin=2)
        for key, there in zip(counts, heights.shape[::-1]):
            if re.fullmatch(r"\d+(\.0)?", str(said.get(key, ""))) and float(said[key]) != there:
                raise _refuse(self.path, "the height map is not whole",
                              f"its header says {key} = {said[key]}, and {there} are there", "export it again")
        return heights

    def translate(self) -> None:
        """Gwyddion writes its headers in the language of its user, always in this order: title, width, height, unit
        of the heights. Gives them their English names."""
        if {"width", "height", "value units"} & self.header.keys():
            return
        said = list(self.header.items())
        for (_, width), (_, height), (_, unit) in zip(said, said[1:], said[2:]):
            sizes = [re.fullmatch(SIZE, text) for text in (width, height)]
            if unit in LENGTHS and all(size and size[2] in LENGTHS for size in sizes):
                self.header |= {"width": width, "height": height, "value units": unit}
                return

    def unused(self) -> list[str]:
        """Headers that state a length, of which nothing was taken."""
        def states(text: str) -> bool:
            size = re.fullmatch(SIZE, text)
            return text in LENGTHS or bool(size and size[2] in LENGTHS)

        taken = {self.header.get(key) for key in HEADERS}
        return [f"{key}: {text}" for key, text in self.header.items()
                if key not in HEADERS and text not in taken and states(text)]

    def size(self, keys: tuple[str, ...], unit: str | None) -> float | None:
        """Å, by the first header that gives a number: with its unit, or in this one."""
        for key in keys:
            if found := re.fullmatch(SIZE, self.header.get(key, "")):
                value, unit = float(found[1].replace(",", ".")), found[2] or unit
                if unit not in LENGTHS or not 0.0 < value < numpy.inf:
                    raise _refuse(self.path, f"the header '{key}: {self.header[key]}' is no size",
                                  f"unit: {unit}" if value > 0.0 else "it is not above zero", "correct the header")
                return value * 10.0 ** LENGTHS[unit]
        return None


def _matrix(text: _Text) -> dict:
    """With the headers of Gwyddion ("# Value units: nm") and SPIP ("# Bit2nm = 0.03"), or without."""
    text.take_commas()
    text.translate()
    said = {key: value for key, value in text.header.items() if value}
    spip = "x-pixels" in said or "bit2nm" in said or said.get("file format", "").lower() == "ascii"
    found = {"heights": text.matrix(said, ("x-pixels", "y-pixels")),
             "unit": said.get("value units", said.get("z-unit"))}
    if "bit2nm" in said and not found["unit"]:
        if not re.fullmatch(r"[-+]?[\d.]*[1-9][\d.]*([eE][-+]?\d+)?", said["bit2nm"]):
            raise _refuse(text.path, f"the header 'Bit2nm = {said['bit2nm']}' is no factor", "", "correct the header")
        found |= {"unit": "nm", "scale": float(said["bit2nm"])}
    lateral = said.get("x-unit", "nm" if spip else found["unit"])
    size = (text.size(("width", "x-length", "edge"), lateral),
            text.size(("height", "y-length", "edge"), said.get("y-unit", lateral)))
    found |= {"notes": [f"the header '{header}' is not understood" for header in text.unused()]}
    return found | ({"size": size, "size_unit": "Å"} if all(size) else {})


def _matrix_or_points(text: _Text) -> dict:
    """More than three rows of three numbers are the points of a map where they lie on a grid."""
    found = _matrix(text)
    rows, columns = found["heights"].shape
    if columns == 3 < rows:
        with contextlib.suppress(InputOutputError):
            points = _points(text)
            found["notes"].append("its three columns are taken as points x, y and height")
            return points | {"unit": found["unit"], "notes": found["notes"]}
        found["notes"].append("its three columns are rows of a map: as points x, y and height they are on no grid")
    return found


def _esri(text: _Text) -> dict:
    header = {}
    while text.lines and text.lines[0][1][0] not in "+-.0123456789":
        number, line = text.lines.pop(0)
        try:
            name, value = line.split()
            header[name.lower()] = float(value)
        except ValueError as error:
            raise _refuse(f"{text.path}:{number}", "the line is no header of a grid", error) from None
    heights = text.matrix(header, ("ncols", "nrows"))
    heights[heights == header.get("nodata_value")] = numpy.nan
    pixel = [header.get(own, header.get("cellsize", 0.0)) for own in ("dx", "dy")]
    if not min(pixel) > 0.0:
        raise _refuse(text.path, "the grid has no pixel size", "cellsize is not above zero", "export the grid again")
    return {"heights": heights, "size": tuple(p * n for p, n in zip(pixel, heights.shape[::-1]))}


def _points(text: _Text) -> dict:
    """XYZ: the points of a grid in any order; those that are not given are missing."""
    def refuse(why: str) -> InputOutputError:
        return _refuse(text.path, "the points of the map are on no grid", why, "interpolate them onto a grid before")

    text.take_commas()
    rows = text.rows()
    for number, row in rows:
        if len(row) != 3 or not numpy.isfinite(row[:2]).all():
            raise _refuse(f"{text.path}:{number}", "the line is no point of a map", f"{row}: x, y and z are needed",
                          "a matrix of heights must not be called .xyz")
    x, y, z = numpy.array([row for _, row in rows]).reshape(-1, 3).T
    axes = []
    for name, places in (("x", x), ("y", y)):
        span = numpy.ptp(places) if len(places) else 0.0
        gaps = numpy.diff(numpy.sort(places))
        steps = numpy.rint(span / gaps[gaps > 1e-6 * span].min()) if span > 0.0 else 0.0
        pixel = span / max(1.0, steps)
        index = numpy.rint((places - places.min()) / pixel) if span > 0.0 else places
        if not span > 0.0 or (abs(places - (places.min() + index * pixel)) > 0.01 * pixel).any():
            raise refuse(f"their {name} are not evenly spaced")
        axes.append((index.astype(int), pixel, int(steps) + 1))
    (across, dx, columns), (along, dy, lines) = axes
    if columns * lines > 4 * len(z):
        raise refuse(f"{len(z)} points for {columns} different x and {lines} different y")
    place = along * columns + across
    if len(numpy.unique(place)) != len(place):
        raise refuse("a point stands twice")
    heights = numpy.full(columns * lines, numpy.nan)
    heights[place] = z
    return {"heights": heights.reshape(lines, columns), "size": (dx * columns, dy * lines)}


def _instrument(path: Path, wanted: str | None) -> dict:
    """One channel of an instrument's file: the one wanted, by name or number from 1, or the reader's first choice."""
    try:
        from SurfaceTopography import open_topography
    except ImportError as error:
        raise _refuse(path, "is in no format that is read without SurfaceTopography", error,
                      to_install("SurfaceTopography") + "; or export it as text with a header") from None
    reader = open_topography(str(path))
    names = [str(channel.name) for channel in reader.channels]
    number = reader.default_channel.index
    listed = ", ".join(f"{k} {name}" for k, name in enumerate(names, 1))
    if wanted is not None:
        number = names.index(wanted) if wanted in names else int(wanted) - 1 if wanted.isdecimal() else -1
        if not 0 <= number < len(names):
            raise _refuse(path, f"has no channel '{wanted}'", f"its channels: {listed}",
                          f"name one of them, or its number: --channel {min(2, len(names))}")
    topography = reader.topography(channel_index=number)
    if topography.dim != 2:
        raise _refuse(path, f"holds no map in channel {number + 1} ({names[number]})",
                      f"it is a line scan; its channels: {listed}", "measure or export an area")
    if topography.unit is None:
        raise _refuse(path, f"does not say the unit of channel {number + 1} ({names[number]})",
                      f"its channels: {listed}", "take another channel (--channel), or export it as text with a header")
    # heights() is [x, y]; masked where there is no height.
    heights = numpy.ma.filled(numpy.ma.asarray(topography.heights(), dtype=float), numpy.nan).T
    others = [f"{k} {name}" for k, name in enumerate(names, 1) if k != number + 1]
    return {"heights": heights, "unit": topography.unit, "size": topography.physical_sizes,
            "notes": [f"channel {number + 1} ({names[number]}) was taken"
                      + (f"; --channel takes another: {', '.join(others)}" if others else "")]}


def _lammps(path: Path, content: str) -> dict:
    lines = content.split("\n")
    units = re.search(r"units = (\w*)", lines[0])
    if lines[0].startswith("ITEM:") or (units and units[1] not in ("metal", "real")):
        raise _refuse(path, "is no LAMMPS data file in Å", lines[0][:80], "write_data, in units of style metal")
    header, section, style, columns, atoms = {}, "", None, 0, {}
    for number, line in enumerate(lines[1:], 2):
        text, _, comment = (part.strip() for part in line.partition("#"))
        words = text.split()
        try:
            if text[:1].isalpha():
                if text == "Atoms" and style is not None:
                    raise ValueError("a second section Atoms")
                section, style = text, comment if text == "Atoms" else style
            elif words and not section:
                name = " ".join(w for w in words if w[0].isalpha())
                header[name] = [float(w) for w in words[:len(words) - len(name.split())]]
            elif words and section == "Atoms":
                columns = columns or len(words)
                style = style or {5: "atomic", 8: "atomic", 7: "full", 10: "full"}.get(columns, "")
                if style not in STYLES:
                    raise ValueError(f"its atom style is {style}" if style else f"no atom style is named, and {columns} "
                                     "columns may be of several")
                kind, x, plain = STYLES[style]
                if len(words) != columns or columns not in (plain, plain + 3) or int(words[0]) in atoms:
                    raise ValueError(f"atom {words[0]} with {len(words)} columns, of style {style} with {plain}")
                if not words[kind][0].isalpha():
                    int(words[kind])  # a type is a whole number, or a label
                atoms[int(words[0])] = words[kind], [float(w) for w in words[x:x + 3]]
                _ = [int(w) for w in words[plain:]]  # image flags
        except (ValueError, KeyError) as error:
            raise _refuse(f"{path}:{number}", "the line cannot be read", error, "atom styles are " + ", ".join(STYLES)
                          + "; write it behind the section's name: Atoms # molecular") from None
    box = [header.get(f"{a}lo {a}hi", []) for a in "xyz"]
    if [len(side) for side in box[:2]] != [2, 2] or header.get("atoms") != [len(atoms)] or not content.endswith("\n"):
        raise _refuse(path, "the file of atoms is not whole", f"{len(atoms)} atoms are there, its header: {header}")
    if any(header.get("xy xz yz", [])) or {"avec", "bvec", "cvec"} & header.keys():
        raise _refuse(path, "the box of the atoms is not orthogonal", "", "repeat or cut the atoms to a square box")
    return {"types": [atom[0] for atom in atoms.values()], "position": [atom[1] for atom in atoms.values()],
            "low": [side[0] if side else 0.0 for side in box],
            "width": [side[1] - side[0] if side else 0.0 for side in box]}


def _extended_xyz(path: Path) -> dict:
    try:
        from ase.io import read
    except ImportError as error:
        raise _refuse(path, "needs ASE", error, to_install("ase")) from None
    frames = read(str(path), index=":", format="extxyz")
    cell = numpy.array(frames[0].cell)
    if len(frames) > 1 or not all(frames[0].pbc[:2]) or abs(cell - numpy.diag(numpy.diag(cell))).max() > 1e-9:
        raise ValueError(f"{len(frames)} frames, pbc {frames[0].pbc}, Lattice {cell.tolist()}; one frame, periodic "
                         "along x and y, in an orthogonal box is needed")
    return {"types": frames[0].get_chemical_symbols(), "position": frames[0].positions,
            "low": frames[0].info.get("Origin", (0.0, 0.0, 0.0)), "width": numpy.diag(cell)}


def _folded(path: Path, atoms: dict) -> dict:
    """Positions from the box's lower corner, folded into it, along x and y."""
    place, width = numpy.array(atoms["position"], dtype=float), atoms["width"]
    if not (abs(place) <= FARTHEST).all() or not 0.0 < min(width[:2]) <= max(width) <= FARTHEST:
        raise _refuse(path, "the atoms or their box have no size", f"coordinates up to {abs(place).max():g} Å in a box "
                      f"of {width[0]:g} x {width[1]:g} Å, and {FARTHEST:g} Å are the limit")
    place[:, :2] -= atoms["low"][:2]
    outside = 0
    for k in range(3):
        from_side = place[:, k] - (atoms["low"][2] if k == 2 else 0.0)
        if width[k] > 0.0 and ((from_side < -width[k]) | (from_side > 2.0 * width[k])).any():
            raise _refuse(path, "an atom is more than a box away from the box",
                          f"along {'xyz'[k]}, where it is {width[k]:g} Å wide")
        if k < 2:
            outside += int(((place[:, k] < 0.0) | (place[:, k] > width[k])).sum())
            place[:, k] -= width[k] * numpy.floor(place[:, k] / width[k])
            place[place[:, k] >= width[k], k] = 0.0  # of a negative number next to zero
    names = list(dict.fromkeys(atoms["types"]))
    return {"position": place, "names": names, "type": [names.index(t) for t in atoms["types"]], "box": width[:2],
            "outside": outside}


def _found(source: str, channel: str | None) -> dict:
    """What the file holds: "heights", or "position" of atoms; and "notes" on it."""
    path = Path(source)
    try:
        with path.open("rb") as file:
            head = file.read(8)
        for kind, first in PICTURES.items():
            if head.startswith(first):
                raise _refuse(path, f"is a picture ({kind}), not a map of heights", "its colours are no heights",
                              "export the heights, as text with a header or in the instrument's own format")
        for kind, first in (("HDF5", b"\x89HDF\r\n\x1a\n"), (".npy", b"\x93NUMPY")):
            if head.startswith(first):
                raise _refuse(path, "needs no conversion", f"the program reads {kind}", "name it in the scene")
        raw = path.read_bytes()
        try:
            content = raw.decode("utf-8-sig")
        except UnicodeDecodeError:
            content = raw.decode("latin-1")
        if re.search(r"^\s*(\d+\s+atoms|Atoms\s*(#.*)?)\s*$", content[:1 << 16], re.M) or content.startswith("ITEM:"):
            return _folded(path, _lammps(path, content))
        if path.suffix.lower() in (".xyz", ".extxyz") and re.match(r"\s*\d+\s*\n", content):
            return _folded(path, _extended_xyz(path))
        text = _Text(path, content)
        first = text.lines[0][1] if text.lines and "\0" not in content else "no text"
        if not re.match(r"[-+.\d]|nan|inf|bad|void|ncols", first, re.I):
            return _instrument(path, channel)
        return (_esri if first.lower().startswith("ncols") else _points if path.suffix == ".xyz" else
                _matrix_or_points)(text)
    except Error:
        raise
    except FileNotFoundError:
        raise _refuse(source, "cannot be read", "there is no such file", "check the path") from None
    except Exception as error:  # every library has its own
        raise _refuse(source, "cannot be read", f"{type(error).__name__}: {error}") from None


def read_heights(source: str, channel: str | None = None) -> dict:
    """Of a file that convert() takes as a map: heights, unit, scale, size, size_unit, notes, as far as it tells them."""
    found = _found(source, channel)
    if "heights" not in found:
        raise _refuse(source, "holds atoms, not a map of heights", "", "name it in a scene: surface.kind = \"atoms\"")
    return found


def convert(source: str | Path, target: str | Path, channel: str | None = None) -> str:
    """Writes the map or the atoms of `source` to `target`; of an instrument's file the channel of this name or number.
    Returns what was found, as lines of text."""
    source, target = str(source), Path(target)
    if target.suffix.lower() not in (".h5", ".hdf5"):
        raise _refuse(target, "is no name of an HDF5 file", "what is written is HDF5",
                      f"for example {target.with_suffix('.h5')}")
    files.require_new(target)
    found = _found(source, channel)
    if channel is not None and not any(note.startswith("channel") for note in found.get("notes", [])):
        raise _refuse(source, f"has no channel '{channel}'", "it is no file of an instrument: it holds one map",
                      "leave --channel out")
    with files.new(target) as beside:
        with h5py.File(beside, "w", libver="earliest") as file:
            file.attrs["origin"] = found.get("origin", Path(source).name)
            if "heights" in found:
                heights = numpy.where(numpy.isfinite(found["heights"]), found["heights"], numpy.nan)
                attributes = file.create_dataset("heights", data=heights).attrs
                attributes.update({k: found[k] for k in ("unit", "scale", "size_unit") if found.get(k) is not None})
                size = found.get("size") or ()
                attributes.update(dict(zip(("size_x", "size_y"), map(float, size))))
                unit = found.get("unit") or "an unknown unit (set surface.file_unit)"
                said = " x ".join(f"{s:g}" for s in size) + " " + (found.get("size_unit") or unit)
                text = (f"{heights.shape[1]} x {heights.shape[0]} points, "
                        f"{said if size else 'of unknown size (set surface.file_size)'}, heights in {unit}; points without "
                        f"a height: {int(numpy.isnan(heights).sum())}")
            else:
                for name, kind in (("position", "f8"), ("box", "f8"), ("type", "i4")):
                    file[name] = numpy.array(found[name], kind)
                    file[name].attrs.update({"names": " ".join(found["names"])} if name == "type" else {"unit": "Å"})
                text = (f"{len(found['position'])} atoms of type {', '.join(found['names'][:20])}, in a box of "
                        f"{found['box'][0]:.8g} x {found['box'][1]:.8g} Å; {found['outside']} coordinates of atoms lay "
                        "outside of the box and were folded back")
        files.seal_hdf5(beside)
    return "\n".join([text, *(f"note: {note}" for note in found.get("notes", []))])
