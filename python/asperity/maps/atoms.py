# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Atoms of a substrate in files of LAMMPS and in extended XYZ."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

import numpy

from ..errors import to_install
from .channels import refuse

STYLES = {"atomic": (1, 2, 5), "charge": (1, 3, 6), "bond": (2, 3, 6), "angle": (2, 3, 6), "molecular": (2, 3, 6),
          "full": (2, 4, 7)}
"""LAMMPS' atom styles: the column of the type, that of x, and how many there are without image flags."""
FARTHEST = 1e7
"""Å; coordinates beyond (1 mm) lose the digits that forces need."""


def lammps(path: Path, content: str) -> dict:
    """Reads the atoms of a LAMMPS data file. Raises InputOutputError."""
    lines = content.split("\n")
    units = re.search(r"units = (\w*)", lines[0])
    if lines[0].startswith("ITEM:") or (units and units[1] not in ("metal", "real")):
        raise refuse(path, "is no LAMMPS data file in Å", lines[0][:80], "write_data, in units of style metal")
    header, section, style, columns, atoms, unread = {}, "", None, 0, {}, {}
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
            elif words:
                unread[section] = True
        except (ValueError, KeyError) as error:
            raise refuse(f"{path}:{number}", "the line cannot be read", error, "atom styles are " + ", ".join(STYLES)
                          + "; write it behind the section's name: Atoms # molecular") from None
    box = [header.get(f"{a}lo {a}hi", []) for a in "xyz"]
    if [len(side) for side in box[:2]] != [2, 2] or header.get("atoms") != [len(atoms)] or not content.endswith("\n"):
        raise refuse(path, "the file of atoms is not whole", f"{len(atoms)} atoms are there, its header: {header}")
    if any(header.get("xy xz yz", [])) or {"avec", "bvec", "cvec"} & header.keys():
        raise refuse(path, "the box of the atoms is not orthogonal", "", "repeat or cut the atoms to a square box")
    if style in ("charge", "full"):
        unread["charges"] = True
    return {"notes": _not_read("sections and columns", unread),
            "types": [atom[0] for atom in atoms.values()], "position": [atom[1] for atom in atoms.values()],
            "low": [side[0] if side else 0.0 for side in box],
            "width": [side[1] - side[0] if side else 0.0 for side in box]}


def _not_read(what: str, names: Iterable[str]) -> list[str]:
    """Returns a note on what a file has beside types and places."""
    return [f"{what} that are not read, since a rigid substrate is types and places: {', '.join(names)}"] if names else []


def extended_xyz(path: Path) -> dict:
    """Reads the atoms of a frame of extended XYZ, by ASE. Raises InputOutputError without ASE, and ValueError for a frame that
    is not periodic along x and y in an orthogonal box, or several frames."""
    try:
        from ase.io import read
    except ImportError as error:
        raise refuse(path, "needs ASE", error, to_install("ase")) from None
    frames = read(str(path), index=":", format="extxyz")
    cell = numpy.array(frames[0].cell)
    if len(frames) > 1 or not all(frames[0].pbc[:2]) or abs(cell - numpy.diag(numpy.diag(cell))).max() > 1e-9:
        raise ValueError(f"{len(frames)} frames, pbc {frames[0].pbc}, Lattice {cell.tolist()}; one frame, periodic "
                         "along x and y, in an orthogonal box is needed")
    others = [*(name for name in frames[0].arrays if name not in ("numbers", "positions")),
              *(name for name in frames[0].info if name != "Origin")]
    return {"notes": _not_read("arrays and values", others), "types": frames[0].get_chemical_symbols(), "position": frames[0].positions,
            "low": frames[0].info.get("Origin", (0.0, 0.0, 0.0)), "width": numpy.diag(cell)}


def folded(path: Path, atoms: dict) -> dict:
    """Folds atoms into their box, along x and y. Raises InputOutputError."""
    place, width = numpy.array(atoms["position"], dtype=float), atoms["width"]
    if not (abs(place) <= FARTHEST).all() or not 0.0 < min(width[:2]) <= max(width) <= FARTHEST:
        raise refuse(path, "the atoms or their box have no size", f"coordinates up to {abs(place).max():g} Å in a box "
                      f"of {width[0]:g} x {width[1]:g} Å, and {FARTHEST:g} Å are the limit")
    place[:, :2] -= atoms["low"][:2]
    outside = 0
    for k in range(3):
        from_side = place[:, k] - (atoms["low"][2] if k == 2 else 0.0)
        if width[k] > 0.0 and ((from_side < -width[k]) | (from_side > 2.0 * width[k])).any():
            raise refuse(path, "an atom is more than a box away from the box",
                          f"along {'xyz'[k]}, where it is {width[k]:g} Å wide")
        if k < 2:
            outside += int(((place[:, k] < 0.0) | (place[:, k] > width[k])).sum())
            place[:, k] -= width[k] * numpy.floor(place[:, k] / width[k])
            place[place[:, k] >= width[k], k] = 0.0  # of a negative number next to zero
    names = list(dict.fromkeys(atoms["types"]))
    return {"position": place, "names": names, "type": [names.index(t) for t in atoms["types"]], "box": width[:2],
            "outside": outside, "notes": atoms["notes"]}
