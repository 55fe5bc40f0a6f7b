# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What `asperity tip` says: its tables, its page and its file tip.json."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .. import terminal
from ..files import store
from ..plots.run import map_of
from ..plots.tip import force_curve, indentation
from ..studies.stated_number import ROW, finite, lines_of, rounded, saved
from ..studies.tip import CURVE, RESULT, RUN_OF, Tip
from ..theories.yielding import EPSILON, UPPER, YieldingSphere
from .page import Page, page_files
from .run import end

FIGURES = ("force-drive", "force-tip", "indentation", "pressure", "gap")
FILES = [RESULT, CURVE, *page_files(FIGURES)]
DEFINED = ("Forces press if they are positive. λ is Maugis' parameter with the largest stress w/range of the attraction, Tabor's number is "
           "(R w²/E*²)^(1/3) over the range: above λ = 5 JKR holds, below 0.1 DMT, between Maugis. E* = E/(1-ν²).")
STATE = "relaxed"
"""The state whose contact is drawn."""


def _set(text: str) -> str:
    """Returns a text with the subscripts of its symbols as a page sets them."""
    return re.sub(r"_([\w-]+)", r"_{\1}", text)


OVER = "pull-off over 1.5πR"


def _compared(found: Tip) -> list[list[str]]:
    """Returns the head and the rows of what was put in and what an experimentalist would have found."""
    contact, fit, pulled = found.contact, found.fit, found.number("pull_off_force")
    by_pull_off = f"{1e3 * pulled.estimate / (1.5 * np.pi * contact.radius):.4g}"
    if contact.yields:
        read = [" ± ".join(found.number(path).cells).removesuffix(" ± ") for path in ("hardness", "modulus")]
        return [["", "put in", "Oliver and Pharr", OVER], ["hardness, GPa", f"{contact.hardness:.4g}", read[0], ""],
                ["E*, GPa", f"{contact.modulus:.4g}", read[1], ""],
                ["work of adhesion, mJ/m²", f"{1e3 * contact.work:.4g}", "", "not stated" if pulled.reason else by_pull_off]]
    work = [rounded(1e3 * fit.work, 1e3 * fit.work_error), rounded(fit.modulus, fit.modulus_error)]
    shown = [" ± ".join(pair) for pair in work] if not fit.failed else ["no fit", "no fit"]
    return [["", "put in", "JKR fitted to the retraction", OVER],
            ["work of adhesion, mJ/m²", f"{1e3 * contact.work:.4g}", shown[0], by_pull_off if contact.shape is None and not fit.failed else ""],
            ["E*, GPa", f"{contact.modulus:.4g}", shown[1], ""]]


def _fit(found: Tip) -> str:
    """Returns the sentence on the fit."""
    if (read := found.unloading) is not None:
        return (f"No fit of Oliver and Pharr: {read.failed}." if read.failed else
                f"Oliver and Pharr: a power law of the exponent {read.exponent:.3g}, fitted to the unloading from {100 * UPPER[1]:g} to "
                f"{100 * UPPER[0]:g} % of the largest force, has a slope of {read.slope:.4g} N/m at the largest depth; less {EPSILON:g} F/slope "
                f"the contact is {read.contact_depth:.4g} nm deep, and the sphere has an area of {read.area:.4g} nm² there (β = 1).")
    return found.fit.failed or f"The fit misses the curve by {found.fit.misfit:.2g} nN rms; its errors are those of the fit alone."


def _theory(found: Tip) -> str:
    contact = found.contact
    if contact.yields:
        most = float(found.force.max())
        sphere = YieldingSphere(contact.radius, contact.modulus, contact.hardness, contact.work)
        return (f"A smooth tip without adhesion begins to yield at {contact.first_yield:.3g} nN; the largest force is "
                f"{most / contact.first_yield:.3g} times that. A contact that is all at the hardness under it comes off with "
                f"{sphere.pull_off(most):.4g} nN if the attraction is short (Mesarovic and Johnson). The model is a cap on the pressure: no "
                "pile-up, no hardening.")
    if contact.shape is not None:
        return (f"The tip is a {contact.words}: its end alone has Maugis' λ {contact.parameter:.3g}, Tabor's number {contact.tabor:.3g}: "
                f"{contact.model}. By JKR the pull-off force of the whole smooth tip is {contact.pull_off_by_jkr():.3g} nN.")
    return (f"A smooth tip: Maugis' λ {contact.parameter:.3g}, Tabor's number {contact.tabor:.3g}: {contact.model}. Its pull-off force is "
            f"{contact.pull_off():.3g} nN by Maugis, {1.5 * contact.unit:.3g} by JKR, {2 * contact.unit:.3g} by DMT.")


