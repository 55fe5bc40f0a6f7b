# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The parameters of `asperity cost`: what each is set to, what it is compared with, what its error should do.

All of it follows by rule from the scene, before anything has run. A parameter is varied alone, all others stay as
the scene has them; its own error is that against the same scene with this one parameter at its best (`reference`). The
error that counts in the end is that against the reference, which is the best in every parameter at once; for a
target it is the same experiment with the best numerics.
"""

from __future__ import annotations

import difflib
import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from .errors import SceneError
from .pool import Outcome
from .result import Values

Setting = list[str]
"""Keys of the scene and what they are set to: "section.key=value"."""
QUANTITIES = ("gamma", "contact", "approach", "pull-off", "force")
"""What is compared: binding energy at zero load over flat, contact fraction there, works of the two branches over flat,
largest attraction of the pull-off (eV/Å). Energies are compared over the flat reference of the same interaction, so
that a cutoff is not blamed for the adhesion that it takes from both."""
ASKED = {"state": 2, "path": len(QUANTITIES)}
"""What a setting can be asked for: the relaxed state (the first two quantities), or all of the path too."""
NAN = math.nan
NUMERICS = ("block", "precision", "timestep", "tolerance", "step")
"""Parts that change no experiment: what a target may choose."""


class Value(NamedTuple):
    label: str
    setting: Setting
    x: float = 0.0
    """for the order of the error; 0: none"""


def nothing() -> np.ndarray:
    return np.full(len(QUANTITIES), NAN)


@dataclass(eq=False)
class Row:
    """A setting to run and what came of it. parameter: its name, or "reference", "scene", "combination"."""

    parameter: str
    label: str
    setting: Setting
    """in full"""
    own: Setting
    """the part of it that is the parameter's value"""
    x: float = 0.0
    compared: bool = True
    """its error is one of settings: not the reference, not another solid"""
    outcome: Outcome = field(default_factory=Outcome)
    numbers: np.ndarray = field(default_factory=nothing)
    own_error: np.ndarray = field(default_factory=nothing)
    error: dict[str, float] = field(default_factory=lambda: dict.fromkeys(ASKED, NAN))
    front: dict[str, bool] = field(default_factory=lambda: dict.fromkeys(ASKED, False))
    seconds: float = NAN
    """of the processor"""
    wall: float = NAN
    added: float = NAN
    """of a combination: the sum of its own errors"""

    @property
    def text(self) -> str:
        """The setting as a user would give it."""
        return "--set " + " ".join(self.setting) if self.setting else "the scene as it is"


@dataclass
class Parameter:
    name: str
    rows: list[Row]
    """from coarse to fine"""
    reference: Row | None
    """the last of them, what they are compared with; None: with the reference alone"""
    expected: str
    """order of its error in x, in words"""
    part: str = ""
    """parameters of one part exclude each other in a combination; "": never in one"""
    order: float | None = None
    reference_is_exact: bool = False
    """nothing of the parameter's error is left in its reference: it may be chosen too"""
    without_effect: bool = False
    """on the scene as it is: its runs have a base of their own"""


@dataclass
class Base:
    """Where a combination starts: how the path is followed, and the parts that matter there."""

    label: str
    """"": as the scene says"""
    setting: Setting
    parts: list[str]
    question: str = "path"
    """what it answers: the state at zero load, or all of the path too"""


@dataclass
class CostCase:
    reference: Setting
    reference_text: str
    parameters: list[Parameter]
    bases: list[Base]
    notes: list[str]


def joined(first: Setting, then: Setting) -> Setting:
    """Later settings of a key take the place of earlier ones."""
    later = {one.partition("=")[0] for one in then}
    return [one for one in first if one.partition("=")[0] not in later] + then


def _value(key: str, v: float, unit: str) -> Value:
    return Value(f"{v:.6g} {unit}".strip(), [f"{key}={v:.6g}"], v)


