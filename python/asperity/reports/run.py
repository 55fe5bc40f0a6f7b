# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity report DIR`: a run or a sweep as one page (report.html), with the figures in report/ in the same directory.

A second report replaces these files.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from pathlib import Path

from .. import terminal
from ..plots import run as plots
from ..plots.style import KINDS
from ..results.losses import losses
from ..results.result import Result, State, Values
from ..running import program, scene
from ..studies.stress import stresses_in
from ..studies.tables import AREA
from ..terminal import minus
from ..theories import combined
from ..units import shown
from . import sentences, stress as report_stress
from .page import Page, file_name, page_files

MOST_STATES = 6
FIGURES = {
    "path": ("Force and contact", (
        ("separation", "Force and separation", "{path}"),
        ("contact", "Contact over the path",
         "{contact} (in contact), and sites whose net normal force is repulsive (repulsive), over all sites. Displacement "
         "is negative towards the substrate."))),
    "surface": ("Surface and theory", (
        ("height", "Height of the substrate", "The substrate from above. The colour bar spans 99\u00a0% of it."),
        ("spectrum", "Roughness spectrum",
         "Radially averaged power spectrum of this surface (realised), and the one that the scene asks for (target). {pair}"),
        ("roughness", "Binding energy and roughness", "Curves: the theories for this scene at other roughnesses. Markers: "
         "this run’s numbers, all as energies that separate the solids: works of the interface’s force, works of the "
         "drive, and the binding energy of the state."),
        ("sliding", "Rubber friction over velocity", "Persson’s theory of the friction coefficient (hysteresis alone) and of the contact "
         "area over the nominal area while the block slides."))),
    "energies": ("Energies", (
        ("energy", "Energies",
         "{energy}"),
        ("balance", "Energy balance", "Error of the energy balance: work of the drive minus the change of all energies minus energy "
         "damped, over the largest of these so far. Below 1e-3 is good."),
        ("loading", "Force and displacement of the top plane", "Elastic force on the driven top plane over its "
         "displacement (negative towards the substrate): what a testing machine would record. {loading}"),
        ("friction", "Force against the slides", "Lateral force of the substrate on the lowest layer against each "
         "slide, over its distance.")))}
"""Sections of a run: heading, and of each figure its plot, heading and caption."""
PATH_CAPTIONS = {
    False: "Force of the substrate on the block, over the nominal area; negative is attraction. The mean separation is "
           "the mean height of the lowest layer above the substrate’s mean plane. ",
    True: "Force of the substrate on the block over the mean height of the lowest layer above the apex; negative is "
          "attraction. Other curves: a smooth sphere by JKR, and by JKR and Maugis-Dugdale with the periodic "
          "images of the sphere."}
RINGING = (" On the approach the surfaces jump into contact, faster than the top plane moves, and the block then vibrates about its new place: "
           "the curve folds. After the pull-off the free block rings on until the damping has taken its energy.")
MAPS = (("gap", "Gap", "Height of each site above the substrate below it. The colour bar {bar}."),
        ("pressure", "Pressure", "Normal force of the substrate on a site over its area. Blue is attractive, orange "
                                 "repulsive; the colour bar spans 99\u00a0% of the values."),
        ("contact", "Contact", "{contact}."))
DISTRIBUTIONS = (
    ("pressures", "Distribution of pressure", "Probability density of the pressure on a site; negative is attraction. Sites "
     "beyond the interaction range are left out: the integral is the fraction of the others."),
    ("gaps", "Distribution of gaps", "Probability density of the gaps of all sites; the integral is one."))


