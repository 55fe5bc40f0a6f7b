# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""`asperity theory SCENE`: the theories of a scene, their profile over magnification, and where adhesion ends."""

from __future__ import annotations

import argparse
import json
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from .. import terminal
from ..arguments import checks_call
from ..errors import Named, SceneError
from ..files import store
from ..running import lock, program
from ..running.scene import Overrides, SceneLike, inputs_of, scene_given
from .options import Command, OfScene, option, out

if TYPE_CHECKING:
    from ..results.names import Theory
    from ..results.result import Values


@dataclass(kw_only=True)
class Options(OfScene):
    """Options of `asperity theory`."""

    out: str | None = out("results/<scene>-theory", terminal=True)
    points: str | None = option("FILE", argparse.SUPPRESS, None)


STATUS = {
    "adhesive": "the surfaces adhere without load",
    "pressed": "only the load keeps the surfaces in contact: bending them into contact costs more energy than the bonds "
               "across the interface give",
    "no contact": "the theory has no adhesive solution: the surfaces separate, and all numbers are zero"}


def _directory(asked: str | None, name: str) -> tuple[Path, list[str]]:
    """Returns the directory of the result, by the rules of the program (io/result_directory.hpp), and the message about it."""
    place = store.chosen(asked, f"results/{name}-theory")
    if not (place / "result.json").exists() and not (place / "run.journal").exists():
        return place, []
    if asked is not None:
        raise SceneError(str(place), "already holds a result, result.json", "results are not written over",
                         "name another directory (--out), or remove this one")
    free = store.numbered(place, lambda one: (one / "result.json").exists())
    return free, [f"{place} already holds a result; this one goes to {free}"]


def _write_profile(out: store.Outputs, columns: list[dict[str, Any]]) -> None:
    import h5py

    with out.replacing("theory.h5") as beside, h5py.File(beside, "w") as file:
        for column in columns:
            made = file.create_dataset(f"profile/{column['name']}", data=column["values"])
            made.attrs["unit"], made.attrs["meaning"] = column["unit"], column["meaning"]


def _units(values: dict[str, Any], path: str) -> dict[str, Any]:
    return {name: _units(value, f"{path}.{name}") if isinstance(value, dict) else
            _units(value[0], f"{path}.{name}[]") if isinstance(value, list) else
            program.quantities().get(f"{path}.{name}", {}).get("unit", "") for name, value in values.items()}


