# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What `asperity curve` says: its tables, its page, and its files curve.json, curves.csv and fit.csv."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import Any

from .. import terminal
from ..files import store
from ..plots.curve import histogram, over_places, residuals, with_fit, with_simulation
from ..studies.curves import FIT, POINTS, RESULT, Curves, FittedCurve, missed, points_of
from ..studies.stated_number import ROW, finite, lines_of, rounded, saved
from .page import Page, page_files

TABLE = "curves.csv"
FIGURES = ("fit", "residuals", "simulated", "histogram-work", "histogram-modulus", "map-work", "map-modulus", "map-pull_off_force")
FILES = [RESULT, TABLE, FIT, *page_files(FIGURES, ("png",))]
NAMES = {"hertz": "Hertz", "jkr": "JKR", "dmt": "DMT", "maugis": "Maugis and Dugdale"}


def _model(name: str) -> str:
    kind, _, parameter = name.partition(" ")
    return NAMES[kind] + f", λ = {parameter}" * bool(parameter)


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


def _simulated(found: Curves) -> str:
    """Returns how the simulated tip compares with the first curve; "": it was not simulated."""
    if found.simulated is None:
        return ""
    one, pulled = found.curves[0], found.simulated.number("pull_off_force")
    measured = next((n for n in one.numbers if n.path == "pull_off_force"), None)
    own, model = missed(one, found.simulated)
    return (f"Simulated with these numbers, for a range of {found.simulated.contact.range:.3g} nm: {pulled}"
            + (f"; measured {' ± '.join(rounded(measured.estimate, measured.error))} nN" if measured else "")
            + f". In contact it misses the curve by {own:.2g} nN rms, the stated model by {model:.2g} nN.")


def text_of(found: Curves) -> str:
    """Returns what the terminal shows: numbers, lines to quote, and the models of the first curve."""
    rows = [n.row[:4] for n in found.numbers]
    one = found.curves[0]
    first = f"{one.name}:" if len(found.curves) > 1 else ""
    table = terminal.table(HEADS, models(one, short=True), left=(0, 1))
    return "\n".join([terminal.table(ROW[:4], rows), "", *lines_of(found.numbers), "", *([first] if first else []),
                      table, "", _apart(one), *(("", _simulated(found)) if found.simulated else ())])


def answer_of(found: Curves) -> dict[str, Any]:
    """Returns what curve.json and --json have."""
    def fits(one: FittedCurve) -> dict[str, Any]:
        return {way: {"stated": next(name for name, fit in found.fits.items() if fit is found.stated), "excluded": found.excluded,
                      **{name: getattr(found, name) for name in ("work", "modulus", "of_fit", "of_model")},
                      "maugis": [finite(value) for value in found.parameter],
                      "models": {name: {"values": fit.values, "errors": fit.errors, "covariance": fit.covariance.tolist(), "noise": fit.noise,
                                        "correlated": fit.slack, "points": fit.points, "worse_by": found.worse_by[name]}
                                 for name, fit in found.fits.items()}} for way, found in one.fits.items()}

    asked = {"poisson": finite(found.question.poisson), "model": found.question.model, "range": found.question.range,
             "period": found.question.period}
    return {"file": found.file, "tip": found.question.indenter._asdict(), "question": asked, "numbers": saved(found.numbers), "notes": found.notes,
            "refused": found.refused,
            "curves": [{"name": one.name, "place": one.measured.place, "stiffness": one.measured.stiffness, "numbers": saved(one.numbers),
                        "fits": fits(one), "failed": one.failed} for one in found.curves]}


def write(found: Curves) -> Path:
    """Writes curve.json, curves.csv, fit.csv (of the first curve) and the page. Returns the page."""
    one = found.curves[0]
    with store.outputs(found.directory, [RESULT, TABLE, FIT]) as out:
        out.write(RESULT, store.sealed_json(answer_of(found)))
        out.write(TABLE, store.csv_text(store.rows_of(found.columns(), found.units)))
        out.write(FIT, store.csv_text(store.rows_of(points_of(one), POINTS)))
    tip = found.question.indenter
    size = f"{tip.size:g} nm" if tip.shape in ("paraboloid", "sphere", "punch") else f"{tip.size:g}°"
    lead = re.sub(r"_([\w-]+)", r"_{\1}", str(found.numbers[0]))
    title = f"{Path(found.file).name}: {len(found.curves)} force curve{'s' * (len(found.curves) != 1)}"
    page = Page(found.directory, "asperity curve", title, lead, kinds=("png",))
    page.section("numbers", "Numbers")
    page.table(ROW, [n.row for n in found.numbers])
    page.add("paragraph", f"Tip: {tip.shape}, {size}; cantilever {one.measured.stiffness:.4g} N/m. E* = E/(1-ν²). Errors are one standard error.")
    page.section("curve", "Curve and fit" if len(found.curves) == 1 else f"Curve and fit: {one.name}")
    page.figure(FIGURES[0], "Force curve", "Less its baseline; the lines are the stated models where they are fitted.", partial(with_fit, one))
    page.figure(FIGURES[1], "Residuals", "A fit that describes the curve leaves noise.", partial(residuals, one))
    if found.simulated is not None:
        page.section("simulated", "The fitted tip, simulated")
        page.figure(FIGURES[2], "Force curve", "The contact of a tip with the stated numbers, as asperity tip computes it.",
                    partial(with_simulation, found))
        page.add("paragraph", _simulated(found))
    page.section("models", "Models")
    page.table(HEADS, models(one))
    page.add("paragraph", _apart(one))
    if len(found.curves) > 2:
        page.section("all", "All curves")
        there = [n.path for n in found.numbers]
        for name in FIGURES[3:]:
            kind, _, path = name.partition("-")
            if path in there:
                draw = histogram if kind == "histogram" else over_places
                page.figure(name, found.number(path).name.capitalize(), "", partial(draw, found, path))
    for note in [*found.notes, *(f"not taken: {why}" for why in found.refused)]:
        page.add("paragraph", note[0].upper() + note[1:] + ".")
    page.write()
    return page.path
