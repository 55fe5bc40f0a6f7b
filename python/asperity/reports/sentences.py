# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What a report says of a run in words: key numbers, results, effects, provenance."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..results.losses import losses
from ..results.result import Result, Values, finite
from ..studies.estimate import left_out
from ..terminal import duration, millijoules, minus, number
from ..units import ATTOJOULE, GIGAPASCAL, NANONEWTON


@dataclass
class KeyNumber:
    """A number at the top of a page, with its unit, name and a note."""

    value: str
    unit: str
    name: str
    note: str = ""


FEW = 99.5
"""Sites in contact that are counted beside their fraction."""


def percent(fraction: float) -> str:
    """Spells a fraction in percent."""
    digits = 2 if abs(fraction) < 0.1 else 1
    return minus(f"{number(100 * fraction, digits)}\u00a0%")


def energy(gamma: float, more: str = "") -> str:
    """Spells an energy over an area: "69.91 meV/Å² (1120 mJ/m²)"."""
    return minus(f"{number(gamma, 2)} meV/Å²") + f" ({minus(millijoules(gamma))} mJ/m²" + f"; {more}" * bool(more) + ")"


def whole(run: Result, gamma: float) -> str:
    """Spells the energy of a whole contact: "1.29 aJ"."""
    return minus(f"{gamma * run.edge**2 / 1e3 / ATTOJOULE:.4g} aJ")


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


def _stress(gigapascal: float) -> tuple[str, str]:
    """Converts a stress, GPa, to a unit of its size. Returns number and unit."""
    for scale, unit in ((1.0, "GPa"), (1e-3, "MPa")):
        if abs(gigapascal) >= 0.1 * scale:
            return f"{gigapascal / scale:.3g}", unit
    return f"{gigapascal / 1e-6:.3g}", "kPa"


def smooth_pull_off(run: Result, gamma: float) -> float:
    """Returns the force that stands for a work of adhesion of a sphere in result.json (JKR: 3πγR/2)."""
    return 1.5 * math.pi * (run.radius or 0.0) * gamma / 1e3


def reference(run: Result, key: str) -> float:
    """Returns the Δγ that an energy is compared with. Persson's theory may have been given another than the run's."""
    own = key.startswith("theory.") and not key.startswith(("theory.renormalised.", "theory.sphere."))
    return (own and run.number("theory.persson.delta_gamma")) or run.number("delta_gamma", 0.0)


def of_mesh(run: Result, key: str, scale: float, unit: str) -> str:
    """Returns the words on the error of a number by the spacing; "" if the sites are no mesh. key: the error; scale: unit over that of the
    result."""
    if run.key("interface.kind") != "wall" or run.key("interface.law") == "smeared":
        return ""
    error = run.number(key)
    return "; mesh not included" if error is None else f"; ± {error / scale:.2g} {unit} by the mesh"


def _of_area(error: float | None, theory: str) -> str:
    """Returns the note on an area in contact with a wall: that of a theory, and the error."""
    return "; ".join(filter(None, [theory, "mesh not included" if error is None else f"± {percent(error)}"]))


