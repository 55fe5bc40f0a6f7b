# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The renormalised theory of adhesive contact: the effect of roughness on the potential φ(u) of two flat surfaces.

docs/explanation/theory.md derives it and defines S, D, κ and K. Roughness is integrated in shells of wavevectors from the finest to
the coarsest; for each shell of height variance dh² the response of the block minimises the energy to second order:
    dφ/dh² = ½ [ S + 2D - (S + D)² / (S + φ″) ],
    dχ/dh² = ½ [ (S + D) / (S + φ″) ]² χ″,       χ: any area observable, and V of each ring of atoms

On a grid in u, two implicit stages a step (order 2, L-stable), each by Newton's method, which converges from anywhere:
the right side is concave in φ″, and continued by its tangent below φ″ = -S. Units: Å, eV; the input is "rough" of
`asperity theory-points`.
"""

from __future__ import annotations

import math
from collections import namedtuple
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg.lapack import dgtsv
from scipy.optimize import brentq
from scipy.special import erf, j0, j1

from ..units import GIGAPASCAL

TOLERANCE = 1e-4  # on γ_eff/Δγ and contact: grids are halved until the last two extrapolations differ by less
USEFUL = 1e-2  # if they differ by more in the end, there is no answer
MOST_WORK = 1.3e8  # of a grid: shells, points, observables; two seconds
STEPS, SPACING = 14, 0.125  # of the coarsest grid: in ln q; at the minimum, over its distance to the inflection
STAGE = 1 - 1 / math.sqrt(2)  # of a step: each of its two stages
TOUCHING, SIDEWAYS, TILT, STIFFENING, RINGS_FROM = range(5)
"""Columns of the observables: contact fraction, φ_tt, what tilt has cost and lateral forces have stiffened of φ so far
(for the expected errors), then V_uu of each ring and V_Ru of each ring."""


class NoSolution(Exception):
    """Error: the theory has no solution, with the reason."""


class Spectrum:
    """Pieces of C = c (q/qa)^n from qa to qb."""

    def __init__(self, pieces: list[list[float]], smallest: float):
        self.qa, self.qb, self.c, self.n = np.array(pieces or [[1.0, 2.0, 0.0, 0.0]]).T
        self.smallest, self.largest = smallest, self.qb[-1]
        self._below = np.concatenate([[0], np.cumsum(self._moments(1, self.qb))])
        self.rms = math.sqrt(2 * math.pi * self._below[-1])
        self.slopes = 2 * math.pi * self._moments(3, self.qb).sum()  # <|∇h|²>
        # Waves of equal variance with the same (Σ variance)² / Σ variance².
        squares = (_power_integral(2 + 2 * self.n, np.log(self.qb / self.qa)) * (self.c * self.qa) ** 2).sum()
        self.waves = 2 * math.pi * self._below[-1] ** 2 / (smallest**2 * squares) if pieces else math.inf

    def _moments(self, k: int, q: np.ndarray, piece: Any = slice(None)) -> np.ndarray:
        """Returns ∫ q^k C dq of pieces, up to q."""
        qa = self.qa[piece]
        return self.c[piece] * qa ** (k + 1) * _power_integral(k + 1 + self.n[piece], np.log(q / qa))

    def variance_above(self, q: np.ndarray) -> np.ndarray:
        """Returns the variance of the heights in the waves above wave numbers q (1/Å), Å²."""
        piece = np.maximum(np.searchsorted(self.qa, q, "right") - 1, 0)
        below = self._below[piece] + self._moments(1, np.clip(q, self.qa[piece], self.qb[piece]), piece)
        return 2 * math.pi * np.maximum(self._below[-1] - below, 0)


def _power_integral(m: np.ndarray, L: np.ndarray) -> np.ndarray:
    """Returns ∫ e^(m x) dx from 0 to L."""
    return np.where(np.abs(m * L) < 1e-8, L * (1 + m * L / 2), np.expm1(m * L) / np.where(m == 0, 1, m))


class Flat:
    """Two flat surfaces: the minimum of φ, its inflection (the largest tension), and the terms of rings of atoms."""

    def __init__(self, given: dict[str, Any]):
        self.rings = np.array(given["rings"] or np.empty((0, 2)))
        self.closest, self.reach, self.contact, self.spacing = (
            given[k] for k in ("closest", "reach", "contact", "spacing"))
        at = np.array(given["at"])
        self.last = at[-1]
        if len(self.rings):
            self._pair = CubicSpline(np.log(at), np.array([given["energy"], given["first"], given["second"]]).T)
        else:
            self._wall = CubicSpline(at, given["energy"])
        u = np.linspace(self.closest, self.reach, 4001)
        low = int(np.argmin(self.derivative(u, 0)))
        steep = low + int(np.argmax(self.derivative(u[low:-1], 1)))
        self.separation = brentq(self.derivative, u[low - 1], u[low + 1], (1,), 1e-12)
        near = u[steep - 1:steep + 2]
        self.inflection, self.tension = _parabola(near, self.derivative(near, 1))
        self.depth = -float(self.derivative(self.separation, 0))
        self.well = self.inflection - self.separation

    def pair(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns the pair potential of each ring of atoms of the lattice.

        Parameters
        ----------
        u : np.ndarray
            Separations, Å.

        Returns
        -------
        tuple[np.ndarray, np.ndarray, np.ndarray]
            V (eV), V'/r (eV/Å²) and (V'/r)'/r (eV/Å⁴), by ring and separation.
        """
        r = np.sqrt(np.asarray(u)[..., None] ** 2 + self.rings[:, 0] ** 2)
        found = np.where((r <= self.last)[..., None], self._pair(np.log(r)), 0)
        return found[..., 0], found[..., 1], found[..., 2]

    def derivative(self, u: Any, order: int) -> Any:
        """Returns the energy of a flat surface, or a derivative of it.

        Parameters
        ----------
        u : Any
            Separations, Å.
        order : int
            0, 1 or 2.

        Returns
        -------
        Any
            φ (eV/Å²), φ′ or φ″ at the separations.
        """
        u = np.asarray(u, float)
        if not len(self.rings):
            return np.where(u <= self.last, self._wall(u, order), 0)
        energy, first, second = self.pair(u)
        far = u[..., None]
        return (energy, first * far, first + second * far**2)[order] @ self.rings[:, 1]

    def touching(self, u: np.ndarray, slopes: float) -> np.ndarray:
        """Returns the fraction of sites in contact over a surface of Gaussian slopes: of the four corners below a site the
        nearest is closer by (a/2)(|∂h/∂x| + |∂h/∂y|) than on the flat, which is below y with the probability erf(y/aσ)².

        Parameters
        ----------
        u : np.ndarray
            Separations, Å.
        slopes : float
            Standard deviation σ of a component of the slope.

        Returns
        -------
        np.ndarray
            The fractions, 0 to 1.
        """
        if not slopes > 0 or self.spacing == 0:
            return np.where(u < self.contact, 1.0, 0.0)
        y = np.maximum(u - self.contact, 0) / (self.spacing * math.sqrt(slopes / 2))
        return 1 - erf(y) ** 2


