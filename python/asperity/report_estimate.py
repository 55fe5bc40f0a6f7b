# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What `asperity estimate` says: its table, the lines to quote, its chart and its page."""

from __future__ import annotations

import math
import re

import numpy as np
from matplotlib.axes import Axes

from . import files, terminal
from .estimates import Estimate, Number
from .estimate_parts import GROUPS
from .page import Page, minus, page_files
from .plots import style as figures
from .plots.style import BLUE, INK, Curve, drawn, finish
from .sentences import ALWAYS_LEFT_OUT
from .units import MILLIJOULE, NANONEWTON, shown

SMALL = 0.1
"""Of the whole error: contributions below it are not quoted."""
LEFT_OUT = [text for text in ALWAYS_LEFT_OUT if not text.startswith("edges")]  # the width, or a map's edges, are parts


def rounded(value: float, error: float) -> tuple[str, str]:
    """A number and its error, to two digits of the error."""
    if not error > 0.0:
        return f"{value:.6g}", "0"
    digits = max(0, 1 - math.floor(math.log10(error)))
    if digits > 8:
        return f"{value:.1e}", f"{error:.1e}"
    if digits == 0:
        step = 10.0 ** (math.floor(math.log10(error)) - 1)
        value, error = step * round(value / step), step * round(error / step)
    return f"{value:.{digits}f}", f"{error:.{digits}f}"


def _units(n: Number) -> list[tuple[float, str]]:
    """Factors and units that people quote, the one to be quoted first."""
    if n.unit == "meV/Å^2":
        return [(MILLIJOULE, "mJ/m²"), (1.0, shown(n.unit))]
    return [(1.0 / NANONEWTON, "nN")] if n.unit == "eV/Å" else [(1.0, shown(n.unit))]


def quote(n: Number) -> str:
    """"γ_eff = 1170 ± 14 mJ/m² (73.0 ± 0.9 meV/Å²; one standard error), of which ± 13 seeds; corrected by +27 (tail)."""
    (factor, unit), *others = _units(n)

    def number(factor: float, unit: str) -> str:
        return f"{' ± '.join(rounded(factor * n.estimate, factor * n.error))} {unit}".strip()

    text = f"{n.symbol} = {minus(number(factor, unit))} (" + "".join(f"{minus(number(*one))}; " for one in others) + \
        "one standard error)"
    large = sorted(((f.error, name) for name, f in n.parts.items() if f.error > SMALL * n.error), reverse=True)
    if large:
        text += ", of which " + ", ".join(f"± {rounded(0.0, factor * e)[1]} {name}" for e, name in large)
    moved = [(f.shift, name) for name, f in n.parts.items() if abs(f.shift) > SMALL * n.error and f.shift]
    if moved:
        text += "; corrected by " + ", ".join(f"{signed(factor * shift)} ({name})" for shift, name in moved)
    return text


def two_digits(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def signed(value: float) -> str:
    return ("+" if value > 0 else "−" if value < 0 else "") + two_digits(abs(value))


def _cell(n: Number, part: str, what: str) -> str:
    if part not in n.parts:
        return ""
    value = getattr(n.parts[part], what)
    if abs(value) < 1e-7 * abs(n.value):  # rounding
        return "0"
    return signed(value) if what == "shift" else two_digits(value)


def rows_of(estimate: Estimate, columns: list[Number]) -> list[list[str]]:
    """The scene, each part, and the sum: group, part, what was varied, and of each number its shift and error."""
    rows: list[list[str]] = [["the scene as it is", "", "", *(c for n in columns for c in (f"{n.value:.5g}", ""))], []]
    last = ""
    for group in GROUPS:
        for part in (p for p in estimate.parts if p["group"] == group):
            rows.append([group if group != last else "", part["name"], part["failed"] and "failed" or part["what"],
                         *(_cell(n, part["name"], what) for n in columns for what in ("shift", "error"))])
            last = group
    rows.append([])
    rows.append(["estimate", "", "", *(c for n in columns for c in rounded(n.estimate, n.error))])
    return rows


def heads_of(columns: list[Number]) -> list[str]:
    return ["", "part", "varied", *(h for n in columns for h in (f"{n.symbol}{', ' * bool(n.unit)}{shown(n.unit)}", "±"))]


def tables_of(estimate: Estimate) -> list[list[Number]]:
    """Numbers that stand beside each other: three a table."""
    numbers = list(estimate.numbers.values())
    return [numbers[i:i + 3] for i in range(0, len(numbers), 3)]


def text_of(estimate: Estimate) -> str:
    """For the terminal."""
    parts = ["\nShift: to be added to the number of the scene as it is. ±: one standard error of the shift, or of the mean over surfaces.\n"]
    for columns in tables_of(estimate):
        parts += [terminal.table(heads_of(columns), rows_of(estimate, columns), left=(0, 1, 2)), ""]
    parts += ["To quote:", *(f"  {quote(n)}" for n in estimate.numbers.values())]
    failed = [f"failed: {p['name']}: {p['failed']}" for p in estimate.parts if p["failed"]]
    parts += ["Not in the error: " + "; ".join([*estimate.unseen, *LEFT_OUT]) + ".", *failed,
              *(f"note: {note}" for note in estimate.notes)]
    return "\n".join(parts)


def chart(estimate: Estimate, ax: Axes) -> bool:
    """Of the first number: a bar from zero to each part's shift, with its standard error."""
    n = estimate.first
    factor, unit = _units(n)[0]
    names = [*n.parts, "all"]
    shifts = [factor * f.shift for f in n.parts.values()] + [factor * (n.estimate - n.value)]
    errors = [factor * f.error for f in n.parts.values()] + [factor * n.error]
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
    """Symbols as a page sets them: γ_{eff}."""
    return re.sub(r"_(\w+)", r"_{\1}", text)


def page_of(estimate: Estimate) -> Page:
    """Written by its write()."""
    page = Page(estimate.directory, "Asperity estimate", estimate.name, _set(quote(estimate.first)) + ".")
    page.section("numbers", "Numbers")
    for n in list(estimate.numbers.values())[1:]:
        page.add("paragraph", _set(quote(n)) + ".")
    page.section("budget", "Budget")
    for columns in tables_of(estimate):
        page.table([*map(_set, heads_of(columns))], [row for row in rows_of(estimate, columns) if row])
    page.figure("budget", "Budget of " + estimate.first.name, "Bars: shift by each part of the error; whiskers: standard error of the shift.",
                lambda ax: chart(estimate, ax))
    page.section("left-out", "What is not in the error")
    page.add("lists", [("", [*estimate.unseen, *LEFT_OUT])])
    page.section("notes", "Notes")
    page.add("lists", estimate.notes and [("", estimate.notes)])
    return page


FILES = [*figures.files_of("estimate", ("png",)), *page_files(["budget"])]
"""The names of the files that write() writes."""


def write(estimate: Estimate) -> list[str]:
    """The chart and the page beside estimate.json; names of what there is."""
    fig = figures.make(lambda ax: chart(estimate, ax))
    with files.outputs(estimate.directory, figures.files_of("estimate", ("png",))) as out:
        figures.save(fig, out, "estimate", ("png",))
    page_of(estimate).write()
    return ["estimate.json", "estimate.png", "report.html"]
