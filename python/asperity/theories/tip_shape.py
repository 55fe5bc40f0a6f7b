# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The surface of a rigid tip that is no sphere: a cone or a pyramid of four sides with a rounded end, or a measured map.

A cone or pyramid is rounded by a ball that touches its flanks: the tip rises over its apex, at a place p, by the largest of
    g·p - R (√(1 + g²) - 1)
over all slopes g that the sharp tip has: a disc of the radius cot α of a cone, the square with the corners (±cot θ, 0) and (0, ±cot θ)
of a pyramid. Contact radius and force are those of JKR for the body of revolution with the rise averaged around the axis (Sneddon):
    δ_H = a ∫ f'(a sin t) dt,    F_H = 2E* ∫ (a sin t)² f'(a sin t) dt,    0 < t < π/2,
    δ = δ_H - √(2πwa/E*),        F = F_H - √(8πwE*a³).

Lengths in nm, forces in nN, moduli in GPa, works in N/m.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.interpolate import RectBivariateSpline

from ..errors import SceneError

SHAPES = ("sphere", "cone", "pyramid")
"""Tips that are described by a radius and, but for the sphere, the angle between the axis and a flank."""
STEEPEST = 0.75
"""Largest slope of a tip at the edge of its contact: that of a sphere at 0.6 of its radius."""
AROUND = 24
"""Directions over which a rise is averaged."""
POINTS = 300
"""Radii of a table of rises and contacts."""


