# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity convert IN OUT.h5`: a map of heights or the atoms of a substrate, as the HDF5 that a scene names.

    text             a matrix with the headers of Gwyddion or SPIP, ESRI grid, XYZ (text.py)
    HDF5, npz, npy   of several maps, or of instruments: .h5-jpk, .topostats (arrays.py)
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
import tempfile
import zipfile
from functools import partial
from pathlib import Path
from typing import Any

import h5py
import numpy

from ..arguments import checks_call
from ..errors import Error, meant, to_install
from ..files import store
from ..running import program
from ..running.scene import toml_of
from ..units import in_angstrom, is_length, size_text
from . import arrays as map_arrays
from .atoms import extended_xyz, folded, lammps
from .channels import NO_HEIGHT, Channel, factor, first_line, refuse, select, text_of
from .text import of_text

PICTURES = {"PNG": b"\x89PNG", "JPEG": b"\xff\xd8\xff", "GIF": b"GIF8", "BMP": b"BM"}
"""How files of colours begin. TIFF is one of the formats of instruments."""
OLE = b"\xd0\xcf\x11\xe0"
"""How files of Microsoft's compound format begin, which Office and some programs of instruments write."""
PACKED = {"a PDF document": b"%PDF", "packed by gzip": b"\x1f\x8b", "packed by xz": b"\xfd7zXZ", "a file of MS Office": OLE}
"""How files begin in which no reader looks for heights."""
AS_TEXT = "export the heights as text: a matrix of numbers, or lines of x, y and z"
ARCHIVES = {"a spreadsheet": (("xl/", "content.xml"), AS_TEXT), "a text of an office program": (("word/",), AS_TEXT),
            "force curves of JPK": (("segments/", "shared-header/", "data-image.force"), "export the height image of the scan (.jpk, .h5-jpk)"),
            "an archive of contact.engineering": (("meta.yml",), "unpack it, and convert the file of one of its topographies")}
"""What archives hold, by the names in them, and what to do."""


def _refuse_other_files(path: Path, head: bytes) -> None:
    """Refuses a file that no reader of maps takes: a picture, a document, an archive, an empty file. Raises InputOutputError."""
    for kind, first in PICTURES.items():
        if head.startswith(first):
            raise refuse(path, f"is a picture ({kind}), not a map of heights", "its colours are no heights",
                         "export the heights, as text with a header or in the instrument's own format")
    if not head:
        raise refuse(path, "is empty", "it has no bytes", "export it again")
    found = next((kind for kind, first in PACKED.items() if head.startswith(first)), None)
    fix = AS_TEXT
    if head.startswith(b"PK"):
        if not zipfile.is_zipfile(path):
            raise refuse(path, "is a damaged archive", "it begins as a zip file and does not end as one", "copy or export it again")
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
        found = next((kind for kind, (parts, _) in ARCHIVES.items() if any(name.startswith(parts) for name in names)), None)
        fix = ARCHIVES[found][1] if found else fix
    if head.startswith(OLE) and path.suffix.lower() == ".mnt":
        found, fix = "a document of Digital Surf MountainsMap", "save the surface in it as .sur (Digital Surf), or as text"
    if found:
        raise refuse(path, f"is {found}, not a map of heights", "", "unpack it" if "packed" in found else fix)


def _unknown(path: Path, content: bytes, error: Exception) -> Error:
    """Makes the error of a file that no reader of maps takes: what it is, in one line, and what to do."""
    if content.startswith(b"[DataSet]"):
        curves = b"spec" in content[:1 << 16].lower()
        return refuse(path, "is a file of Nanosurf in which no map is found", "it holds spectroscopy" if curves else first_line(error),
                      "export the scan of the heights" if curves else AS_TEXT)
    if content.startswith(b"PK"):
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
        return refuse(path, "is an archive in which no map is found", f"it holds {len(names)} files: {', '.join(names[:3])}"
                      + ", ..." * (len(names) > 3), "unpack it, and convert the file of the heights")
    known = type(error).__name__ not in ("UnknownFileFormat", "CannotDetectFileFormat")
    begins = "".join(c if c.isprintable() else "." for c in content[:24].decode("latin-1"))
    return refuse(path, "cannot be read" if known else "is in no format that a reader of maps knows",
                  first_line(error) if known else f"it begins with {begins}", AS_TEXT)


