# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""An indenter on an elastic half-space, with and without adhesion: Hertz and Sneddon, JKR, DMT, Maugis and Dugdale, and the curve that a
cantilever shows.

A convex indenter of revolution has, without adhesion, the force F_H(a) and the depth δ_H(a) at a contact radius a (Sneddon):
    paraboloid  δ = a²/R                       F = 4 E* a³/(3R)
    sphere      δ = (a/2) ln((R+a)/(R-a))      F = E* ((a²+R²)/2 ln((R+a)/(R-a)) - aR)
    cone        δ = (π/2) a/tan α              F = (π/2) E* a²/tan α,  α between surface and sample: F = (2/π) E* δ² / tan α
JKR adds a flat punch that pulls: δ = δ_H - √(2πwa/E*), F = F_H - √(8πwE*a³). For a flat punch a is fixed, and it holds down to
-√(8πwE*a³) (Kendall). A pyramid of four sides has F = 0.7453 E* tan(θ) δ² (Bilodeau), with θ between axis and face, and no closed form with
adhesion. DMT: the force of the paraboloid less 2πwR at Hertz' depth. Maugis and Dugdale: sphere.py.

Lengths in nm, forces in nN, moduli in GPa, works in N/m.
"""

from __future__ import annotations

import functools
import math
from typing import NamedTuple

import numpy as np

from .sphere import Openings, jkr, maugis, openings

POINTS = 1500
"""Points of a path."""
COARSE = 16
BILODEAU = 0.7453
SHAPES = {"paraboloid": ("radius", ("hertz", "jkr", "dmt", "maugis")), "sphere": ("radius", ("hertz", "jkr", "dmt")),
          "cone": ("angle", ("hertz", "jkr")), "pyramid": ("angle", ("hertz",)), "punch": ("radius", ("hertz", "jkr"))}
"""What a shape is given by, and the models that have a closed form for it."""


class Indenter(NamedTuple):
    """A rigid indenter: a word of SHAPES, and its radius (nm) or the angle between its axis and its surface (degrees)."""

    shape: str
    size: float

    @property
    def _opening(self) -> float:
        """Tangent of the angle between axis and surface of the cone that has the same Hertzian force."""
        tangent = math.tan(math.radians(self.size))
        return tangent if self.shape == "cone" else BILODEAU * math.pi / 2 * tangent

    def hertz(self, a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns depth (nm) and force over E* (nm²) without adhesion at contact radii (nm); of a punch, "a" is the depth."""
        if self.shape == "paraboloid":
            return a * a / self.size, 4 / 3 * a**3 / self.size
        if self.shape == "sphere":
            ratio = np.arctanh(a / self.size)  # half of the logarithm; its series cancels the lowest order of the force
            small = a < 0.02 * self.size
            force = np.where(small, 4 / 3 * a**3 / self.size * (1 + 0.4 * (a / self.size) ** 2), (a * a + self.size**2) * ratio - a * self.size)
            return a * ratio, force
        if self.shape == "punch":
            return a, 2 * self.size * a
        return math.pi / 2 * a / self._opening, math.pi / 2 * a * a / self._opening

    def radius_for(self, force: float) -> float:
        """Returns a contact radius at which the Hertzian force over E* is at least this (nm²); of a punch, the depth."""
        if self.shape == "punch":
            return force / (2 * self.size)
        if self.shape in ("cone", "pyramid"):
            return math.sqrt(force * self._opening * 2 / math.pi)
        paraboloid = float(np.cbrt(0.75 * self.size * force))
        return min(paraboloid, 0.9999 * self.size) if self.shape == "sphere" else paraboloid


class Path(NamedTuple):
    """Depth (nm), force (nN) and contact radius (nm) of an indenter, from the least contact to the largest."""

    depth: np.ndarray
    force: np.ndarray
    radius: np.ndarray

    def on_drive(self, stiffness: float) -> tuple[np.ndarray, np.ndarray]:
        """Returns the height of the drive over the point of contact (nm, increasing) and the force (nN) of the states that a cantilever
        of this stiffness (N/m) holds, up to the point at which it jumps off."""
        height = -self.depth - self.force / stiffness
        last = int(np.argmax(height))
        return height[last:][::-1], self.force[last:][::-1]


