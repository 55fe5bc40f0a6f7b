# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What `asperity cost` leaves behind: cost.csv, its figures, and the tables on the terminal."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .. import terminal
from ..files import store
from ..plots import style as figures
from ..plots.style import BLUE, DASHES, GREEN, GREY, PINK, RED, SKY, YELLOW, curve, finish
from ..running.pool import FAILED
from ..studies.cost import TARGETS, Cost, errors_of
from ..studies.cost_parameters import ASKED, QUANTITIES, Row
from ..studies.variations import NAN

GROUPS = (("cutoff, tail, precision", ("cutoff", "tail", "precision"), BLUE, "o"),
          ("layers, block model", ("layers", "model"), RED, "s"), ("time step", ("timestep",), GREEN, "^"),
          ("velocity, damping", ("velocity", "damping"), PINK, "D"),
          ("tolerance and step, quasi-static", ("tolerance", "step"), YELLOW, "v"),
          ("the scene as it is", ("scene",), GREY, "X"), ("combinations", ("combination",), SKY, "P"))


def error_against_time(cost: Cost, question: str, ax: Axes) -> bool:
    """Draws the largest error of a question over the processor time of each setting that was run."""
    rows = [r for r in cost.rows if r.compared and r.error[question] > 0 and r.seconds > 0]
    for label, parameters, colour, marker in GROUPS:
        if some := [r for r in rows if r.parameter in parameters]:
            curve(ax, [r.seconds for r in some], [100 * r.error[question] for r in some], label, colour=colour, line="",
                  marker=marker, filled=marker != "P")
    if front := sorted((r.seconds, 100 * r.error[question]) for r in rows if r.front[question]):
        curve(ax, [time for time, _ in front], [error for _, error in front], "best for its time", colour=GREY, line=DASHES[1], behind=True)
    finish(ax, "processor time (s)", "largest error of γ and contact (%)" if question == "state" else
           "largest error of γ, contact, works and force (%)", log="xy", legend="above")
    return bool(rows)


def csv_of(cost: Cost) -> str:
    """Returns the content of cost.csv."""
    return store.csv_text([
        ["parameter", "value", "setting", "processor_seconds", "ratio", *QUANTITIES, *(f"error_{q}" for q in ASKED),
         *(f"front_{q}" for q in ASKED)],
        *([row.parameter, row.label, " ".join(row.setting), row.seconds, row.seconds / (cost.rows[1].seconds or NAN), *row.numbers,
           *row.error.values(), *row.front.values()] for row in cost.rows)])


def json_of(cost: Cost) -> dict[str, Any]:
    """Returns the rows with their numbers, errors and times (s), and the cheapest settings for the target, as JSON has them."""
    def row(one: Row) -> dict[str, Any]:
        return {"parameter": one.parameter, "value": one.label, "setting": one.setting, "seconds": one.seconds,
                "numbers": dict(zip(QUANTITIES, one.numbers)), "error": one.error, "failed": one.outcome.reason}

    return {"rows": [row(one) for one in cost.rows], "target": cost.target, "notes": cost.notes,
            "chosen": cost.chosen.setting if cost.chosen else None}


FILES = ["cost.csv", *(file for question in ASKED for file in figures.files_of(f"cost-{question}"))]
"""The names of all files that write() may write."""


def write(cost: Cost, directory: Path) -> list[str]:
    """Writes cost.csv and the figures."""
    written = ["cost.csv"]
    with store.outputs(directory, FILES) as out:
        out.write("cost.csv", csv_of(cost))
        for question in ASKED:
            fig = figures.make(lambda ax: error_against_time(cost, question, ax)) if cost.answered(question) else None
            if fig is not None:
                figures.save(fig, out, f"cost-{question}")
                written.append(f"cost-{question}.svg")
    return written


def percent(error: float, least: float = 0.0) -> str:
    """Spells a relative error in percent with three digits."""
    if math.isnan(error):
        return "-"
    return f"{100 * error:.3g}" if abs(error) >= least else f"< {100 * least:.2g}"


def text_of(cost: Cost) -> str:
    """Returns the tables for the terminal."""
    parts = ["\nErrors in %, against the reference: γ and works over flat on flat. * marks a setting if no "
             "other is faster\nand more accurate: first star for the state at zero load (γ, contact), second for the whole path.\n"]
    rows: list[list[str]] = []
    last, reference = "", cost.rows[0]
    least = np.abs(errors_of(reference.numbers + reference.grains, reference.numbers))
    for row in cost.rows:
        if row.parameter != last and last:
            rows.append([])
        cells = ["" if row.parameter == last else row.parameter, row.label]
        last = row.parameter
        if row.outcome.status == FAILED:
            rows.append([*cells, "failed"])
            continue
        times = [f"{row.seconds:.2f} s", f"{row.seconds / (cost.rows[1].seconds or NAN):.2f}"]
        rows.append([*cells, *(percent(error, grain) for error, grain in zip(errors_of(row.numbers, reference.numbers), least)),
                     *("-" if "nan" in time else time for time in times),
                     "".join("*" if f else " " for f in row.front.values())])
    parts.append(terminal.table(["parameter", "value", "γ", "contact", "in", "out", "force", "processor", "to scene", ""],
                                rows, left=(0, 1), again=(0, 1)))
    for question, what in (("state", "the state at zero load (γ, contact)"),
                           ("path", "the whole path (works, pull-off force too)")):
        if cost.target or not cost.answered(question):
            continue
        parts.append(f"\nCheapest for {what}:")
        for target, cheapest in zip(TARGETS, cost.cheapest[question]):
            parts.append(f"  {100 * target:>4g} %  " + ("none of those that were run" if cheapest is None else
                         f"{cheapest.seconds:.2f} s, error {percent(cheapest.error[question])} %: "
                         + ("--set " + " ".join(cheapest.setting) if cheapest.setting else "the scene as it is")))
    if not cost.answered("path"):
        parts.append("\nThe path was not followed: works and force are not measured.")
    parts += [f"failed: {r.parameter} {r.label}: {r.outcome.reason}" for r in cost.rows if r.outcome.status == FAILED]
    return "\n".join(parts)


def answer_of(cost: Cost) -> str:
    """Returns the answer for the target; its last line is to be put behind a command."""
    assert cost.target is not None
    target, varied = f"{100 * cost.target:.6g} %", "varied: " + ", ".join(p.name for p in cost.case.parameters)
    row, question = cost.chosen, cost.case.bases[0].question
    if row is None:
        best = "none could be measured" if math.isnan(cost.smallest) else (
            f"the smallest error of those tried is {percent(cost.smallest)} %")
        return (f"No settings keep {target}: {best} ({varied}).\n"
                "Ask for more, or start from a scene with finer settings.")
    return (f"The cheapest settings within {target} ({varied}): error {percent(row.error[question])} % of the reference,\n"
            f"{row.seconds:.2f} s: {row.seconds / cost.rows[1].seconds:.2f} of the scene's time, "
            f"{row.seconds / cost.rows[0].seconds:.2f} of the reference's.\n"
            + (f"--set {' '.join(row.setting)}" if row.setting else "The scene as it is: nothing is to be set."))