def _text(point: Values) -> str:
    """Returns the printed text."""
    from ..studies.stated_number import cut, with_error

    flat, given = point.number("delta_gamma", 0.0), point.number("theory.persson.delta_gamma", 0.0)
    rms, slope = point.number("theory.persson.h_rms", 0.0), point.number("theory.persson.rms_slope", 0.0)

    def row(words: str, energy: float | None, ratio: float, error: float | None = None) -> list[str]:
        return [words, *(("", "") if energy is None else (f"{energy:#.4g}".rstrip("."), terminal.millijoules(energy))), f"{ratio:.5f}",
                "" if error is None else f"{error:.1e}"]

    def over(energy: float) -> float:
        return energy / given if given else 0.0

    named = point.text("theory.persson.status")
    rows = [row("Δγ, flat on flat" if point.find("scene.theory.delta_gamma") in ("flat", None) else
                "Δγ, as the scene says", given, over(given))]
    for words, key in (("γ_eff", "gamma_eff"), ("γ assuming full contact", "gamma_full_contact"),
                       ("elastic energy U_el", "elastic_energy")):
        value, error = (point.number(f"theory.persson.{key}{end}") for end in ("", "_error"))
        rows.append(row(words, value, over(value or 0.0), None if error is None else over(error)))
    rows.append(row("contact area A/A0", None, point.number("theory.persson.contact_fraction", 0.0),
                    point.number("theory.persson.contact_fraction_error")))
    law = point.part("theory.renormalised")
    if (gamma := law.number("gamma_eff")) is not None:
        rows += [row("renormalised theory: γ_eff", gamma, law.number("gamma_eff_ratio", 0.0),
                     law.number("gamma_eff_error", 0.0) / flat),
                 row("  contact area", None, law.number("contact_fraction", 0.0), law.number("contact_fraction_error"))]
    lines = [f"{point.text('name')}: Persson's theory, Eqs. (1) to (5), rms {rms:.4g} Å, rms slope {slope:.4g}, load "
             f"{point.number('scene.drive.load', 0.0):.6g} MPa", "",
             terminal.table(["", "meV/Å²", "mJ/m²", "over Δγ", "± (numerical)"], rows), ""]
    critical, theta = point.number("theory.persson.critical_rms"), point.number("theory.persson.theta")
    if critical is not None:
        full = point.number("theory.persson.critical_rms_full_contact")
        lines.append(f"  critical rms   {critical:.4g} Å: a rougher surface does not adhere without a load"
                     + (f" (assuming full contact: {full:.4g} Å)" if full is not None else ""))
    if theta is not None:
        lines.append(f"  theta          {theta:.4f} = E* h² q0 / Δγ" + (
            f", {theta * (critical / rms) ** 2:.4f} at the critical rms" if critical is not None and rms else ""))
    if (force := point.number("theory.persson.jkr_pull_off_force")) is not None:
        lines.append(f"  JKR pull-off   {force:.6g} eV/Å with γ_eff, R = {point.number('scene.surface.radius'):.6g} Å")
    lines.append(f"  area factor    {point.text('theory.persson.area_factor')}")
    lines.append(f"  status         {STATUS[named]}")
    if point.find("theory.persson.converged") is False:
        lines.append("                 NOT converged to 1e-3: see the errors in the table")
    if (error := law.number("gamma_eff_expected_error")) is not None:
        ratio, contact = law.number("gamma_eff_ratio", 0.0), law.number("contact_fraction", 0.0)
        touching = with_error(contact, *cut(contact, law.number("contact_fraction_expected_error", 0.0), 0.0, 1.0))
        lines.append(f"  renormalised   γ_eff/Δγ {with_error(ratio, *cut(ratio, error / flat, 0.0, max(ratio, 1.0)))}, contact "
                     f"area {touching}: 19 of 20 simulated surfaces at zero load")
    if gamma is not None:
        place = law.number("separation")
        lines.append("  renormalised   mean separation " + (
            "undefined, for the surfaces do not adhere" if place is None else f"{place:.3f} Å") +
            f", largest tension {law.number('tension', 0.0):.4g} GPa")
    if (spheres := point.part("theory.sphere")) and "maugis_images" in spheres:
        lines.append(f"  smooth sphere  Maugis' λ {spheres['maugis_parameter']:.3g}; pull-off by Maugis and Dugdale "
                     f"{spheres['maugis_images'] / flat:.4f} of JKR's"
                     + (f", {spheres['renormalised'] / flat:.4f} with the renormalised law" if "renormalised" in spheres
                        else ""))
    return "\n".join([*lines, *_sliding(point)])


def _sliding(point: Values) -> list[str]:
    """Returns the printed lines of rubber friction: numbers at drive.velocity, and a table over velocity."""
    sliding = point.part("theory.sliding")
    if (coefficient := sliding.number("friction_coefficient")) is None:
        return []
    beta = point.number("scene.theory.beta", 1.0)
    rows = [[f"{at['velocity']:.4g}", f"{at['friction_coefficient']:.5f}", f"{at['contact_fraction']:.5f}"]
            for at in sliding.listed("curve", dict)[::2]]
    return ["", f"Rubber friction by Persson's theory: hysteresis alone, without adhesion; correction factor S = β + (1-β) P² with "
                f"β = {beta:g} (theory.beta; 1: S = 1)",
            f"  at {point.number('scene.drive.velocity', 0.0):g} m/s       friction coefficient {coefficient:.5f}, contact area "
            f"{sliding.number('contact_fraction', 0.0):.5f}",
            f"  slow sliding   friction coefficient over velocity {sliding.number('slope', 0.0):.5g} s/m",
            *([f"  maximum        {sliding.number('largest_friction_coefficient', 0.0):.5f} at "
               f"{sliding.number('velocity_of_largest', 0.0):.4g} m/s"] if rows else []),
            *(["", terminal.table(["v, m/s", "μ", "A/A0"], rows)] if rows else [])]


