# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Persson's theory of rubber friction: hysteresis of a viscoelastic half-space that slides over a rough surface
(B. N. J. Persson, J. Chem. Phys. 115, 3840 (2001)).

At the velocity v and under the pressure p the friction coefficient and the contact area A(v) = P(q1) are
    μ(v) = (1/2) ∫ dq q³ C(q) S(q) P(q) ∫ dφ cosφ Im E*(q v cosφ)/p,     P(q) = erf(1/(2√G(q))),
    G(q) = (1/8) ∫ dq' q'³ C(q') ∫ dφ |E*(q' v cosφ)/p|², up to q,        S = β + (1-β) P².

E*(ω) = E(ω)/(1-ν²), φ runs from 0 to 2π, and S is the factor by which deformation in the contacts is smaller than in full
contact: 1 in that paper (β = 1), β = 1/2 or 0.45 in later ones (theory.beta). With block.prony
    E(ω)/E = 1 + Σ r iωτ/(1 + iωτ)
both integrals over φ have closed forms, in y = q v τ:
    ∫ dφ cosφ Im E/E = 2π Σ r y/(s + s²),       s = √(1 + y²),
    ∫ dφ |E/E|² = 2π (K² - 2 K Σ r/s + 2 ΣΣ r r' τ/((τ + τ') s)),         K = 1 + Σ r.

The remaining integral over q is computed by Gauss quadrature in panels of ln q. Numbers are in Å, eV and ps.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import erf

Branches = Sequence[tuple[float, float]]
"""Pairs of a modulus over the relaxed one and a relaxation time, ps."""
NODES, WIDEST = 6, 0.2  # of a panel: nodes, and width in ln q
PER_DECADE = 4  # velocities of a curve


class Rubber(NamedTuple):
    """A viscoelastic half-space on a rough surface."""

    pieces: list[list[float]]
    """C = c (q/qa)^n from qa to qb (Å, Å⁴): [qa, qb, c, n] of each piece"""
    branches: Branches
    modulus: float
    """relaxed E/(1-ν²), eV/Å³"""
    pressure: float
    """eV/Å³"""
    beta: float
    """of S(q): 1, and S = 1"""


class Friction(NamedTuple):
    """Friction coefficient and relative contact area, a value for each velocity."""

    coefficient: np.ndarray
    area: np.ndarray


def modulus(branches: Branches, frequency: Any) -> Any:
    """Returns the complex modulus of a solid relative to its relaxed modulus, E(ω)/E.

    Parameters
    ----------
    branches : Branches
        Branches of the solid.
    frequency : float or array
        Angular frequency, 1/ps.

    Returns
    -------
    complex or array
        Storage (real) and loss modulus (imaginary part), dimensionless.
    """
    iw = 1j * np.asarray(frequency, float)
    return 1 + sum((r * iw * tau / (1 + iw * tau) for r, tau in branches), np.zeros(iw.shape, complex))