def _instrument(path: Path, content: bytes) -> list[Channel]:
    """Returns the channels of an instrument's file."""
    try:
        from SurfaceTopography import open_topography
    except ImportError as error:
        raise refuse(path, "is in no format that is read without SurfaceTopography", error,
                     to_install("SurfaceTopography") + "; or export it as text with a header") from None
    try:
        reader = open_topography(str(path))
    except Exception as error:  # its message may list all readers, with bytes of the file
        raise _unknown(path, content, error) from None

    def load(number: int, name: str) -> dict[str, Any]:
        topography = reader.topography(channel_index=number)
        if topography.dim != 2:
            raise refuse(path, f"holds no map in channel {number + 1} ({name})", "it is a line scan", "measure or export an area")
        if topography.unit is None:
            raise refuse(path, f"does not say the unit of channel {number + 1} ({name})", "",
                         "take another channel (--channel), or export it as text with a header")
        # heights() is [x, y]; masked where there is no height.
        heights: numpy.ndarray = numpy.ma.filled(numpy.ma.asarray(topography.heights(), dtype=float), numpy.nan).T
        return {"heights": heights, "unit": topography.unit, "size": topography.physical_sizes}

    named = [(str(channel.name), channel.unit if isinstance(channel.unit, str) else None) for channel in reader.channels]
    return [Channel(name, partial(load, k, name), unit) for k, (name, unit) in enumerate(named)]


def _text_in(raw: bytes) -> str:
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        return raw.decode("utf-16")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def _found(source: str, channel: str | None, unit: str | None, as_it_is: bool) -> dict[str, Any]:
    """Reads the contents of a file: "heights", or "position" of atoms; and "notes". as_it_is: also reads files that the
    program reads itself."""
    path = Path(source)
    try:
        with path.open("rb") as file:
            head = file.read(8)
        _refuse_other_files(path, head)
        known = next((kind for kind, first in map_arrays.MAGIC.items() if head.startswith(first)), None)
        default = None
        with contextlib.ExitStack() as opened:
            if known == "HDF5":
                channels, default, own = map_arrays.of_hdf5(opened.enter_context(h5py.File(path, "r")))
            elif known or (head.startswith(b"PK") and all(n.endswith(".npy") for n in zipfile.ZipFile(path).namelist())):
                channels, own = map_arrays.of_numpy(path)
            else:
                raw = path.read_bytes()
                content, own = _text_in(raw), False
                if path.suffix.lower() == ".toml":
                    raise refuse(path, "is a scene, not a map of heights", "its name ends in .toml",
                                 "name the map that the scene names: surface.file")
                if re.search(r"^\s*(\d+\s+atoms|Atoms\s*(#.*)?)\s*$", content[:1 << 16], re.M) or content.startswith("ITEM:"):
                    return folded(path, lammps(path, content))
                if path.suffix.lower() in (".xyz", ".extxyz") and re.match(r"\s*\d+\s*\n", content):
                    return folded(path, extended_xyz(path))
                channels = of_text(path, content) or _instrument(path, raw)
            if own and channel is None and not as_it_is:
                raise refuse(path, "needs no conversion", f"the program reads {known}", "name it in the scene")
            found = select(path, channels, channel, default, unit)
            return found | {"scale": factor(path, found["scale"])} if found.get("scale") is not None else found
    except Error:
        raise
    except FileNotFoundError:
        raise refuse(source, "cannot be read", "there is no such file", meant(source) or "check the path") from None
    except Exception as error:  # every library has its own
        raise refuse(source, "cannot be read", first_line(error)) from None


def read_heights(source: str, channel: str | None = None, unit: str | None = None) -> dict[str, Any]:
    """Reads a map of heights from any file. Raises InputOutputError."""
    path, _, data_set = source.partition(":/")
    if data_set and channel is not None and channel.lstrip("/") != data_set:
        raise refuse(source, f"names the data set {data_set}, and --channel names {channel}", "one of them is meant", "leave one out")
    found = _found(path, data_set or channel, unit, True)
    if "heights" not in found:
        raise refuse(source, "holds atoms, not a map of heights", "", "name it in a scene: surface.kind = \"atoms\"")
    heights = numpy.asarray(found["heights"], dtype=float)
    return {**found, "heights": numpy.where(abs(heights) < NO_HEIGHT, heights, numpy.nan)}


