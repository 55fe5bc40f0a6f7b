# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What `asperity stress` says and writes: the table of the largest stresses, the page, stress.json and stress.vti."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from .. import terminal
from ..files import store
from ..plots import stress as plots
from ..studies.stated_number import rounded
from ..studies.stress import COMPONENTS, MEASURES, RESULT, Stress, largest_tension, von_mises
from .export import volume_text
from .page import Page, page_files

NUMBERS, IMAGE = "stress.json", "stress.vti"
FIGURES = ("section", "tension", "level", "profile")
FILES = [RESULT, NUMBERS, IMAGE, *page_files(FIGURES)]
CAPTIONS = {
    "section": ("Section", "Stress of von Mises in the vertical plane through its largest value (+). The surface is below; dashed lines are "
                "boundaries of layers."),
    "tension": ("Largest tension", "Largest principal stress in the vertical plane through its largest value (+); tension is positive. A brittle "
                "layer cracks where it is largest."),
    "level": ("Level", "Stress of von Mises from above, at the depth at which it is largest."),
    "profile": ("Profile", "Largest stresses at each depth. Points: the largest of each layer with their errors; a curve without a point has "
                "none to be quoted.")}


def conditions(found: Stress) -> str:
    """Returns the sentence on what the numbers hold for."""
    sides = ("The sides are free, and the mean pressure is that of a box without images: the change by images of "
             "the contact is a part of the error." if found.free_edges else "The sides are held: the mean pressure strains the block along z alone.")
    if found.solid == "counter":
        sides += " These are the stresses in the second solid; depths lead from its surface into it."
    if found.slid:
        return sides + " The friction of the slide acts as the pressure times the slope of the wall."
    if found.friction:
        return sides + f" A friction of {found.friction:g} times the pressure acts along x, where the pressure is repulsive."
    return sides + " No friction acts."


def _rows(found: Stress) -> list[list[str]]:
    scale, _ = plots.unit(found)
    rows = []
    for one in found.largest:
        top, end = (0.1 * z for z in found.layers[one.layer])
        where = ", ".join(f"{0.1 * v:.4g}" for v in (one.x, one.y, one.depth))
        value, error = rounded(one.value / scale, one.error / scale) if one.error is not None else ("–", "not stated")
        rows.append([f"{top:.4g} to {end:.4g}", MEASURES[one.measure], terminal.minus(value), error, where])
    return rows


def _heads(found: Stress) -> list[str]:
    return ["depths, nm", "largest", plots.unit(found)[1], "error", "at x, y, depth, nm"]


def reasons(found: Stress) -> list[str]:
    """Returns a sentence for each number that is not stated."""
    several = len(found.layers) > 1
    return [f"{MEASURES[one.measure]}{f' of layer {one.layer + 1}' * several} is not stated: {one.reason}" for one in found.largest if one.reason]


def text_of(found: Stress) -> str:
    """Returns what the terminal shows."""
    table = terminal.table(_heads(found), _rows(found))
    return "\n".join([f"Below the state {found.state}:", table, "", conditions(found), *reasons(found)])


def answer_of(found: Stress) -> dict[str, Any]:
    """Returns what stress.json and --json have."""
    layers = []
    for number, (top, end) in enumerate(found.layers):
        of_layer = {one.measure: {"value": one.value, "error": one.error, "x": one.x, "y": one.y, "depth": one.depth, "reason": one.reason,
                                  "parts": one.parts} for one in found.largest if one.layer == number}
        layers.append({"from": top, "to": end, **of_layer})
    return {"state": found.state, "solid": found.solid, "friction": found.friction, "slide": found.slid, "conditions": conditions(found),
            "layers": layers, "units": {"value": "GPa", "x": "Å", "y": "Å", "depth": "Å"}}


def image_of(found: Stress) -> str:
    """Returns the stresses as VTK's image: the volume, or the section; z leads into the block."""
    volume = found.volume or {name: values[:, None, :] for name, values in found.section.items()}
    spacing = found.edge / found.section["xx"].shape[1]
    fields = {f"stress {name} (GPa)": volume[name] for name in COMPONENTS}
    fields |= {"von Mises (GPa)": von_mises(volume), "largest tension (GPa)": largest_tension(volume)}
    start = 0.5 * spacing
    return volume_text((spacing, spacing, float(found.depth[1] - found.depth[0])),
                       (start, start if found.volume else found.section_y, 0.0), fields)


def figures(page: Page, found: Stress, name: str = "") -> None:
    """Adds the figures to a page."""
    draw = {"section": plots.section, "tension": partial(plots.section, measure="tension"), "level": plots.level, "profile": plots.profile}
    for figure, (heading, caption) in CAPTIONS.items():
        page.figure(figure + name, heading, caption, partial(draw[figure], found))


def add_table(page: Page, found: Stress) -> None:
    """Adds the largest stresses, the conditions, and the reasons of what is not stated to a page."""
    page.table(_heads(found), _rows(found))
    for sentence in (conditions(found), *(f"{reason[0].upper()}{reason[1:]}." for reason in reasons(found))):
        page.add("paragraph", sentence)


def write(found: Stress, place: Path, out: store.Outputs) -> Path:
    """Writes stress.json, stress.vti and the page."""
    out.write(NUMBERS, store.sealed_json(answer_of(found)))
    out.write(IMAGE, image_of(found))
    page = Page(place, "asperity stress", f"Stresses below {found.directory.resolve().name}, state {found.state}", "")
    page.section("largest", "Largest stresses")
    add_table(page, found)
    page.section("figures", "Where they are")
    figures(page, found)
    page.write()
    return page.path