def _words(run: Result) -> dict[str, str]:
    """Returns the texts for captions; contact: definition of sites in contact."""
    contact = "Sites nearer to an atom of the substrate than the inflection of the potential"
    if run.key("interface.kind") == "wall":
        contact = "Sites that touch the wall" if run.key("interface.law") in ("exponential", "dugdale", "power") else \
            "Sites nearer to the wall than the inflection of its potential"
    static, held = run.key("drive.mode") == "quasistatic", run.key("drive.control") == "mean-height"
    path = PATH_CAPTIONS[run.curved]
    if not run.curved:
        path += ("Straight lines across are jumps, on which the solids are not in force balance." if static and not held else
                 "The integral of a curve along its path is the work of the interface’s force on that segment." + RINGING * (not static))
    places = losses(run.series)
    others = "".join(f" + dissipated in the {place}" for place in places)
    return {"path": path, "contact": contact,
            "energy": "Work of the drive = interface + elastic + dissipated" + others + ". Steps of the curves are "
                      "instabilities." if static else
                      "Work of the drive = interface + elastic + kinetic + damped" +
                      " + the energy of the time step" * ("time_step_energy" in run.series) + ". The drive is the top plane, and the "
                      "medium of the damping that moves with it.",
            "loading": f"The area between approach and pull-off is the energy lost and dissipated in the {' and the '.join(places)} in a "
                       "cycle." if places else
                       "The area between approach and pull-off is the energy lost in a cycle." if static else
                       "The area between approach and pull-off is the work of the top plane in a cycle; what the medium of "
                       "the damping does is not in it. Swings after the jump into contact and after the pull-off are vibrations of the "
                       "block.", "at": run.load_words[0],
            "pair": sentences.pair(run), "bar": "ends at the cutoff" if run.curved else "spans 99\u00a0% of the values"}


def _figures(section: str, page: Page, run: Result) -> None:
    (heading, figures), words = FIGURES[section], _words(run)
    page.section(section, heading.format(**words))
    for name, title, caption in figures:
        page.figure(name, title, caption.format(**words), partial(getattr(plots, name), run))


def _top(page: Page, run: Result) -> None:
    if run.failure_text:
        page.notices.append(("This run failed", run.failure_text))
    if run.stopped:
        page.notices.append(("This run was stopped early", f"Reason: {run.stopped}. The path is not complete; the page "
                             "shows the part before the stop."))
    page.notices += [("Some of the files cannot be read", note) for note in run.notes]
    page.unread += run.notes
    numbers = sentences.key_numbers(run)
    page.add("first", numbers and numbers[0])
    for sentence in sentences.results(run):
        page.add("paragraph", sentence)
    page.table(["number", "value", "unit", ""], [[one.name, one.value, one.unit, one.note] for one in numbers[1:]])
    if not run.part("scene"):
        return
    # A result without a path or a state came from the theory alone.
    if run.series or run.fields or run.number("run.steps") is not None:
        page.add("lists", [("Simulated", sentences.effects(run, True)),
                           ("Not simulated", sentences.effects(run, False))])
    else:
        page.add("lists", [("Computed", ["the theory alone: nothing was simulated"])])


def _state(page: Page, run: Result, state: State) -> None:
    name = file_name(state.name)
    page.section(f"state-{name}", f"The state {sentences.state_in_words(run, state.name)}")
    for key, heading, caption in MAPS:
        page.figure(f"{key}-{name}", heading, caption.format(**_words(run)), partial(plots.map_of, run, state, key))
    for key, heading, caption in DISTRIBUTIONS:
        page.figure(f"{key}-{name}", heading, caption, partial(plots.OF_STATE[key], state))


