# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The force curve of a tip in the form of an instrument."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..studies.tip import Tip
from ..theories.sphere import jkr
from .style import BLUE, GREY, RED, curve, finish


def force_curve(found: Tip, ax: Axes, over: str = "drive") -> bool:
    """Draws the force over the displacement, for approach and retraction."""
    place = found.drive if over == "drive" else found.tip
    for words, part, colour in (("approach", ~found.retracting, BLUE), ("retraction", found.retracting, RED)):
        shown = part & (np.abs(place) < _extent(found, place))
        curve(ax, place[shown], found.force[shown], words, colour=colour, marker="")
    if over == "tip" and not found.fit.failed:
        a = np.linspace(0.5, 4, 400)
        force, _, approach = jkr(a)
        stiffness, unit = 4 / 3 * found.fit.modulus, np.pi * found.fit.work * found.contact.radius
        length = np.cbrt(unit * found.contact.radius / stiffness)
        height, force = found.fit.zero - approach * length**2 / found.contact.radius, unit * force
        shown = (force < found.force.max()) & (np.arange(len(a)) >= np.argmin(approach))
        curve(ax, height[shown], force[shown], "JKR, fitted", colour=GREY, line="--", marker="")
    return finish(ax, f"separation by the {over} (nm)", "force on the sample (nN)")


def indentation(found: Tip, ax: Axes) -> bool:
    """Draws the force over the depth of a sample that yields, with what Oliver and Pharr fit to the unloading."""
    shown = found.tip < _extent(found, found.tip) / 4
    for words, part, colour in (("loading", ~found.retracting, BLUE), ("unloading", found.retracting, RED)):
        curve(ax, -found.tip[part & shown], found.force[part & shown], words, colour=colour, marker="")
    if (read := found.unloading) is not None and not read.failed:
        top = int(np.argmax(found.force))
        deepest, most = -found.tip[top], found.force[top]
        depth = np.linspace(max(read.fitted_depth, deepest - 1.5 * most / read.slope), deepest, 100)
        at_top = read.slope * (deepest - read.fitted_depth) / read.exponent
        law = at_top * ((depth - read.fitted_depth) / (deepest - read.fitted_depth)) ** read.exponent
        curve(ax, depth, law, "power law, fitted", colour=GREY, line="--", marker="")
        line = np.array([deepest - most / read.slope, deepest])
        curve(ax, line, most + read.slope * (line - deepest), "slope", colour=GREY, line=":", marker="")
    return finish(ax, "depth (nm)", "force on the sample (nN)")


def _extent(found: Tip, place: np.ndarray) -> float:
    """Returns the largest separation to be drawn, nm, somewhat beyond the range of the contact."""
    touching = np.abs(found.force) > 0.002 * np.abs(found.force).max()
    return 1.15 * float(np.abs(place[touching]).max())
