# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The figure of heights and displacements: PYTHONPATH=python python3 docs/gallery/geometry.py"""
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from asperity.plots.style import style

SITES = 26
x = np.arange(SITES)
height = 1.0 * np.sin(2 * np.pi * x / 13) + 0.45 * np.sin(2 * np.pi * x / 5.2 + 1)
height -= height.mean()
lowest = 3.6 + 0.35 * np.interp(x + 0.5, x, height)
mean, layers, top = lowest.mean(), 4, 11.6


def arrow(axis, at, low, high, text, side="left"):
    axis.annotate("", (at, high), (at, low), arrowprops={"arrowstyle": "<->", "lw": 1})
    axis.text(at + (0.3 if side == "left" else -0.3), (low + high) / 2, text, ha=side, va="center", fontsize=8)


with style():
    figure, axis = plt.subplots(figsize=(7.2, 4.3), layout="constrained")
    axis.scatter(x, height, s=60, color="0.45", zorder=3)
    axis.scatter(x + 0.5, lowest, s=42, color="C0", zorder=3)
    for n in range(1, layers):
        axis.scatter(x + 0.5, mean + 1.9 * n + 0.35 * 0.55**n * (lowest - mean) / 0.35, s=20, color="C0", alpha=0.55)
    axis.plot([-0.7, SITES], [top, top], lw=5, color="0.25", solid_capstyle="butt")
    axis.plot([-0.7, SITES], [0, 0], ls="--", lw=0.8, color="0.4")
    axis.plot([-0.7, SITES], [mean, mean], ls="--", lw=0.8, color="C0")
    axis.plot([SITES, SITES + 8], [14.4, 14.4], ls=":", lw=1, color="0.25")
    arrow(axis, SITES + 1.0, 0, mean, "mean height")
    arrow(axis, SITES + 1.0, mean, top, "block.thickness,\nin layers")
    arrow(axis, SITES + 1.0, top, 14.4, "top displacement,\nnegative on the way down")
    at = 16
    arrow(axis, at + 0.5, np.interp(at + 0.5, x, height), lowest[at], "gap of a site")
    axis.text(-0.9, 0, "height 0:\nmean plane\nof the map", ha="right", va="center", fontsize=8)
    axis.text(-0.9, mean, "lowest layer\n(sites)", ha="right", va="center", fontsize=8)
    axis.text(-0.9, top, "top plane\n(rigid, driven)", ha="right", va="center", fontsize=8)
    axis.text(-0.9, 14.4, "top plane\nat the start", ha="right", va="center", fontsize=8)
    axis.plot([-0.7, SITES], [14.4, 14.4], ls=":", lw=1, color="0.25")
    axis.text(SITES / 2, -2.6, "rigid substrate: its atoms are below the corners between four sites", ha="center",
              va="center", fontsize=8)
    axis.set(xlim=(-6.5, SITES + 10), ylim=(-3.4, 15.4))
    axis.axis("off")
    figure.savefig(Path(__file__).with_name("geometry.svg"), metadata={"Date": None})