class Computed(NamedTuple):
    """Theories of a scene: what result.json holds, the columns over magnification, notes, and the printed text."""

    values: Values
    profile: list[dict[str, Any]]
    notes: list[str]
    text: str


def computed(file: str, overrides: list[str]) -> Computed:
    """Computes the theories of a scene."""
    from ..results.result import Values
    from ..theories import combined

    start = time.monotonic()
    point = combined.points(file, [overrides], profile=True)[0]
    program.complaints([point])
    profile, notes = point.pop("profile"), point.pop("notes")
    text = terminal.folded(_text(Values(point)))
    notes += [Values(point).part("theory." + part).text("note") for part in ("renormalised", "sphere", "sliding")]
    point.pop("flat")
    for key in ("gamma_eff_ratio", "gamma_eff_ratio_error"):
        point["theory"]["persson"].pop(key)
    for part in ("renormalised", "sphere", "sliding"):
        if part in point["theory"]:
            point["units"]["theory"][part] = _units(point["theory"][part], "theory." + part)
    point.setdefault("run", {})["wall_seconds"] = time.monotonic() - start
    return Computed(Values(json.loads(json.dumps(point), object_hook=Values)), profile, [note for note in notes if note], text)


@dataclass
class TheoryOfScene(Named):
    """Theories of a scene: numbers by their names in result.json (energies in meV/Å²), Δγ (meV/Å²), notes, and the text that the
    command prints."""

    name: str
    theory: Theory
    delta_gamma: float
    notes: list[str]
    text: str

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return terminal.html_table(self.name, (), [(name, f"{value:.6g}") for name, value in self.theory.numbers().items()], "; ".join(self.notes))


@checks_call
def theory(scene: SceneLike, overrides: Overrides | None = None) -> TheoryOfScene:
    """Computes the theories of a scene without simulating it.

        found = asperity.theory("scene.toml", {"surface.rms": 2.0})
        found.theory.persson.gamma_eff, found.theory.renormalised.contact_fraction

    Parameters
    ----------
    scene : SceneLike
        Scene file or dictionary.
    overrides : Overrides, optional
        Values of keys in place of the scene's.

    Returns
    -------
    TheoryOfScene
        Numbers of Persson's theory, of the renormalised theory, and of smooth spheres.

    Raises
    ------
    SceneError
        The scene is refused.
    """
    with scene_given(scene, overrides) as given:
        found = computed(*given)
    return TheoryOfScene(found.values.text("name"), cast("Theory", found.values.part("theory")), found.values.number("delta_gamma", 0.0),
                         found.notes, found.text)


def _carry_out(given: Options, voice: terminal.Voice) -> int:
    """Carries out `asperity theory`; with --json it writes files only with --out. Returns the exit code."""
    if given.points is not None:
        raise SceneError("--points", "is no option of theory any more", "it is for programs", "asperity theory-points SCENE --points FILE")
    file = given.scene()
    found = computed(file, given.sets)
    point = found.values
    voice.tell(point)
    if voice.json and given.out is None:
        return 0
    place, said = _directory(given.out, point.text("name"))
    names = ("theory.h5", "result.json")
    with lock.in_use(place), store.outputs(place, names, renew=False, inputs=inputs_of(file, point["scene"])) as written:
        _write_profile(written, found.profile)
        written.write("result.json", store.sealed_json(point))
    voice.show(found.text)
    for note in [*found.notes, *said]:
        voice.say(f"  note: {note}")
    voice.say(f"  written: {place}/result.json, {place}/theory.h5 (the profile over magnification)")
    return 0


COMMAND = Command(Options, _carry_out, progress=False, writes="; writes files only with --out")
