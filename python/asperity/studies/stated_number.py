# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A number of a scene as it is stated: corrected by its parts, kept within what is possible, with an error that covers it,
or with a reason why it is not stated. Tables, lines to quote, pages, estimate.json and reprs take it from here.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from ..arguments import checks_calls
from ..errors import Named, UnknownName
from ..terminal import html_table, minus
from ..units import MILLIJOULE, NANONEWTON, shown

NAN, INFINITE = math.nan, math.inf
COVERED = 2.0
"""Errors within which a number is: bounds are so many from the estimate."""

SMALL = 0.1
"""Of the whole error: contributions below it are not quoted."""


class Found(NamedTuple):
    """Shift that a part of the error adds to the number of the scene, and its standard error."""

    shift: float
    error: float


ROW = ["number", "value", "error", "unit", "parts of the error, or why it is not stated"]
"""Heads of Number.row."""


@dataclass
class Number(Named):
    """A number of the scene: value as it is run, estimate with the biases corrected, its standard error, and the shift
    and error of each part by name.

    least, most   the possible range, which the estimate does not leave
    grain         the least error: one site, of a number that is counted
    withheld      why the number is not stated; estimate and error are then NaN
    condition     what the number holds for: "for a range of 24 nm"
    unresolved    what is said of a number that does not differ from zero by its error
    bounded       why only the largest size of the number is known; estimate and error are then NaN
    """

    path: str
    symbol: str
    name: str
    unit: str
    value: float
    parts: dict[str, Found] = field(default_factory=dict)
    least: float = -INFINITE
    most: float = INFINITE
    grain: float = 0.0
    withheld: str = ""
    condition: str = ""
    unresolved: str = ""
    bounded: str = ""

    @property
    def corrected(self) -> float:
        """The value with the shifts of all parts, which may lie outside the possible range."""
        return self.value + sum(found.shift for found in self.parts.values())

    @property
    def sum_of_errors(self) -> float:
        """The errors of all parts, added as independent ones; at least the grain."""
        return max(self.grain, math.sqrt(sum(found.error**2 for found in self.parts.values())))

    @property
    def reason(self) -> str:
        """Reason why the number is not stated; "" if it is."""
        beyond = max(self.least - self.corrected, self.corrected - self.most)
        if not self.withheld and beyond > max(COVERED * self.sum_of_errors, 1e-6 * abs(self.value)):
            return f"its parts correct it to {self.corrected:.3g} {shown(self.unit)}".rstrip() + ", which is not possible"
        return self.withheld

    @property
    def possible(self) -> float:
        """The corrected value, moved into the possible range."""
        return min(max(self.corrected, self.least), self.most)

    @property
    def estimate(self) -> float:
        """The number as it is stated: corrected and possible; NaN if it is not stated."""
        return NAN if self.reason or self.bounded else self.possible

    @property
    def error(self) -> float:
        """The standard error of the estimate; NaN if the number is not stated."""
        return NAN if self.reason or self.bounded else self.sum_of_errors

    @property
    def largest(self) -> float:
        """The largest size that the errors allow."""
        return abs(self.possible) + COVERED * self.sum_of_errors

    @property
    def below(self) -> float:
        """The bound of the size of a number that its error does not tell from zero, or of which no more is known; NaN of any
        other."""
        unresolved = 0.0 in (self.least, self.most) and abs(self.possible) < self.sum_of_errors
        return self.largest if not self.reason and (unresolved or self.bounded) else NAN

    @property
    def sides(self) -> tuple[float, float]:
        """The error upwards and downwards, cut at the possible range."""
        return cut(self.estimate, self.error, self.least, self.most)

    def __str__(self) -> str:
        """Spells the number: "γ_eff = 1170 ± 14 mJ/m² (73.0 ± 0.9 meV/Å²; one standard error)", "γ_eff below ...", or
        "γ_eff is not stated: ..."."""
        (factor, unit), *others = self.units
        if self.reason:
            return f"{self.symbol} is not stated: {self.reason}"
        if self.below == self.below:
            way, sign = ("above", -1.0) if self.most == 0.0 else ("below", 1.0)
            bounds = [f"{minus(upwards(f, sign * self.below))} {u}".strip() for f, u in [(factor, unit), *others]]
            return (f"{self.symbol} {way} {bounds[0]}" + f" ({'; '.join(bounds[1:])})" * bool(bounds[1:]) + f" {self.condition}".rstrip()
                    + ": " + f"{self.unresolved}, " * bool(self.unresolved) + (self.bounded or "not resolved"))
        text = [f"{minus(with_error(f * self.estimate, *(f * side for side in self.sides)))} {u}".strip() for f, u in [(factor, unit), *others]]
        return (f"{self.symbol} = {text[0]} (" + "".join(t + "; " for t in text[1:]) + "one standard error)"
                + f" {self.condition}".rstrip())

    def _repr_html_(self) -> str:
        return html_table(self.name, (), [(str(self),)])

    @property
    def units(self) -> list[tuple[float, str]]:
        """Factors and units that people quote, the one to be quoted first."""
        if self.unit == "meV/Å^2":
            return [(MILLIJOULE, "mJ/m²"), (1.0, shown(self.unit))]
        return [(1.0 / NANONEWTON, "nN")] if self.unit == "eV/Å" else [(1.0, shown(self.unit))]

    @property
    def cells(self) -> tuple[str, str]:
        """The estimate and its error in a table, in the unit of the number."""
        if self.reason:
            return "not stated", ""
        if self.below == self.below:
            return (("> " if self.most == 0.0 else "< ") + upwards(1.0, math.copysign(self.below, -0.5 if self.most == 0.0 else 0.5)), "")
        return rounded(self.estimate, self.error)

    @property
    def row(self) -> list[str]:
        """Cells of the number under ROW."""
        parts = "; ".join(f"{name} {rounded(0.0, found.error)[1]}" for name, found in self.parts.items())
        return [self.symbol.replace("_", " "), *self.cells, self.unit, self.reason or parts]


