# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What `asperity cost` leaves behind: cost.csv, cost.json, its figures, and the tables on the terminal."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes

from . import files, terminal
from .cost import TARGETS, Cost, Search, errors_of
from .cost_parameters import ASKED, NAN, QUANTITIES
from .plots import style as figures
from .plots.style import BLUE, DASHES, GREEN, GREY, PINK, RED, SKY, YELLOW, curve, finish
from .pool import FAILED

GROUPS = (("cutoff, tail, precision", ("cutoff", "tail", "precision"), BLUE, "o"),
          ("layers, block model", ("layers", "model"), RED, "s"), ("time step", ("timestep",), GREEN, "^"),
          ("velocity, damping", ("velocity", "damping"), PINK, "D"),
          ("tolerance and step, quasi-static", ("tolerance", "step"), YELLOW, "v"),
          ("the scene as it is", ("scene",), GREY, "X"), ("combinations", ("combination",), SKY, "P"))


def error_against_time(cost: Cost, question: str, ax: Axes) -> bool:
    """The largest error of a question ("state", "path") over the processor time of each setting that was run."""
    rows = [r for r in cost.rows if r.compared and r.error[question] > 0 and r.seconds > 0]
    for label, parameters, colour, marker in GROUPS:
        some = [r for r in rows if r.parameter in parameters]
        if some:
            curve(ax, [r.seconds for r in some], [100 * r.error[question] for r in some], label, colour=colour, line="",
                  marker=marker, filled=marker != "P")
    front = sorted((r.seconds, 100 * r.error[question]) for r in rows if r.front[question])
    if front:
        curve(ax, *zip(*front), "nothing is better in both", colour=GREY, line=DASHES[1], behind=True)
    finish(ax, "processor time (s)", "largest error of γ and contact (%)" if question == "state" else
           "largest error of γ, contact, works and force (%)", log="xy")
    return bool(rows)


def csv_of(cost: Cost) -> str:
    heads = ["parameter", "value", "setting", "processor_seconds", "wall_seconds", "ratio", *QUANTITIES,
             *(f"error_{q}" for q in ASKED), *(f"own_{q}" for q in QUANTITIES), *(f"front_{q}" for q in ASKED)]
    scene = cost.rows[1].seconds or NAN
    return files.csv_text([heads, *(
        [row.parameter, row.label, " ".join(row.setting), row.seconds, row.wall, row.seconds / scene, *row.numbers,
         *row.error.values(), *row.own_error, *row.front.values()] for row in cost.rows)])


def json_of(cost: Cost) -> dict[str, Any]:
    def known(value: float | None) -> float | None:
        return None if value is None or not math.isfinite(value) else float(value)

    def by_quantity(values) -> dict[str, float | None]:
        return {name: known(v) for name, v in zip(QUANTITIES, values)}

    settings = [{"parameter": row.parameter, "value": row.label, "set": row.setting,
                 "processor_seconds": known(row.seconds), "wall_seconds": known(row.wall),
                 "measured": by_quantity(row.numbers), "error": {q: known(e) for q, e in row.error.items()},
                 "own_error": by_quantity(row.own_error),
                 "pareto": dict(row.front),
                 **({} if math.isnan(row.added) else {"added_error": row.added}),
                 **({"failed": row.outcome.reason} if row.outcome.status == FAILED else {})} for row in cost.rows]
    orders = [{"parameter": parameter.name, "expected": parameter.expected,
               **({} if parameter.order is None else {"expected_order": parameter.order}),
               "measured": by_quantity(measured)}
              for parameter, measured in cost.orders]
    cheapest = {question: [{"target": target, "set": cost.rows[i].text, "error": cost.rows[i].error[question],
                            "processor_seconds": cost.rows[i].seconds}
                           for target, i in zip(TARGETS, places) if i is not None]
                for question, places in cost.cheapest.items()}
    result = {"scene": cost.scene, "reference": cost.case.reference_text, "settings": settings, "orders": orders}
    if cost.asked is None:
        return {**result, "cheapest": {question: found for question, found in cheapest.items() if found}}
    question = cost.asked.base.question
    answer: dict[str, Any] = {"target": cost.asked.target, "question": question}
    if row := cost.asked.chosen:
        answer |= {"set": row.setting, "error": row.error[question], "added_error": row.added,
                   "time_over_scene": known(row.seconds / cost.rows[1].seconds),
                   "time_over_reference": known(row.seconds / cost.rows[0].seconds)}
    else:
        answer["smallest_error"] = known(cost.asked.smallest)
    return {**result, "chosen": answer}


