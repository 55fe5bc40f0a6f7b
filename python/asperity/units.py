# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Units of the package. Results are in eV, Å, ps, GPa and meV/Å² (shared with engine/units.hpp)."""

import re
from collections.abc import Iterable

ELECTRONVOLT = 1.602176634e-19
"""J"""
NANONEWTON = 1e-19 / ELECTRONVOLT
"""1 nN in eV/Å"""
ATTOJOULE = 1e-18 / ELECTRONVOLT
"""1 aJ in eV"""
GIGAPASCAL = 1e-21 / ELECTRONVOLT
"""1 GPa in eV/Å^3"""
MEGAPASCAL = 1e-3 * GIGAPASCAL
"""1 MPa in eV/Å^3"""
MILLIJOULE = 1e20 * ELECTRONVOLT
"""1 meV/Å² in mJ/m²"""
ANGSTROM_PER_PS = 0.01
"""1 m/s in Å/ps"""

_LENGTH, _MASS, _TIME, _WARMTH = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
_ENERGY, _FORCE, _PRESSURE, _RATE, _NUMBER = (2, 1, -2, 0), (1, 1, -2, 0), (-1, 1, -2, 0), (0, 0, -1, 0), (0, 0, 0, 0)
SYMBOLS: dict[str, tuple[tuple[int, ...], float, int, bool]] = {
    "m": (_LENGTH, 1.0, 0, True), **dict.fromkeys(("Å", "\u212b", "A", "Ang", "angstrom", "Angstrom"), (_LENGTH, 1.0, -10, False)),
    "g": (_MASS, 1.0, -3, True), **dict.fromkeys(("u", "amu", "Da"), (_MASS, 1.66053906660, -27, False)),
    "s": (_TIME, 1.0, 0, True), "min": (_TIME, 6.0, 1, False), "h": (_TIME, 3.6, 3, False), "d": (_TIME, 8.64, 4, False),
    "K": (_WARMTH, 1.0, 0, True), "J": (_ENERGY, 1.0, 0, True), "eV": (_ENERGY, 1.602176634, -19, True), "N": (_FORCE, 1.0, 0, True),
    "Pa": (_PRESSURE, 1.0, 0, True), "bar": (_PRESSURE, 1.0, 5, True), "atm": (_PRESSURE, 1.01325, 5, False),
    "psi": (_PRESSURE, 6.894757293168, 3, True), "ksi": (_PRESSURE, 6.894757293168, 6, False), "Hz": (_RATE, 1.0, 0, True),
    "%": (_NUMBER, 1.0, -2, False), "1": (_NUMBER, 1.0, 0, False)}
"""Of each symbol the powers of length, mass, time and temperature, a number and a power of ten (SI), and whether it takes
prefixes. io/units.cpp has the same table, by which the program reads quantities."""
PREFIXES = {"a": -18, "f": -15, "p": -12, "n": -9, "u": -6, "\u00b5": -6, "\u03bc": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9, "T": 12}
SPELLINGS = {"⁰": "^0", "¹": "^1", "²": "^2", "³": "^3", "⁴": "^4", "⁵": "^5", "⁶": "^6", "⁷": "^7", "⁸": "^8", "⁹": "^9",
             "⁻^": "^-", "**": "^", "·": "*", "\u00c2\u00b5": "\u00b5", "Â²": "^2", "Ã\u0085": "Å"}
"""Other spellings: superscripts, a product's dot, and UTF-8 that a program took for Latin-1."""


def _symbol(name: str) -> tuple[tuple[int, ...], float, int] | None:
    if name in SYMBOLS:
        return SYMBOLS[name][:3]
    for prefix, power in PREFIXES.items():
        if name.startswith(prefix) and (found := SYMBOLS.get(name[len(prefix):])) and found[3]:
            return found[0], found[1], found[2] + power
    return None


def _parsed(text: str) -> tuple[tuple[int, ...], float, int] | None:
    """Returns powers of the dimensions, factor and power of ten of a unit; None if the text is no unit."""
    for other, plain in SPELLINGS.items():
        text = text.replace(other, plain)
    dimension, factor, ten, divide, text = [0, 0, 0, 0], 1.0, 0, False, text.strip(" \t")
    while text:
        term = re.match(r"([^ \t*/^]*?)(?:\^(-?[1-9])|(-?[1-9]))?(?=[ \t*/]|$)[ \t]*", text)
        if not term or not (one := _symbol(term[1] or term[3] or "")):
            return None
        times = int(term[2] or term[3] and term[1] and term[3] or 1) * (-1 if divide else 1)
        dimension = [a + times * b for a, b in zip(dimension, one[0])]
        ten += times * one[2]
        for _ in range(abs(times)):
            factor = factor * one[1] if times > 0 else factor / one[1]
        text = text[term.end():]
        divide = text.startswith("/")
        if text[:1] in ("/", "*") and not (text := text[1:].lstrip(" \t")):
            return None
    return tuple(dimension), factor, ten


def conversion(unit: object, base: str) -> float | None:
    """Returns the number of base units in one unit."""
    source, target = _parsed(unit) if isinstance(unit, str) and unit.strip() else None, _parsed(base)
    if not source or not target or source[0] != target[0]:
        return None
    shift, ratio = source[2] - target[2], source[1] / target[1]
    return ratio * 10.0**shift if shift >= 0 else ratio / 10.0**-shift


def quantity(text: object, base: str) -> float | None:
    """Returns a quantity in base units."""
    parts = re.fullmatch(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\D.*?)\s*", str(text))
    factor = conversion(parts[2], base) if parts else None
    return float(parts[1]) * factor if parts and factor is not None else None


def is_unit(text: str) -> bool:
    """Returns True for a unit of any dimension."""
    return bool(text.strip()) and _parsed(text) is not None


def is_length(unit: object) -> bool:
    """Returns True for a unit of length."""
    return conversion(unit, "Å") is not None


def in_angstrom(unit: str) -> float:
    """Returns a unit of length in Å. Raises KeyError if it is none."""
    if (found := conversion(unit, "Å")) is None:
        raise KeyError(unit)
    return found


def size_text(edges: Iterable[float]) -> str:
    """Returns the edges of a map, Å, in the unit that people give them in: "87.61 x 129.7 µm"."""
    edges = list(edges)
    one, unit = next((one, unit) for one, unit in ((1e10, "m"), (1e7, "mm"), (1e4, "µm"), (10.0, "nm"), (0.0, "Å")) if min(edges) >= one)
    return " x ".join(f"{edge / (one or 1.0):.4g}" for edge in edges) + " " + unit


def shown(unit: str) -> str:
    """Returns a unit as people write it: meV/Å^2 as meV/Å²."""
    for power, sign in (("^2", "²"), ("^3", "³"), ("^4", "⁴")):
        unit = unit.replace(power, sign)
    return unit