def _total(S, D, bend):
    """Returns S + φ″, or the value below which the equation is continued by its tangent."""
    return np.maximum(S + bend, 1e-4 * (S + np.abs(D)))


def _rate(S, D, bend):
    """Returns dφ/dh² of a shell."""
    return 0.5 * (S + 2 * D - (S + D) ** 2 / _total(S, D, bend))


class Flow:
    """Integration of φ and its observables over the shells, on one grid."""

    def __init__(self, rough: dict[str, Any], spectrum: Spectrum, flat: Flat, level: int):
        self.spectrum, self.flat, self.friction = spectrum, flat, rough["friction"] and len(flat.rings) > 0
        self.stiffness = np.array(rough["stiffness"])
        self.u = u = self._grid(SPACING * flat.well / 2**level, flat.reach + 5 * spectrum.rms + 8 * flat.well)
        a, b = u[1:-1] - u[:-2], u[2:] - u[1:-1]
        self.left, self.right = 2 / (a * (a + b)), 2 / (b * (a + b))
        self.rings = len(flat.rings)
        self.observed = np.zeros((len(u), RINGS_FROM + 2 * self.rings), order="F")
        self.phi = flat.derivative(u, 0)
        self.observed[:, TOUCHING] = flat.touching(u, spectrum.slopes)
        if self.rings:
            (R, density), (_, first, second), far = flat.rings.T, flat.pair(u), u[:, None]
            self.observed[:, SIDEWAYS] = (first + 0.5 * second * R**2) @ density
            self.observed[:, RINGS_FROM:] = np.hstack([density * (first + second * far**2), density * second * R * far])
        self.wall_bend = self._bend(self.phi)[0]
        none: np.ndarray = np.empty(0)
        self.q: np.ndarray
        self.variance: np.ndarray
        self.inside: np.ndarray
        self.q, self.variance, self.inside = self._cut(level) if spectrum.rms else (none, np.zeros(1), none)

    def _grid(self, spacing: float, last: float) -> np.ndarray:
        """Returns a grid that is equidistant up to twice the distance from the minimum to the inflection, and geometrically wider
        beyond."""
        even_until, growth = self.flat.separation + 2 * self.flat.well, 6 * self.flat.well

        def step(x: float) -> float:
            s = max(0.0, x - even_until)
            return spacing * (1 + s * s / ((s + growth) * growth))

        u, x = [], self.flat.closest
        while x < last:
            u.append(x)
            x += step(x + 0.5 * step(x))  # midpoint rule: the spacing varies smoothly
        return np.array([*u, x])

    def _cut(self, level: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns the cuts of the shells from q1 down to q_L (STEPS even in ln q and one for each width of the well of the rms
        of the roughness above, both `level` times halved), the variances above, and the wavevectors of the first stages."""
        of, width = self.spectrum, math.log(self.spectrum.largest / self.spectrum.smallest)
        more = min(of.rms / self.flat.well, 1e4)
        even, steps = STEPS / (STEPS + more), math.ceil(STEPS + more) << level
        table = np.linspace(0, 1, max(20000, 20 * steps) + 1)
        above = of.variance_above(of.largest * np.exp(-width * table))
        marks = even * table + (1 - even) * np.sqrt(above) / of.rms
        q = of.largest * np.exp(-width * np.interp(marks[-1] * np.arange(steps + 1) / steps, marks, table))
        q[-1] = of.smallest
        variance = np.append(of.variance_above(q[:-1]), of.rms**2)
        inside = np.interp(variance[:-1] + STAGE * np.diff(variance), above, table)
        return q, variance, of.largest * np.exp(-width * inside)

    def _bend(self, f: np.ndarray) -> np.ndarray:
        return self.left * (f[:-2] - f[1:-1]) + self.right * (f[2:] - f[1:-1])

    def _coefficients(self, q: float, observed: np.ndarray) -> tuple[Any, np.ndarray, np.ndarray, float]:
        """Returns S, D, D without the gain of sliding, and S without friction, at the separations. S/q is interpolated."""
        table = self.stiffness
        zz, xx, xz, free = (q * np.interp(q, table[:, 0], column) for column in (table[:, 1:] / table[:, :1]).T)
        x = q * self.flat.rings[:, 0]
        tilt = unrelieved = observed[:, RINGS_FROM:RINGS_FROM + self.rings] @ (1 - j0(x))
        if not self.friction:
            return np.full(len(self.u), free), tilt, unrelieved, free
        sideways = observed[:, SIDEWAYS]
        kappa = np.abs(observed[:, RINGS_FROM + self.rings:] @ j1(x))
        K, furthest = xx + sideways, self.u * q
        v = np.where(K * furthest > kappa, kappa / np.where(K == 0, 1, K), furthest)
        gain = np.clip((kappa - 0.5 * K * v) * v, 0, np.maximum(tilt, 0))
        return zz - xz**2 / (xx + np.maximum(sideways, 0)), tilt - gain, unrelieved, free

    def _solve(self, weight: np.ndarray, right_side: np.ndarray) -> np.ndarray:
        """Solves x - weight x″ = right_side for x at the inner points, x = 0 at both ends."""
        lower, upper = weight * self.left, weight * self.right
        return dgtsv(-lower[1:], 1 + lower + upper, -upper[:-1], right_side)[3]

    def _step_potential(self, f: np.ndarray, start: np.ndarray, dt: float, S: np.ndarray, D: np.ndarray) -> np.ndarray:
        """Solves f - dt F(f″) = start for f by Newton's method; the ends of f are given."""
        S, D, small, f = S[1:-1], D[1:-1], 1e-10 * self.flat.depth, f.copy()
        for iteration in range(1000):
            bend = self._bend(f)
            at = _total(S, D, bend)
            slope = 0.5 * ((S + D) / at) ** 2
            change = self._solve(dt * slope, start[1:-1] + dt * (_rate(S, D, bend) + slope * (S + bend - at)) - f[1:-1])
            f[1:-1] += change
            largest = np.abs(change).max()
            if not largest > small or (iteration > 40 and largest < 1e3 * small):  # the last digits may keep moving
                return f
        raise NoSolution("Newton’s method has not converged; this is a defect of the solver, please report the scene")

    def _step_observables(self, x: np.ndarray, f: np.ndarray, dt: float, at: tuple) -> np.ndarray:
        """Computes x - dt W x″ of all columns, W = ½ [(S + D)/(S + f″)]². It is the equation of a small change of φ too: the
        contribution of a term of the rate to φ follows with that term added."""
        S, D, unrelieved = (values[1:-1] for values in at[:3])
        bend, right_side = self._bend(f), x[1:-1].copy(order="F")
        weight = 0.5 * dt * ((S + D) / _total(S, D, bend)) ** 2
        right_side[:, TILT] += dt * (_rate(S, unrelieved, bend) - _rate(S, 0, bend))
        right_side[:, STIFFENING] += dt * (_rate(S, D, bend) - _rate(at[3], D, bend))
        right_side[0] += weight[0] * self.left[0] * x[0]
        right_side[-1] += weight[-1] * self.right[-1] * x[-1]
        x = x.copy(order="F")
        x[1:-1] = self._solve(weight, right_side)
        return x

    def run(self) -> None:
        """Runs Alexander's two stages. Observables enter the coefficients of φ; at the stages they are extrapolated from the
        last two steps, which keeps the order."""
        ratio, older, older_step = (1 - STAGE) / STAGE, self.observed, 0.0
        for q, inside, step in zip(self.q[1:], self.inside, np.diff(self.variance)):
            if not step > 0:
                continue
            dt, now = STAGE * step, self.observed

            def expected(ahead: float) -> np.ndarray:
                return now + ahead * step / older_step * (now - older) if older_step and self.rings else now

            at = self._coefficients(inside, expected(STAGE))
            stage = self.phi.copy()
            stage[0] += dt * _rate(at[0][0], at[1][0], self.wall_bend)
            stage = self._step_potential(stage, self.phi, dt, at[0], at[1])
            observed = now + ratio * (self._step_observables(now, stage, dt, at) - now)
            # Where φ″ is about to reach -S, φ follows from that bound: carried on by a rate it would fall below it.
            follows = np.ones(len(self.u))
            follows[1:-1] = np.clip(4 * (1 + self._bend(stage) / at[0][1:-1]), 0, 1)
            start = stage + follows * (ratio - 1) * (stage - self.phi)
            at = self._coefficients(q, expected(1))
            stage[0] = start[0] + dt * _rate(at[0][0], at[1][0], self.wall_bend)
            self.phi = self._step_potential(stage, start, dt, at[0], at[1])
            older, older_step, self.observed = now, step, self._step_observables(observed, self.phi, dt, at)


def _parabola(x: np.ndarray, y: np.ndarray, at: float | None = None) -> tuple[float, float]:
    """Returns the extremum of the parabola through three points between them, or the given place, and the value there."""
    a, b = np.diff(y) / np.diff(x)
    bend = (b - a) / (x[2] - x[0])
    if at is None:
        at = float(np.clip(x[1] if bend == 0 else (x[0] + x[1] - a / bend) / 2, x[0], x[2]))
    return at, y[0] + (at - x[0]) * (a + (at - x[1]) * bend)


def _state_of(flow: Flow, pressure: float) -> np.ndarray:
    """Returns γ_eff, contact, separation, largest tension, tilt and stiffening, on the branch from the minimum of φ."""
    u, phi = flow.u, flow.phi
    least = int(np.argmin(phi))
    slopes, middles = np.diff(phi) / np.diff(u), (u[1:] + u[:-1]) / 2
    steep = least + int(np.argmax(slopes[least:])) if least < len(slopes) else least
    sides = slice(steep - 1, steep + 2)
    tension = _parabola(middles[sides], slopes[sides])[1] if 0 < steep < len(u) - 2 else 0.0
    if -pressure > tension:
        raise NoSolution(f"{-pressure / GIGAPASCAL:.4g} GPa exceeds the largest tension, {tension / GIGAPASCAL:.4g} GPa; pull less")
    energy = phi + pressure * u
    at = int(np.argmin(energy[:least + 1])) if pressure > 0 else least + int(np.argmin(energy[least:steep + 2]))
    if at == 0:
        raise NoSolution(f"{pressure / GIGAPASCAL:.4g} GPa press the surfaces together to less than {u[0]:.4g} Å; press less")
    at = min(max(at, 1), len(u) - 2)
    near = slice(at - 1, at + 2)
    place = _parabola(u[near], energy[near])[0]
    touching, tilt, stiffening, least_phi = (_parabola(u[near], y[near], place)[1] for y in (
        *flow.observed[:, (TOUCHING, TILT, STIFFENING)].T, phi))
    return np.array([-least_phi, touching, place, tension, tilt, stiffening])


State = namedtuple("State", "depth ratio contact separation tension ratio_error contact_error tilt stiffening",
                   defaults=(0.0, 0.0, 0.0, 0.0))
"""Å, eV. depth: -min φ of the flat interface; ratio: γ_eff over it; tilt, stiffening: what of it, to first order, tilt
has cost before sites slide, and lateral forces by a stiffer block."""


def state(rough: dict[str, Any], quick: bool = False) -> State:
    """Computes the state of a scene.

    Parameters
    ----------
    rough : dict[str, Any]
        Input of the theory, as the program gives it.
    quick : bool
        True: on two grids, accurate to about 1e-3.

    Returns
    -------
    State
        The state.

    Raises
    ------
    NoSolution
        The theory has no state for this input.
    """
    if "note" in rough:
        raise NoSolution(rough["note"])
    spectrum, flat = Spectrum(rough["spectrum"], rough["q_L"]), Flat(rough["flat"])
    pressure, depth, slope = rough["pressure"], flat.depth, math.sqrt(spectrum.slopes)
    if not spectrum.rms and pressure == 0:
        return State(depth, 1.0, 1.0, flat.separation, flat.tension)
    # Left of the grid the interface must be much stiffer than the block.
    q, table = spectrum.largest, np.array(rough["stiffness"])
    S, bend = q * np.interp(q, table[:, 0], table[:, 4] / table[:, 0]), float(flat.derivative(flat.closest, 2))
    if spectrum.rms and not bend > 2 * S:
        raise NoSolution(f"the block ({S:.3g} eV/Å⁴ for its shortest wave) is as stiff as the interface pressed "
                         f"together ({bend:.3g}); choose a softer block or a shorter-ranged repulsion")
    coarse = best = np.zeros(6)
    for level in range(6):
        flow = Flow(rough, spectrum, flat, level)
        flow.run()
        point = _state_of(flow, pressure)
        now = point if level == 0 else (4 * point - coarse) / 3
        now[4:] = point[4:]
        errors = np.abs(now - best)[:2] / (depth, 1)
        coarse, best = point, now
        work = 4 * len(flow.q) * (flow.observed.size + 30 * len(flow.u))  # of the next grid
        hopeless = level > 2 and not errors.max() <= 30 * USEFUL
        if (quick and level) or level >= 2 and (errors.max() <= TOLERANCE or work > MOST_WORK or hopeless):
            break
    gamma, contact, separation, tension, tilt, stiffening = best.tolist()
    if not errors.max() <= (10 if quick else 1) * USEFUL:
        raise NoSolution(f"numerical errors of {errors[0]:.2g} Δγ and {errors[1]:.2g} of the contact: an rms slope of "
                         f"{slope:.3g} is too steep for so strong an interface; choose less roughness")
    if gamma > 1.01 * depth:  # roughness only weakens
        raise NoSolution(f"it finds {gamma / depth:.3g} Δγ: of second order in the slope, it does not hold at an rms "
                         f"slope of {slope:.3g}; choose less roughness")
    # Pressed to many times the work of adhesion: no digits below the tolerance of the value.
    error = max(errors[0], TOLERANCE * abs(gamma / depth)) if abs(gamma) > depth else errors[0]
    return State(depth, gamma / depth, min(max(contact, 0.0), 1.0), separation, tension, float(error),
                 float(errors[1]), tilt / depth, stiffening / depth)


def expected_error(found: State, rough: dict[str, Any]) -> tuple[float, float]:
    """Returns the expected errors of a state: 19 of 20 simulated surfaces lie within them at zero load (calibrated as described in
    docs/explanation/theory.md).

    Parameters
    ----------
    found : State
        State.
    rough : dict[str, Any]
        Input of the theory.

    Returns
    -------
    tuple[float, float]
        Errors of γ_eff/Δγ and of the contact fraction.
    """
    spectrum, flat = Spectrum(rough["spectrum"], rough["q_L"]), Flat(rough["flat"])
    scatter = (1 - min(max(found.ratio, 0.0), 1.0)) / math.sqrt(spectrum.waves)
    few, few_contact = (0.5, 0.8) if rough["realised"] else (1.5, 1.1)
    ratio = math.hypot(few * scatter, 3.2 * spectrum.slopes * found.tilt, 1.2 * found.stiffening)
    spread = 1.6 * spectrum.slopes * math.sqrt(found.contact * (1 - found.contact)) if flat.rings.size else 0.0
    follows = 0.0
    if spectrum.rms:  # contact follows the binding, both over the roughness: it is not known better
        ends = []
        for factor in (0.95, 1.05):
            pieces = [[qa, qb, factor**2 * c, n] for qa, qb, c, n in rough["spectrum"]]
            flow = Flow(rough, Spectrum(pieces, rough["q_L"]), flat, 0)
            flow.run()
            ends.append(_state_of(flow, 0.0)[:2] / (flat.depth, 1))
        gamma, touching = np.abs(ends[1] - ends[0])
        follows = ratio * touching / gamma if gamma > 1e-6 else 0.0
    return ratio + found.ratio_error, math.hypot(few_contact * scatter, spread, follows) + found.contact_error
