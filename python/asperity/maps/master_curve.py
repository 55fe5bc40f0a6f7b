# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Master curves of viscoelastic moduli as text, as instruments for dynamic mechanical analysis export them: frequency, storage
and loss modulus (or the loss factor tan δ), with or without a shift factor aT.

Cells stand between tabs, semicolons, commas or blanks, with decimal points or commas; comments begin with #, % or //. A line
names the columns, and the units stand beside the names or in the next line.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..units import conversion
from .channels import refuse
from .columns import COMMENTS, cells_of, lines_of, numbers_of, rows_of, separator_of

FEWEST_POINTS = 6
FALL = 0.1
"""So much may the storage modulus fall behind its largest value at lower frequencies, as measured curves do."""
SAME_FREQUENCY = 0.01
"""Difference of two columns of frequencies that are one, over them."""
ONE_TEMPERATURE = 2.0
"""K: temperatures closer than this are one."""


class MasterCurve(NamedTuple):
    """Moduli over frequency, the lowest frequency first."""

    frequency: np.ndarray
    """angular, rad/s, shifted to the reference temperature"""
    storage: np.ndarray
    """Pa"""
    loss: np.ndarray
    """Pa"""
    kind: str
    """E: Young's modulus; G: shear modulus"""
    source: str
    notes: list[str]


class _Column(NamedTuple):
    role: str
    kind: str
    logarithm: bool
    unit: str
    words: str


def _plain(text: str) -> str:
    """Returns a unit or a name with plain primes and powers."""
    for signs, plain in (("″”“\"", "''"), ("′’‘`´", "'"), ("²", "^2"), ("⁻¹", "^-1"), ("·⋅*", " ")):
        for sign in signs if len(signs) > 2 or plain != "^-1" else (signs,):
            text = text.replace(sign, plain)
    return text.strip()


def _factor(unit: str, of: str) -> float | None:
    """Returns a unit of "frequency" in rad/s, or of "modulus" in Pa; None if it is none. 1/s is no unit of frequency: it may be
    Hz or rad/s."""
    unit = _plain(unit)
    if of == "modulus":
        return conversion(unit, "Pa")
    if unit.startswith("rad"):
        return conversion(re.sub(r"(?<=s)ec\b", "", "1" + unit[3:].replace(".", " ")), "1/s")
    turns = conversion(unit, "Hz") if "Hz" in unit else None
    return None if turns is None else 2 * math.pi * turns


def _unit(text: str) -> str:
    """Returns the text if it is a unit, else ""."""
    text = text.strip()
    return text if any(_factor(text, of) is not None for of in ("frequency", "modulus")) else ""


def _column(cell: str, below: str) -> _Column:
    """Returns the meaning of a column. below: the cell of the next line, which may be the unit."""
    text = _plain(cell)
    written = [*re.finditer(r"[\[(]([^\])]*)[\])]\s*$", text), *re.finditer(r"(?:/|,|\bin\b)\s*(?=(\S.*)$)", text)]
    named = next((one for one in written if _unit(one[1])), None)
    unit = _unit(named[1]) if named else ""
    name = text[:named.start()] if named else text[:written[0].start()] if written and text.endswith((")", "]")) else text
    if not unit and (last := text.rsplit(None, 1))[1:] and _unit(last[1]):
        name, unit = last[0], _unit(last[1])
    unit = unit or _unit(re.sub(r"^[\[(](.*)[\])]$", r"\1", below.strip()))
    logarithm = re.match(r"\s*(log|lg)(10)?\b[\s_(]*", name, re.I)
    name = name[logarithm.end():] if logarithm else name
    low = name.lower().strip(" ()_:")
    letter = re.search(r"(?<![a-z])([eg])('|_?stor|_?loss)", low)
    kind = letter[1].upper() if letter else "G" if "shear" in low else "E" if re.search(r"young|tensile", low) else ""
    frequency = re.search(r"freq|omega|ω|^[fw](_?(red|set))?$", low)
    if "tan" in low:
        role = "tan"
    elif re.search(r"''|loss|verlust", low):
        role = "loss"
    elif re.search(r"'|storage|speicher|^[eg]_?stor$", low):
        role = "storage"
    elif frequency and re.search(r"red|shifted|a_?t\b", low):
        role = "reduced"
    elif frequency:
        role = "angular" if re.search(r"omega|ω|angular|kreis", low) else "frequency"
    elif re.search(r"shift|^a_?t$|^a_?t\b", low):
        role = "shift"
    elif re.search(r"temp|^t$", low):
        role = "temperature"
    else:
        role = ""
    return _Column(role, kind if role in ("storage", "loss") else "", bool(logarithm), unit, cell)


