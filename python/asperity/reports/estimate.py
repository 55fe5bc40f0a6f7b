# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Output of `asperity estimate`: table, lines to quote, chart and page."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from .. import terminal
from ..files import store
from ..plots import style as figures
from ..plots.style import BLUE, INK, Curve, drawn, finish
from ..results.result import Values
from ..studies.estimate_parts import GROUPS
from ..studies.estimates import Estimate
from ..studies.stated_number import Found, Number, rounded
from ..units import shown
from .page import Page, page_files
from .run import end
from .sentences import left_out

SMALL = 0.1
"""Of the whole error: contributions below it are not quoted."""


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


def names_of(estimate: Estimate) -> list[str]:
    """Explains the symbols of an estimate; each number has the sign that it has in result.json."""
    return [f"{n.symbol}: {n.name}" for n in estimate.numbers.values()]


def two_digits(value: float) -> str:
    """Spells a number with two digits."""
    return f"{float(f'{value:.2g}'):g}"


def signed(value: float) -> str:
    """Spells a number with its sign and two digits."""
    return ("+" if value > 0 else "−" if value < 0 else "") + two_digits(abs(value))


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


def chart(estimate: Estimate, ax: Axes) -> bool:
    """Draws the parts of the first number: a bar from zero to each part's shift, with its standard error."""
    n = estimate.first
    factor, unit = n.units[0]
    whole = [] if n.reason else [("all", Found(n.estimate - n.value, n.error))]
    if not n.parts:
        return False
    names, found = zip(*n.parts.items(), *whole)
    shifts, errors = [factor * f.shift for f in found], [factor * f.error for f in found]
    places = range(len(names))
    ax.barh(places, shifts, xerr=errors, color=BLUE, alpha=0.75, height=0.6,
            error_kw={"capsize": 2, "elinewidth": 0.9, "ecolor": INK})
    drawn(ax).curves.append(Curve("shift and standard error of " + ", ".join(names), *map(np.array, (places, shifts, errors))))
    finish(ax, "shift of " + re.sub(r"_(\w+)", r"$_\\mathrm{\1}$", n.symbol) + f" ({unit})" * bool(unit), "", legend=False)
    ax.axvline(0, color=INK, linewidth=0.5)
    ax.set_yticks(list(places), names)
    ax.tick_params(axis="y", which="minor", left=False, right=False)
    ax.invert_yaxis()
    box = ax.get_position()
    ax.set_position((0.25, box.y0, box.x1 - 0.25, box.height))
    return True


def _set(text: str) -> str:
    """Spells symbols as a page sets them: γ_{eff}."""
    return re.sub(r"_(\w+)", r"_{\1}", text)


def page_of(estimate: Estimate, out: Path | None = None) -> Page:
    """Makes the page of an estimate, which its write() writes."""
    page = Page(out or estimate.directory, "Asperity estimate", estimate.name, _set(quote(estimate.first)) + ".")
    page.section("numbers", "Numbers")
    for line in lines_of([n for n in estimate.numbers.values() if n is not estimate.first]):
        page.add("paragraph", _set(line) + ".")
    page.add("paragraph", _set("; ".join(names_of(estimate))) + ".")
    page.section("budget", "Budget")
    for columns in tables_of(estimate):
        page.table([*map(_set, heads_of(columns))], [row for row in rows_of(estimate, columns) if row])
    page.figure("budget", "Budget of " + estimate.first.name, "Bars: shift by each part of the error; whiskers: standard error of the shift.",
                lambda ax: chart(estimate, ax))
    page.section("left-out", "What is not in the error")
    page.add("lists", [("", [*estimate.unseen, *left_out(Values(estimate.scene))])])
    page.section("notes", "Notes")
    page.add("lists", estimate.notes and [("", estimate.notes)])
    end(page, Values({"run": estimate.run}), "The scene", estimate.scene, "Every key with the value that was used; the runs of the error vary one at "
        "a time.")
    return page


FILES = [*figures.files_of("estimate", ("png",)), *page_files(["budget"])]
"""The names of the files that write() writes."""


def write(estimate: Estimate) -> list[str]:
    """Writes the chart and the page beside estimate.json. Returns the names of the files."""
    fig = figures.make(lambda ax: chart(estimate, ax))
    if fig is not None:
        with store.outputs(estimate.directory, figures.files_of("estimate", ("png",))) as out:
            figures.save(fig, out, "estimate", ("png",))
    page_of(estimate).write()
    return ["estimate.json", *["estimate.png"] * (fig is not None), "report.html"]
