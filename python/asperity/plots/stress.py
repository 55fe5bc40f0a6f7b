# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Stresses below the surface: a vertical section, a level, and the largest stresses over depth."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..studies.stress import MEASURES, Stress, largest_tension, von_mises
from .style import BLUE, GAP, GREY, INK, PAPER, PRESSURE, RED, SKY, curve, drawn, finish, image


def unit(found: Stress) -> tuple[float, str]:
    """Returns divisor and name of the unit of stresses."""
    largest = max(abs(one.value) for one in found.largest)
    return next(((s, name) for s, name in ((1.0, "GPa"), (1e-3, "MPa")) if largest >= 0.1 * s), (1e-6, "kPa"))


DRAWN = {"von_mises": (von_mises, "von Mises", GAP), "tension": (largest_tension, "largest principal stress", PRESSURE)}


def section(found: Stress, ax: Axes, measure: str = "von_mises") -> bool:
    """Draws a measure in the vertical plane through its largest value; the surface is below, the block above."""
    compute, words, cmap = DRAWN[measure]
    scale, name = unit(found)
    values = compute(found.section if measure == "von_mises" else found.tension_section) / scale
    wide, deep = 0.1 * found.edge, 0.1 * float(found.depth[-1])
    low, high = float(values.min()), float(values.max())
    if cmap is PRESSURE:  # the tension counts; compression may be beyond the scale
        high = high if high > 0 else -low
        low = -high
    step = 0.5 * deep / max(1, len(found.depth) - 1)
    shown = ax.imshow(values, origin="lower", extent=(0, wide, -step, deep + step), aspect="auto", cmap=cmap, vmin=low, vmax=high,
                      interpolation="bilinear")
    for top in (0.1 * layer[0] for layer in found.layers[1:]):
        if top < deep:
            ax.axhline(top, color=PAPER if cmap is GAP else INK, linewidth=0.8, linestyle="--")
    at = max((one for one in found.largest if one.measure == measure), key=lambda one: one.value)
    if 0.1 * at.depth <= deep:
        ax.plot(0.1 * at.x, 0.1 * at.depth, marker="+", color=RED if cmap is GAP else INK, markersize=7, markeredgewidth=1.4)
    ax.tick_params(which="both", direction="out", top=False, right=False)
    finish(ax, "x (nm)", "depth (nm)", legend=False)
    ax.figure.colorbar(shown, ax=ax, label=f"{words} ({name})", aspect=25, extend="neither" if low <= values.min() else "min")
    kept = drawn(ax)
    kept.map, kept.unit = values, name
    return True


def level(found: Stress, ax: Axes) -> bool:
    """Draws the stress of von Mises at the depth at which it is largest, from above."""
    scale, name = unit(found)
    return image(ax, von_mises(found.map) / scale, found.edge, label=f"von Mises ({name})", cmap=GAP)


def profile(found: Stress, ax: Axes) -> bool:
    """Draws the largest stresses at each depth, with the largest of all and their errors."""
    scale, name = unit(found)
    for (measure, words), colour in zip(MEASURES.items(), (BLUE, SKY, RED)):
        curve(ax, 0.1 * found.profile_depth, found.profile[measure] / scale, words, colour=colour)
        stated = [one for one in found.largest if one.measure == measure and one.error is not None]
        if stated:
            curve(ax, [0.1 * one.depth for one in stated], [one.value / scale for one in stated], colour=colour, line="", marker="o",
                  spread=np.array([one.error for one in stated]) / scale)
    for top, _ in found.layers[1:]:
        ax.axvline(0.1 * top, color=GREY, linewidth=0.8, linestyle="--", zorder=1)
    return finish(ax, "depth (nm)", f"largest stress ({name})", log="x", zero=True)