def _doubts(file: Path, found: dict[str, Any]) -> list[str]:
    """Asks the program what may be wrong with the map in a file that convert() wrote: line noise, an implausible size and
    the like; if no scene takes the map as it is, returns the reason."""
    size, unit = found.get("size"), found.get("size_unit") or found.get("unit")
    made_up = found.get("unit") is None or not (size and is_length(unit))  # a size or a unit that the file does not tell
    n = max(2, min(found["heights"].shape))
    keys = {"kind": "file", "file": str(file.resolve()), "file_missing": "fill", "file_crop": "middle", "sites": n,
            "resample": "band-limited", "spacing": 1.0}
    if found.get("unit") is None:
        keys["file_unit"] = "nm"
    if size and is_length(unit):
        keys["spacing"] = min(size) * in_angstrom(str(unit)) / n
    else:
        keys["file_size"] = float(n)
    with tempfile.TemporaryDirectory(prefix="asperity-") as place:
        scene = Path(place) / "map.toml"
        scene.write_text(toml_of({"surface": keys}))
        try:
            return list(program.surface(str(scene))["doubts"])
        except Error as error:
            listed = [one for one in error.listed if not (made_up and str(one["what"]).startswith("surface.file:"))]
            said = "; ".join(one[name] for one in listed for name in ("what", "why", "fix") if one[name])
            return ["a scene refuses it as it is: " + said] if said else []


def _size(source: str, found: dict[str, Any]) -> tuple[float, ...]:
    """Returns the edges x and y as the file tells them; no edges if it does not. Raises InputOutputError unless they are above zero."""
    size = tuple(float(s) for s in found.get("size") or ())
    if any(not 0.0 < s < numpy.inf for s in size):
        raise refuse(source, "is a map without a size", "it says " + " x ".join(f"{s:g}" for s in size),
                     "correct the file; what --size and surface.file_size say holds over it")
    return size


@checks_call
def convert(source: str | Path, target: str | Path, channel: str | None = None) -> str:
    """Writes the map or the atoms of a file as HDF5.

    Parameters
    ----------
    source : str | Path
        File of heights or atoms.
    target : str | Path
        File to write, which must not be there; its name ends in .h5.
    channel : str, optional
        Name or number of the map in a file with several.

    Returns
    -------
    str
        Description of the contents, as lines of text.

    Raises
    ------
    InputOutputError
        The source cannot be read, or the target cannot be written.
    SceneError
        The target is there already, or is not called .h5.
    """
    source, target = str(source), Path(target)
    if target.suffix.lower() not in (".h5", ".hdf5"):
        raise refuse(target, "is no name of an HDF5 file", "what is written is HDF5",
                      f"for example {target.with_suffix('.h5')}")
    if target != Path(source):  # of a file that would be written to itself it is said first that it needs no conversion
        store.require_new(target)
    found = read_heights(source, channel) if ":/" in source else _found(source, channel, None, False)
    store.require_new(target)
    if channel is not None and "heights" not in found:
        raise refuse(source, f"has no channel '{channel}'", "it holds atoms", "leave --channel out")
    with store.new(target) as beside:
        with h5py.File(beside, "w", libver="earliest") as file:
            file.attrs["origin"] = found.get("origin") or Path(source).name
            if "heights" in found:
                heights = numpy.where(abs(numpy.asarray(found["heights"], dtype=float)) < NO_HEIGHT, found["heights"], numpy.nan)
                attributes = file.create_dataset("heights", data=heights).attrs
                told = {k: text_of(found.get(k)) for k in ("unit", "size_unit")} | {"scale": found.get("scale")}
                attributes.update({k: told[k] for k in ("unit", "scale", "size_unit") if told[k] is not None})
                size = _size(source, found)
                attributes.update(dict(zip(("size_x", "size_y"), size)))
                unit = found.get("unit") or "an unknown unit (set surface.file_unit)"
                across = found.get("size_unit") or found.get("unit")
                said = size_text(s * in_angstrom(str(across)) for s in size) if size and is_length(across) else \
                    " x ".join(f"{s:.4g}" for s in size) + (f" {across}" if across else " of an unknown unit")
                text = (f"{target}: {heights.shape[1]} x {heights.shape[0]} points, "
                        f"{said if size else 'of unknown size (set surface.file_size)'}, heights in {unit}; points without "
                        f"a height: {int(numpy.isnan(heights).sum())}")
            else:
                for name, kind in (("position", "f8"), ("box", "f8"), ("type", "i4")):
                    file[name] = numpy.array(found[name], kind)
                    file[name].attrs.update({"names": " ".join(found["names"])} if name == "type" else {"unit": "Å"})
                text = (f"{target}: {len(found['position'])} atoms of type {', '.join(found['names'][:20])}, in a box of "
                        f"{found['box'][0]:.8g} x {found['box'][1]:.8g} Å; {found['outside']} coordinates of atoms lay "
                        "outside of the box and were folded back")
        store.seal_hdf5(beside)
    notes = [*found.get("notes", []), *(_doubts(target, found) if "heights" in found else [])]
    return "\n".join([text, *(f"note: {note}" for note in notes)])
