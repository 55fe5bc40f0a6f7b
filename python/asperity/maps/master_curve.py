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

COMMENTS = ("#", "%", "//", "!")
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


def _lines(path: Path) -> list[str]:
    try:
        data = path.read_bytes()
    except OSError as error:
        raise refuse(path, "cannot be read", error.strerror or error, "check the path and its permissions") from None
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", "replace").splitlines()
    try:
        return data.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace").splitlines()


def _is_row(line: str) -> bool:
    return bool(re.match(r"""["']?[-+]?[.,]?\d""", line.strip()))


def _separator(path: Path, rows: list[str], wanted: int) -> tuple[str | None, bool]:
    """Returns what separates the cells (None: blanks), and True if commas are decimal points. wanted: number of names; 0:
    unknown."""
    body = "\n".join(rows)
    for separator in "\t;":
        if separator in body:
            return separator, bool(re.search(r"\d,\d", body))
    if "," not in body:
        return None, False
    decimal = bool(re.search(r"[ ]", "\n".join(row.strip() for row in rows))) and not re.search(r",\s|\s,|\.", body)
    if decimal:
        return None, True
    cells = {len(row.split(",")) for row in rows}
    if wanted and min(cells) > wanted and '"' not in body:
        raise refuse(path, "the commas may be decimal points or separate the cells",
                     f"its header names {wanted} columns, and a row has {min(cells)} cells between commas",
                     "separate the cells by tabs or semicolons, or write decimal points")
    return ",", '"' in body and bool(re.search(r'"[^"]*\d,\d[^"]*"', body))


def _cells(line: str, separator: str | None) -> list[str]:
    if separator == "," and '"' in line:
        found = [quoted or plain for quoted, plain in re.findall(r'"((?:[^"]|"")*)"|([^,]+)', line)]
    else:
        found = line.split(separator) if separator else re.split(r"\s{2,}", line.strip())
        if separator is None and len(found) < 3:
            found = re.split(r"\s+(?![\[(])", line.strip())  # a unit in brackets belongs to the name before it
    return [re.sub(r'^"(.*)"$', r"\1", cell.strip()).strip() for cell in found]


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
        cells.append(_cells(text, separator) if text else [])
    for k in range(first - 1, -1, -1):
        below = cells[k + 1] if k + 1 < first else []
        of_units = sum(bool(_unit(re.sub(r"^[\[(](.*)[\])]$", r"\1", cell))) for cell in below) > 1
        found = [_column(cell, below[i] if of_units and i < len(below) else "") for i, cell in enumerate(cells[k])]
        if _named(found):
            return found
    if first and re.fullmatch(r"\s*(\w+=[^;=]*;)+\s*", lines[0]):
        return [_Column("angular", "", False, "rad/s", "ω"), _Column("storage", "G", False, "Pa", "G'"), _Column("loss", "G", False, "Pa", "G''")]
    return []


def _numbers(path: Path, lines: list[str], first: int, separator: str | None, decimal: bool, width: int) -> list[tuple[int, list[float]]]:
    rows = []
    for number, line in enumerate(lines[first:], first + 1):
        text = line.strip()
        if not text or text.startswith(COMMENTS):
            continue
        cells = _cells(text, separator) if separator else text.split()
        try:
            values = [float(cell.replace(",", ".") if decimal else cell) if cell else math.nan for cell in cells]
        except ValueError as error:
            raise refuse(f"{path}:{number}", "the line is no row of numbers", error, "take it out, or put a # before it") from None
        if len(values) < width:
            raise refuse(f"{path}:{number}", "the line has too few numbers", f"{len(values)}, and the columns before it end with "
                         f"number {width}", "fill the row, or take it out")
        rows.append((number, values))
    return rows


def read_master_curve(source: str | Path, frequency_unit: str = "", modulus_unit: str = "", kind: str = "") -> MasterCurve:
    """Reads a master curve.

    Parameters
    ----------
    source : str | Path
        Text file.
    frequency_unit : str
        Hz, rad/s, ...; "": the unit that the file says.
    modulus_unit : str
        Pa, MPa, ...; "": the unit that the file says.
    kind : str
        E or G, where the file does not say it.

    Returns
    -------
    MasterCurve
        The curve.

    Raises
    ------
    InputOutputError
        The file is no master curve: names or units are missing, numbers are not above zero, or points too few.
    """
    path = Path(source)
    lines = _lines(path)
    first = next((k for k, line in enumerate(lines) if _is_row(line)), None)
    if first is None:
        raise refuse(path, "is no master curve", "no line begins with a number", "give a text of columns: frequency, E', E''")
    rows = [line for line in lines[first:] if _is_row(line)]
    separator, decimal = _separator(path, rows, len(_header(lines, first, ",")))
    columns = _header(lines, first, separator)
    if not columns and len(_cells(rows[0], separator) if separator else rows[0].split()) == 3:
        if frequency_unit and modulus_unit and kind:
            columns = [_Column(role, k, False, "", role) for role, k in (("frequency", ""), ("storage", kind), ("loss", kind))]
    if not columns:
        raise refuse(path, "does not say what its columns are", "no line before the numbers names a frequency and a storage modulus",
                     "name them: frequency (Hz), E' (MPa), E'' (MPa); or say of three columns in this order --frequency-unit Hz "
                     "--modulus-unit MPa --modulus E")
    at = {column.role: k for k, column in reversed(list(enumerate(columns))) if column.role}
    if "loss" not in at and "tan" not in at:
        raise refuse(path, "has no loss modulus", "no column is named E'', G'', loss modulus or tan δ", "export it, too")
    table = _numbers(path, lines, first, separator, decimal, 1 + max(at.values()))
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
