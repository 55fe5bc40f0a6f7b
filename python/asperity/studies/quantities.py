# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Quantities that `cost` and `estimate` state: where a result has each, and the least error that each can have."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..results.losses import losses
from ..results.result import Values
from ..units import GIGAPASCAL

NAN = float("nan")


class Quantity(NamedTuple):
    """A number of a result that can be stated."""

    path: str
    """Of result.json; binding_energy_ratio: over delta_gamma; pull_off_stress: pull_off_force over the area; slide.X: X of the
    last slide in segments."""
    symbol: str
    name: str
    order: float
    """Of the error of a finite spacing, as measured (docs/howto/estimate.md)."""


FLAT = (Quantity("binding_energy", "γ_eff", "binding energy at zero load", 2),
        Quantity("binding_energy_ratio", "γ_eff/Δγ", "the same over that of flat surfaces", 2),
        Quantity("contact_fraction", "A/A₀", "contact area fraction", 1),
        Quantity("work_of_drive.approach", "w_in", "work of the drive on the solids on the approach (negative: they pull it)", 2),
        Quantity("work_of_drive.pull_off", "w_out", "work of the drive on the solids on the pull-off", 2),
        Quantity("lost.cycle", "w_lost", "energy lost in a cycle", 1),
        Quantity("pull_off_stress", "σ_off", "pull-off stress: the largest attraction over the area", 1))
CURVED = (Quantity("pull_off_force", "F_off", "pull-off force", 1), Quantity("jkr.pull_off", "γ_JKR", "work of adhesion by JKR", 1),
          Quantity("contact_radius.relaxed", "a", "contact radius at zero load", 1))
AREA = Quantity("contact_area", "A/A₀", "contact area over the nominal area", 1)
"""Over a wall instead of the contact area fraction."""
YIELDING = (Quantity("yielding.largest_fraction", "A_H/A₀", "area fraction at the hardness, the largest of the path", 1),
            Quantity("yielding.largest_set", "s_max", "largest permanent set of a site", 1))
SLIDING = (Quantity("slide.friction_stress", "τ", "friction stress of the last slide", 2),
           Quantity("slide.friction_coefficient", "μ", "friction coefficient of the last slide", 2),
           Quantity("slide.steady_contact_area", "A_slide/A₀", "contact area of the last slide over the nominal area", 1))


def quantities_of(result: Values, curved: bool) -> tuple[Quantity, ...]:
    """Returns the quantities that are stated."""
    flat = tuple(AREA if q.path == "contact_fraction" and AREA.path in result else q for q in FLAT)
    yielding = YIELDING if result.part("yielding") else ()
    return (CURVED if curved else flat + tuple(
        Quantity(name + ".cycle", f"w_{place}", f"energy dissipated in the {place} in a cycle", 1) for place, name in losses(result).items()
    )) + yielding + (SLIDING if slide_of(result) else ())


def slide_of(result: Values) -> Values | None:
    """Returns the segment of the last slide with a mean friction; None if the path has none."""
    return next((one for one in map(Values, reversed(result.listed("segments", dict))) if "steady_friction" in one), None)


def number_of(result: Values, path: str) -> float:
    """Returns a number of a result."""
    if path == "binding_energy_ratio":
        return result.number("binding_energy", NAN) / (result.number("delta_gamma") or NAN)
    if path == "pull_off_stress":
        edge = result.number("scene.surface.sites", NAN) * result.number("scene.surface.spacing", NAN)
        return result.number("pull_off_force", NAN) / edge**2 / (1e-3 * GIGAPASCAL)
    if path.startswith("slide."):
        slide = slide_of(result)
        return slide.number(path.removeprefix("slide."), NAN) if slide else NAN
    return result.number(path, NAN)


def convergence_of(result: Values, path: str) -> float:
    """Returns the bound that a result states for the error of its solver."""
    parent, _, leaf = path.rpartition(".")
    if path.startswith("slide.") and (slide := slide_of(result)):
        if leaf == "steady_contact_area":
            return slide.number("steady_contact_fraction_error", NAN)
        friction, error = (slide.number(f"steady_friction{name}", NAN) for name in ("", "_error"))
        relative = math.sqrt(max(error**2 - slide.number("steady_friction_mesh_error", 0.0) ** 2, 0.0)) / abs(friction or NAN)
        return relative * abs(number_of(result, path))
    if path == "binding_energy_ratio":
        return result.number("binding_energy_uncertainty", NAN) / (result.number("delta_gamma") or NAN)
    if leaf == "cycle":
        return sum(result.number(f"{parent}.uncertainty.{way}", NAN) for way in ("approach", "pull_off"))
    return result.number(path + "_uncertainty", result.number(f"{parent}.uncertainty.{leaf}", NAN))


def grain_of(result: Values, path: str, value: float) -> float:
    """Returns the least error of a number: one site of an area, 1e-6 Δγ of an energy per area."""
    flat, keys = result.number("delta_gamma", 0.0), result.part("scene")
    sites, spacing = keys.number("surface.sites", 1.0), keys.number("surface.spacing", NAN)
    if path in ("contact_fraction", AREA.path, "slide.steady_contact_area", "yielding.largest_fraction"):
        return 1.0 / sites**2
    if path == "contact_radius.relaxed":
        return spacing**2 / (2.0 * math.pi * max(value, spacing))
    if path == "binding_energy_ratio":
        return 1e-6
    return 1e-6 * flat * (path in ("binding_energy", "lost.cycle") or path.startswith("work_of_drive."))