def cut(value: float, error: float, least: float, most: float) -> tuple[float, float]:
    """Cuts the error of a value at the possible range."""
    return min(error, most - value), min(error, value - least)


def rounded(value: float, error: float) -> tuple[str, str]:
    """Rounds a number and its error to two digits of the error."""
    if not error > 0.0:
        return f"{value:.6g}", "0"
    digits = max(0, 1 - math.floor(math.log10(error)))
    if digits > 8:
        return f"{value:.1e}", f"{error:.1e}"
    if digits == 0:
        step = 10.0 ** (math.floor(math.log10(error)) - 1)
        value, error = step * round(value / step), step * round(error / step)
    return f"{value:.{digits}f}", f"{error:.{digits}f}"


def with_error(value: float, up: float, down: float) -> str:
    """Spells a number with its error: "0.45 ± 0.03"; with errors of two sizes "0.985 (+0.015, -0.031)"."""
    number, larger = rounded(value, max(up, down))
    if math.isclose(up, down, rel_tol=1e-9):
        return f"{number} ± {larger}"
    digits = len(larger.partition(".")[2])
    sides = [larger if side == max(up, down) else f"{side:.{digits}f}" if side > 0.0 else "0" for side in (up, down)]
    return f"{number} (+{sides[0]}, -{sides[1]})"


def upwards(factor: float, bound: float) -> str:
    """Rounds a bound to two digits, away from zero."""
    size = factor * abs(bound)
    step = 10.0 ** (math.floor(math.log10(size)) - 1)
    return ("-" if bound < 0.0 else "") + f"{float(f'{step * math.ceil(size / step * (1 - 1e-12)):.2g}'):g}"


def two_digits(value: float) -> str:
    """Spells a number with two digits."""
    return f"{float(f'{value:.2g}'):g}"


def signed(value: float) -> str:
    """Spells a number with its sign and two digits."""
    return ("+" if value > 0 else "−" if value < 0 else "") + two_digits(abs(value))


def quote(n: Number) -> str:
    """Spells a number with its parts: "γ_eff = 1170 ± 14 mJ/m² (73.0 ± 0.9 meV/Å²; one standard error), of which ± 13 seeds;
    corrected by +27 (tail)."""
    text, (factor, _) = str(n), n.units[0]
    if n.reason or n.below == n.below:
        return text
    large = sorted(((f.error, name) for name, f in n.parts.items() if f.error > SMALL * n.error), reverse=True)
    if large:
        text += ", of which " + ", ".join(f"± {rounded(0.0, factor * e)[1]} {name}" for e, name in large)
    moved = [(f.shift, name) for name, f in n.parts.items() if abs(f.shift) > SMALL * n.error and f.shift]
    if moved:
        text += "; corrected by " + ", ".join(f"{signed(factor * shift)} ({name})" for shift, name in moved)
    return text


def lines_of(numbers: list[Number]) -> list[str]:
    """Spells a line to quote for each number, and one line for all numbers that are not stated for the same reason."""
    lines = [quote(n) for n in numbers if not n.reason]
    for reason in dict.fromkeys(n.reason for n in numbers if n.reason):
        some = [n.symbol for n in numbers if n.reason == reason]
        lines.append(f"{', '.join(some)} {'is' if len(some) == 1 else 'are'} not stated: {reason}")
    return lines


def finite(value: float) -> float | None:
    """Returns a number as JSON has it: None if it is not finite."""
    return float(value) if math.isfinite(value) else None


def saved(numbers: Iterable[Number]) -> dict[str, Any]:
    """Returns numbers without corrections as JSON has them; numbers_of() reads them."""
    return {n.path: {"value": finite(n.estimate), "error": finite(n.error), "unit": n.unit, "reason": n.reason, "condition": n.condition,
                     "symbol": n.symbol, "meaning": n.name, "least": finite(n.least), "grain": finite(n.grain),
                     "parts": {name: finite(part.error) for name, part in n.parts.items()}} for n in numbers}


def numbers_of(json: Mapping[str, Any]) -> list[Number]:
    """Returns the numbers that saved() wrote."""
    def number(value: float | None, otherwise: float = NAN) -> float:
        return otherwise if value is None else value

    return [Number(path, one["symbol"], one["meaning"], one["unit"], number(one["value"]),
                   {name: Found(0.0, number(error)) for name, error in one["parts"].items()}, least=number(one["least"], -INFINITE),
                   grain=number(one["grain"], 0.0), withheld=one["reason"], condition=one["condition"]) for path, one in json.items()]


@checks_calls
class WithNumbers(Named):
    """Base class of results that have a list of numbers."""

    numbers: list[Number]

    def number(self, path: str) -> Number:
        """Returns a number by its name.

        Parameters
        ----------
        path : str
            Name of the number: "pull_off_force" of a tip, "work" of force curves.

        Returns
        -------
        Number
            The number with its error.

        Raises
        ------
        UnknownName
            There is no number of this name.
        """
        known = {one.path: one for one in self.numbers}
        if path not in known:
            raise UnknownName.among(type(self).__name__, path, known, what="number")
        return known[path]
