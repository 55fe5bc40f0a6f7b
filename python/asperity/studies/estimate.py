# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""An estimate: the numbers of a scene with their errors, as estimate.json has them, and its text."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import terminal
from ..above import from_above
from ..arguments import checks_call, checks_calls
from ..errors import InputOutputError, Named, UnknownName
from ..files import store
from ..results.result import Values, read_json
from ..units import shown
from .estimate_parts import GROUPS
from .stated_number import Found, Number, finite, lines_of, quote, signed, two_digits

if TYPE_CHECKING:
    from matplotlib.axes import Axes

RESULT = "estimate.json"


def left_out(scene: Values) -> list[str]:
    """Returns what no effect simulates in a scene that is given by its keys."""
    return ["deformation of the substrate: it is rigid"] * (scene.number("surface.counter_young") is None) + [
        "plastic flow: the block is elastic throughout"] * (scene.find("interface.hardness") in (None, "none"))


@checks_calls
@dataclass
class Estimate(Named):
    """Numbers of a scene with their errors. numbers: by their names in result.json, the most important first; parts: parts of the
    error in order, with name, group, what was varied (or the reason why nothing was) and failed; notes."""

    name: str
    numbers: dict[str, Number]
    parts: list[dict[str, str]]
    notes: list[str]
    scene: dict[str, Any]
    run: dict[str, Any]
    directory: Path

    @property
    def first(self) -> Number:
        """The main number of the estimate: the binding energy, or the first number of the scene."""
        return next(iter(self.numbers.values()))

    def number(self, path: str = "") -> Number:
        """Returns a number with its error.

        Parameters
        ----------
        path : str
            Path of the number in result.json; "" for the first one.

        Returns
        -------
        Number
            The number with its estimate, standard error and the parts of the error.

        Raises
        ------
        UnknownName
            The estimate has no number of this path.
        """
        if path and path not in self.numbers:
            raise UnknownName.among(self.name, path, self.numbers, what="number")
        return self.numbers[path] if path else self.first

    def quote(self, path: str = "") -> str:
        """Returns a number as it is published, with its error and the parts of the error.

        Parameters
        ----------
        path : str
            Path of the number in result.json; "": the first number.

        Returns
        -------
        str
            Sentence with the number, mJ/m² and meV/Å² for energies per area.
        """
        return quote(self.number(path))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the shifts of the first number and their errors, as bars.

        Parameters
        ----------
        ax : matplotlib Axes, optional
            Axes to draw into; by default new ones.

        Returns
        -------
        Axes
            The axes with the plot.
        """
        return from_above("reports.estimate.draw")(self, ax)

    def report(self, out: str | os.PathLike | None = None) -> Path:
        """Writes report.html into a directory.

        Parameters
        ----------
        out : str or Path, optional
            Directory of the page; None: that of the estimate.

        Returns
        -------
        Path
            The file.
        """
        return from_above("reports.estimate.write_estimate_page")(self, store.named(out)).path

    @property
    def unseen(self) -> list[str]:
        """Parts that were not measured and are not included in the error."""
        return [f"{p['name']}: {p['failed'] or p['what']}" for p in self.parts
                if p["failed"] or p["what"].startswith(("not varied", "left out"))]

    def json(self) -> dict[str, Any]:
        """Returns the content of estimate.json."""
        return {"name": self.name, "numbers": {path: {
            "symbol": n.symbol, "meaning": n.name, "unit": n.unit, "scene": n.value, "estimate": finite(n.estimate),
            "standard_error": finite(n.error), "below": finite(n.below), "least": finite(n.least), "most": finite(n.most),
            "least_error": n.grain, "withheld": n.withheld, "condition": n.condition, "unresolved": n.unresolved, "bounded": n.bounded,
            "parts": {part: {"shift": f.shift, "standard_error": f.error}
                      for part, f in n.parts.items()}} for path, n in self.numbers.items()},
            "parts": self.parts, "notes": self.notes, "scene": self.scene, "run": self.run}

    def __repr__(self) -> str:
        return f"<Estimate {self.name}: {self.first}>"

    def __str__(self) -> str:
        return text_of(self)

    def _repr_html_(self) -> str:
        return terminal.html_table(self.name, (), [[self.quote(path)] for path in self.numbers],
                                   f"not measured: {'; '.join(self.unseen)}" if self.unseen else "")


def names_of(estimate: Estimate) -> list[str]:
    """Explains the symbols of an estimate; each number has the sign that it has in result.json."""
    return [f"{n.symbol}: {n.name}" for n in estimate.numbers.values()]


def _cell(n: Number, part: str, what: str) -> str:
    if part not in n.parts:
        return ""
    value = getattr(n.parts[part], what)
    if abs(value) < 1e-7 * abs(n.value):  # rounding
        return "0"
    return signed(value) if what == "shift" else two_digits(value)


def rows_of(estimate: Estimate, columns: list[Number]) -> list[list[str]]:
    """Returns the rows of the budget of some numbers: the scene, each part and the sum."""
    rows: list[list[str]] = [["the scene as it is", "", "", *(c for n in columns for c in (f"{n.value:.5g}", ""))], []]
    last = ""
    for group in GROUPS:
        for part in (p for p in estimate.parts if p["group"] == group):
            rows.append([group if group != last else "", part["name"] if part["name"] != group else "", part["failed"] and "failed" or part["what"],
                         *(_cell(n, part["name"], what) for n in columns for what in ("shift", "error"))])
            last = group
    rows.append([])
    rows.append(["estimate", "", "", *(c for n in columns for c in n.cells)])
    return rows


def heads_of(columns: list[Number]) -> list[str]:
    """Returns the heads of the budget's columns, with units."""
    return ["", "part", "varied", *(h for n in columns for h in (f"{n.symbol}{', ' * bool(n.unit)}{shown(n.unit)}", "±"))]


