# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The parameters of `asperity cost`: what each is set to and what it is compared with, by rule from the scene.

A parameter is varied alone, all others stay as the scene has them; its own error is that against the same scene with
this one parameter at its best. The error that counts is that against the reference, the best in every parameter at once;
for a target it is the same experiment with the best numerics.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from . import program
from .errors import SceneError
from .pool import Outcome
from .result import Values

Setting = list[str]
"""Keys of the scene and what they are set to: "section.key=value"."""
QUANTITIES = ("gamma", "contact", "approach", "pull-off", "force")
"""What is compared: binding energy at zero load over flat, contact fraction there, works of the two branches over flat,
largest attraction of the pull-off (eV/Å). Flat is that of the same interaction: a cutoff takes adhesion from both."""
# What a setting can be asked for: the relaxed state (the first two quantities), or all of the path too.
ASKED = {"state": 2, "path": len(QUANTITIES)}
NAN = math.nan


@dataclass(eq=False)
class Row:
    """A setting to run (own: the part of it that is the parameter's value) and what came of it."""

    parameter: str  # its name, or "reference", "scene", "combination"
    label: str
    setting: Setting
    own: Setting = field(default_factory=list)
    compared: bool = True  # its error is one of settings: not the reference, not another solid
    outcome: Outcome = field(default_factory=Outcome)
    numbers: np.ndarray = field(default_factory=lambda: np.full(len(QUANTITIES), NAN))
    error: dict[str, float] = field(default_factory=lambda: dict.fromkeys(ASKED, NAN))
    front: dict[str, bool] = field(default_factory=lambda: dict.fromkeys(ASKED, False))
    seconds: float = NAN  # of the processor


class Parameter(NamedTuple):
    """rows: from coarse to fine; the last is what own errors are taken against (exact: nothing of the parameter's error is
    left there, it may be chosen too). part: parameters of one part exclude each other in a combination; "": never in one.
    moved: without effect on the scene as it is, its runs are without time."""

    name: str
    rows: list[Row]
    part: str
    exact: bool
    moved: bool


class Base(NamedTuple):
    """Where a combination starts: how the path is followed ("": as the scene says), the parts that matter, what it answers."""
    label: str
    setting: Setting
    parts: list[str]
    question: str = "path"


class CostCase(NamedTuple):
    reference: Setting
    reference_text: str
    parameters: list[Parameter]
    bases: list[Base]


def joined(first: Setting, then: Setting) -> Setting:
    """Later settings of a key take the place of earlier ones."""
    later = {one.partition("=")[0] for one in then}
    return [one for one in first if one.partition("=")[0] not in later] + then


def _refuse(scene: Values, same_experiment: bool) -> None:
    problems = [{"where": "", "what": f"{key} = {scene.find(key)}", "why": why, "fix": fix} for key, wrong, why, fix in (
        ("drive.temperature", scene.number("drive.temperature"), "differences between runs would be those of their noise",
         "measure the same scene at 0 K"),
        ("drive.max_steps", scene.number("drive.max_steps"), "runs that are cut off cannot be compared", "leave it out"),
        ("block.strain", scene.text("block.strain") == "finite" and not same_experiment,
         "errors are measured against the path without time, and there is none at finite strain",
         "measure the same scene at small strain, or with --target")) if wrong]
    if problems:
        raise SceneError.of(problems)


def _chosen(parameters: list[Parameter], names: list[str] | None) -> list[Parameter]:
    there = [parameter.name for parameter in parameters]
    for name in names or []:
        if name not in there:
            raise SceneError(f"--parameters {name}", "is none of them", "this scene has " + ", ".join(there),
                             "name some of these, or leave --parameters out for all of them")
    return [parameter for parameter in parameters if not names or parameter.name in names]