def _refuse(scene: Values, same_experiment: bool) -> None:
    problems = []
    for key, shown, why, fix in (
            ("drive.temperature", "{:.6g} K", "differences between runs would be those of their noise",
             "measure the same scene at 0 K"),
            ("drive.max_steps", "{:.0f}", "runs that are cut off cannot be compared", "leave it out")):
        value = scene.number(key)
        if value:
            problems.append({"where": "", "what": f"{key} = {shown.format(value)}", "why": why, "fix": fix})
    if scene.text("block.strain") == "finite" and not same_experiment:
        problems.append({"where": "", "what": 'block.strain = "finite"',
                         "why": "errors are measured against the path without time, and there is none at finite strain",
                         "fix": "measure the same scene at small strain, or with --target"})
    if problems:
        raise SceneError.of(problems)


def _chosen(parameters: list[Parameter], names: list[str]) -> list[Parameter]:
    there = [parameter.name for parameter in parameters]
    for name in names:
        if name not in there:
            near = difflib.get_close_matches(name, there, 1)
            raise SceneError(f"--parameters {name}", "is none of the parameters", "parameters: " + ", ".join(there),
                             f"did you mean {near[0]}?" if near else "leave --parameters out for all of them")
    return [parameter for parameter in parameters if not names or parameter.name in names]


_LENGTHS = {"lennard-jones": "interface.r0", "morse": "interface.morse_r0"}
"""of potentials that have a tail: the key of their length"""


