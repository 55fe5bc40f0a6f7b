# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What `asperity tip` says: its tables, its page and its file tip.json."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from .. import terminal
from ..files import store
from ..plots.tip import force_curve
from ..studies.stated_number import Number, rounded
from ..studies.tip import Tip
from .estimate import lines_of
from .page import Page, page_files

RESULT = "tip.json"
FIGURES = ("force-drive", "force-tip")
FILES = [RESULT, "curve.csv", *page_files(FIGURES)]
DEFINED = ("Forces press if they are positive. λ is Maugis' parameter with the largest stress w/range of the attraction, Tabor's number is "
           "(R w²/E*²)^(1/3) over the range: above λ = 5 JKR holds, below 0.1 DMT, between Maugis.")


def _plain(symbol: str) -> str:
    return symbol.replace("_", " ")


def _cells(n: Number) -> list[str]:
    value, error = n.cells
    parts = "; ".join(f"{name} {rounded(0.0, found.error)[1]}" for name, found in n.parts.items())
    return [_plain(n.symbol), value, error, n.unit, n.reason or parts]


def _compared(found: Tip) -> list[list[str]]:
    """Returns the rows of what was put in and what an experimentalist would have found."""
    contact, fit = found.contact, found.fit
    work = [rounded(1e3 * fit.work, 1e3 * fit.work_error), rounded(fit.modulus, fit.modulus_error)]
    pulled = found.number("pull_off_force")
    by_pull_off = 1e3 * pulled.estimate / (1.5 * np.pi * contact.radius)
    shown = [" ± ".join(pair) for pair in work] if not fit.failed else ["no fit", "no fit"]
    return [["work of adhesion, mJ/m²", f"{1e3 * contact.work:.4g}", shown[0], f"{by_pull_off:.4g}"],
            ["E*, GPa", f"{contact.modulus:.4g}", shown[1], ""]]


COMPARED = ["", "put in", "JKR fitted to the retraction", "pull-off over 1.5πR"]


def _theory(found: Tip) -> str:
    contact = found.contact
    return (f"A smooth tip: Maugis' λ {contact.parameter:.3g}, Tabor's number {contact.tabor:.3g}: {contact.model}. Its pull-off force is "
            f"{contact.pull_off():.3g} nN by Maugis, {1.5 * contact.unit:.3g} by JKR, {2 * contact.unit:.3g} by DMT.")


def text_of(found: Tip) -> str:
    """Returns what the terminal shows.

    Parameters
    ----------
    found : Tip
        Contact of a tip.

    Returns
    -------
    str
        Tables and lines to quote.
    """
    rows = [[cells[0], cells[1], cells[2], cells[3]] for cells in map(_cells, found.numbers)]
    fit = found.fit
    said = fit.failed or f"the fit misses the curve by {fit.misfit:.2g} nN rms; its errors are those of the fit alone"
    return "\n".join([terminal.table(["tip", "value", "error", "unit"], rows), "", *lines_of(found.numbers), "",
                      terminal.table(COMPARED, _compared(found)), "", f"  {said}", "", _theory(found)])


def answer_of(found: Tip) -> dict[str, Any]:
    """Returns what tip.json and --json have.

    Parameters
    ----------
    found : Tip
        Contact of a tip.

    Returns
    -------
    dict
        Numbers with errors, the fit, the contact and the notes.
    """
    def numbered(value: float) -> float | None:
        return float(value) if np.isfinite(value) else None

    numbers = {n.path: {"value": numbered(n.estimate), "error": numbered(n.error), "unit": n.unit, "reason": n.reason, "condition": n.condition,
                        "parts": {name: numbered(part.error) for name, part in n.parts.items()}} for n in found.numbers}
    contact = {"radius": found.contact.radius, "modulus": found.contact.modulus, "work": found.contact.work, "range": found.contact.range,
               "stiffness": found.contact.stiffness, "maugis": found.contact.parameter, "tabor": found.contact.tabor,
               "model": found.contact.model, "smooth_pull_off_force": found.contact.pull_off()}
    fit: dict[str, Any] = {key: numbered(value) for key, value in found.fit._asdict().items() if key != "failed"}
    if found.fit.failed:
        fit = {"failed": found.fit.failed}
    return {"numbers": numbers, "fit": fit, "contact": contact, "notes": found.notes}


def write(found: Tip) -> Path:
    """Writes tip.json, curve.csv and the page into the directory of the study.

    Parameters
    ----------
    found : Tip
        Contact of a tip.

    Returns
    -------
    Path
        The page.
    """
    rows: list[list[str | float]] = [["drive, nm", "tip, nm", "force, nN", "retraction"]]
    rows += [[float(d), float(t), float(f), int(r)] for d, t, f, r in zip(found.drive, found.tip, found.force, found.retracting)]
    with store.outputs(found.directory, [RESULT, "curve.csv"]) as out:
        out.write(RESULT, store.sealed_json(answer_of(found)))
        out.write("curve.csv", store.csv_text(rows))
    lead = re.sub(r"_([\w-]+)", r"_{\1}", str(found.numbers[0]))
    page = Page(found.directory, "asperity tip", f"A tip of {found.contact.radius:g} nm on {found.contact.stiffness:g} N/m", lead)
    page.section("curve", "Force curve")
    page.figure(FIGURES[0], "As the instrument shows it", "The drive moves the far end of the cantilever.", lambda ax: force_curve(found, ax))
    page.figure(FIGURES[1], "Against the place of the tip", "The drive less the deflection of the cantilever, with JKR's fit.",
                lambda ax: force_curve(found, ax, "tip"))
    page.section("numbers", "Numbers")
    page.table(["number", "value", "error", "unit", "parts of the error, or why it is not stated"], [_cells(n) for n in found.numbers])
    page.section("fit", "What an experimentalist would have found")
    page.table(COMPARED, _compared(found))
    page.add("text", found.fit.failed or f"The fit misses the curve by {found.fit.misfit:.2g} nN rms; its errors are those of the fit alone.")
    page.add("text", _theory(found))
    page.add("text", DEFINED)
    for note in found.notes:
        page.add("text", note[0].upper() + note[1:] + ".")
    page.write()
    return page.path