def _named(columns: list[_Column]) -> bool:
    roles = {column.role for column in columns}
    return bool(roles & {"frequency", "angular", "reduced"}) and "storage" in roles


def _header(lines: list[str], first: int, separator: str | None) -> list[_Column]:
    """Returns the columns that the lines before the first row name; none if they do not. Files of RepTate begin with a line of
    parameters, and their columns are ω (rad/s), G' (Pa) and G'' (Pa) unless a line names them."""
    cells = []
    for line in lines[:first]:
        text = line.strip()
        for sign in COMMENTS:
            text = text.removeprefix(sign).strip()
        cells.append(cells_of(text, separator) if text else [])
    for k in range(first - 1, -1, -1):
        below = cells[k + 1] if k + 1 < first else []
        of_units = sum(bool(_unit(re.sub(r"^[\[(](.*)[\])]$", r"\1", cell))) for cell in below) > 1
        found = [_column(cell, below[i] if of_units and i < len(below) else "") for i, cell in enumerate(cells[k])]
        if _named(found):
            return found
    if first and re.fullmatch(r"\s*(\w+=[^;=]*;)+\s*", lines[0]):
        return [_Column("angular", "", False, "rad/s", "ω"), _Column("storage", "G", False, "Pa", "G'"), _Column("loss", "G", False, "Pa", "G''")]
    return []


def read_master_curve(source: str | Path, frequency_unit: str = "", modulus_unit: str = "", kind: str = "") -> MasterCurve:
    """Reads a master curve. Raises InputOutputError."""
    path = Path(source)
    lines = lines_of(path)
    first, rows = rows_of(lines)
    if first is None:
        raise refuse(path, "is no master curve", "no line begins with a number", "give a text of columns: frequency, E', E''")
    separator, decimal = separator_of(path, rows, len(_header(lines, first, ",")))
    columns = _header(lines, first, separator)
    if not columns and len(cells_of(rows[0], separator) if separator else rows[0].split()) == 3:
        if frequency_unit and modulus_unit and kind:
            columns = [_Column(role, k, False, "", role) for role, k in (("frequency", ""), ("storage", kind), ("loss", kind))]
    if not columns:
        raise refuse(path, "does not say what its columns are", "no line before the numbers names a frequency and a storage modulus",
                     "name them: frequency (Hz), E' (MPa), E'' (MPa); or say of three columns in this order --frequency-unit Hz "
                     "--modulus-unit MPa --modulus E")
    at = {column.role: k for k, column in reversed(list(enumerate(columns))) if column.role}
    if "loss" not in at and "tan" not in at:
        raise refuse(path, "has no loss modulus", "no column is named E'', G'', loss modulus or tan δ", "export it, too")
    table = numbers_of(path, lines, first, separator, decimal, 1 + max(at.values()))
    values = np.array([row[:1 + max(at.values())] for _, row in table])
    return _curve(path, columns, at, values, [number for number, _ in table], (frequency_unit, modulus_unit, kind))


def _scale(path: Path, column: _Column, given: str, of: str) -> float:
    example = {"frequency": "Hz", "modulus": "MPa"}[of]
    factor = _factor(given or column.unit, of)
    if given and factor is None:
        raise refuse(f"--{of}-unit {given}", f"is no unit of a {of}", "", f"for example {example}")
    if factor is None:
        raise refuse(path, f"does not say the unit of '{column.words}'", "a wrong unit shifts the curve by its factor",
                     f"write it behind the name, as in '{column.words} ({example})', or say --{of}-unit {example}")
    return factor


