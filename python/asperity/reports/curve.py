# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What `asperity curve` says: its tables, its page, and its files curve.json, curves.csv and fit.csv."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .. import terminal
from ..files import store
from ..plots.curve import histogram, over_places, residuals, with_fit
from ..studies.curves import Curves, FittedCurve
from ..studies.stated_number import Number, rounded
from .estimate import lines_of
from .page import Page, page_files

RESULT = "curve.json"
TABLE, FIT = "curves.csv", "fit.csv"
FIGURES = ("fit", "residuals", "histogram-work", "histogram-modulus", "map-work", "map-modulus", "map-pull_off_force")
FILES = [RESULT, TABLE, FIT, *page_files(FIGURES, ("png",))]
NAMES = {"hertz": "Hertz", "jkr": "JKR", "dmt": "DMT", "maugis": "Maugis and Dugdale"}


def _model(name: str) -> str:
    kind, _, parameter = name.partition(" ")
    return NAMES[kind] + f", λ = {parameter}" * bool(parameter)


def _cells(n: Number) -> list[str]:
    value, error = n.cells
    parts = "; ".join(f"{name} {rounded(0.0, found.error)[1]}" for name, found in n.parts.items())
    return [n.symbol.replace("_", " "), value, error, n.unit, n.reason or parts]


HEADS = ["direction", "model", "w, mJ/m²", "E*, GPa", "contact at, nm", "-2 ln L"]
"""The last: twice the logarithm of the ratio of the best model's likelihood to this one's."""


def models(found: FittedCurve, short: bool = False) -> list[list[str]]:
    """Returns the rows of all fits of a curve: what each model says, and how much worse it describes the data than the best. short: of the
    values of λ only the most likely."""
    rows = []
    for way, one in found.fits.items():
        likely = min((name for name in one.fits if name.startswith("maugis")), key=lambda name: one.worse_by[name], default="")
        for name, fit in one.fits.items():
            if short and name.startswith("maugis") and name != likely:
                continue
            work = " ± ".join(rounded(1e3 * fit.values["work"], 1e3 * fit.errors["work"])) if "work" in fit.values else ""
            worse = one.worse_by[name]
            rows.append([way, _model(name), work, " ± ".join(rounded(fit.values["modulus"], fit.errors["modulus"])),
                         " ± ".join(rounded(fit.values["contact"], fit.errors["contact"])), f"{worse:.1f}" + ", excluded" * (name in one.excluded)])
    return rows


def _apart(found: FittedCurve) -> str:
    """Returns which models the data tell apart, in a sentence."""
    if (main := found.main) is None:
        return ""
    kinds = list(dict.fromkeys(NAMES[name.split()[0]] for name in main.fits if name not in main.excluded))
    text = f"The data allow {', '.join(kinds)}"
    out = [name for name in dict.fromkeys(NAMES[name.split()[0]] for name in main.excluded) if name not in kinds]
    text += f", and exclude {', '.join(out)}." if out else "." if len(main.fits) == 1 else ", and exclude none."
    if main.parameter[0] == main.parameter[0]:
        at, low, high = main.parameter
        text += f" Maugis' λ is {at:.3g}" + (f", between {low:.2g} and {high:.2g}." if high > low else ".")
    return text


def text_of(found: Curves) -> str:
    """Returns what the terminal shows: numbers, lines to quote, and the models of the first curve."""
    rows = [_cells(n)[:4] for n in found.numbers]
    one = found.curves[0]
    first = f"{one.name}:" if len(found.curves) > 1 else ""
    return "\n".join([terminal.table(["number", "value", "error", "unit"], rows), "", *lines_of(found.numbers), "", *([first] if first else []),
                      terminal.table(HEADS, models(one, short=True), left=(0, 1)), "", _apart(one)])