def _states(page: Page, run: Result) -> None:
    """Adds the relaxed state and further states; of many states an even selection."""
    states = sorted(run.fields.values(), key=lambda s: s.name != "relaxed")
    n, few = len(states), min(len(states), MOST_STATES)
    for i in range(few):
        _state(page, run, states[i * (n - 1) // (few - 1) if few > 1 else i])
    if few < n:
        page.add("paragraph", f"{few} of the {n} states in run.h5 are shown; `asperity export` writes them all.")


def _stresses(page: Page, run: Result) -> None:
    """Adds the stresses below the states that the run has recorded (output.stress)."""
    for found in stresses_in(run):
        name = file_name(found.state)
        page.section(f"stress-{name}", f"Stresses below the state {sentences.state_in_words(run, found.state)}")
        report_stress.add_table(page, found)
        report_stress.figures(page, found, f"-{name}")


def _segments(page: Page, run: Result) -> None:
    """Adds the segments of a path with segments other than approach and pull-off."""
    page.section("segments", "Segments of the path")
    page.table(*sentences.segment_table(run))


def _numbers(page: Page, run: Result) -> None:
    """Adds every number of the result, in the order of the file."""
    rows = []
    for key, value in run.numbers().items():
        if key.split(".")[0] in ("scene", "run", "failure", "units"):
            continue
        known = program.quantity(key)
        unit, meaning, flat = shown(run.unit(key) or known["unit"]), known["meaning"], sentences.reference(run, key)
        nominal = known["per"] == AREA and not key.startswith("theory.")
        over = unit == "meV/Å²" and flat > 0 and not (run.in_newtons and nominal)
        rows.append([f"{key}: {meaning}" if meaning else key, minus(f"{value:.6g}"), "" if unit == "1" else unit,
                     minus(terminal.millijoules(value)) if unit == "meV/Å²" else "",
                     minus(terminal.number(value / flat, 4)) if over else ""])
    page.section("numbers", "All numbers")
    page.table(["", "value", "unit", "mJ/m²", "over Δγ"], rows)


def _times(page: Page, run: Result) -> None:
    found = run.part("run.phases")
    bars = [(name, s, c) for name in found
            if (s := found.number(f"{name}.seconds")) is not None and (c := found.number(f"{name}.calls")) is not None]
    longest = max((s for _, s, _ in bars), default=0.0) or 1.0
    page.section("times", "Time spent")
    page.add("bars", [{"name": name, "fraction": s / longest, "text": f"{s:.3g} s, {c:.0f} ×"}
                      for name, s, c in sorted(bars, key=lambda b: -b[1])])


def end(page: Page, result: Values, heading: str, keys: Mapping, note: str) -> None:
    """Adds the scene, the origin of the numbers, and how to cite them."""
    if keys:
        page.section("scene", heading)
        page.add("paragraph", note)
        page.add("preformatted", scene.toml_of(keys).strip())
    page.section("provenance", "Provenance")
    page.table([], sentences.provenance(result))
    page.section("cite", "How to cite")
    page.add("paragraph", "Name the program with its version, and the paper whose system it simulates; with the "
             "theory’s numbers, also the theory.")
    page.add("lists", [("", sentences.citations(result))])


def run_page_files(states: Iterable[str], kinds: tuple[str, ...] = KINDS) -> list[str]:
    """Returns the names of all files that write_run_page() may write."""
    of_state = [*(one[0] for one in (*MAPS, *DISTRIBUTIONS)), *report_stress.FIGURES]
    return page_files([*(figure[0] for _, figures in FIGURES.values() for figure in figures),
                       *(f"{id}-{file_name(state)}" for state in states for id in of_state)], kinds)


def write_run_page(run: Result, kinds: tuple[str, ...] = KINDS, out: Path | None = None) -> Page:
    """Writes DIR/report.html of a run."""
    combined.complete(run)
    page = Page(out or run.directory, "Asperity report", run.title, sentences.lead(run), kinds=kinds)
    for part in (_top, partial(_figures, "path"), _segments, _states, _stresses, partial(_figures, "surface"),
                 partial(_figures, "energies"), _numbers, _times):
        part(page, run)
    beside = {"file": ", with the map beside it", "atoms": ", with the file of atoms beside it"}.get(
        run.text("scene.surface.kind"), "")
    end(page, run, "The scene", run.find("scene") if run.part("scene") else {},
        f"Every key with the value that was used. Saved as a file, it runs again{beside}.")
    page.write()
    return page