def _panels(pieces: list[list[float]]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Returns nodes q [panel, node], their weights times C, and the weights of integrals from a panel's start to a node."""
    x, w = np.polynomial.legendre.leggauss(NODES)
    # Integral of the polynomial through the nodes from -1 to each node, by Legendre's polynomials.
    powers = np.polynomial.legendre.legvander(x, NODES)
    degrees = np.arange(NODES)
    coefficients = (2 * degrees[:, None] + 1) / 2 * powers[:, :NODES].T * w  # of degree d by the value at a node
    steps = [(powers[:, d + 1] - powers[:, d - 1]) / (2 * d + 1) if d else powers[:, 1] + 1 for d in degrees]
    within = np.array(steps).T @ coefficients
    columns: list[list[np.ndarray]] = [[], [], [], [], []]
    for low, high, value, power in pieces:
        if not high > low:
            continue
        edges = np.linspace(math.log(low), math.log(high), 1 + max(1, math.ceil(math.log(high / low) / WIDEST)))
        if not columns[0]:  # of little pressure the contact breaks up within the longest waves
            edges = np.concatenate([edges[:1], edges[0] + (edges[1] - edges[0]) * 0.5 ** np.arange(20, 0, -1), edges[1:]])
        one = np.ones(len(edges) - 1)
        for column, numbers in zip(columns, (edges[:-1], np.diff(edges), value * one, power * one, low * one)):
            column.append(numbers)
    first, width, height, slope, base = (np.concatenate(column)[:, None] for column in columns)
    half = width / 2
    q = np.exp(first + half * (1 + x))
    spectrum = height * (q / base) ** slope
    return q, half * spectrum, within


def _angles(branches: Branches, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the two integrals over φ over 2π, at y = q v (1/ps)."""
    loss, square, stiff = np.zeros(y.shape), np.zeros(y.shape), 1 + sum(r for r, _ in branches)
    for r, tau in branches:
        s = np.hypot(1, y * tau)
        loss += r * y * tau / (s + s * s)
        square += (2 * sum(r * other * tau / (tau + time) for other, time in branches) - 2 * stiff * r) / s
    return loss, stiff**2 + square


class _Contact:
    """Contact of a rough surface at all magnifications."""

    def __init__(self, rubber: Rubber):
        self.rough = any(c > 0 for _, _, c, _ in rubber.pieces)
        self.stiffness, self.beta = rubber.modulus / rubber.pressure, rubber.beta
        smooth = np.ones((1, NODES))
        panels: tuple[np.ndarray, np.ndarray, np.ndarray] = _panels(rubber.pieces) if self.rough else (smooth, smooth, smooth)
        self.q, self._weight, self._within = panels
        self._sum = np.polynomial.legendre.leggauss(NODES)[1]

    def integral(self, loss: np.ndarray, square: np.ndarray) -> tuple[float, float]:
        """Returns friction and contact area.

        Parameters
        ----------
        loss, square : np.ndarray
            The two integrals over φ over 2π, at each q.

        Returns
        -------
        tuple[float, float]
            Friction coefficient, and relative contact area.
        """
        if not self.rough:
            return 0.0, 1.0
        rise = self._weight * self.q**4 * square * (math.pi / 4 * self.stiffness**2)
        before = np.concatenate([[0], np.cumsum(rise @ self._sum)])
        with np.errstate(divide="ignore"):
            part = erf(0.5 / np.sqrt(before[:-1, None] + rise @ self._within.T))
            area = erf(0.5 / np.sqrt(before[-1]))
        share = part * (self.beta + (1 - self.beta) * part**2)
        return float(((self._weight * self.q**4 * share * loss) @ self._sum).sum() * math.pi * self.stiffness), float(area)


def friction(rubber: Rubber, velocity: Any) -> Friction:
    """Computes friction and contact area of steady sliding.

    Parameters
    ----------
    rubber : Rubber
        The half-space and its surface.
    velocity : float or array
        Velocities, Å/ps.

    Returns
    -------
    Friction
        A value for each velocity.
    """
    contact = _Contact(rubber)
    found = [contact.integral(*_angles(rubber.branches, contact.q * v)) for v in np.atleast_1d(np.asarray(velocity, float))]
    return Friction(*np.array(found).T)


def slope(rubber: Rubber) -> float:
    """Returns the slope dμ/dv of slow sliding, ps/Å: (π/2) (E*/p) Σ rτ ∫ dq q⁴ C S P, with P of the relaxed contact."""
    contact = _Contact(rubber)
    return contact.integral(contact.q / 2 * sum(r * tau for r, tau in rubber.branches), np.ones(contact.q.shape))[0]


def velocities(rubber: Rubber) -> np.ndarray:
    """Returns velocities (Å/ps) of a curve, four per decade, from the range in which friction is proportional to the velocity to
    that in which the solid is glassy in all waves."""
    rough = [piece for piece in rubber.pieces if piece[2] > 0]
    times = [tau for _, tau in rubber.branches]
    if not rough or not times:
        return np.zeros(0)
    low, high = 0.03 / (rough[-1][1] * max(times)), 30 / (rough[0][0] * min(times))
    first, last = math.floor(PER_DECADE * math.log10(low)), math.ceil(PER_DECADE * math.log10(high))
    return 10.0 ** (np.arange(first, last + 1) / PER_DECADE)


def largest(rubber: Rubber, near: float) -> tuple[float, float]:
    """Finds the largest friction coefficient.

    Parameters
    ----------
    rubber : Rubber
        The half-space and its surface.
    near : float
        Velocity of velocities() with the largest friction, Å/ps.

    Returns
    -------
    tuple[float, float]
        The friction coefficient and its velocity, Å/ps.
    """
    best = minimize_scalar(lambda x: -friction(rubber, math.exp(x)).coefficient[0], method="bounded",
                           bounds=(math.log(near) - 2.31 / PER_DECADE, math.log(near) + 2.31 / PER_DECADE), options={"xatol": 1e-4})
    return float(-best.fun), math.exp(best.x)