def answer_of(found: Curves) -> dict[str, Any]:
    """Returns what curve.json and --json have."""
    def numbered(value: float) -> float | None:
        return float(value) if np.isfinite(value) else None

    def numbers(some: list[Number]) -> dict[str, Any]:
        return {n.path: {"value": numbered(n.estimate), "error": numbered(n.error), "unit": n.unit, "reason": n.reason, "condition": n.condition,
                         "parts": {name: numbered(part.error) for name, part in n.parts.items()}} for n in some}

    def fits(one: FittedCurve) -> dict[str, Any]:
        return {way: {"stated": next(name for name, fit in found.fits.items() if fit is found.stated), "excluded": found.excluded,
                      "maugis": [numbered(value) for value in found.parameter],
                      "models": {name: {"values": fit.values, "errors": fit.errors, "covariance": fit.covariance.tolist(), "noise": fit.noise,
                                        "correlated": fit.slack, "points": fit.points, "worse_by": found.worse_by[name]}
                                 for name, fit in found.fits.items()}} for way, found in one.fits.items()}

    return {"file": found.file, "tip": found.question.indenter._asdict(), "numbers": numbers(found.numbers), "notes": found.notes,
            "refused": found.refused,
            "curves": [{"name": one.name, "place": one.measured.place, "stiffness": one.measured.stiffness, "numbers": numbers(one.numbers),
                        "fits": fits(one), "failed": one.failed} for one in found.curves]}


def _table(found: Curves) -> list[list[str | float]]:
    paths = [n.path for n in found.numbers]
    units = {n.path: n.unit for n in found.numbers}
    rows: list[list[str | float]] = [["curve", "x, µm", "y, µm", *(f"{path}, {units[path]}{end}" for path in paths for end in ("", ": error"))]]
    values = {path: found.values(path) for path in paths}
    for k, one in enumerate(found.curves):
        own = {n.path: n for n in one.numbers}
        errors = {path: own[path].error * values[path][k] / own[path].estimate if path in own and own[path].estimate else np.nan for path in paths}
        rows.append([one.name, *(one.measured.place or ("", "")), *(float(x) for path in paths for x in (values[path][k], errors[path]))])
    return rows


def write(found: Curves) -> Path:
    """Writes curve.json, curves.csv, fit.csv (of the first curve) and the page. Returns the page."""
    one = found.curves[0]
    rows: list[list[str | float]] = [["height, nm", "force, nN", "model, nN", "residual, nN", "in the fit", "retraction"]]
    for way, fits in one.fits.items():
        fit = fits.stated
        rows += [[float(h), float(f), float(m), float(f - m), int(u), int(way == "retraction")]
                 for h, f, m, u in zip(fit.height, fit.force, fit.fitted, fit.used)]
    with store.outputs(found.directory, [RESULT, TABLE, FIT]) as out:
        out.write(RESULT, store.sealed_json(answer_of(found)))
        out.write(TABLE, store.csv_text(_table(found)))
        out.write(FIT, store.csv_text(rows))
    tip = found.question.indenter
    size = f"{tip.size:g} nm" if tip.shape in ("paraboloid", "sphere", "punch") else f"{tip.size:g}°"
    lead = re.sub(r"_([\w-]+)", r"_{\1}", str(found.numbers[0]))
    title = f"{Path(found.file).name}: {len(found.curves)} force curve{'s' * (len(found.curves) != 1)}"
    page = Page(found.directory, "asperity curve", title, lead, kinds=("png",))
    page.section("numbers", "Numbers")
    page.table(["number", "value", "error", "unit", "parts of the error, or why it is not stated"], [_cells(n) for n in found.numbers])
    page.add("text", f"Tip: {tip.shape}, {size}; cantilever {one.measured.stiffness:.4g} N/m. E* = E/(1-ν²). Errors are one standard error.")
    page.section("curve", "Curve and fit" if len(found.curves) == 1 else f"Curve and fit: {one.name}")
    page.figure(FIGURES[0], "Force curve", "Less its baseline; the lines are the stated models where they are fitted.", partial(with_fit, one))
    page.figure(FIGURES[1], "Residuals", "A fit that describes the curve leaves noise.", partial(residuals, one))
    page.section("models", "Models")
    page.table(HEADS, models(one))
    page.add("text", _apart(one))
    if len(found.curves) > 2:
        page.section("all", "All curves")
        there = [n.path for n in found.numbers]
        for name in FIGURES[2:]:
            kind, _, path = name.partition("-")
            if path in there:
                draw = histogram if kind == "histogram" else over_places
                page.figure(name, found.number(path).name.capitalize(), "", partial(draw, found, path))
    for note in [*found.notes, *(f"not taken: {why}" for why in found.refused)]:
        page.add("text", note[0].upper() + note[1:] + ".")
    page.write()
    return page.path
