# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A sphere on a half-space whose pressure is at most its hardness H, and what an instrument reads from its unloading.

Without adhesion the sphere begins to yield at F_y = π³R²H³/(6E*²). From about 30 F_y on all of its contact, of radius A, is at the hardness:
F = πA²H, the depth is A²/2R + 4HA/(πE*), and the contact unloads as that of a body which fits the set, with x = r/A from 1 to 0:
    F(x) = F (2/π) [asin x - x √(1 - x²)],    depth(x) = depth - (2HA/E*) √(1 - x²).
An attraction of short range adds -√(8πwE*r³) to F(x) (Mesarovic and Johnson, J. Mech. Phys. Solids 48, 2009 (2000)).

Oliver and Pharr (J. Mater. Res. 7, 1564 (1992)) fit P = B (h - h_f)^m to the upper part of an unloading. Its slope S at the largest depth gives
    contact depth h_c = h_max - 0.75 P_max/S,    H = P_max/A(h_c),    E* = (√π/2) S/√A(h_c),
for a sphere with the area function A(h_c) = π (2 R h_c - h_c²), and β = 1 as for all bodies of revolution.

Lengths in nm, forces in nN, moduli in GPa, works in N/m.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from .indentation import Path

POINTS = 4000
"""Points of an unloading."""
FULLY = 30.0
"""Load over that of the first yield from which the whole contact is at the hardness."""
EPSILON = 0.75
"""Of Oliver and Pharr: depth of the contact's edge below the surface, over P/S."""
UPPER = (0.5, 0.98)
"""Part of the unloading that is fitted, over the largest force."""


class YieldingSphere(NamedTuple):
    """A rigid sphere on a half-space that yields: radius (nm), E* and hardness (GPa), work of adhesion (N/m)."""

    radius: float
    modulus: float
    hardness: float
    work: float = 0.0

    @property
    def first_yield(self) -> float:
        """Load at which the sphere begins to yield without adhesion, nN."""
        return math.pi**3 * self.radius**2 * self.hardness**3 / (6 * self.modulus**2)

    def unloading(self, load: float) -> Path:
        """Returns the unloading of a contact that is all at the hardness, from no contact to the largest load (nN)."""
        x = np.sin(np.linspace(0, math.pi / 2, POINTS))
        most = math.sqrt(load / (math.pi * self.hardness))
        depth = most**2 / (2 * self.radius) + 4 * self.hardness * most / (math.pi * self.modulus)
        force = load * 2 / math.pi * (np.arcsin(x) - x * np.sqrt(1 - x * x))
        return Path(depth - 2 * self.hardness * most / self.modulus * np.sqrt(1 - x * x),
                    force - np.sqrt(8 * math.pi * self.work * self.modulus * (most * x) ** 3), most * x)

    def pull_off(self, load: float) -> float:
        """Returns the pull-off force after a load under which all of the contact is at the hardness, nN."""
        return -float(self.unloading(load).force.min())


class Unloading(NamedTuple):
    """Result of Oliver and Pharr for an unloading: hardness and E* (GPa), depth of the contact and at the end of the fitted law (nm), area of
    the contact (nm²), slope at the largest depth (N/m), exponent of the law. failed: reason why there is no fit."""

    hardness: float = math.nan
    modulus: float = math.nan
    contact_depth: float = math.nan
    fitted_depth: float = math.nan
    area: float = math.nan
    slope: float = math.nan
    exponent: float = math.nan
    failed: str = ""


def oliver_pharr(radius: float, depth: np.ndarray, force: np.ndarray) -> Unloading:
    """Reads hardness and modulus from the unloading of a sphere.

    Parameters
    ----------
    radius : float
        Radius of the sphere, nm.
    depth, force : numpy.ndarray
        Depths, nm, and forces, nN, from the largest force on.

    Returns
    -------
    Unloading
        Hardness and modulus, and what they are made of.
    """
    first, most = float(depth[0]), float(force[0])
    end = next((i for i, one in enumerate(force) if one < UPPER[0] * most), len(force))
    used = np.flatnonzero(force[:end] <= UPPER[1] * most)
    if not most > 0 or len(used) < 5:
        return Unloading(failed="the upper half of the unloading has fewer than five points")
    h, p = depth[used], force[used] / most
    span = first - float(h.min())
    if not span > 0:
        return Unloading(failed="the unloading does not lead out of the sample")

    def law(x: np.ndarray) -> np.ndarray:  # logarithm of the force at the largest depth, length over span, exponent
        return np.exp(x[0]) * np.maximum(1 - (first - h) / (x[1] * span), 0.0) ** x[2]

    found = least_squares(lambda x: law(x) - p, [0.0, 2.0, 1.3], bounds=([-1.0, 1.0 + 1e-6, 1.0], [1.0, 1e3, 4.0]))
    if not found.success:
        return Unloading(failed="the fit of the unloading does not converge")
    top, length, exponent = most * math.exp(found.x[0]), float(found.x[1]) * span, float(found.x[2])
    slope = exponent * top / length
    contact = first - EPSILON * most / slope
    if not 0 < contact < radius:
        return Unloading(failed=f"the depth of the contact would be {contact:.3g} nm")
    area = math.pi * (2 * radius * contact - contact**2)
    return Unloading(most / area, math.sqrt(math.pi) / 2 * slope / math.sqrt(area), contact, first - length, area, slope, exponent)
