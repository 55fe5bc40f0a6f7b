# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The parameters of `asperity cost`: what each is set to and what it is compared with, by rule from the scene.

A parameter is varied alone, all others stay as the scene has them; its own error is that against the same scene with
this one parameter at its best. The error that counts is that against the reference, the best in every parameter at once;
for a target it is the same experiment with the best numerics.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ..results.result import Values
from ..running.pool import DONE, Outcome
from .quantities import grain_of, number_of
from .variations import AT_REST, NAN, Choice, Setting, Study, Variation, Variations, joined

QUANTITIES = {"gamma": "binding_energy", "contact": "contact_fraction", "approach": "work_of_drive.approach",
              "pull-off": "work_of_drive.pull_off", "force": "pull_off_force"}
"""Quantities that are compared, and their paths in result.json. Energies are compared over those of flat surfaces with the same
interaction: a cutoff takes adhesion from both."""
# What a setting can be asked for: the relaxed state (the first two quantities), or all of the path too.
ASKED = {"state": 2, "path": len(QUANTITIES)}


def _scales(result: Values) -> np.ndarray:
    flat = result.number("delta_gamma", NAN) or NAN
    return np.array([1.0 if path in ("contact_fraction", "pull_off_force") else flat for path in QUANTITIES.values()])


def numbers_of(result: Values) -> np.ndarray:
    """Returns one number for each quantity; NaN if there is none."""
    return np.array([number_of(result, path) for path in QUANTITIES.values()]) / _scales(result)


def grains_of(result: Values) -> np.ndarray:
    """Returns the least error of each number of numbers_of()."""
    return np.array([grain_of(result, path, number_of(result, path)) for path in QUANTITIES.values()]) / _scales(result)


@dataclass(eq=False)
class Row(Variation):
    """A setting to run (own: the part of it that is the parameter's value) and what came of it."""

    # Of `parameter`: its name, or "reference", "scene", "combination".
    own: Setting = field(default_factory=list)
    compared: bool = True  # its error is one of settings: not the reference, not another solid
    numbers: np.ndarray = field(default_factory=lambda: np.full(len(QUANTITIES), NAN))
    grains: np.ndarray = field(default_factory=lambda: np.zeros(len(QUANTITIES)))
    error: dict[str, float] = field(default_factory=lambda: dict.fromkeys(ASKED, NAN))
    front: dict[str, bool] = field(default_factory=lambda: dict.fromkeys(ASKED, False))

    def take(self, outcome: Outcome) -> None:
        """Takes the outcome of the run, and its numbers if the run is done."""
        super().take(outcome)
        if outcome.status == DONE:
            self.numbers, self.grains = numbers_of(outcome.result), grains_of(outcome.result)


class Parameter(NamedTuple):
    """rows: from coarse to fine; the last is what own errors are taken against (exact: nothing of the parameter's error is
    left there, it may be chosen too). part: parameters of one part exclude each other in a combination; "": never in one.
    moved: without effect on the scene as it is, its runs are quasi-static."""

    name: str
    rows: list[Row]
    part: str
    exact: bool
    moved: bool


class Base(NamedTuple):
    """Starting point of a combination: how the path is followed ("": as the scene says), the parts that matter, the question
    that it answers."""
    label: str
    setting: Setting
    parts: list[str]
    question: str = "path"


class CostCase(NamedTuple):
    """Reference of a scene, parameters that are varied, and starting points of combinations."""

    reference: Setting
    reference_text: str
    parameters: list[Parameter]
    bases: list[Base]


def _chosen(parameters: list[Parameter], names: list[str]) -> list[Parameter]:
    Study.require_known(names, parameters, "--parameters")
    return [parameter for parameter in parameters if not names or parameter.name in names]


