# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What accuracy costs: errors against processor time."""

from __future__ import annotations

from matplotlib.axes import Axes

from ..cost import Cost
from .style import BLUE, DASHES, GREEN, GREY, PINK, RED, SKY, YELLOW, curve, finish

GROUPS = (("cutoff, tail, precision", ("cutoff", "tail", "precision"), BLUE, "o"),
          ("layers, block model", ("layers", "model"), RED, "s"), ("time step", ("timestep",), GREEN, "^"),
          ("velocity, damping", ("velocity", "damping"), PINK, "D"),
          ("tolerance and step, quasi-static", ("tolerance", "step"), YELLOW, "v"),
          ("the scene as it is", ("scene",), GREY, "X"), ("combinations", ("combination",), SKY, "P"))


def error_against_time(cost: Cost, question: str, ax: Axes) -> bool:
    """The largest error of a question ("state", "path") over the processor time of each setting that was run."""
    rows = [r for r in cost.rows if r.compared and r.error[question] > 0 and r.seconds > 0]
    for label, parameters, colour, marker in GROUPS:
        some = [r for r in rows if r.parameter in parameters]
        if some:
            curve(ax, [r.seconds for r in some], [100 * r.error[question] for r in some], label, colour=colour, line="",
                  marker=marker, filled=marker != "P")
    front = sorted((r.seconds, 100 * r.error[question]) for r in rows if r.front[question])
    if front:
        curve(ax, *zip(*front), "nothing is better in both", colour=GREY, line=DASHES[1], behind=True)
    finish(ax, "processor time (s)", "largest error of γ and contact (%)" if question == "state" else
           "largest error of γ, contact, works and force (%)", log="xy")
    return bool(rows)
