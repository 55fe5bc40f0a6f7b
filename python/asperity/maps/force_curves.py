# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Force curves of atomic force microscopes: force over the height of the drive, on the way to the surface and back.

Text of columns is read here: a height (piezo, drive, Z) or a separation of tip and sample, and a force or a deflection, with names and
units above. All other files are read by afmformats (PyPI): JPK, Igor (Asylum), AFM Workshop, NT-MDT, HDF5, and maps of curves.
"""

from __future__ import annotations

import logging
import math
import re
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputOutputError, to_install
from ..units import conversion, quantity
from .channels import refuse
from .columns import cells_of, lines_of, numbers_of, rows_of, separator_of

FEWEST = 20
"""Points of a direction."""
TEXT = (".txt", ".csv", ".tsv", ".dat", ".asc", ".tab")
ROLES = {"tip": r"separation|tip|indent|distance", "height": r"height|piezo|drive|(?<![a-z])z(?![a-z])|ramp|displacement|extension|position",
         "deflection": r"defl", "force": r"force|load|kraft|(?<![a-z])f(?![a-z])", "way": r"retrac|segment|direction"}
"""Words of the name of a column, by what it is."""


@dataclass
class ForceCurve:
    """A force curve: height of the drive (nm, larger is away from the sample), force (nN, pressing is positive) in the order of measurement,
    True on the way back, stiffness of the cantilever (N/m), place in a map (µm), and notes."""

    name: str
    height: np.ndarray
    force: np.ndarray
    retracting: np.ndarray
    stiffness: float
    place: tuple[float, float] | None = None
    notes: list[str] = field(default_factory=list)

    def direction(self, retracting: bool) -> tuple[np.ndarray, np.ndarray]:
        """Returns height and force of a direction, from far to near."""
        height, force = (one[self.retracting == retracting] for one in (self.height, self.force))
        return (height[::-1], force[::-1]) if retracting else (height, force)


def read_force_curves(file: str, stiffness: str | None = None, sensitivity: str | None = None) -> tuple[list[ForceCurve], list[str]]:
    """Reads all force curves of a file. Raises InputOutputError."""
    path, given = Path(file), {}
    for name, text in (("stiffness", stiffness), ("sensitivity", sensitivity)):
        if text is not None:
            value = _sensitivity(text) if name == "sensitivity" else quantity(text, "N/m")
            if value is None or not 0 < value < math.inf:
                raise InputOutputError(f"--{name} {text}", f"is no {name} above zero", "", f"for example --{name} "
                                       + ("60nm/V" if name == "sensitivity" else "0.2N/m"))
            given[name] = value
    if path.suffix.lower() == ".nid":
        raise refuse(path, "is a file of Nanosurf, which is not read", "afmformats has no reader of it",
                     "export the curve as text with the columns height (nm) and force (nN)")
    if not path.is_file():
        lines_of(path)  # says why
    if path.suffix.lower() not in TEXT:
        return _of_afmformats(path, given)
    try:  # files of instruments are text, too
        return _of_afmformats(path, given)
    except InputOutputError as error:
        if "does not say" not in str(error) and (curves := _of_text(path, given)):
            return curves, []
        raise


def _sensitivity(text: str) -> float | None:
    """Returns a sensitivity in nm/V: V is no unit of scenes."""
    parts = re.fullmatch(r"(.*\S)\s*/\s*(m?)V", text.strip())
    found = quantity(parts[1], "nm") if parts else None
    return None if found is None or not parts else found * (1e3 if parts[2] else 1.0)


def _of_text(path: Path, given: Mapping[str, float]) -> list[ForceCurve] | None:
    """Returns the curve of a text of columns; None if no line names them."""
    lines = lines_of(path)
    first, rows = rows_of(lines)
    if first is None or len(rows) < 2 or first == 0:
        return None
    separator, decimal = separator_of(path, rows, 0)
    columns: dict[str, tuple[int, str, str]] = {}
    for line in reversed(lines[:first]):
        found: dict[str, tuple[int, str, str]] = {}
        for k, cell in enumerate(cells_of(line.lstrip("#%/! "), separator)):
            name, unit = _named(cell)
            role = next((role for role, words in ROLES.items() if re.search(words, name.lower())), "")
            if role and role not in found:
                found[role] = (k, unit, cell)
        if {"tip", "height"} & found.keys() and {"force", "deflection"} & found.keys():
            columns = found
            break
    if not columns:
        return None
    table = np.array([row for _, row in numbers_of(path, lines, first, separator, decimal, 1 + max(at for at, _, _ in columns.values()))])

    def values(role: str, unit: str) -> np.ndarray:
        at, own, words = columns[role]
        factor = conversion(own, unit)
        if factor is None:
            raise refuse(path, f"does not say the unit of '{words}'", "a wrong unit shifts the result by its factor",
                         f"write it behind the name: '{words} ({unit})'")
        return factor * table[:, at]

    stiffness = given.get("stiffness", math.nan)
    if "force" in columns:
        force = values("force", "nN")
    else:
        at, own, _ = columns["deflection"]
        deflection = table[:, at] * given.get("sensitivity", math.nan) * (1e-3 if own == "mV" else 1.0) if own in ("V", "mV") \
            else values("deflection", "nm")
        _require(path, {"sensitivity": float(deflection[0])} if own in ("V", "mV") else {}, "sensitivity")
        force = stiffness * deflection
    _require(path, {"stiffness": stiffness}, "stiffness")
    height = values("height", "nm") if "height" in columns else values("tip", "nm") - force / stiffness
    way = table[:, columns["way"][0]] if "way" in columns else None
    return [_curve(path.name, height, force, None if way is None else way != way[0], stiffness)]


def _named(cell: str) -> tuple[str, str]:
    """Returns the name and the unit of a column: "force (nN)", "drive, nm", "Z [µm]"."""
    parts = re.fullmatch(r"\s*(.*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])]|,\s*(\S+)|\s/\s*(\S+))\s*", cell)
    return (parts[1], next((one for one in parts.groups()[1:] if one), "")) if parts else (cell, "")


def _require(path: Path, known: Mapping[str, float], name: str) -> None:
    """Raises InputOutputError for a property of the cantilever that neither the file nor the user says."""
    if name in known and not math.isfinite(known[name]):
        example = {"stiffness": "0.2N/m", "sensitivity": "60nm/V"}[name]
        raise refuse(path, f"does not say the {name} of the cantilever", "force and place of the tip follow from it", f"name it: --{name} {example}")


def _curve(name: str, height: np.ndarray, force: np.ndarray, retracting: np.ndarray | None, stiffness: float,
           place: tuple[float, float] | None = None) -> ForceCurve:
    """Returns a curve whose height grows away from the sample. retracting None: the way back begins where the drive turns. Raises
    InputOutputError if there are too few points."""
    good = np.isfinite(height) & np.isfinite(force)
    height, force, notes = height[good], force[good], []
    retracting = None if retracting is None else retracting[good]
    if len(height) >= FEWEST and np.ptp(height) > 0:
        pressed = force >= force.min() + 0.9 * np.ptp(force)
        if np.mean(height[pressed]) > np.median(height):
            height = -height
            notes.append("the height grows towards the sample in the file: it is taken with the other sign")
        if retracting is None or not retracting.any():
            turn = int(np.argmin(height))
            retracting = np.arange(len(height)) > turn
    if retracting is None or min(np.sum(retracting), np.sum(~retracting)) < FEWEST and max(np.sum(retracting), np.sum(~retracting)) < FEWEST:
        raise InputOutputError(name, "is no force curve", f"it has {len(height)} points; {FEWEST} are needed in a direction", "measure it again")
    return ForceCurve(name, height, force, retracting, stiffness, place, notes)


def _of_afmformats(path: Path, given: Mapping[str, float]) -> tuple[list[ForceCurve], list[str]]:
    """Reads a file by afmformats."""
    try:
        import afmformats
        import afmformats.errors
    except ImportError as error:
        raise refuse(path, "is in no format that is read without afmformats", error, to_install("afmformats")
                     + "; or export it as text with the columns height (nm) and force (nN)") from None
    override: dict[str, Any] = {}
    if "stiffness" in given:
        override["spring constant"] = given["stiffness"]
    if "sensitivity" in given:
        override["sensitivity"] = 1e-9 * given["sensitivity"]
    logging.disable(logging.CRITICAL)  # it prints the traces of errors that it raises
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            data = afmformats.load_data(path, meta_override=override or None)
            return _taken(path, data, given)
    except InputOutputError:
        raise
    except afmformats.errors.MissingMetaDataError as error:
        words = {"stiffness": "spring constant", "sensitivity": "sensitivity"}
        lacks = [name for name, one in words.items() if one in str(error) and name not in given]
        raise refuse(path, f"does not say the {' and the '.join(lacks) or 'numbers'} of the cantilever", " ".join(str(error).split()),
                     "name them: " + " ".join({"stiffness": "--stiffness 0.2N/m", "sensitivity": "--sensitivity 60nm/V"}[one] for one in lacks)
                     if lacks else "export it as text") from None
    except Exception as error:  # a library of readers raises what it likes on damaged files
        raise refuse(path, "is no force curve that afmformats reads", " ".join(f"{type(error).__name__}: {error}".split())[:200],
                     "export it as text with the columns height (nm) and force (nN)") from None
    finally:
        logging.disable(logging.NOTSET)


def _taken(path: Path, data: Any, given: Mapping[str, float]) -> tuple[list[ForceCurve], list[str]]:
    """Takes the curves of afmformats."""
    curves: list[ForceCurve] = []
    reasons: list[str] = []
    for k, one in enumerate(data):
        name = f"{path.name}:{k}" if len(data) > 1 else path.name
        known = {key: one.metadata.get(word) for key, word in (("stiffness", "spring constant"), ("x", "position x"), ("y", "position y"))}
        stiffness = given.get("stiffness") or known["stiffness"]
        _require(path, {"stiffness": float(stiffness) if stiffness else math.nan}, "stiffness")
        try:
            column = next((c for c in ("height (measured)", "height (piezo)") if c in one), None)
            if column is None or "force" not in one:
                raise InputOutputError(name, "has no height or no force", "its columns are " + ", ".join(one.columns), "")
            height, force, way = (np.asarray(one[c], float) for c in (column, "force", "segment"))
            place = (1e6 * known["x"], 1e6 * known["y"]) if known["x"] is not None and known["y"] is not None else None
            both = (way == 0) | (way == 1)  # not what is between: a pause at the surface
            curves.append(_curve(name, 1e9 * height[both], 1e9 * force[both], way[both] == 1, float(stiffness), place))
        except InputOutputError as error:
            reasons.append(" ".join(str(error).split()))
    if not curves:
        raise refuse(path, "holds no force curve", reasons[0] if reasons else "it is empty", "measure it again")
    return curves, reasons