def key_numbers(run: Result) -> list[KeyNumber]:
    """Returns the numbers that stand at the top of a page."""
    found: list[KeyNumber] = []
    at, pressed = run.load_words

    def add(value: str, unit: str, name: str, note: str = "") -> None:
        found.append(KeyNumber(minus(value), unit, name, note))

    def gamma(key: str, name: str, symbol: str = "Δγ") -> None:
        sign, key = (-1.0, key[1:]) if key.startswith("-") else (1.0, key)  # of works on the solids
        value, flat = run.number(key), reference(run, key)
        if value is not None and flat > 0:
            value *= sign
            parent, _, leaf = key.rpartition(".")
            error = run.number(key + "_uncertainty") or run.number(f"{parent}.uncertainty.{leaf}")
            add(number(value / flat, 3), symbol, name,
                energy(value) + (f"; solver converged to {error:.2g} meV/Å²" if error else "")
                + of_mesh(run, f"mesh_error.{key}", 1.0, "meV/Å²") * key.startswith(("binding_energy", "work_of_")))

    force = run.number("pull_off_force")
    if run.curved:  # energies over the nominal area mean nothing
        pinning = run.number("jkr.edge_pinning")
        gamma("jkr.pull_off", "from the pull-off force, by JKR" + (
            f": about {pinning:.3g} times too large, for rows of sites hold the edge of the contact" if pinning else ""), "Δγ")
        gamma("jkr.approach_averaged", "from the attraction on the approach, by JKR, averaged over 2 ps")
        if force is not None:
            jkr, maugis = (smooth_pull_off(run, run.number(k, 0.0)) / NANONEWTON
                           for k in ("delta_gamma", "theory.sphere.maugis_images"))
            smooth = f"smooth sphere: JKR {jkr:.4g} nN, Maugis-Dugdale with images {maugis:.4g} nN"
            add(f"{force / NANONEWTON:.4g}", "nN", "pull-off force",
                (smooth * (jkr > 0 and maugis > 0) + of_mesh(run, "mesh_error.pull_off_force", NANONEWTON, "nN")).removeprefix("; "))
        if (radius := run.number("instrument.contact_radius")) is not None:
            add(f"{radius:.4g}", "nm", f"contact radius {at}",
                "√(area in contact / π)" + of_mesh(run, "instrument.contact_radius_uncertainty", 1.0, "nm"))
    else:
        gamma("binding_energy", f"binding energy {at}")
        area, theory = run.number("contact_area"), run.number("theory.persson.contact_fraction")
        contact = run.number("contact_fraction") if area is None else area
        if contact is not None:
            of_theory = f"theory{pressed}: {percent(theory)}" if theory is not None else ""
            add(percent(contact), "", f"of the {'sites' if area is None else 'area'} in contact {at}",
                of_theory if area is None else _of_area(run.number("contact_area_uncertainty"), of_theory))
        slide = next((s for s in reversed(run.listed("segments", dict)) if {"friction_coefficient", "steady_contact_area"} <= set(s)), None)
        if slide is not None:
            theories = [run.number(f"theory.sliding.{name}") for name in ("friction_coefficient", "contact_fraction")]
            error = slide.get("friction_coefficient_error")
            add(f"{slide['friction_coefficient']:.3g}" + (f" ± {error:.1g}" if error else ""), "", "friction coefficient of the slide",
                f"Persson’s theory of rubber friction: {theories[0]:.3g}" if theories[0] is not None else "")
            add(percent(slide["steady_contact_area"]), "", "of the area in contact while it slides",
                _of_area(slide.get("steady_contact_area_uncertainty"),
                         f"Persson’s theory of rubber friction: {percent(theories[1])}" if theories[1] is not None else ""))
        if force is not None and run.edge:
            add(*_stress(force / run.edge**2 / GIGAPASCAL),
                "pull-off stress, the largest attraction of the pull-off",
                f"{force / NANONEWTON:.4g} nN in all" + of_mesh(run, "mesh_error.pull_off_force", NANONEWTON, "nN"))
    others = _cycle_losses(run)
    for key, name, note in (
            ("lost.cycle", "lost at instabilities in a cycle" if others else "lost in a cycle (hysteresis)", _loss(run)),
            *((loss + ".cycle", f"dissipated in the {place} in a cycle", "plastic work" if place == "surface" else f"by the {place}, with time")
              for place, loss in others.items())):
        if (value := run.number(key)) is not None:
            if run.in_newtons:
                energy_lost, unit = whole(run, value).split()
                add(energy_lost, unit, name, note)
            else:
                add(f"{value:.4g}", "meV/Å²", name, f"{millijoules(value)} mJ/m²; {note}")
    if not run.in_newtons:
        gamma("work_of_interface.approach", "work of the interface, approach")
        gamma("-work_of_interface.pull_off", "work against the interface, pull-off")
        gamma("-work_of_drive.approach", "work that the drive takes up, approach")
        gamma("work_of_drive.pull_off", "work that the drive gives, pull-off")
    gamma("theory.persson.gamma_eff", f"Persson’s theory{pressed}" + ", of the flat surface" * run.curved)
    gamma("theory.renormalised.gamma_eff", f"renormalised theory{pressed}")
    theory = run.number("theory.persson.contact_fraction")
    if theory is not None and run.number("contact_fraction") is None:
        add(percent(theory), "", f"contact area in theory{pressed}")
    residual = run.number("energy.balance_error")
    if residual is not None and not run.failure_text:
        add(f"{abs(residual):.1e}", "", "energy balance error", "of the largest work or energy; below 1e-3 is good")
    return found


