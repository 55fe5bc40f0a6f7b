# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Fits of contact models to a force curve: work of adhesion and E* with their covariance.

The model is the force that the cantilever shows at a height of the drive: the tip is at the height plus F/k, and the states are followed up to
the jump off contact. Only forces are noisy, so that the deflection biases nothing. Baseline (offset, tilt, maybe interference), contact point,
E*, w and Maugis' λ are parameters of one fit to the points beyond the range of the attraction and to those in contact. Points between, where
the tip jumps or the attraction acts across a gap, are left out, and so are those beside a jump, where derivatives of the force by the
parameters have no bound. The height at which the tip jumps off contact, known to the distance of two points, is one more datum.

Errors are those of least squares with the noise of the residuals, times the length over which residuals are correlated.

Lengths in nm, forces in nN, moduli in GPa, works in N/m.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from ..theories.indentation import SHAPES, Indenter, maugis_parameter, path

SEEN = 6.0
"""Standard errors of a smoothed force from which it differs from the baseline."""
WIDE = 5.0
"""Logarithm of the factor by which E*, w and a period differ from where a fit begins at most."""
FAR = 0.3
"""Part of a curve that is far from the sample for certain."""
MARGIN = 0.005
"""Part of the points in contact that is left out beside the end of the baseline."""
STEEP = 0.05
"""Part of the points in contact that is left out beside a jump: derivatives of their forces by the parameters have no bound."""
BESIDE = 3
"""Points beside a jump that are left out at least: one step of the drive moves their force by more than its noise."""
JUMP = 0.5
"""Part of the largest attraction by which the force of two neighbouring points differs across a jump off contact."""
ACROSS = 0.34
"""Standard error of the place of a jump, in steps of the drive: two thirds of a uniform distribution lie within."""
MOST_POINTS = 3000
"""Points of a fit; more are averaged in groups."""
EXCLUDED = 6.0
"""2 ln of the ratio of likelihoods from which the data exclude a model."""
PARAMETERS = (0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4)
"""Maugis' λ at which a curve is fitted if λ is not known, equally likely beforehand; below and above are DMT and JKR."""


class Jump(NamedTuple):
    """Height at which the tip jumps off contact and its standard error, nm, if it is seen; otherwise the largest height in contact."""

    height: float
    error: float
    seen: bool

    def missed(self, by_model: float) -> float:
        """Returns by how many errors a model's jump misses the data."""
        off = (by_model - self.height) / self.error
        return off if self.seen else min(0.0, off)


class Regions(NamedTuple):
    """A direction of a curve, from far to near: points beyond the attraction, points in contact, noise of a force (nN), forces less the line
    through the far part, that line's offset and tilt, depth of the dip by attraction (nN; 0: none is seen), jump off contact (None: no dip is
    seen)."""

    height: np.ndarray
    force: np.ndarray
    free: np.ndarray
    contact: np.ndarray
    noise: float
    line: tuple[float, float]
    dip: float
    jump: Jump | None

    @property
    def above_line(self) -> np.ndarray:
        """Forces less the line through the far part, nN."""
        return self.force - self.line[0] - self.line[1] * self.height


@dataclass
class Fit:
    """A model fitted to a direction of a curve.

    values, errors   by name: "work" (N/m), "modulus" (E*, GPa), "contact" (height of the drive, nm), "parameter" (Maugis' λ)
    covariance       of ln work and ln modulus
    noise, slack     noise of a force, nN, and the number of points over which residuals are correlated
    misfit           sum of squares of the residuals over noise² and slack, of `points` points
    jump             errors by which the jump off contact is missed
    height, force, model, used   the curve less its baseline, the model (NaN where it has no force), and the points of the fit
    """

    model: str
    values: dict[str, float]
    errors: dict[str, float]
    covariance: np.ndarray
    noise: float
    slack: float
    misfit: float
    free_parameters: int
    points: int
    height: np.ndarray
    force: np.ndarray
    fitted: np.ndarray
    used: np.ndarray
    baseline: Callable[[np.ndarray], np.ndarray]
    jump: float = 0.0
    notes: list[str] = field(default_factory=list)

    @property
    def residual(self) -> float:
        """Rms residual over the noise of the points far from the sample."""
        return math.sqrt(self.misfit / self.points)


