# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What a report says of a run in words: key numbers, results, effects, provenance."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

from ..results.result import Result, Values, finite
from ..studies.estimate import left_out
from ..terminal import duration, millijoules, minus, number
from ..units import NANONEWTON


@dataclass
class KeyNumber:
    """A number at the top of a page, with its unit, name and a note."""

    value: str
    unit: str
    name: str
    note: str = ""


SEGMENTS = "segment"
"""Table of the rows of segments."""
NONE = "-"
"""Value of a row that a column does not have."""


def percent(fraction: float) -> str:
    """Spells a fraction in percent."""
    digits = 2 if abs(fraction) < 0.1 else 1
    return minus(f"{number(100 * fraction, digits)}\u00a0%")


def minus_signs(text: str) -> str:
    """Replaces the minus signs before the numbers of a sentence."""
    return re.sub(r"(?<![\w.])-(?=\d)", "−", text)


def energy(gamma: float, more: str = "") -> str:
    """Spells an energy over an area: "69.91 meV/Å² (1120 mJ/m²)"."""
    return minus(f"{number(gamma, 2)} meV/Å²") + f" ({minus(millijoules(gamma))} mJ/m²" + f"; {more}" * bool(more) + ")"


def general(value: Any, digits: int = 4) -> str:
    """Spells a number of a scene."""
    return "?" if (number := finite(value)) is None else f"{number:.{digits}g}"


def state_in_words(run: Result, name: str) -> str:
    """Returns when a state was saved, in words."""
    if name == "relaxed":
        return run.load_words[0]
    if name == "pull-off":
        return "at the largest attraction of the pull-off"
    if name.startswith("after-approach:"):
        return name.removeprefix("after-approach:") + " ps after zero load"
    if name.startswith("step-"):
        return "at step " + name.removeprefix("step-")
    number = name.removeprefix("segment-")
    if number != name and number.isdecimal() and int(number) < len(run.segment_names):
        return f"at the end of segment {int(number) + 1}, “{run.segment_names[int(number)]}”"
    return f"“{name}”"


def _path(run: Result) -> str:
    """Spells the path: " Dynamic path at 5 m/s: approach, pull-off."; "" of a result of the theory alone."""
    if not run.segment_names or not (run.series or run.fields):
        return ""
    if run.segment_names == ["relax"]:
        return f" Its relaxed state {run.load_words[0]}."
    kind = "Quasi-static path" if run.key("drive.mode") == "quasistatic" else \
        f"Dynamic path at {general(run.key('drive.velocity'))} m/s"
    held = ", mean height prescribed" * (run.key("drive.control") == "mean-height")
    return f" {kind}{held}: {', '.join(run.segment_names)}."


def lead(run: Result) -> str:
    """Tells in two sentences what was simulated."""
    sites = run.number("scene.surface.sites")
    if not sites:
        return ""
    surface = {"flat": "a flat substrate", "file": "a measured substrate",
               "atoms": f"a substrate of {run.number('surface.atoms', 0):.0f} atoms"}.get(
        run.text("scene.surface.kind"), "a self-affine rough substrate")
    rms, slope = run.number("surface.rms"), run.number("surface.rms_slope")
    if rms:
        surface += f" (rms height {rms:.3g} Å" + (f", rms slope {slope:.2g}" if slope is not None else "") + ")"
    if run.number("surface.counter.rms") is not None:
        surface = f"another, both rough: the sum of the surfaces has an rms height of {rms or 0.0:.3g} Å and an rms slope of {slope or 0.0:.2g}"
    if run.radius:
        surface += f" on a sphere of R = {0.1 * run.radius:.4g} nm"
    if run.has_free_edges:
        return (f"An elastic half-space on {surface}: {sites:.0f} × {sites:.0f} sites, {number(0.1 * run.edge, 1)} nm wide, "
                f"with free edges.{_path(run)}")
    return (f"An elastic block on {surface}: {sites:.0f} × {sites:.0f} atoms, {number(0.1 * run.edge, 1)} nm wide, "
            f"{general(run.key('block.thickness'))} layers thick.{_path(run)}")


