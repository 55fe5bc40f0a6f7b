# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The theories of scenes and runs: Persson's theory of adhesion (computed by the program), the renormalised theory, smooth spheres
and rubber friction.

Numbers have the names and units of `theory` in result.json: `renormalised`; `sphere` for a curved scene; `sliding` for a sliding
viscoelastic block.
"""

from __future__ import annotations

import json
import math
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import Error
from ..results.result import Result, Values
from ..running import program, scene
from ..units import ANGSTROM_PER_PS, GIGAPASCAL, MEGAPASCAL
from .sphere import Sphere

COMPARED_SLOPE = 0.6
"""The steepest roughness at which the renormalised theory was held against simulations."""
_known: dict[str, dict[str, Any]] = {}


def renormalised(rough: dict[str, Any], quick: bool = False) -> dict[str, Any]:
    """Computes the renormalised theory of a scene; results are cached.

    Parameters
    ----------
    rough : dict[str, Any]
        Input of the theory, from theory_points().
    quick : bool
        True: accurate to about 1e-3, without expected errors, for curves.

    Returns
    -------
    dict[str, Any]
        The object theory.renormalised of result.json.
    """
    key = json.dumps([quick, rough])
    if key not in _known:
        _known[key] = _renormalised(rough, quick)
    return dict(_known[key])


def _renormalised(rough: dict[str, Any], quick: bool) -> dict[str, Any]:
    from . import renormalised as theory  # scipy

    try:
        found = theory.state(rough, quick)
    except theory.NoSolution as error:
        return {"note": f"renormalised theory: {error}"}
    depth = 1e3 * found.depth
    numbers = {"gamma_eff": depth * found.ratio, "gamma_eff_ratio": found.ratio, "contact_fraction": found.contact}
    if found.ratio > 1e-9 or rough["pressure"] > 0:  # below, the potential is rounding, and its minimum anywhere
        numbers["separation"] = found.separation
    numbers |= {"tension": found.tension / GIGAPASCAL, "gamma_eff_error": depth * found.ratio_error,
                "contact_fraction_error": found.contact_error}
    if quick:
        return numbers
    notes = []
    if max(found.ratio_error / max(1.0, abs(found.ratio)), found.contact_error) > theory.TOLERANCE:
        notes.append(f"known to {found.ratio_error:.1e} of the work of adhesion and {found.contact_error:.1e} of the "
                     "contact only, on the finest grid that is tried")
    if rough["pressure"] == 0:
        ratio, contact = theory.expected_error(found, rough)
        numbers |= {"gamma_eff_expected_error": depth * ratio, "contact_fraction_expected_error": contact}
    if (slope := math.sqrt(theory.Spectrum(rough["spectrum"], rough["q_L"]).slopes)) > COMPARED_SLOPE:
        notes.append("it is of second order in the slope, and its expected error is calibrated up to an rms slope of "
                     f"{COMPARED_SLOPE}; here it is {slope:.2f}")
    return {**numbers, "note": "renormalised theory: " + "; ".join(notes)} if notes else numbers


def _modulus(keys: Values) -> float:
    """Returns E* of the solids of a scene, eV/Å³: 1/E* is the sum of those of the block and of an elastic second solid."""
    def of(young: str, poisson: str) -> float:
        return keys.number(young, 0.0) * GIGAPASCAL / (1 - keys.number(poisson, 0.0) ** 2)

    own, counter = of("block.young", "block.poisson"), 0.0
    if keys.text("surface.counter") not in ("", "none"):
        counter = of("surface.counter_young", "surface.counter_poisson")
    return own * counter / (own + counter) if counter > 0 else own


def _spheres(point: Values) -> tuple[Any, float, Any, float]:
    """Returns the smooth sphere of a point and the largest tension of its interface, and both with the renormalised law (None
    without adhesion), in eV and Å."""
    keys = point.part("scene")
    modulus = _modulus(keys)
    edge = keys.number("surface.sites", 0.0) * keys.number("surface.spacing", 0.0)
    smooth = Sphere(keys.number("surface.radius", 0.0), modulus, point.number("delta_gamma", 0.0) / 1e3, edge,
                    point.number("flat.separation", 0.0))
    law = point.part("theory.renormalised")
    tension, gamma = law.number("tension", 0.0) * GIGAPASCAL, law.number("gamma_eff", 0.0) / 1e3
    rough = smooth._replace(work=gamma, separation=law.number("separation", smooth.separation))
    return smooth, point.number("flat.tension", 0.0) * GIGAPASCAL, rough if gamma > 0 and tension > 0 else None, tension


def _sphere(point: Values) -> dict[str, Any]:
    """Returns `theory.sphere`: pull-off forces of smooth spheres, as works of adhesion by JKR."""
    smooth, stress, rough, tension = _spheres(point)
    if not (smooth.work > 0 and stress > 0):
        return {}
    numbers = {"maugis_parameter": smooth.parameter(stress), "jkr_images": 1e3 * smooth.pull_off(),
               "maugis_images": 1e3 * smooth.pull_off(stress)}
    if rough is not None:
        numbers |= {"renormalised": 1e3 * rough.pull_off(tension), "renormalised_parameter": rough.parameter(tension)}
    if all(math.isfinite(value) for value in numbers.values()):
        return {name: float(value) for name, value in numbers.items()}
    return {"note": "the images flatten the sphere: the contact is as wide as the box; use a larger box"}


def _slides(point: Values) -> bool:
    """Returns True if a viscoelastic block slides in a scene."""
    path = point.part("scene").listed("drive.path", str)
    return bool(point.find("scene.block.prony")) and any(segment.startswith("slide") for segment in path)


def _sliding(point: Values, rough: dict[str, Any], curve: bool) -> dict[str, Any]:
    """Returns `theory.sliding`. curve: True includes the theory over velocity."""
    from . import viscoelastic

    if not rough["pressure"] > 0:
        return {"note": "the theory of rubber friction is of surfaces under a pressure: give drive.load a value above 0"}
    keys = point.part("scene")
    modulus = _modulus(keys)
    rubber = viscoelastic.Rubber(rough["spectrum"], [(r, tau) for r, tau in keys.listed("block.prony", list)], modulus,
                                 rough["pressure"], keys.number("theory.beta", 1.0))
    here = viscoelastic.friction(rubber, keys.number("drive.velocity", 0.0) * ANGSTROM_PER_PS)
    coefficient = float(here.coefficient[0])
    found: dict[str, Any] = {"friction_coefficient": coefficient,
                             "friction_stress": coefficient * rough["pressure"] / MEGAPASCAL,
                             "contact_fraction": float(here.area[0]), "slope": viscoelastic.slope(rubber) * ANGSTROM_PER_PS}
    speeds = viscoelastic.velocities(rubber)
    if curve and len(speeds):
        over = viscoelastic.friction(rubber, speeds)
        most, at = viscoelastic.largest(rubber, speeds[int(np.argmax(over.coefficient))])
        found |= {"largest_friction_coefficient": most, "velocity_of_largest": at / ANGSTROM_PER_PS,
                  "curve": [dict(zip(("velocity", "friction_coefficient", "contact_fraction"), map(float, numbers)))
                            for numbers in zip(speeds / ANGSTROM_PER_PS, *over)]}
    return found


def points(file: str, variations: list[list[str]], runnable: bool = False, profile: bool = False,
           quick: bool = False) -> list[dict]:
    """Computes the theories of many variations of a scene.

    Parameters
    ----------
    file : str
        Scene file.
    variations : list[list[str]]
        Overrides of each variation.
    runnable : bool
        True: includes the problems that would prevent a run.
    profile : bool
        True: includes the theory at all magnifications.
    quick : bool
        True: for a curve.

    Returns
    -------
    list[dict]
        An object for each variation, as from program.theory_points().
    """
    found = program.theory_points(file, variations, runnable, profile)
    for point in found:
        if (rough := point.pop("rough", None)) is not None:
            point["theory"]["renormalised"] = found_of_it = renormalised(rough, quick)
            if "contact_fraction_expected_error" in found_of_it:  # contacts are counted: one site at least
                sites = Values(point).number("scene.surface.sites", 1.0)
                found_of_it["contact_fraction_expected_error"] = max(found_of_it["contact_fraction_expected_error"], 1.0 / sites**2)
            if Values(point).number("scene.surface.radius"):
                point["theory"]["sphere"] = _sphere(Values(point))
            elif _slides(Values(point)):
                point["theory"]["sliding"] = _sliding(Values(point), rough, profile)
    return found


def variations_of(run: Result, variations: list[dict[str, Any]], quick: bool = False) -> list[Values]:
    """Computes the theories of a run's scene with some keys changed.

    Parameters
    ----------
    run : Result
        Result of the run.
    variations : list[dict[str, Any]]
        Changed keys of each variation, with their values.
    quick : bool
        True: for a curve.

    Returns
    -------
    list[Values]
        The theories; [] if there are none.
    """
    if not run.part("scene"):
        return []
    overrides: dict[str, Any] = {}
    try:
        with scene.scene_file({**run.find("scene"), "name": "scene"}) as file, tempfile.TemporaryDirectory() as place:
            if run.key("surface.kind") == "file":
                # As run.h5 holds it: the map that it was made from may be gone.
                if not run.substrate or run.curved:
                    return []
                overrides = {"surface.file": f"{place}/heights.npy", "surface.file_size": run.edge,
                             "surface.detrend": "none", "surface.line_noise": "keep", "surface.resample": "none", "surface.file_unit": "Å"}
                np.save(Path(place) / "heights.npy", run.substrate.height)
            found = points(file, [scene.assignments({**overrides, **one}) for one in variations], quick=quick)
    except Error:  # a scene that this version refuses, or no program beside the package
        return []
    return [Values(point) for point in found]


def of_run(run: Result) -> Values:
    """Returns the theories of the scene of a run (`theory`, `flat`), computed in the first call."""
    cached = run.__dict__
    if "_theories" not in cached:
        found = variations_of(run, [{}]) if run.part("theory") else []
        cached["_theories"] = found[0] if found and "theory" in found[0] else Values()
    return cached["_theories"]


def complete(run: Result) -> None:
    """Adds the numbers that result.json lacks to the `theory` of a run."""
    found = of_run(run)
    for name in ("renormalised", "sphere", "sliding"):
        if found.part("theory." + name):
            run["theory"].setdefault(name, found.part("theory." + name))


def sphere_curves(run: Result, largest_force: float) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Computes curves of smooth spheres for a curved scene, up to the contact radius at which JKR's force is 10 % above the largest
    force of the run.

    Parameters
    ----------
    run : Result
        Result of the run.
    largest_force : float
        Largest force of the run, eV/Å.

    Returns
    -------
    list[tuple[str, np.ndarray, np.ndarray]]
        For each its label, mean heights (Å) and forces (eV/Å).
    """
    found = of_run(run)
    if not found or not run.curved:
        return []
    smooth, stress, rough, tension = _spheres(found)
    if not (smooth.work > 0 and stress > 0):
        return []
    alone = smooth._replace(period=1e6 * smooth.period)
    radii = np.linspace(0, smooth.period / 2, 2000)
    force = alone.curve(radii)[1]
    below = radii[force < 1.1 * max(0.0, largest_force) + 1e-9]
    widest = below[-1] if len(below) else 0.0
    ratios = 1 + np.exp(np.linspace(-9, 5, 400))  # m
    s = np.sqrt((ratios - 1) * (ratios + 1))
    curves = [("smooth sphere, JKR", alone.curve(np.linspace(1e-3 * widest, widest, 300))),
              ("smooth sphere, JKR with images", smooth.curve(np.linspace(1e-3 * widest, widest, 300))),
              ("smooth sphere, Maugis-Dugdale with images", smooth.curve(s, stress))]
    if rough is not None:
        curves.append(("theory: Maugis-Dugdale with images and the renormalised law", rough.curve(s, tension)))
    kept = []
    for label, (height, force, radius) in curves:
        here = np.isfinite(height + force) & (radius <= widest * (1 + 1e-12))
        kept.append((label, height[here], force[here]))
    return [curve for curve in kept if len(curve[1])]
