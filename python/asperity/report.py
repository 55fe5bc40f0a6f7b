# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity report DIR`: a run or a sweep as one page (report.html), with every figure in report/ beside it.

These files are the report's own: a second report writes them anew.
"""

from __future__ import annotations

from functools import partial

from . import program, scene, sentences
from .page import Page, Row, file_name, minus
from .plots import run as plots
from .plots.files import KINDS
from .result import Result, State, Values, load_words
from .units import shown

MOST_STATES = 6

PATH_CAPTIONS = {
    False: "Force of the substrate on the block over the mean separation, the mean height of the lowest layer above the "
           "substrate’s mean plane; negative is attraction. The area under a curve is the work of adhesion of that segment.",
    True: "Force of the substrate on the block over the mean height of the lowest layer above the apex; negative is "
          "attraction. Beside it what a smooth sphere would do: JKR alone, and JKR and Maugis-Dugdale with the sphere’s "
          "periodic images."}
MAPS = (("gap", "Gap", "Height of each site above the substrate below it."),
        ("pressure", "Pressure", "Normal force of the substrate on a site over its area. Blue is attractive, orange "
                                 "repulsive; the colour bar spans 99\u00a0% of the values."),
        ("contact", "Contact", ""))
STATE_COLUMNS = (("binding_energy", "binding energy, meV/Å²"), ("contact_fraction", "contact"),
                 ("repulsive_fraction", "repulsive"), ("mean_height", "mean height, Å"),
                 ("elastic_energy", "elastic energy, meV/Å²"), ("barrier", "barrier to the next, MPa"))


def _in_contact(run: Result) -> str:
    """Which sites the program counts as in contact."""
    if run.key("interface.kind") != "wall":
        return "Sites nearer to an atom of the substrate than the inflection of the potential"
    if run.key("interface.law") == "exponential":
        return "Sites that touch the wall"
    return "Sites nearer to the wall than the inflection of its potential"


def _top(page: Page, run: Result) -> None:
    if run.failure_text:
        page.notices.append(("This run failed", run.failure_text))
    if run.stopped:
        page.notices.append(("This run was stopped early", f"Reason: {run.stopped}. The path is not complete; what is "
                             "shown is what had been reached."))
    page.notices += [("Some of the files cannot be read", note) for note in run.notes]
    page.add("numbers", sentences.key_numbers(run))
    for sentence in sentences.results(run):
        page.add("paragraph", sentence)
    if not isinstance(run.find("scene"), dict):
        return
    # A result without a path or a state came from the theory alone.
    if run.series or run.fields or run.number("run.steps") is not None:
        page.add("lists", [("Simulated", sentences.effects(run, True)), ("Not simulated", sentences.effects(run, False))])
    else:
        page.add("lists", [("Computed", ["the theory alone: nothing was simulated"])])


def _path(page: Page, run: Result) -> None:
    page.section("path", "Force and contact")
    page.figure("separation", "Force and separation", PATH_CAPTIONS[run.curved], partial(plots.separation, run))
    page.figure("contact", "Contact over the path",
                f"{_in_contact(run)} (in contact), and sites whose net normal force is repulsive.",
                partial(plots.contact, run))


def _state(page: Page, run: Result, state: State) -> None:
    name = file_name(state.name)
    page.section(f"state-{name}", f"The state {sentences.state_in_words(run, state.name)}")
    for key, heading, caption in MAPS:
        if key == "gap":
            caption += " The colour bar ends at the cutoff." if run.curved else \
                " The colour bar spans 99\u00a0% of the values."
        page.figure(f"{key}-{name}", heading, caption or f"{_in_contact(run)}.", partial(plots.map_of, run, state, key))
    page.figure(f"pressures-{name}", "Distribution of pressure",
                "How the interface’s pressure is distributed over the sites that feel any: the left wing is attractive, "
                "the right one repulsive. Per site of the box.", partial(plots.pressures, state))
    page.figure(f"gaps-{name}", "Distribution of gaps", "Distribution of the gaps of all sites, normalised to one.",
                partial(plots.gaps, state))


def _states(page: Page, run: Result) -> None:
    """The relaxed state first; of many, some that are spread evenly."""
    states = sorted(run.fields.values(), key=lambda s: s.name != "zero-load")
    n, few = len(states), min(len(states), MOST_STATES)
    for i in range(few):
        _state(page, run, states[i * (n - 1) // (few - 1) if few > 1 else i])
    if few < n:
        page.add("paragraph", f"{few} of the {n} states in run.h5 are shown; `asperity export` writes them all.")
    at = load_words(run.find("scene"))[0]
    page.section("states", f"States {at}")
    page.figure("states", "Energy of every state", f"Binding energy of the states {at} over their mean height.",
                partial(plots.states, run))
    found = run.find("states.all")
    rows = [Row([str(i + 1), *(sentences.general(s.get(k), 6) for k, _ in STATE_COLUMNS)])
            for i, s in enumerate(found if isinstance(found, list) else []) if isinstance(s, dict)]
    page.add("table", {"heads": ["state", *(head for _, head in STATE_COLUMNS)], "rows": rows} if rows else None)


def _surface(page: Page, run: Result) -> None:
    page.section("surface", "Surface and theory")
    page.figure("height", "Height of the substrate",
                "The substrate from above. The colour bar spans 99\u00a0% of it.", partial(plots.height, run))
    page.figure("spectrum", "Roughness spectrum", "Radially averaged power spectrum of the surface that was made, and "
                "what was asked for.", partial(plots.spectrum, run))
    page.figure("roughness", "Binding energy and roughness", "Persson’s theory for this scene at other roughnesses, and "
                "this run’s numbers.", partial(plots.roughness, run))


def _energies(page: Page, run: Result) -> None:
    page.section("energies", "Energies")
    page.figure("energy", "Energies", "Energies over the path. Work is done by the top plane and the moving medium of "
                "the damping.", partial(plots.energy, run))
    page.figure("balance", "Energy balance", "Work done minus energy gained minus energy damped or radiated, over the largest of "
                "these terms so far.", partial(plots.balance, run))
    page.figure("loading", "Force and displacement of the top plane", "Elastic force on the driven top plane over its "
                "displacement: what a testing machine would record. Between the curves lies the energy lost in a "
                "cycle.", partial(plots.loading, run))
    page.figure("friction", "Force against the slides", "Lateral force of the substrate on the lowest layer against each "
                "slide, over its distance.", partial(plots.friction, run))


SEGMENT_COLUMNS = (("name", "segment"), ("work_of_drive", "work of the drive, meV/Å²"), ("lost", "lost, meV/Å²"),
                   ("pressure", "ends at, MPa"), ("mean_height", "mean height, Å"), ("contact_fraction", "contact"),
                   ("friction", "friction, eV/Å"))


def _segments(page: Page, run: Result) -> None:
    """Of a path that does more than to approach and to pull off."""
    found = run.find("segments")
    if not isinstance(found, list) or set(run.segments) <= {"approach", "pull-off", "zero-load"}:
        return
    columns = [c for c in SEGMENT_COLUMNS if any(isinstance(s, dict) and c[0] in s for s in found)]
    page.section("segments", "Segments of the path")
    page.add("table", {"heads": [head for _, head in columns],
                       "rows": [Row([str(s.get("name", "")), *(sentences.general(s.get(k), 5) for k, _ in columns[1:])])
                                for s in found if isinstance(s, dict)]})


def _numbers(page: Page, run: Result) -> None:
    """Every number of the result, in the order of the file."""
    rows = []
    for key, value in run.numbers().items():
        if key.split(".")[0] in ("scene", "run", "failure", "units") or run.number(key) is None:
            continue
        known = program.quantity(key)
        unit, meaning, flat = shown(run.unit(key) or known["unit"]), known["meaning"], sentences.reference(run, key)
        # Of a sphere, the nominal area says nothing, and so does an energy over it.
        nominal = key.split(".")[0] in ("binding_energy", "work_of_adhesion", "work_of_drive", "lost", "states", "zero_load")
        over = unit == "meV/Å²" and flat > 0 and not (run.curved and nominal)
        rows.append(Row([f"{key}: {meaning}" if meaning else key, minus(f"{value:.6g}"), "" if unit == "1" else unit,
                         minus(f"{value / flat:.4f}") if over else ""]))
    page.section("numbers", "All numbers")
    page.add("table", {"heads": ["", "value", "unit", "over Δγ"], "rows": rows} if rows else None)


def _times(page: Page, run: Result) -> None:
    phases = run.find("run.phases")
    found = Values(phases if isinstance(phases, dict) else {})
    bars = [(name, s, c) for name in found
            if (s := found.number(f"{name}.seconds")) is not None and (c := found.number(f"{name}.calls")) is not None]
    longest = max((s for _, s, _ in bars), default=0.0) or 1.0
    page.section("times", "Time spent")
    page.add("bars", [{"name": name, "fraction": s / longest, "text": f"{s:.3g} s, {c:.0f} ×"}
                      for name, s, c in sorted(bars, key=lambda b: -b[1])])


def end(page: Page, result: Values, heading: str, keys: dict | None, note: str) -> None:
    """The scene, where the numbers come from, and how to cite them."""
    if keys:
        page.section("scene", heading)
        page.add("paragraph", note)
        page.add("preformatted", scene.toml_of(keys).strip())
    page.section("provenance", "Provenance")
    rows = sentences.provenance(result)
    page.add("table", {"heads": [], "rows": [Row(r) for r in rows]} if rows else None)
    page.section("cite", "How to cite")
    page.add("paragraph", "Name the program with its version, and the paper whose system it simulates; with the theory’s "
             "numbers, also the theory.")
    page.add("lists", [("", sentences.citations(result))])


def write_run_page(run: Result, kinds: tuple[str, ...] = KINDS) -> Page:
    """DIR/report.html of a run; kinds: of files of its figures."""
    page = Page(run.directory, "Asperity report", run.title, sentences.lead(run), kinds=kinds)
    for part in (_top, _path, _segments, _states, _surface, _energies, _numbers, _times):
        part(page, run)
    keys = run.find("scene")
    beside = {"file": "map", "atoms": "file of atoms"}.get(str(run.key("surface.kind")), "")
    measured = f", with the {beside} beside it" if beside else ""
    end(page, run, "The scene", keys if isinstance(keys, dict) else None,
        f"Every key with the value that was used. Saved as a file, it runs again{measured}.")
    page.said = page.write()
    return page