def cost_case(keys: dict[str, Any], longest_timestep: float, names: list[str] | None = None,
              same_experiment: bool = False) -> CostCase:
    """keys: the scene as it is used; longest_timestep: its stability limit, fs; names: of the parameters, none: all;
    same_experiment: those of the numerics, and the reference is the scene with these at their best. Raises SceneError."""
    scene = Values(keys)
    _refuse(scene, same_experiment)
    path = scene.find("drive.path")
    dynamic = scene.text("drive.mode") == "dynamic" and "zero-load" not in path
    moves = "approach" in path or "pull-off" in path
    at_rest = ["drive.mode=quasistatic"]
    parameters: list[Parameter] = []

    def own(key: str) -> float:
        return scene.number(key, 0.0)

    def worded(key: str, v: float) -> str:
        return f"{v:.6g} {program.schema()[key].get('unit') or 'layers' * (key == 'block.thickness')}".strip()

    def at(key: str, *values: float) -> list[tuple[str, Setting]]:
        return [(worded(key, v), [f"{key}={v:.6g}"]) for v in values]

    def scaled(key: str, *factors: float) -> list[tuple[str, Setting]]:
        return at(key, *(f * own(key) for f in factors))

    def cut(tail: bool, *cutoffs: float) -> list[tuple[str, Setting]]:
        return [(label + " + tail" * tail, [*setting, f"interface.tail={str(tail).lower()}"])
                for label, setting in at("interface.cutoff", *cutoffs)]

    def vary(name: str, values: list[tuple[str, Setting]], part: str = "", exact: bool = False, moved: bool = False) -> None:
        rows = [Row(name, label, joined(at_rest if moved else [], setting), setting, name != "thickness")
                for label, setting in values]
        parameters.append(Parameter(name, rows, part, exact, moved))

    # Of potentials that have a tail: the key of their length.
    lengths = {"lennard-jones": "interface.r0", "morse": "interface.morse_r0"}
    length = own(lengths.get(scene.text("interface.potential"), ""))
    widest = min(8 * length, 0.5 * own("surface.sites") * own("surface.spacing"))
    tolerance, step = 0.1 * own("drive.tolerance"), 0.5 * own("drive.step")
    mixed = (scene.text("interface.kind") == "atoms" and scene.text("surface.kind") != "atoms"
             and own("surface.lattice_ratio") == 1 and scene.text("interface.potential") != "table")
    reference = ["numerics.precision=double", f"drive.tolerance={tolerance:.6g}"]
    if length:
        reference += ["interface.tail=true", f"interface.cutoff={widest:.6g}"]
        cutoffs = [f * length for f in (2, 2.5, 3, 4, 6) if f * length < widest]
        vary("cutoff", cut(False, *cutoffs) + cut(True, widest), "interaction", True)
        vary("tail", cut(True, *(c for c in cutoffs if c <= 4 * length), widest), "interaction", True)
    if moves:
        reference += [*at_rest, f"drive.step={step:.6g}"]
    text = ("without time, " + f"no inertia (velocity to 0), steps of {step:.6g} Å, " * moves
            + f"cutoff {widest:.6g} Å and tail, " * bool(length) + f"double precision, tolerance {worded('drive.tolerance', tolerance)}")
    if dynamic:
        vary("layers", [*((f"{m} a level", [f"block.layers_per_level={m}", "block.model=multiscale"]) for m in (2, 3, 4, 6, 8)),
                        ("lattice", ["block.model=lattice"])], "block", True)
    thick = int(own("block.thickness"))
    vary("thickness", at("block.thickness", *filter(None, (thick // 4, thick // 2, thick, 2 * thick, 8 * thick))))
    if mixed:  # pairs over a lattice
        vary("precision", [(word, ["numerics.precision=" + word]) for word in ("mixed", "double")], "precision", True)
    if dynamic:
        stable = [f for f in (6, 5, 4, 3, 2, 1) if f * own("drive.timestep") < 0.9 * longest_timestep]
        vary("timestep", scaled("drive.timestep", *stable, 0.5), "timestep")
        vary("velocity", [*scaled("drive.velocity", 4, 2, 1, 0.5, 0.25), ("quasi-static", at_rest)], "velocity", True)
        if own("drive.damping") > 0:
            vary("damping", scaled("drive.damping", 4, 2, 1, 0.5, 0.125))
    vary("tolerance", scaled("drive.tolerance", 100, 10, 1, 0.1), "tolerance", moved=dynamic)
    if moves:
        vary("step", scaled("drive.step", 4, 2, 1, 0.5, 0.25), "step", moved=dynamic)
        vary("model", [("lattice, in time", ["block.model=lattice"])] * dynamic
             + [("quasi-static", at_rest), ("zero load alone", ["drive.path=zero-load"])])

    if same_experiment:
        parameters = _chosen([k for k in parameters if k.part not in ("", "interaction", "velocity") and not k.moved], names)
        best = [k.rows[-1] for k in parameters]
        return CostCase([key for one in best for key in one.own], "the scene with " + ", ".join(one.label for one in best),
                        parameters, [Base("", [], [k.part for k in parameters], "path" if moves else "state")])
    bases = [Base("in time", [], ["interaction", "block", "precision", "timestep", "velocity"])] * dynamic
    bases += [Base("quasi-static", at_rest, ["interaction", "precision", "tolerance", "step"])] * moves
    bases.append(Base("zero load alone", ["drive.path=zero-load"], ["interaction", "precision", "tolerance"], "state"))
    return CostCase(reference, text, _chosen(parameters, names), bases)