def text_of(found: Tip) -> str:
    """Returns what the terminal shows."""
    rows = [n.row[:4] for n in found.numbers]
    head, *compared = _compared(found)
    return "\n".join([terminal.table(["tip", "value", "error", "unit"], rows), "", *lines_of(found.numbers), "",
                      terminal.table(head, compared), "", _fit(found), "", _theory(found)])


def answer_of(found: Tip) -> dict[str, Any]:
    """Returns what tip.json and --json have."""
    contact = {"radius": found.contact.radius, "modulus": found.contact.modulus, "work": found.contact.work, "range": found.contact.range,
               "stiffness": found.contact.stiffness, "maugis": found.contact.parameter, "tabor": found.contact.tabor,
               "model": found.contact.model, "tip": found.contact.words, "shape": found.contact.shape and found.contact.shape.saved(),
               "smooth_pull_off_force": found.contact.pull_off() if found.contact.shape is None else found.contact.pull_off_by_jkr()}
    fit: dict[str, Any] = {key: finite(value) for key, value in found.fit._asdict().items() if key != "failed"}
    if found.fit.failed:
        fit = {"failed": found.fit.failed}
    answer: dict[str, Any] = {"numbers": saved(found.numbers), "fit": fit, "contact": contact, "notes": found.notes}
    if (read := found.unloading) is not None:
        contact |= {"hardness": found.contact.hardness, "first_yield": found.contact.first_yield}
        answer["unloading"] = {"failed": read.failed} if read.failed else {key: finite(value) for key, value in read._asdict().items()
                                                                           if key != "failed"}
    return answer


def _material(found: Tip) -> list[list[str]]:
    """Returns the rows of what is pressed against what."""
    keys, contact = found.result, found.contact
    return [["tip", contact.words], ["Young's modulus E, GPa", f"{keys.number('scene.block.young', np.nan):.4g}"],
            ["Poisson's ratio ν", f"{keys.number('scene.block.poisson', np.nan):.4g}"],
            ["work of adhesion w, mJ/m²", f"{1e3 * contact.work:.4g}"], ["range of the attraction, nm", f"{contact.range:.4g}"],
            ["stiffness of the cantilever k, N/m", f"{contact.stiffness:.4g}"], ["largest force, nN", f"{found.force.max():.4g}"]]


def write(found: Tip) -> Path:
    """Writes tip.json, curve.csv and the page into the directory of the study."""
    rows = store.rows_of(found.columns(), found.units)
    with store.outputs(found.directory, [RESULT, CURVE]) as out:
        out.write(RESULT, store.sealed_json(answer_of(found)))
        out.write(CURVE, store.csv_text(rows))
    lead = _set(str(found.numbers[0]))
    page = Page(found.directory, "asperity tip", f"A {found.contact.words} on {found.contact.stiffness:g} N/m", lead)
    page.section("curve", "Force curve")
    page.figure(FIGURES[0], "As the instrument shows it", "The drive moves the far end of the cantilever.", lambda ax: force_curve(found, ax))
    page.figure(FIGURES[1], "Against the place of the tip", "The drive less the deflection of the cantilever" + ", with JKR's fit" *
                (not found.contact.yields) + ".", lambda ax: force_curve(found, ax, "tip"))
    if found.contact.yields:
        page.figure(FIGURES[2], "Indentation", "Force over the depth below the undeformed surface; the law that Oliver and Pharr fit to the "
                    "unloading, and its slope at the largest depth.", lambda ax: indentation(found, ax))
    page.section("contact", "The contact at zero load")
    for name, heading in (("pressure", "Pressure"), ("gap", "Gap")):
        if STATE in found.result.fields:
            page.figure(name, heading, "From above, in the middle of the box.", partial(map_of, found.result, found.result.fields[STATE], name))
    page.section("numbers", "Numbers")
    page.table(ROW, [n.row for n in found.numbers])
    page.add("lists", [("Symbols", [_set(f"{n.symbol}: {n.name}") for n in found.numbers])])
    page.section("quote", "To quote")
    for line in lines_of(found.numbers):
        page.add("paragraph", _set(line) + ".")
    page.section("material", "Tip and sample")
    page.table([], _material(found))
    page.section("fit", "What an experimentalist would have found")
    head, *compared = _compared(found)
    page.table(head, compared)
    page.add("paragraph", _fit(found))
    page.add("paragraph", _theory(found))
    page.add("paragraph", DEFINED)
    page.section("notes", "Notes")
    page.add("lists", found.notes and [("", [note[0].upper() + note[1:] + "." for note in found.notes])])
    end(page, found.result, "The scene", found.result.part("scene"), "Every key with the value that was used; the runs of the error ("
        + ", ".join(words for part, words in RUN_OF.items() if part) + ") have others.")
    page.write()
    return page.path