def pair(run: Result) -> str:
    """Tells the roughness of two solids, and how they lie on each other; "" of one rough surface."""
    if run.number("surface.counter.rms") is None:
        return ""
    own, counter = ((run.number(f"surface.{which}.rms", 0.0), run.number(f"surface.{which}.rms_slope", 0.0)) for which in ("own", "counter"))
    return (f"First solid: rms height {own[0]:.3g} Å, rms slope {own[1]:.2g}; second solid: {counter[0]:.3g} Å, {counter[1]:.2g}. Heights are "
            f"outwards from each; where they lie on each other their correlation is {run.number('surface.correlation', 0.0):.2g} (1 of equal "
            f"ones), and their bands overlap by {run.number('surface.band_overlap', 0.0):.2g} (1 of proportional spectra).")


def smooth_pull_off(run: Result, gamma: float) -> float:
    """Returns the force that stands for a work of adhesion of a sphere in result.json (JKR: 3πγR/2)."""
    return 1.5 * math.pi * (run.radius or 0.0) * gamma / 1e3


def reference(run: Result, key: str) -> float:
    """Returns the Δγ that an energy is compared with. Persson's theory may have been given another than the run's."""
    own = key.startswith("theory.") and not key.startswith(("theory.renormalised.", "theory.sphere."))
    return (own and run.number("theory.persson.delta_gamma")) or run.number("delta_gamma", 0.0)


def _rows(run: Result) -> list[KeyNumber]:
    """Returns the numbers of the run that are not those of segments, with their errors and shares as notes."""
    found: list[KeyNumber] = []
    above: list[KeyNumber] = []
    for row in map(Values, run.listed("rows", dict)):
        if row.text("table") == SEGMENTS:
            continue
        columns, values = row.listed("columns", str), row.listed("texts", str)
        if not row.find("detail"):
            above = [KeyNumber(minus_signs(value), row.text("unit"), ", ".join(filter(None, [row.text("name"), column or row.text("table")])))
                     for column, value in zip(columns, values)]
            found += above
            continue
        for one, value in zip(above, values):
            if value != NONE:
                one.note += "; " * bool(one.note) + f"{row.text('name')}: {minus_signs(value)} {row.text('unit')}".rstrip()
    return [one for one in found if one.value != NONE]


def segment_table(run: Result) -> tuple[list[str], list[list[str]]]:
    """Returns the table of the segments of a path that has others than approach and pull-off: heads and rows, [] for other paths."""
    rows = [row for row in map(Values, run.listed("rows", dict)) if row.text("table") == SEGMENTS]
    heads = [", ".join(filter(None, [row.text("name"), row.text("unit")])) for row in rows]
    names = rows[0].listed("columns", str) if rows else []
    return [SEGMENTS, *heads], [[name, *map(minus_signs, cells)] for name, *cells in zip(names, *(row.listed("texts", str) for row in rows))]


def _theories(run: Result) -> list[KeyNumber]:
    """Returns the numbers of the theories of a run."""
    found: list[KeyNumber] = []
    pressed = run.load_words[1]
    for key, name in (("theory.persson.gamma_eff", f"Persson’s theory{pressed}" + ", of the flat surface" * run.curved),
                      ("theory.renormalised.gamma_eff", f"renormalised theory{pressed}")):
        value, flat = run.number(key), reference(run, key)
        if value is not None and flat > 0:
            found.append(KeyNumber(minus(number(value / flat, 3)), "Δγ", name, energy(value)))
    for key, name in (("persson.contact_fraction", f"contact area in theory{pressed}"),
                      ("sliding.contact_fraction", "contact area in Persson’s theory of rubber friction")):
        if (area := run.number(f"theory.{key}")) is not None:
            found.append(KeyNumber(percent(area), "", name))
    if (friction := run.number("theory.sliding.friction_coefficient")) is not None:
        found.append(KeyNumber(f"{friction:.3g}", "", "friction coefficient in Persson’s theory of rubber friction"))
    for name, key in (("JKR", "delta_gamma"), ("Maugis-Dugdale with images", "theory.sphere.maugis_images")):
        if run.curved and (force := smooth_pull_off(run, run.number(key, 0.0)) / NANONEWTON) > 0:
            found.append(KeyNumber(f"{force:.4g}", "nN", f"pull-off force of a smooth sphere, {name}"))
    return found