@functools.cache
def _openings() -> tuple[Openings, Openings]:
    """Returns the terms of Maugis' equations from the smallest contact to the largest, and every COARSE-th of them."""
    at = openings(np.sinh(np.geomspace(15, 1e-8, 8 * POINTS)))
    return at, Openings(*(one[::COARSE] for one in at))


@functools.lru_cache(maxsize=64)
def _reduced(model: str, parameter: float, most: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns force, contact radius and approach of an adhesive paraboloid in Maugis' units, at least up to a force."""
    if model == "jkr":
        a = 2 * np.cbrt(most + 3) * np.linspace(0, 1, 2 * POINTS) ** 2
        force, a, approach = jkr(a)
    else:
        at, coarse = _openings()
        force, a, _ = maugis(parameter, coarse)
        first, last = max(0, int(np.searchsorted(a, 0.01)) - 1), int(np.searchsorted(force, most)) + 1
        force, a, approach = maugis(parameter, Openings(*(one[COARSE * first:COARSE * last] for one in at)))
    return force, a, approach


def maugis_parameter(radius: float, modulus: float, work: float, range: float) -> float:
    """Returns Maugis' λ of a sphere whose attraction has the constant stress work/range."""
    return 2 * work / range * float(np.cbrt(radius / (math.pi * work * (4 * modulus / 3) ** 2)))


def path(indenter: Indenter, model: str, modulus: float, work: float, most: float, parameter: float = math.inf) -> Path:
    """Computes the states of an indenter.

    Parameters
    ----------
    indenter : Indenter
        The indenter.
    model : str
        "hertz", "jkr", "dmt" or "maugis", one that SHAPES has for the shape.
    modulus : float
        E*, GPa.
    work : float
        Work of adhesion, N/m; without effect for "hertz".
    most : float
        Force that the path reaches at least, nN.
    parameter : float
        Maugis' λ, for "maugis".

    Returns
    -------
    Path
        The states.
    """
    if indenter.shape == "paraboloid" and work > 0 and model in ("jkr", "maugis"):
        stiffness, unit = 4 * modulus / 3, math.pi * work * indenter.size
        length = float(np.cbrt(unit * indenter.size / stiffness))
        force, a, approach = _reduced(model, parameter, 2.0 ** math.ceil(math.log2(max(most / unit, 0.0) + 0.1)))
        return Path(approach * (length**2 / indenter.size), force * unit, a * length)
    if indenter.shape == "punch":
        held = math.sqrt(8 * math.pi * work * modulus * indenter.size**3) if model == "jkr" else 0.0
        force = np.linspace(-held, 1.05 * max(most, 0.0) + held + 1e-9, POINTS)
        return Path(force / (2 * modulus * indenter.size), force, np.full(POINTS, indenter.size))
    adhesion = {"hertz": 0.0, "dmt": 2 * math.pi * work * indenter.size, "jkr": 0.0}[model]
    largest = indenter.radius_for((1.05 * max(most, 0.0) + adhesion + 1e-9) / modulus)
    if model == "jkr":
        largest = max(largest, 4 * indenter.radius_for(work * indenter.size / modulus if indenter.shape != "cone" else 64 * (work / modulus)**2))
    for _ in range(40):
        a = largest * np.linspace(0, 1, POINTS) ** 2
        depth, force = indenter.hertz(a)
        force = modulus * force - adhesion
        if model == "jkr":
            depth, force = depth - np.sqrt(2 * math.pi * work * a / modulus), force - np.sqrt(8 * math.pi * work * modulus * a**3)
        if force[-1] > most or indenter.shape == "sphere" and largest > 0.99 * indenter.size:
            break
        largest = min(1.5 * largest, 0.9999 * indenter.size) if indenter.shape == "sphere" else 1.5 * largest
    return Path(depth, force, a)