def _curve(path: Path, columns: list[_Column], at: dict[str, int], values: np.ndarray, lines: list[int],
           given: tuple[str, str, str]) -> MasterCurve:
    def column(role: str) -> np.ndarray:
        return 10.0 ** values[:, at[role]] if columns[at[role]].logarithm else values[:, at[role]]

    along = next(role for role in ("reduced", "angular", "frequency") if role in at)
    parts = {"frequency": column(along) * _scale(path, columns[at[along]], given[0], "frequency"),
             "storage modulus": column("storage") * _scale(path, columns[at["storage"]], given[1], "modulus")}
    parts["loss modulus"] = column("loss") * _scale(path, columns[at["loss"]], given[1], "modulus") if "loss" in at else \
        column("tan") * parts["storage modulus"]
    if {"angular", "frequency"} <= set(at):
        both = [column(role) * _scale(path, columns[at[role]], given[0], "frequency") for role in ("angular", "frequency")]
        differs = np.abs(both[0] - both[1]) > SAME_FREQUENCY * np.abs(both[0])
        if differs.any():
            wrong = int(np.argmax(differs))
            raise refuse(f"{path}:{lines[wrong]}", "has two frequencies that differ", f"{both[0][wrong]:.4g} and {both[1][wrong]:.4g} rad/s",
                         "take one of the two columns out, or correct its unit")
    notes = [] if "loss" in at else ["the loss modulus is tan δ times the storage modulus"]
    if "shift" in at and along != "reduced":
        parts["shift factor aT"] = column("shift")
        notes.append("frequencies are multiplied by the shift factor aT")
    for name, numbers in parts.items():
        for line, number in zip(lines, numbers):
            if not 0 < number < math.inf:
                raise refuse(f"{path}:{line}", f"the {name} is {number:g}", "frequencies, moduli and shift factors are above zero",
                             "take the row out, or export it again")
    frequency = parts["frequency"] * parts.get("shift factor aT", 1.0)
    if "temperature" in at and "shift" not in at and along != "reduced" and \
            np.ptp(values[:, at["temperature"]]) > ONE_TEMPERATURE:
        raise refuse(path, "has curves of several temperatures that are not shifted to one", "it has a column of temperatures and "
                     "none of shift factors (aT) or reduced frequencies", "export the master curve, or its shift factors with it")
    order = np.argsort(frequency, kind="stable")
    frequency, storage, loss = (numbers[order] for numbers in (frequency, parts["storage modulus"], parts["loss modulus"]))
    if len(np.unique(frequency)) < FEWEST_POINTS:
        raise refuse(path, "has too few points", f"{len(np.unique(frequency))} frequencies; {FEWEST_POINTS} are needed", "measure more")
    fallen = storage / np.maximum.accumulate(storage)
    if (worst := int(np.argmin(fallen))) and fallen[worst] < 1 - FALL:
        raise refuse(f"{path}:{lines[order[worst]]}", f"the storage modulus falls by {100 * (1 - fallen[worst]):.3g} % with rising "
                     "frequency", f"at {frequency[worst]:.4g} rad/s; that of a solid at rest never falls: the curve is of "
                     "resonance, of slip, or shifted wrongly", "take these rows out, or shift the curves anew")
    kind = given[2] or columns[at["storage"]].kind or columns[at.get("loss", at["storage"])].kind
    if kind not in ("E", "G"):
        raise refuse(path, "does not say whether its moduli are Young's (E) or of shear (G)", f"'{columns[at['storage']].words}' may be "
                     "both, and they differ by 2 (1 + ν)", "say --modulus E, or --modulus G --poisson 0.49")
    return MasterCurve(frequency, storage, loss, kind, path.name, notes)