@dataclass(frozen=True)
class TipShape:
    """A tip that is no sphere: "cone", "pyramid" or "measured", the radius of its end, the slope of its flanks over the sample, and the
    heights of a measured tip over the place beside its apex, within a square of this half width."""

    shape: str
    radius: float
    slope: float = math.inf
    measured: RectBivariateSpline | None = field(default=None, compare=False)
    half: float = math.inf

    @property
    def words(self) -> str:
        """The tip in words."""
        if self.shape in ("cone", "pyramid"):
            return f"{self.shape} of {math.degrees(math.atan(1 / self.slope)):.4g}° with an end of {self.radius:.4g} nm"
        return f"measured tip with an end of {self.radius:.4g} nm"

    def saved(self) -> dict[str, float | str | None]:
        """Returns the shape as JSON has it, without a map; loaded() reads it."""
        return {"shape": self.shape, "radius": self.radius, **{name: value if math.isfinite(value) else None
                                                              for name, value in (("slope", self.slope), ("half", self.half))}}

    @classmethod
    def loaded(cls, saved: Mapping[str, Any]) -> TipShape:
        """Returns the shape that saved() wrote; a measured tip has no map."""
        slope, half = (math.inf if saved[name] is None else saved[name] for name in ("slope", "half"))
        return cls(saved["shape"], saved["radius"], slope, half=half)

    def rise(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Returns the rise of the tip over its apex at places beside the axis. Raises SceneError without the map of a measured tip."""
        if self.measured is not None:
            return -self.measured.ev(y, x)
        if self.shape == "measured":
            raise SceneError("the tip", "is measured, and its map is not loaded", "", "call tip() again, which runs nothing twice")
        R, s = self.radius, self.slope
        u, v = np.maximum(np.abs(x), np.abs(y)), np.minimum(np.abs(x), np.abs(y))
        with np.errstate(invalid="ignore", divide="ignore"):
            root = np.sqrt(R * R - u * u - v * v)
            ball = R - root
            if self.shape == "cone":
                flank = s * np.hypot(u, v) - R * (math.sqrt(1 + s * s) - 1)
                return np.where(np.hypot(u, v) < R * s / math.sqrt(1 + s * s), ball, flank)
            # The largest on a side of the square: g = s (1/2 + t, 1/2 - t).
            q = (u - v) / (2 * s * R)
            t = np.where(2 * (s * q) ** 2 < 1, q * math.sqrt(1 + s * s / 2) / np.sqrt(1 - 2 * (s * q) ** 2), 0.5)
            t = np.minimum(t, 0.5)
            flank = s * ((u + v) / 2 + t * (u - v)) - R * (np.sqrt(1 + s * s * (0.5 + 2 * t * t)) - 1)
            return np.where((root > 0) & (u + v < s * root), ball, flank)

    def mean_rise(self, r: np.ndarray) -> np.ndarray:
        """Returns the rise at distances from the axis, averaged around it."""
        angle = 2 * np.pi * (np.arange(AROUND) + 0.5) / AROUND
        return self.rise(np.outer(r, np.cos(angle)), np.outer(r, np.sin(angle))).mean(axis=1)

    def curvature_radius(self, r: float) -> float:
        """Returns the radius of the paraboloid that rises as much at this distance from the axis."""
        r = min(r, self.half)
        return r * r / (2 * float(self.mean_rise(np.array([r]))[0]))

    @property
    def widest(self) -> float:
        """Largest contact radius whose edge is gently sloped; infinite if all of the tip is."""
        if self.measured is None:
            return math.inf if self.slope <= STEEPEST else self.radius * STEEPEST / math.sqrt(1 + STEEPEST**2)
        r = np.linspace(0, self.half, POINTS)
        steep = np.flatnonzero(np.gradient(self.mean_rise(r), r) > STEEPEST)
        return float(r[steep[0]]) if len(steep) else self.half

    def contact(self, modulus: float, work: float, most: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns contact radius, depth and force by JKR, from no contact to one that holds a force of at least `most`, or to where
        the tip ends. modulus: E*."""
        turn = (np.arange(POINTS) + 0.5) * 0.5 * np.pi / POINTS
        largest = min(4 * float(np.cbrt(self.radius**2 * work / modulus)) + self.radius, 0.99 * self.half)
        while True:
            a = largest * np.linspace(0, 1, POINTS) ** 1.5
            r = np.linspace(0, largest, 4 * POINTS)
            slopes = np.gradient(self.mean_rise(r), r)
            at = np.outer(a, np.sin(turn))
            slope = np.interp(at, r, slopes)
            width = 0.5 * np.pi / POINTS
            depth = a * slope.sum(axis=1) * width - np.sqrt(2 * np.pi * work * a / modulus)
            force = 2 * modulus * (at**2 * slope).sum(axis=1) * width - np.sqrt(8 * np.pi * work * modulus * a**3)
            if force[-1] >= most or largest >= 0.99 * self.half:
                return a, depth, force
            largest = min(1.6 * largest, 0.99 * self.half)


def measured_tip(heights: np.ndarray, pixel: float) -> tuple[TipShape, list[str]]:
    """Makes a tip of a map.

    Parameters
    ----------
    heights : np.ndarray
        Square map of the tip's heights, nm, without missing points; the apex is its highest point, or the lowest.
    pixel : float
        Width of a pixel, nm.

    Returns
    -------
    tuple[TipShape, list[str]]
        The tip, whose radius is that of the paraboloid that is fitted to its end, and notes.
    """
    notes, count = [], len(heights)
    inner = slice(count // 4, -(count // 4))
    if np.mean(np.concatenate([heights[[0, -1]].ravel(), heights[:, [0, -1]].ravel()])) > np.mean(heights[inner, inner]):
        heights = -heights
        notes.append("the apex of the tip is the lowest point of its map, which is turned over")
    row, column = np.unravel_index(int(np.argmax(heights)), heights.shape)
    near = max(3, count // 20)  # the apex is that of a paraboloid: the highest point may be noise
    y, x = np.mgrid[max(0, row - near):min(count, row + near + 1), max(0, column - near):min(count, column + near + 1)]
    terms = np.stack([one.ravel() for one in (np.ones_like(x), x, y, x * x + y * y)], axis=1).astype(float)
    flat, by_x, by_y, bend = np.linalg.lstsq(terms, heights[y, x].ravel(), rcond=None)[0]
    if bend < 0:
        column, row = (float(np.clip(-0.5 * by / bend, low - near, low + near)) for by, low in ((by_x, column), (by_y, row)))
    top = float(flat - 0.25 * (by_x**2 + by_y**2) / bend) if bend < 0 else float(heights.max())
    half = min(row, column, count - 1 - row, count - 1 - column) * pixel
    spline = RectBivariateSpline((np.arange(count) - row) * pixel, (np.arange(count) - column) * pixel, heights - top)
    radius = -0.5 * pixel * pixel / bend if bend < 0 else math.inf
    return TipShape("measured", float(radius), measured=spline, half=float(half)), notes