def key_numbers(run: Result) -> list[KeyNumber]:
    """Returns the numbers that stand at the top of a page: those of the summary of the run, and those of the theories."""
    return _rows(run) + _theories(run)


def results(run: Result) -> list[str]:
    """Tells the results of a run in sentences: those of its summary, and one of the theories."""
    text = [minus_signs(sentence) for sentence in run.listed("sentences", str)]
    flat, state = run.number("delta_gamma", 0.0), run.number("binding_energy")
    theory = run.number("theory.persson.gamma_eff")
    if theory is not None and flat > 0:
        (at, pressed), given = run.load_words, reference(run, "theory.persson.gamma_eff")
        share = "Δγ" if math.isclose(given, flat) else f"its Δγ, {number(given, 2)} meV/Å²"
        sentence = (f"Persson’s theory{pressed} gives γ_{{eff}} = "
                    + energy(theory, f"{percent(theory / given)} of {share}"))
        full, renormalised = run.number("theory.persson.gamma_full_contact"), run.number("theory.renormalised.gamma_eff")
        if full is not None and full > 0:
            sentence += f", or {energy(full)} if the whole area were in contact"
        elif full is not None:
            sentence += "; full contact would store more elastic energy than adhesion gives"
        if renormalised is not None:
            sentence += f"; the renormalised theory gives {energy(renormalised, f'{percent(renormalised / flat)} of Δγ')}"
        found = run.number("jkr.pull_off") if run.curved else state
        if found is not None:
            sentence += f"; the simulation finds {energy(found)}" + \
                (" by JKR from the pull-off force" if run.curved else f" {at}" * bool(pressed))
        text.append(sentence + ".")
    for name in ("theory.persson", "theory.renormalised"):
        note, known = run.text(name + ".note"), run.number(name + ".gamma_eff") is not None
        if note:
            text.append(f"{'Note on the theory' if known else 'The theory has no number for this scene'}: {note}.")
    return [t for t in text if t]


def effects(run: Result, on: bool) -> list[str]:
    """Returns the effects that were simulated or were not, each with the key of the scene that decides it."""
    found = run.part("run.effects")
    text = [f"{name}: {found.text(name + '.why')}" for name in found if found.find(name + ".on") is on]
    scene = run.part("scene")
    edges = ["edges: the box is periodic sideways"] * (scene.text("surface.boundary") != "free")
    return text if on else [*text, *left_out(scene), *edges]


def provenance(result: Values) -> list[list[str]]:
    """Returns rows of names and words on the origin of a run or a sweep."""
    rows = []
    for name, key in (("measured surface", "surface.origin"), ("version", "run.version"), ("git", "run.git"),
                      ("compiler", "run.compiler"), ("flags", "run.flags"), ("machine", "run.machine"),
                      ("device", "run.device"), ("kernels", "run.kernels"), ("ranks", "run.ranks"),
                      ("threads a rank", "run.threads"), ("steps", "run.steps"),
                      ("iterations of the relaxation", "run.iterations"), ("wall time", "run.wall_seconds"),
                      ("stopped", "run.stopped")):
        text, number = result.text(key), result.number(key)
        if number is not None:
            text = duration(number) if key == "run.wall_seconds" else f"{number:.10g}"
        if text:
            rows.append([name, "Asperity " * (key == "run.version") + text])
    return rows


def citations(result: Values) -> list[str]:
    """Returns what to cite for a result."""
    return [f"Asperity {result.text('run.version') or '?'} (commit {result.text('run.git') or '?'}): adhesion between "
            "randomly rough elastic solids, from the atoms up.",
            "N. Mulakaluri and B. N. J. Persson, Adhesion between elastic solids with randomly rough surfaces: "
            "comparison of analytical theory with molecular dynamics simulations, arXiv:1112.5275 (2011).",
            "B. N. J. Persson, Eur. Phys. J. E 8, 385 (2002): the theory of adhesion."]