def cost_case(keys: dict[str, Any], longest_timestep: float, names: list[str] | None = None,
              same_experiment: bool = False) -> CostCase:
    """keys: the scene as it is used; longest_timestep: its stability limit, fs; names: of the parameters, none: all.

    same_experiment: only parameters of the numerics, and the reference is the scene with these at their best.
    Raises SceneError.
    """
    scene = Values(keys)
    _refuse(scene, same_experiment)

    def own(key: str) -> float:
        return scene.number(key, 0.0)

    path = scene.find("drive.path")
    dynamic = scene.text("drive.mode") == "dynamic" and "zero-load" not in path
    moves = "approach" in path or "pull-off" in path
    at_rest = ["drive.mode=quasistatic"]
    tolerance, step = own("drive.tolerance"), own("drive.step")
    length = own(_LENGTHS.get(scene.text("interface.potential"), ""))
    widest = min(8 * length, 0.5 * own("surface.sites") * own("surface.spacing"))

    reference = ["numerics.precision=double", f"drive.tolerance={0.1 * tolerance:.6g}"]
    if length:
        reference += ["interface.tail=true", f"interface.cutoff={widest:.6g}"]
    path_text = ""
    if moves:
        reference += [*at_rest, f"drive.step={0.5 * step:.6g}"]
        path_text = f"no inertia (velocity to 0), steps of {0.5 * step:.6g} Å, "
    reach = f"cutoff {widest:.6g} Å and tail, " if length else ""
    text = (f"without time, {path_text}{reach}double precision, "
            f"tolerance {0.1 * tolerance:.6g} eV/Å")

    def scaled(key: str, unit: str, *factors: float) -> list[Value]:
        return [_value(key, f * own(key), unit) for f in factors]

    def with_tail(value: Value, tail: bool) -> Value:
        return Value(value.label + " + tail" * tail, [*value.setting, f"interface.tail={str(tail).lower()}"], value.x)

    parameters: list[Parameter] = []

    def vary(name: str, values: list[Value], best: Value | None, expected: str, part: str = "",
             order: float | None = None, exact: bool = False, base: Setting | None = None) -> None:
        rows = [Row(name, label, joined(base or [], setting), setting, x, compared=name != "thickness")
                for label, setting, x in [*values, *([best] if best else [])]]
        parameters.append(Parameter(name, rows, rows[-1] if best else None, expected, part, order, exact, bool(base)))

    if length:
        cutoffs = [_value("interface.cutoff", f * length, "Å") for f in (2, 2.5, 3, 4, 6) if f * length < widest]
        finest = with_tail(_value("interface.cutoff", widest, "Å"), True)
        fades = scene.text("interface.potential") == "lennard-jones"
        vary("cutoff", [with_tail(v, False) for v in cutoffs], finest,
             "-4: adhesion of what is beyond" if fades else "exponential", "interaction", -4.0 if fades else None, True)
        vary("tail", [with_tail(v, True) for v in cutoffs if v.x <= 4.0 * length], finest,
             "steeper than -4" if fades else "exponential", "interaction", None, True)
    if dynamic:
        vary("layers", [Value(f"{m} a level", [f"block.layers_per_level={m}", "block.model=multiscale"], m)
                        for m in (2, 3, 4, 6, 8)], Value("lattice", ["block.model=lattice"]),
             "about -2 (docs/explanation/model.md: stiffness of waves)", "block", -2.0, True)
    layers = int(own("block.thickness"))
    thicknesses = [_value("block.thickness", t, "layers")
                   for t in (layers // 4, layers // 2, layers, 2 * layers, 8 * layers) if t]
    vary("thickness", thicknesses[:-1], thicknesses[-1], "none: another solid")
    mixed, double = (Value(word, ["numerics.precision=" + word]) for word in ("mixed", "double"))
    vary("precision", [mixed], double, "none: rounding", "precision", None, True)
    notes = []
    if dynamic:
        vary("timestep", [v for v in scaled("drive.timestep", "fs", 6, 5, 4, 3, 2, 1) if v.x < 0.9 * longest_timestep],
             *scaled("drive.timestep", "fs", 0.5), "2 (velocity Verlet)", "timestep", 2.0)
        vary("velocity", scaled("drive.velocity", "m/s", 4, 2, 1, 0.5, 0.25), Value("quasi-static", at_rest),
             "1: drag and waves; state: none", "velocity", 1.0, True)
        if own("drive.damping") > 0:
            vary("damping", scaled("drive.damping", "1/ps", 4, 2, 1, 0.5), *scaled("drive.damping", "1/ps", 0.125),
                 "1 while weak; state: none", "", 1.0)
        else:
            notes.append("drive.damping = 0: there is none to vary")
    still = at_rest if dynamic else []
    vary("tolerance", scaled("drive.tolerance", "eV/Å", 100, 10, 1), *scaled("drive.tolerance", "eV/Å", 0.1),
         "up to 2: a minimum is flat", "tolerance", None, False, still)
    if moves:
        vary("step", scaled("drive.step", "Å", 4, 2, 1, 0.5), *scaled("drive.step", "Å", 0.25),
             "none: steps are cut where needed", "step", None, False, still)
    models = [Value("lattice, in time", ["block.model=lattice"])] if dynamic else []
    if moves:
        models += [Value("quasi-static", at_rest), Value("zero load alone", ["drive.path=zero-load"])]
        vary("model", models, None, "")

    if same_experiment:
        parameters = _chosen([k for k in parameters if k.part in NUMERICS and not k.without_effect], names or [])
        best = [k.reference for k in parameters if k.reference]
        return CostCase([key for one in best for key in one.own],
                        "the scene with " + ", ".join(one.label for one in best), parameters,
                        [Base("", [], [k.part for k in parameters], "path" if moves else "state")], [])
    bases = []
    if dynamic:
        bases.append(Base("in time", [], ["interaction", "block", "precision", "timestep", "velocity"]))
    if moves:
        bases.append(Base("quasi-static", at_rest, ["interaction", "precision", "tolerance", "step"]))
    bases.append(Base("zero load alone", ["drive.path=zero-load"], ["interaction", "precision", "tolerance"], "state"))
    return CostCase(reference, text, _chosen(parameters, names or []), bases, notes)
