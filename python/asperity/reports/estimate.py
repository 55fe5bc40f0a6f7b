# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Output of `asperity estimate`: table, lines to quote, chart and page."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from ..files import store
from ..plots import style as figures
from ..plots.style import BLUE, INK, Curve, drawn, drawn_into, finish
from ..results.result import Values
from ..studies.estimate import Estimate, heads_of, left_out, names_of, rows_of, tables_of
from ..studies.stated_number import Found, lines_of, quote
from .page import Page, page_files
from .run import end


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


def draw(estimate: Estimate, ax: Axes | None) -> Axes:
    """Draws chart() into axes, new ones by default. Raises InputOutputError."""
    return drawn_into(ax, lambda a: chart(estimate, a), estimate.name, "estimate", "it has no number")


def _set(text: str) -> str:
    """Spells symbols as a page sets them: γ_{eff}."""
    return re.sub(r"_(\w+)", r"_{\1}", text)


def write_estimate_page(estimate: Estimate, out: Path | None = None) -> Page:
    """Writes DIR/report.html of an estimate."""
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
    page.write()
    return page


FILES = [*figures.files_of("estimate", ("png",)), *page_files(["budget"])]
"""The names of the files that write() writes."""


def write(estimate: Estimate) -> list[str]:
    """Writes the chart and the page beside estimate.json. Returns the names of the files."""
    fig = figures.make(lambda ax: chart(estimate, ax))
    if fig is not None:
        with store.outputs(estimate.directory, figures.files_of("estimate", ("png",))) as out:
            figures.save(fig, out, "estimate", ("png",))
    write_estimate_page(estimate)
    return ["estimate.json", *["estimate.png"] * (fig is not None), "report.html"]
