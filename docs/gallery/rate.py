# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Pull-off of a rough surface against velocity (docs/data/tables/rate-paper.csv) and G(v) of a crack (rate-crack.csv, the steady
crack of scenes/validation/rate.py, the classical factor): PYTHONPATH=python python3 docs/gallery/rate.py PICTURE.svg"""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scenes/validation"))
import rate  # noqa: E402

from asperity.crack import opening_factor  # noqa: E402
from asperity.plots.style import BLUE, GREEN, GREY, RED, style  # noqa: E402

TABLES = ROOT / "docs/data/tables"


def rows(name):
    with open(TABLES / name, newline="") as table:
        return list(csv.reader(table))[1:]


with style():
    figure, (force, work, crack) = plt.subplots(1, 3, figsize=(9.6, 3.2), layout="constrained")
    elastic, *runs = rows("rate-paper.csv")
    for branches, colour, marker in (("one", BLUE, "o"), ("three", RED, "s")):
        v, pull, out = np.array([(float(r[1]), float(r[2]) / 1e3, float(r[4])) for r in runs if r[0] == branches]).T
        force.plot(v, pull, marker + "-", color=colour, lw=1, ms=4, label=f"{branches} branch{'es' * (branches != 'one')}")
        work.plot(v, out, marker + "-", color=colour, lw=1, ms=4)
    force.axhline(float(elastic[2]) / 1e3, color=GREY, ls="--", lw=1, label="elastic")
    work.axhline(float(elastic[4]), color=GREY, ls="--", lw=1)
    force.set(xscale="log", ylim=(0, None), xlabel="velocity (m/s)", ylabel="pull-off force (µN)")
    force.legend(loc="lower right")
    work.set(xscale="log", ylim=(0, None), xlabel="velocity (m/s)", ylabel="work of the pull-off (meV/Å²)")
    v = np.geomspace(0.01, 1e4, 40)
    crack.plot(v, [rate.steady(x, 300) for x in v], color=GREY, lw=1.2, label="infinite solid, same law")
    crack.plot(v, opening_factor([(rate.RATIO, f"{rate.TIME} ns")], v, "21.8 nm"), ":", color=GREEN, lw=1.4,
               label="Persson and Brener, $a_0$ = 21.8 nm")
    for column, colour, marker, label in ((1, RED, "s", "strip of 64 nm"), (4, BLUE, "o", "strips, as 1/H → 0")):
        some = [(float(r[column]), float(r[0])) for r in rows("rate-crack.csv") if r[column] and float(r[0]) > 1]
        crack.plot(*np.array(some).T, marker, color=colour, ms=4.5, mfc="none", label=label)
    crack.set(xscale="log", ylim=(0, 4.2), xlabel="velocity of the crack (m/s)", ylabel="G / w")
    crack.legend(loc="lower right", fontsize=6.5)
    figure.savefig(sys.argv[1])
