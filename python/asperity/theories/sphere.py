# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The smooth adhesive sphere, alone and in a periodic box: JKR, and the theory of Maugis and Dugdale.

In Maugis' units, a in (πwR²/K)^(1/3), F in πwR, δ in (π²w²R/K²)^(1/3), K = 4E*/3, JKR is
    F = a³ - √(6a³),    δ = a² - (2/3)√(6a).
Maugis lets a constant stress σ0 act across the gap out to an opening w/σ0, at the radius c = m a;
λ = 2σ0 (R/πwK²)^(1/3). λ -> ∞ is JKR, λ -> 0 DMT. Pressing forces are positive.

In a box the sphere is repeated with the period L. The images' displacement near the contact is that of point forces on a square
lattice over a uniform background: (F/πE*)(φ0/L + φ2 r²/(4L³)). The second term changes the gap like a curvature, 1/R -> 1/R + φ2
F/(2πE*L³); the first shifts the mean height z = d0 - δ - φ0 F/(πE*L), d0 the separation of two flat surfaces. Next order: (a/L)²
smaller.

Units: any consistent set. All functions take arrays.
"""

from __future__ import annotations

import functools
import math
from typing import Any, NamedTuple

import numpy as np

MEAN_SUM = -3.900264920001956  # φ0: Σ' 1/R less its mean
CURVATURE_SUM = 9.033621683100950  # φ2: Σ' 1/R³
RATIOS = np.sinh(np.geomspace(1e-8, 15, 4000))
"""√(m² - 1) along a curve of Maugis."""
COARSE = 16
"""Every so many points of a curve are looked at for its least force, before those around it."""


def jkr(a: Any) -> tuple[Any, Any, Any]:
    """Computes JKR's sphere.

    Parameters
    ----------
    a : Any
        Contact radius, in Maugis' units.

    Returns
    -------
    tuple[Any, Any, Any]
        Force, radius and approach in Maugis' units.
    """
    return a**3 - np.sqrt(6 * a**3), a, a**2 - 2 / 3 * np.sqrt(6 * a)


class Openings(NamedTuple):
    """Terms of Maugis' equations that depend on s = √(m² - 1) alone: s, m, arctan s, and the parts of the opening at c proportional
    to λ/2 and 4λ²/3."""

    s: np.ndarray
    m: np.ndarray
    angle: np.ndarray
    hertz: np.ndarray
    adhesion: np.ndarray


def openings(s: Any) -> Openings:
    """Returns the terms of Maugis' equations at values of √(m² - 1)."""
    s = np.asarray(s, float)
    m, angle = np.sqrt(1 + s * s), np.arctan(s)
    # w/σ0 is the opening at c; both parts cancel to order s³ and s² where m is close to one.
    near, k = np.minimum(s, 0.1), np.arange(12)[:, None]
    powers = (-1.0) ** k * near.ravel() ** (2 * k)
    hertz = np.where(s > 0.1, s + (s * s - 1) * angle,
                     (near.ravel() ** 3 * powers * (1 / (2 * k + 1) + 1 / (2 * k + 3))).sum(0).reshape(s.shape))
    tail = s * s / (1 + m)  # m - 1
    adhesion = np.where(s > 0.1, s * angle - tail,
                        (near.ravel() ** 2 * powers / (2 * k + 1)).sum(0).reshape(s.shape) - tail)
    return Openings(s, m, angle, hertz, adhesion)


def maugis(parameter: Any, at: Any) -> tuple[Any, Any, Any]:
    """Computes the sphere of Maugis and Dugdale.

    Parameters
    ----------
    parameter : Any
        Maugis' λ.
    at : Any
        √(m² - 1), or openings() of it.

    Returns
    -------
    tuple[Any, Any, Any]
        Force, radius and approach in Maugis' units.
    """
    s, m, angle, hertz, adhesion = at if isinstance(at, Openings) else openings(at)
    A, B = parameter / 2 * hertz, 4 * parameter**2 / 3 * adhesion
    a = 2 / (B + np.sqrt(B * B + 4 * A))  # A a² + B a = 1
    return a**3 - parameter * a**2 * (s + m * m * angle), a, a**2 - 4 / 3 * parameter * a * s