class Unfit(Exception):
    """Reason why a direction of a curve cannot be fitted."""


def _grouped(height: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Averages groups of neighbouring points of a long curve."""
    group = -(-len(height) // MOST_POINTS)
    length = len(height) // group * group
    return height[:length].reshape(-1, group).mean(1), force[:length].reshape(-1, group).mean(1)


def regions(height: np.ndarray, force: np.ndarray, retracting: bool = True) -> Regions:
    """Tells what is baseline and what contact in a direction of a curve, from far to near. Raises Unfit."""
    if len(height) < 20:
        raise Unfit(f"it has {len(height)} points")
    height, force = _grouped(height, force)
    count = len(height)
    far = np.arange(count) < max(8, FAR * count)
    steps = np.diff(force[far])
    noise = float(np.median(np.abs(steps - np.median(steps)))) / 0.6745 / math.sqrt(2)
    noise = max(noise, 1e-4 * float(np.ptp(force)) / math.sqrt(count), 1e-12)
    middle = float(height[far].mean())
    if float(np.ptp(height[far])) <= 1e-9 * abs(middle):
        raise Unfit("the drive stands still far from the sample")
    tilt, offset = np.polyfit(height[far] - middle, force[far], 1)
    left = force - offset - tilt * (height - middle)
    width = max(3, count // 200)
    smooth = np.convolve(left, np.ones(width) / width, "same")
    spread = max(noise / math.sqrt(width), float(np.std(smooth[far][width:-width])) if far.sum() > 4 * width else 0.0)
    seen = np.abs(smooth) > SEEN * spread
    seen[:width] = False
    seen[-(width // 2) - 1:] = seen[-(width // 2) - 2]
    quiet = np.flatnonzero(~seen[:count - width])
    runs = np.convolve(seen, np.ones(width), "valid") >= width  # from here on, all of `width` points
    onset = int(np.argmax(runs)) if runs.any() else count
    if onset >= count - 8:
        raise Unfit("no contact is seen")
    if onset < 8 or not len(quiet):
        raise Unfit("no baseline is seen: the curve begins within the range of the forces")
    least = onset + int(np.argmin(smooth[onset:count - width // 2]))
    dip = max(0.0, -float(smooth[least])) if smooth[least] < -SEEN * spread else 0.0
    begin = least if dip else onset
    if count - begin < 8 or left[begin:].max() < SEEN * noise:
        raise Unfit("the tip does not press: no force above the baseline is seen")
    margin, beside = (max(BESIDE, math.ceil(part * (count - begin)), width // 2) for part in (MARGIN, STEEP))
    at = np.arange(count)
    free, contact = at < onset - margin, at >= begin + (beside if dip else -margin)
    jump = None
    if dip:
        about = slice(max(0, onset - 2 * width), least + width)
        rises = left[about][:-1] - left[about][1:]
        edge, seen = about.start + int(np.argmax(rises)), retracting and rises.max() > JUMP * dip
        place = float(0.5 * (height[edge] + height[edge + 1]) if seen else height[contact].max())
        jump = Jump(place, ACROSS * float(np.ptp(height)) / count, bool(seen))
    return Regions(height, force, free, contact, noise, (float(offset - tilt * middle), float(tilt)), dip, jump)


def _start(indenter: Indenter, model: str, found: Regions, stiffness: float) -> tuple[float, float, float]:
    """Returns E*, w and the contact point near which a fit begins."""
    left = found.above_line
    near = found.contact
    top, bottom = int(np.argmax(np.where(near, left, -np.inf))), int(np.flatnonzero(near)[0])
    most = float(left[top])
    tip = found.height + left / stiffness
    depth = max(float(tip[bottom] - tip[top]), 1e-3 * float(np.ptp(found.height)), 1e-3)
    a = indenter.radius_for(1e6) * np.linspace(0, 1, 4000) ** 4 if indenter.shape != "sphere" else 0.999 * indenter.size * np.linspace(0, 1, 4000)
    deep, over = indenter.hertz(a)
    modulus = (most + 2 * found.dip) / max(float(np.interp(depth, deep, over)), 1e-12)
    best, cost = (modulus, 0.0, 0.0), math.inf
    for factor in (0.15, 0.3, 0.6, 1.0, 1.7, 3.0, 8.0):
        E, w = factor * modulus, 0.0
        if model != "hertz":
            works = np.geomspace(1e-6, 30, 40) * 1.0
            pulls = [-float(path(indenter, model, E, one, 0.0, 1.0).force.min()) for one in works]
            w = float(np.exp(np.interp(math.log(max(found.dip, 1e-9)), np.log(np.maximum(pulls, 1e-300)), np.log(works))))
        place, force = path(indenter, model, E, w, 1.2 * most, 1.0).on_drive(stiffness)
        if found.jump and found.jump.seen and w:
            contact = found.jump.height - float(place[-1])
        else:
            contact = float(found.height[top] - np.interp(-most, -force[np.isfinite(force)], place))
        misses = np.interp(found.height[near] - contact, place, force) - left[near]
        if (now := float(np.sum(misses**2))) < cost:
            best, cost = (E, w, contact), now
    return best


class _Problem:
    """Residuals of a model over its parameters: ln E*, contact point, offset, tilt, ln w, ln λ, and interference, each scaled."""

    def __init__(self, indenter: Indenter, model: str, found: Regions, stiffness: float, start: tuple[float, float, float],
                 period: float | None, range: float | None, parameter: float | None):
        self.indenter, self.model, self.found, self.stiffness, self.range = indenter, model, found, stiffness, range
        self.adhesive, self.period, self.parameter = model != "hertz", period, parameter
        self.jump = found.jump if self.adhesive else None
        self.used = found.free | found.contact if self.adhesive or found.dip else np.ones(len(found.height), bool)
        self.middle, self.span = float(found.height.mean()), float(np.ptp(found.height))
        line = found.line[0] + found.line[1] * self.middle, found.line[1]
        left = found.above_line
        self.most = float(left.max())
        depth = max(self.most / stiffness * 1e-3, 1e-2 * abs(float(np.ptp(found.height[found.contact]))))
        self.names = ["modulus", "contact", "offset", "tilt"]
        self.begin, self.scale = [math.log(start[0]), start[2], *line], [1.0, depth, found.noise, found.noise / self.span]
        if self.adhesive:
            self.names.append("work")
            self.begin.append(math.log(max(start[1], 1e-9)))
            self.scale.append(1.0)
        if period:
            self.names += ["sine", "cosine", "period"]
            self.begin += [0.0, 0.0, math.log(period)]
            self.scale += [found.noise, found.noise, 0.1]

    def values(self, x: np.ndarray) -> dict[str, float]:
        """Returns the parameters by name."""
        found = {name: begin + scale * one for name, begin, scale, one in zip(self.names, self.begin, self.scale, x)}
        for name in ("modulus", "work", "period"):
            if name in found:
                begin = self.begin[self.names.index(name)]
                found[name] = math.exp(min(max(found[name], begin - WIDE), begin + WIDE))
        if self.model == "maugis":
            found["parameter"] = self.parameter or maugis_parameter(self.indenter.size, found["modulus"], found["work"], self.range or 0.3)
        return found

    def baseline(self, v: dict[str, float]) -> Callable[[np.ndarray], np.ndarray]:
        """Returns the baseline as a function of the height."""
        def at(height: np.ndarray) -> np.ndarray:
            line = v["offset"] + v["tilt"] * (height - self.middle)
            angle = 2 * math.pi * height / v["period"] if self.period else 0.0
            return line + v["sine"] * np.sin(angle) + v["cosine"] * np.cos(angle) if self.period else line

        return at

    def contact(self, v: dict[str, float], height: np.ndarray) -> tuple[np.ndarray, float]:
        """Returns the force of the contact at heights of the drive, which beyond the jump off contact is that at the jump, and the height
        of the jump."""
        place, force = path(self.indenter, self.model, v["modulus"], v.get("work", 0.0), 1.3 * self.most, v.get("parameter", 1.0)).on_drive(
            self.stiffness)
        at = height - v["contact"]
        found = np.interp(at, place, force)
        slope = (force[1] - force[0]) / (place[1] - place[0])
        found = np.where(at < place[0], force[0] + slope * (at - place[0]), found)
        return found, v["contact"] + float(place[-1])

    def residuals(self, x: np.ndarray) -> np.ndarray:
        """Returns the residuals over the noise and, with adhesion, last that of the jump off contact over its error."""
        v, one = self.values(x), self.found
        at = self.used & (one.contact | (not self.adhesive))
        model = np.zeros(len(one.height))
        model[at], jump = self.contact(v, one.height[at])
        left = (one.force - self.baseline(v)(one.height) - model)[self.used] / one.noise
        return left if self.jump is None else np.append(left, self.jump.missed(jump))

    def jacobian(self, x: np.ndarray) -> np.ndarray:
        """Returns the derivatives of the residuals by central differences."""
        step = 1e-4
        return np.stack([(self.residuals(x + step * unit) - self.residuals(x - step * unit)) / (2 * step) for unit in np.eye(len(x))], axis=1)


def correlated(residuals: np.ndarray) -> float:
    """Returns the number of neighbouring residuals that tell as much as one: 1 plus twice the sum of their correlations."""
    one = residuals - residuals.mean()
    size = float(np.dot(one, one)) or 1.0
    total = 1.0
    for lag in range(1, len(one) // 4):
        now = float(np.dot(one[:-lag], one[lag:])) / size
        if now < 2 / math.sqrt(len(one)):
            break
        total += 2 * now
    return total


def fit(indenter: Indenter, model: str, found: Regions, stiffness: float, period: float | None = None, range: float | None = None,
        parameter: float | None = None, near: Fit | None = None) -> Fit:
    """Fits a model to a direction of a curve. Raises Unfit."""
    if near is None or model == "hertz":
        begin = _start(indenter, model, found, stiffness)
    else:  # with a work that gives the same pull-off
        at, pulls = near.values, []  # lowest forces
        for kind, lam in ((near.model, at.get("parameter", 1.0)), (model, parameter or 1.0)):
            pulls.append(float(path(indenter, kind, at["modulus"], at["work"], 0.0, lam).force.min()))
        begin = at["modulus"], at["work"] * pulls[0] / pulls[1], at["contact"]
    problem = _Problem(indenter, model, found, stiffness, begin, period, range, parameter)
    best = least_squares(problem.residuals, np.zeros(len(problem.names)), jac=problem.jacobian, method="lm", max_nfev=60)
    if not np.isfinite(best.x).all():
        raise Unfit("the fit does not converge")
    count, parameters = int(problem.used.sum()), len(problem.names)
    left = best.fun[:count]
    size = float(np.sum(left**2)) / max(1, count - parameters)
    slack = correlated(left)
    try:
        told = problem.jacobian(best.x)
        told[:count] /= math.sqrt(size * slack)
        spread = np.linalg.inv(told.T @ told)
    except np.linalg.LinAlgError:
        raise Unfit("the curve does not determine all parameters") from None
    values = problem.values(best.x)
    scale = np.array(problem.scale)
    errors = dict(zip(problem.names, scale * np.sqrt(np.maximum(np.diag(spread), 0.0))))
    for name in ("modulus", "work"):
        if name in errors:
            errors[name] *= values[name]
    at = [problem.names.index(name) for name in ("work", "modulus") if name in problem.names]
    height, base = found.height, problem.baseline(values)
    model_force = np.where(found.contact | (not problem.adhesive), problem.contact(values, height)[0], np.where(found.free, 0.0, np.nan))
    return Fit(model, values, {k: float(e) for k, e in errors.items()}, spread[np.ix_(at, at)], found.noise * math.sqrt(size), slack,
               float(np.sum(left**2)), parameters, count, height, found.force - base(height), model_force, problem.used, base,
               float(best.fun[-1]) if problem.jump else 0.0)


@dataclass
class Compared:
    """The models fitted to the same points of a direction, by name ("maugis 0.4": at this λ), with 2 ln of the ratio of likelihoods of the
    best to each, the one whose curve is shown, and the stated numbers: ln work and ln modulus with their errors.

    of_fit, of_model   standard errors of both logarithms by the noise, and by the spread over the models that the data allow
    parameter          λ and the range of λ that the data allow; NaN if λ is not looked for
    """

    fits: dict[str, Fit]
    stated: Fit
    worse_by: dict[str, float]
    work: float
    modulus: float
    of_fit: tuple[float, float]
    of_model: tuple[float, float]
    parameter: tuple[float, float, float]

    @property
    def excluded(self) -> list[str]:
        """Models that the data exclude."""
        return [name for name, worse in self.worse_by.items() if worse > EXCLUDED]


def compared(indenter: Indenter, found: Regions, stiffness: float, model: str = "auto", range: float | None = None,
             period: float | None = None, parameter: float | None = None) -> Compared:
    """Fits the models that have a closed form for a tip to a direction of a curve. Raises Unfit."""
    known = SHAPES[indenter.shape][1]
    if model == "auto":
        model = "hertz" if not found.dip else "maugis" if "maugis" in known else "jkr" if "jkr" in known else "hertz"
    fits: dict[str, Fit] = {}

    def add(kind: str, lam: float | None = None, near: Fit | None = None) -> None:
        try:
            fits[f"{kind} {lam:g}" if lam else kind] = fit(indenter, kind, found, stiffness, period, range, lam, near)
        except Unfit:
            if kind == model and lam is None:
                raise

    for kind in ("jkr", "dmt") if found.dip else ():
        if kind in known:
            add(kind, near=fits.get("jkr"))
    averaged = model == "maugis" and range is None and parameter is None
    for lam in reversed(PARAMETERS) if averaged else ():
        add("maugis", lam, next(reversed(fits.values()), None) if len(fits) > 2 else fits.get("jkr"))
    if not averaged and model not in fits:
        add(model, parameter, fits.get("jkr"))
    if not fits:
        raise Unfit("no model can be fitted")
    best = min(fits.values(), key=lambda one: one.misfit)
    size = best.slack * best.misfit / max(1, best.points - best.free_parameters)
    unlikely = {name: one.misfit / size + one.jump**2 for name, one in fits.items()}
    worse = {name: one - min(unlikely.values()) for name, one in unlikely.items()}
    names = list(fits) if averaged else [name for name in fits if name.partition(" ")[0] == model]
    weights = np.array([math.exp(-0.5 * (worse[name] - min(worse[one] for one in names))) for name in names])
    weights /= weights.sum()
    logs = np.log([[fits[name].values.get("work", 1.0), fits[name].values["modulus"]] for name in names])
    within = [[fits[name].errors.get("work", 0.0) / fits[name].values.get("work", 1.0), fits[name].errors["modulus"] / fits[name].values["modulus"]]
              for name in names]
    mean = weights @ logs
    of_fit, of_model = np.sqrt(weights @ np.square(within)), np.sqrt(weights @ (logs - mean) ** 2)
    shown = fits[min(names, key=lambda name: worse[name])]
    lam = (math.nan, math.nan, math.nan)
    if averaged:
        scale = {name: {"jkr": 2 * PARAMETERS[-1], "dmt": 0.5 * PARAMETERS[0]}.get(name) or float(name.split()[1]) for name in names}
        allowed = [scale[name] for name in names if worse[name] < EXCLUDED]
        lam = (scale[min(names, key=lambda name: worse[name])], min(allowed), max(allowed))
    elif model == "maugis":
        lam = (shown.values["parameter"],) * 3
    return Compared(fits, shown, worse, float(np.exp(mean[0])) if "work" in shown.values else 0.0, float(np.exp(mean[1])),
                    (float(of_fit[0]), float(of_fit[1])), (float(of_model[0]), float(of_model[1])), lam)