def tables_of(estimate: Estimate) -> list[list[Number]]:
    """Returns the numbers in groups of three, one table each."""
    numbers = list(estimate.numbers.values())
    return [numbers[i:i + 3] for i in range(0, len(numbers), 3)]


def text_of(estimate: Estimate) -> str:
    """Returns the estimate as text for the terminal."""
    parts = ["\nShift: to be added to the number of the scene as it is. ±: one standard error of the shift, or of the mean over surfaces.\n"]
    varied = [row for row in rows_of(estimate, []) if row][1:-1]
    parts += [terminal.table(heads_of([]), varied, left=(0, 1, 2)), ""] * bool(varied)
    for columns in tables_of(estimate):
        rows = [[row[1] or row[0].removesuffix(" as it is"), *row[3:]] if row else [] for row in rows_of(estimate, columns)]
        parts += [terminal.table(["part", *heads_of(columns)[3:]], rows), ""]
    parts += ["To quote:", *(f"  {line}" for line in lines_of(list(estimate.numbers.values())))]
    parts.append("Names: " + "; ".join(names_of(estimate)) + ".")
    failed = [f"failed: {p['name']}: {p['failed']}" for p in estimate.parts if p["failed"]]
    parts += ["Not in the error: " + "; ".join([*estimate.unseen, *left_out(Values(estimate.scene))]) + ".", *failed,
              *(f"note: {note}" for note in estimate.notes)]
    return "\n".join(parts)


@checks_call
def load_estimate(directory: str | os.PathLike) -> Estimate:
    """Loads the estimate in a directory.

    Parameters
    ----------
    directory : str or os.PathLike
        Directory with estimate.json.

    Returns
    -------
    Estimate
        The numbers with their errors.

    Raises
    ------
    InputOutputError
        The directory has no estimate, or it cannot be read.
    """
    if not (Path(directory) / RESULT).exists():
        raise InputOutputError(str(directory), "holds no estimate", f"{RESULT} is not in it" if Path(directory).is_dir() else
                               "there is no such directory", "name a directory that asperity estimate or adhesion has written")
    found = read_json(Path(directory) / RESULT)
    numbers = {}
    for path, n in found.part("numbers").items():
        one = Values(n)
        parts = {name: Found(Values(f).number("shift", math.nan), Values(f).number("standard_error", math.nan))
                 for name, f in one.part("parts").items()}
        numbers[path] = Number(path, one.text("symbol"), one.text("meaning"), one.text("unit"), one.number("scene", math.nan), parts,
                               one.number("least", -math.inf), one.number("most", math.inf), one.number("least_error", 0.0),
                               one.text("withheld"), one.text("condition"), one.text("unresolved"), one.text("bounded"))
    return Estimate(found.text("name"), numbers, found.listed("parts", dict), found.listed("notes", str), found.part("scene"),
                    found.part("run"), Path(directory))