class Sphere(NamedTuple):
    """A smooth sphere on a half-space: radius (Å), modulus E* (eV/Å³), work of adhesion (eV/Å²), period of its images (Å),
    equilibrium separation d0 (Å)."""

    radius: float
    modulus: float
    """E*"""
    work: float
    period: float = math.inf
    separation: float = 0.0
    """d0"""

    @property
    def stiffness(self) -> float:
        """4 E*/3, eV/Å³."""
        return 4 * self.modulus / 3

    def parameter(self, stress: float, radius: Any = None) -> Any:
        """Returns Maugis' λ.

        Parameters
        ----------
        stress : float
            Theoretical stress, eV/Å³.
        radius : Any
            Radius, Å; None: radius of the sphere.

        Returns
        -------
        Any
            λ, a pure number.
        """
        return 2 * stress * np.cbrt((self.radius if radius is None else radius) / (
            math.pi * self.work * self.stiffness**2))

    def curve(self, at: np.ndarray, stress: float | None = None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Computes a path of the sphere with its images.

        Parameters
        ----------
        at : np.ndarray
            Contact radii, Å; with `stress`, values of √(m² - 1).
        stress : float, optional
            Stress of Maugis and Dugdale, eV/Å³; None: by JKR.

        Returns
        -------
        tuple[np.ndarray, np.ndarray, np.ndarray]
            Mean height (Å), force (eV/Å) and contact radius (Å). NaN if the images flatten the sphere, or do not converge.
        """
        curvature = CURVATURE_SUM / (2 * math.pi * self.modulus * self.period**3)
        at = np.asarray(at, float)
        force = before = 0 * at
        opened = None if stress is None else openings(at)
        for _ in range(200):  # the radius that the force itself has changed; NaN where that diverges
            inverse = 1 / self.radius + curvature * force
            R = 1 / np.where(inverse > 0, inverse, np.nan)
            unit = math.pi * self.work * R
            length = np.cbrt(unit * R / self.stiffness)
            with np.errstate(over="ignore", invalid="ignore"):
                reduced, a, approach = jkr(at / length) if stress is None or opened is None else maugis(self.parameter(stress, R), opened)
            before, force = force, np.where(np.isfinite(reduced), reduced * unit, np.nan)
            if not np.any(np.abs(force - before) > 1e-13 * math.pi * self.work * self.radius):
                break
        force = np.where(np.abs(force - before) < 1e-6 * math.pi * self.work * self.radius, force, np.nan)
        height = self.separation - approach * length**2 / R - MEAN_SUM * force / (math.pi * self.modulus * self.period)
        return height, force, a * length

    @functools.lru_cache(maxsize=256)
    def pull_off(self, stress: float | None = None) -> float:
        """Returns the largest attraction as a work of adhesion by JKR, F/(1.5πR), eV/Å²; NaN without attraction."""
        unit = float(np.cbrt(math.pi * self.work * self.radius**2 / self.stiffness))
        at = np.linspace(0.2, 3, 4000) * unit if stress is None else RATIOS
        coarse = self.curve(at[::COARSE], stress)[1]
        if not np.isfinite(coarse).any():
            return math.nan
        least = COARSE * int(np.nanargmin(coarse))
        at = at[max(least - COARSE, 0):least + COARSE + 1]
        for _ in range(3):  # finer about the least
            force = self.curve(at, stress)[1]
            if not np.isfinite(force).any():
                return math.nan
            least = int(np.nanargmin(force))
            at = np.linspace(at[max(least - 1, 0)], at[min(least + 1, len(at) - 1)], 200)
        return -float(np.nanmin(force)) / (1.5 * math.pi * self.radius)