def _state_sentence(run: Result, state: float, flat: float) -> str:
    bonds, contact, pushed = map(run.number, ("pair_binding_energy", "contact_fraction", "repulsive_fraction"))
    at = run.load_words[0]
    at = "Without external force" if at == "at zero load" else "U" + at[1:]
    known, sites = run.number("binding_energy_uncertainty", 0.0), run.number("scene.surface.sites", 0.0) ** 2
    if abs(state) <= known:
        text = f"{at} the solids do not stick: the binding energy is below {energy(abs(state) + known)}."
    elif run.in_newtons:
        text = f"{at} the {'sphere is' if run.curved else 'solids are'} bound by {whole(run, state)}."
    else:
        unit = "one flat layer of the block’s lattice" if run.key("surface.kind") == "atoms" else "two flat surfaces"
        text = (f"{at} the solids are bound by {energy(state)}. That is {percent(state / flat)} of the binding energy "
                f"Δγ of {unit}, {energy(flat)}.")
        if bonds is not None:
            text += (f" The bonds across the interface give {energy(bonds)}; bending the block into contact costs "
                     f"{energy(bonds - state)} of it.")
    if contact is not None:
        count = f" ({round(contact * sites)} of {round(sites)})" * (contact * sites < FEW)
        text += f" {percent(contact)} of the sites{count} are in contact"
        if pushed is not None:
            text += f"; the force on {percent(pushed)} of the sites is repulsive"
        text += "."
    return text


def _loss(run: Result) -> str:
    """Tells as which quantity the loss of a cycle was measured."""
    return "damped, or still moving at the end" if run.find("dissipated") is None else "dissipated at instabilities"


def _cycle_losses(run: Result) -> dict[str, str]:
    """Returns the losses of a cycle beside `lost`: {"block": "dissipated_in_block"}."""
    return {place: name for place, name in losses(run).items() if run.number(name + ".cycle") is not None}


def _relaxing_sentence(run: Result, energy: Callable[[float], str]) -> str:
    """Tells the energies that are dissipated in a cycle beside the loss; "" if the solids are elastic."""
    return "".join(f" The {place} dissipates {energy(run.number(name + '.cycle', 0.0))}."
                   for place, name in _cycle_losses(run).items())


def _cycle_sentence(run: Result, into: float, out: float, flat: float) -> str:
    lost, *parts = (run.number("lost." + k) for k in ("cycle", "approach", "pull_off"))
    if lost is None:
        lost = into + out
    if run.in_newtons:
        loop, *ways = ("" if p is None else whole(run, p) for p in (lost, *parts))
        return f"A cycle of approach and pull-off loses {loop}" + (
            f": {ways[0]} on the way in, where the contact spreads by itself, and {ways[1]} on the way out, where it "
            "detaches." if all(ways) else ".") + _relaxing_sentence(run, lambda e: whole(run, e))
    text = f"On the approach the drive takes up {energy(-into)}; on the pull-off it gives {energy(out)}."
    if relaxing := _relaxing_sentence(run, energy):
        text += f" Of these works {energy(lost)} are lost at instabilities." + relaxing
    elif abs(lost) < 0.01 * flat:
        text += f" The two agree to {energy(abs(lost))}: hardly any energy is lost."
    else:
        text += f" The difference, {energy(lost)}, is lost (hysteresis): {_loss(run)}."
    if run.number("box.softness") is not None:
        loss = run.number("box.flat_loss")
        text += (" These works, and what is lost, are those of a box of this width, not of the surface: its longest waves jump, however "
                 "smooth the surfaces are" + ("." if loss is None else f", and flat surfaces lose about {energy(loss)} in it."))
    inwards, outwards = (run.number("work_of_interface." + k) for k in ("approach", "pull_off"))
    if inwards is not None and outwards is not None and run.find("dissipated") is None:  # dynamic; quasi-static it is the same work
        text += (f" The interface’s force does the work {energy(inwards)} on the approach and {energy(outwards)} on the "
                 "pull-off (its integral over the mean height); a jump of the block as a whole does not change it.")
    return text


def results(run: Result) -> list[str]:
    """Tells the results of a run in sentences."""
    text: list[str] = []
    flat = run.number("delta_gamma", 0.0)
    state, into, out = (run.number(k) for k in ("binding_energy", "work_of_drive.approach", "work_of_drive.pull_off"))
    if state is not None and flat > 0:
        text.append(_state_sentence(run, state, flat))
    kinds = {name.split()[0] for name in run.segment_names}
    if into is not None and out is not None and flat > 0 and kinds <= {"approach", "hold", "pull-off", "relax"}:
        text.append(_cycle_sentence(run, into, out, flat))
    if (pinning := run.number("jkr.edge_pinning")) is not None:
        text.append("Rows of sites hold the edge of the contact: the pull-off force, and the work of adhesion by "
                    f"JKR from it, are about {pinning:.3g} times too large.")
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


CONVERGED = ("“Solver converged to” says by how much an exact solver could change a number. It is not the error of the number: "
             "`asperity estimate` measures the effect of cutoff, spacing, thickness, width, velocity and surface.")


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
