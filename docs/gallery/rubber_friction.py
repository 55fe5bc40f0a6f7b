# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Friction and contact of rubber against velocity, with and without adhesion (docs/data/tables/rubber-friction.csv, means over
surfaces and their scatter): PYTHONPATH=python python3 docs/gallery/rubber_friction.py PICTURE.svg"""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from asperity.plots.style import BLUE, GREY, RED, style

with open(Path(__file__).resolve().parents[1] / "data/tables/rubber-friction.csv", newline="") as table:
    rows = np.array([[float(cell) for cell in row] for row in list(csv.reader(table))[1:]])

with style():
    figure, (friction, area) = plt.subplots(1, 2, figsize=(7.2, 3.0), layout="constrained")
    for adhesion, colour, label in ((0, BLUE, "without adhesion"), (10, RED, "10 mJ/m²")):
        v, mu, scatter, contact, spread = rows[rows[:, 0] == adhesion, 1:].T
        friction.errorbar(v, mu, scatter, fmt="o-", color=colour, lw=1, ms=3.5, label=label)
        area.errorbar(v, contact, spread, fmt="o-", color=colour, lw=1, ms=3.5)
    v = np.array([1e-5, 1e-3])
    friction.plot(v, rows[0, 2] * 1.6 * v / v[0], ":", color=GREY, lw=1, label="∝ v")
    friction.set(xscale="log", yscale="log", xlabel="velocity (m/s)", ylabel="friction coefficient μ")
    friction.legend(fontsize=7)
    area.set(xscale="log", ylim=(0, 1.03), xlabel="velocity (m/s)", ylabel="contact A/A$_0$")
    figure.savefig(sys.argv[1])
