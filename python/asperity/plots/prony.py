# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The plot of a master curve beside the branches that were fitted to it."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..studies.prony import Prony
from .style import BLUE, RED, curve, drawn_into, finish


def moduli(found: Prony, ax: Axes) -> bool:
    """Draws storage and loss modulus over frequency: measured as points, fitted as lines."""
    over = np.geomspace(found.frequency[0], found.frequency[-1], 300)
    fitted = 1e3 * found.modulus(over)
    for words, measured, line, colour, marker in (("storage modulus $E'$", found.storage, fitted.real, BLUE, "o"),
                                                  ("loss modulus $E''$", found.loss, fitted.imag, RED, "s")):
        curve(ax, found.frequency, 1e3 * measured, words, colour=colour, line="", marker=marker, filled=False)
        curve(ax, over, line, f"{len(found.prony)} branches", colour=colour)
    return finish(ax, "angular frequency $ω$ (rad/s)", "modulus (MPa)", log="xy")


def draw(found: Prony, ax: Axes | None) -> Axes:
    """Draws moduli() into axes, new ones by default. Raises InputOutputError."""
    return drawn_into(ax, lambda a: moduli(found, a), found.source, "moduli", "it has no branches")
