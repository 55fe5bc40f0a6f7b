#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""collect.py DIR KEY QUANTITY: the runs below DIR as one table and one plot.

    python3 docs/slurm/collect.py results/study surface.seed binding_energy

KEY is a number of the scenes, QUANTITY one of result.json (docs/reference/result.md). Writes DIR/collected.csv and
DIR/collected.png, a point for each run, with mean and standard deviation at each value of KEY.
"""

import csv
import sys
from pathlib import Path

import matplotlib

import asperity

matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator

if len(sys.argv) != 4:
    sys.exit(__doc__)
place, key, quantity = Path(sys.argv[1]), sys.argv[2], sys.argv[3]
rows = []
for file in sorted(place.glob("**/result.json")):
    run = asperity.load(file.parent)
    value = run.number(quantity)
    if value is None:
        print(f"left out: {file.parent} has no {quantity} ({run.stopped or 'failed or not computed'})")
        continue
    at = run.number("scene." + key)
    if at is None:
        sys.exit(f"{file.parent}: its scene has no number {key}; for example surface.seed")
    rows.append((at, value, file.parent.name))
if not rows:
    sys.exit(f"{place}: no run has {quantity}")
rows.sort()
unit = run.unit(quantity)
with open(place / "collected.csv", "w", newline="") as table:
    csv.writer(table).writerows([(key, f"{quantity} ({unit})", "run"), *rows])

at, values = np.array([row[:2] for row in rows]).T
for x in np.unique(at):
    here = values[at == x]
    if len(here) > 1:
        plt.errorbar(x, here.mean(), here.std(ddof=1), fmt="_", color="0.6", capsize=4)
plt.plot(at, values, "o")
if all(x.is_integer() for x in at):
    plt.gca().xaxis.set_major_locator(MaxNLocator(integer=True))
plt.xlabel(key)
plt.ylabel(f"{quantity}, {unit.replace('^2', '²')}")
plt.title(f"{len(rows)} runs: {values.mean():.4g} ± {values.std(ddof=1) if len(rows) > 1 else 0:.2g}")
plt.savefig(place / "collected.png", dpi=150)
print(f"{len(rows)} runs: {place}/collected.csv, {place}/collected.png")