def write(cost: Cost, directory: Path) -> list[str]:
    """Names of the files written."""
    files.directory(directory)
    written = ["cost.csv", "cost.json"]
    files.write(directory / "cost.csv", csv_of(cost))
    for question in ASKED:
        if cost.answered(question):
            fig = figures.make(lambda ax: error_against_time(cost, question, ax))
            if fig is not None:
                figures.save(fig, directory / f"cost-{question}")
                written.append(f"cost-{question}.svg")
    files.write(directory / "cost.json", json.dumps(json_of(cost), indent=2, ensure_ascii=False) + "\n")
    return written


def percent(error: float) -> str:
    """A relative error in percent with two digits: "0.83", "-0.0012"; "-": none."""
    if math.isnan(error):
        return "-"
    if error == 0:
        return "0"
    digits = min(6, max(0, 1 - math.floor(math.log10(abs(100 * error)))))
    return f"{100 * error:.{digits}f}"


def text_of(cost: Cost) -> str:
    """The tables on the terminal."""
    parts = ["\nErrors in %, against the reference: γ and works over flat on flat. * marks what nothing beats in both "
             "time\nand error: first star the state at zero load (γ, contact), second the whole path. The last of each "
             "is the one its own error is taken against.\n"]
    rows: list[list[str]] = []
    last = ""
    for row in cost.rows:
        if row.parameter != last and last:
            rows.append([])
        cells = ["" if row.parameter == last else row.parameter, row.label]
        last = row.parameter
        if row.outcome.status == FAILED:
            rows.append([*cells, "failed"])
            continue
        ratio = row.seconds / cost.rows[1].seconds if cost.rows[1].seconds else NAN
        rows.append([*cells, *map(percent, errors_of(row.numbers, cost.rows[0].numbers)),
                     "-" if math.isnan(row.seconds) else f"{row.seconds:.2f} s",
                     f"{ratio:.2f}" if math.isfinite(ratio) else "-",
                     "".join("*" if f else " " for f in row.front.values())])
    heads = ["parameter", "value", "γ", "contact", "in", "out", "force", "processor", "to scene", ""]
    parts.append(terminal.table(heads, rows, left=(0, 1)))
    if cost.orders:
        parts.append("\nOrder of each parameter's own error (all else as in the scene): the power that fits it.\n")
        parts.append(terminal.table(["parameter", "γ", "contact", "in", "out", "force", "expected"],
                                    [[parameter.name, *("-" if p is None else f"{p:.1f}" for p in measured),
                                      parameter.expected]
                                     for parameter, measured in cost.orders], left=(0, 6)))
    for question, what in (("state", "the state at zero load (γ, contact)"),
                           ("path", "the whole path (works, pull-off force too)")):
        if cost.asked or not cost.answered(question):
            continue
        parts.append(f"\nCheapest for {what}:")
        for target, i in zip(TARGETS, cost.cheapest[question]):
            row = None if i is None else cost.rows[i]
            parts.append(f"  {100 * target:>4g} %  " + ("none of those that were run" if row is None else
                         f"{row.seconds:.2f} s, error {percent(row.error[question])} %: {row.text}"))
    if not cost.answered("path"):
        parts.append("\nThe path was not followed: works and force are not measured.")
    parts += [f"note: {note}" for note in cost.case.notes]
    parts += [f"failed: {r.parameter} {r.label}: {r.outcome.reason}" for r in cost.rows if r.outcome.status == FAILED]
    return "\n".join(parts)


def answer_of(cost: Cost, asked: Search) -> str:
    """What was found for the target; the last line is what to put behind a command."""
    target, varied = f"{100 * asked.target:.6g} %", "varied: " + ", ".join(p.name for p in cost.case.parameters)
    row = asked.chosen
    if row is None:
        best = "none could be measured" if math.isnan(asked.smallest) else (
            f"the smallest error {'of those tried' if asked.tried else 'that they add up to'} is "
            f"{percent(asked.smallest)} %")
        return (f"No settings keep {target}: {best} ({varied}).\n"
                "Ask for more, or start from a scene with finer settings.")
    scene, reference = cost.rows[1].seconds, cost.rows[0].seconds
    return (f"The cheapest settings within {target} ({varied}): error {percent(row.error[asked.base.question])} % of "
            f"the reference,\n{row.seconds:.2f} s: {row.seconds / scene:.2f} of the scene's time, "
            f"{row.seconds / reference:.2f} of the reference's.\n{row.text}")