def cost_case(scene: Variations, names: list[str], same_experiment: bool) -> CostCase:
    """Makes the case of a scene. Raises SceneError."""
    if not same_experiment:
        scene.refuse_finite_strain("measure the same scene at small strain, or with --target")
    own, dynamic, moves, length = scene.own, scene.dynamic, scene.moves, scene.length
    parameters: list[Parameter] = []

    def vary(name: str, values: list[Choice], part: str = "", exact: bool = False, moved: bool = False) -> None:
        rows = [Row(name, label, joined(AT_REST if moved else [], setting), setting, name != "thickness")
                for label, setting in values]
        parameters.append(Parameter(name, rows, part, exact, moved))

    widest = min(8 * length, 0.5 * scene.edge)
    tolerance, step = 0.1 * own("drive.tolerance"), 0.5 * own("drive.displacement_step")
    reference = ["numerics.precision=double", f"drive.tolerance={tolerance:.6g}"]
    if length:
        reference += ["interface.tail=true", f"interface.cutoff={widest:.6g}"]
        cutoffs = [f * length for f in (2, 2.5, 3, 4, 6) if f * length < widest]
        vary("cutoff", scene.cut(False, *cutoffs) + scene.cut(True, widest), "interaction", True)
        vary("tail", scene.cut(True, *(c for c in cutoffs if c <= 4 * length), widest), "interaction", True)
    if moves:
        reference += [*AT_REST, f"drive.displacement_step={step:.6g}"]
    text = ("quasi-static, " + f"no inertia (velocity to 0), steps of {step:.6g} Å, " * moves
            + f"cutoff {widest:.6g} Å and tail, " * bool(length)
            + f"double precision, tolerance {scene.worded('drive.tolerance', tolerance)}")
    if dynamic:
        vary("layers", scene.layers(2, 3, 4, 6, 8) + scene.lattice, "block", True)
    thick = scene.thickness
    vary("thickness", scene.at("block.thickness", *filter(None, (thick // 4, thick // 2, thick, 2 * thick, 8 * thick))))
    if scene.continuous and not dynamic and scene.scene.text("surface.kind") in ("flat", "self-affine"):
        finest = 0.25 if scene.sites <= 128 else 0.5
        reference += [*scene.spaced(finest), "block.model=continuum"]
        text += f", spacing {scene.worded('surface.spacing', finest * own('surface.spacing'))} of a continuum"
        vary("spacing", scene.meshes(2, 1, 0.5))
    if scene.mixed:  # pairs over a lattice
        vary("precision", scene.precisions("mixed", "double"), "precision", True)
    if dynamic:
        vary("timestep", scene.stable(6, 5, 4, 3, 2, 1) + scene.scaled("drive.timestep", 0.5), "timestep")
        vary("velocity", [*scene.scaled("drive.velocity", 4, 2, 1, 0.5, 0.25), ("quasi-static", AT_REST)], "velocity", True)
        if own("drive.damping") > 0:
            vary("damping", scene.scaled("drive.damping", 4, 2, 1, 0.5, 0.125))
    vary("tolerance", scene.scaled("drive.tolerance", 100, 10, 1, 0.1), "tolerance", moved=dynamic)
    if moves:
        vary("step", scene.scaled("drive.displacement_step", 4, 2, 1, 0.5, 0.25), "step", moved=dynamic)
        vary("model", [("lattice, dynamic", ["block.model=lattice"])] * dynamic
             + [("quasi-static", AT_REST), ("zero load alone", ["drive.path=relax"])])

    if same_experiment:
        parameters = _chosen([k for k in parameters if k.part not in ("", "interaction", "velocity") and not k.moved], names)
        best = [k.rows[-1] for k in parameters]
        return CostCase([key for one in best for key in one.own], "the scene with " + ", ".join(one.label for one in best),
                        parameters, [Base("", [], [k.part for k in parameters], "path" if moves else "state")])
    bases = [Base("dynamic", [], ["interaction", "block", "precision", "timestep", "velocity"])] * dynamic
    bases += [Base("quasi-static", AT_REST, ["interaction", "precision", "tolerance", "step"])] * moves
    bases.append(Base("zero load alone", ["drive.path=relax"], ["interaction", "precision", "tolerance"], "state"))
    return CostCase(reference, text, _chosen(parameters, names), bases)
