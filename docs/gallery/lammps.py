#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The speeds of docs/reports/lammps.md as bars: python3 docs/gallery/lammps.py

Reads docs/data/tables/lammps-speed.csv, writes lammps.svg beside itself. Needs matplotlib (Debian: python3-matplotlib)."""
import csv
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

here = Path(__file__).resolve().parent
rows = list(csv.reader(open(here.parent / "data/tables/lammps-speed.csv")))[1:]
plt.rcParams.update({"font.size": 9, "svg.hashsalt": "asperity", "svg.fonttype": "none"})
figure, ax = plt.subplots(figsize=(7.2, 2.8), layout="constrained")
for number, (column, label) in enumerate(((2, "one core"), (4, "two cores"))):
    bars = [(i + 0.36 * (number - 0.5), float(row[column])) for i, row in enumerate(rows) if row[column]]
    ax.barh(*zip(*bars), 0.36, label=label)
ax.set_yticks(range(len(rows)), [row[0].replace("`", "") for row in rows])
ax.invert_yaxis()
ax.set_xlabel("wall time for a mobile atom and step, median, ns")
ax.legend()
figure.savefig(here / "lammps.svg", metadata={"Date": None})
