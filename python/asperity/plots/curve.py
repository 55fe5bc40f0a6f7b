# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Measured force curves with their fits, residuals, and histogram and map of many."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..studies.curves import Curves, FittedCurve
from .style import BLUE, GREY, RED, curve, finish

COLOURS = {"approach": BLUE, "retraction": RED}


def with_fit(found: FittedCurve, ax: Axes) -> bool:
    """Draws the force of both directions over the height of the drive, less the baseline, with the stated fits."""
    contact = [one.stated.values["contact"] for one in found.fits.values()][0]
    for way, one in found.fits.items():
        fit = one.stated
        curve(ax, fit.height - contact, fit.force, way, colour=COLOURS[way], line="", marker=".", behind=True)
        shown = np.where(fit.used, fit.fitted, np.nan)
        name = fit.model.upper() if len(fit.model) == 3 else fit.model.title()
        curve(ax, fit.height - contact, shown, f"{name}, {way}", colour=GREY if way == "approach" else "k", line="--" if way == "approach" else "-")
    near = max(3.0 * abs(float(fit.height.min()) - contact) for fit in (one.stated for one in found.fits.values()))
    ax.set_xlim(min(float(one.stated.height.min()) for one in found.fits.values()) - contact - 0.03 * near, near)
    return finish(ax, "height of the drive over the point of contact (nm)", "force on the sample (nN)")


def with_simulation(found: Curves, ax: Axes) -> bool:
    """Draws the first curve with its fits, and the simulated contact of the fitted tip."""
    one, simulated = found.curves[0], found.simulated
    with_fit(one, ax)
    if simulated is not None:
        for words, part, colour in (("approach", ~simulated.retracting, "c"), ("retraction", simulated.retracting, "m")):
            curve(ax, simulated.drive[part], simulated.force[part], f"simulated, {words}", colour=colour, marker="")
    return finish(ax, "height of the drive over the point of contact (nm)", "force on the sample (nN)")


def residuals(found: FittedCurve, ax: Axes) -> bool:
    """Draws the residuals of the stated fits over their noise."""
    for way, one in found.fits.items():
        fit = one.stated
        curve(ax, fit.height - fit.values["contact"], np.where(fit.used, (fit.force - fit.fitted) / fit.noise, np.nan), way, colour=COLOURS[way],
              line="", marker=".")
    return finish(ax, "height of the drive over the point of contact (nm)", "residual over noise", zero=True)


def histogram(found: Curves, path: str, ax: Axes) -> bool:
    """Draws how a number is distributed over the curves. Returns False if fewer than three have it."""
    values = found.values(path)
    values = values[np.isfinite(values)]
    if len(values) < 3:
        return False
    number = found.number(path)
    counts, edges = np.histogram(values, bins=max(5, int(np.sqrt(len(values)))))
    curve(ax, np.repeat(edges, 2)[1:-1], np.repeat(counts, 2), f"{len(values)} curves")
    return finish(ax, f"{number.name} ({number.unit})", "curves")


def over_places(found: Curves, path: str, ax: Axes) -> bool:
    """Draws a number at the places of the curves. Returns False if the places are not known or one."""
    places = [one.measured.place for one in found.curves]
    if len(places) < 3 or any(place is None for place in places) or len(set(places)) < 3:
        return False
    number, (x, y) = found.number(path), np.array(places, float).T
    points = ax.scatter(x, y, c=found.values(path), marker="s", cmap="viridis")
    ax.figure.colorbar(points, ax=ax, label=f"{number.name} ({number.unit})")
    return finish(ax, "x (µm)", "y (µm)", legend=False)
