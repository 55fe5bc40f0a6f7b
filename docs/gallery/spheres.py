# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Force against height of rough spheres on quasi-static paths, beside Maugis-Dugdale with the renormalised law, of
scenes/paper/small/fig5-quasistatic.toml, and the table of its values of γ (mean ± standard deviation of the surfaces):
PYTHONPATH=python python3 docs/gallery/spheres.py SWEEP_DIRECTORY PICTURE.svg TABLE.csv"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import asperity
from asperity.plots.style import BLUE, GREY, PINK, RED, style
from asperity.theories import combined
from asperity.units import NANONEWTON

directory, picture, table = sys.argv[1:4]
sweep = asperity.load_sweep(directory)
runs = [run for run in sweep.results() if run]
with style():
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.4), layout="constrained")
    for axis, rms in zip(axes, (0, 3, 6)):
        lowest, left, right = 0.0, 1e9, -1e9
        for number, run in enumerate(r for r in runs if r.key("surface.rms") == rms):
            segment, height, force = (run.series[name] for name in ("segment", "mean_height", "force"))
            for which, colour, name in ((0, BLUE, "approach"), (1, RED, "pull-off")):
                axis.plot(height[segment == which], force[segment == which] / NANONEWTON, color=colour, lw=1,
                          label=name if number == 0 else None)
            felt = abs(force) > 0.01 * -force.min()
            lowest, left, right = min(lowest, force.min()), min(left, height[felt].min()), max(right, height[felt].max())
            for label, x, y in combined.sphere_curves(run, force.max()):
                if "renormalised" in label:
                    axis.plot(x, y / NANONEWTON, "--", color=PINK, lw=1.1, zorder=1,
                              label="the same, renormalised law" if number == 0 else None)
                elif "Maugis" in label and number == 0:
                    axis.plot(x, y / NANONEWTON, ":", color=GREY, lw=1.1, label="smooth sphere, Maugis-Dugdale", zorder=1)
        axis.axhline(0, color=GREY, lw=0.5)
        axis.set(title=f"rms {rms} Å", xlabel="mean height above the apex, Å", xlim=(left - 2, right + 3))
        axis.set_ylim(1.6 * lowest / NANONEWTON, -0.4 * lowest / NANONEWTON)
    axes[0].set_ylabel("force, nN (repulsion positive)")
    axes[1].legend(loc="lower right")
    figure.savefig(picture, metadata={"Date": None})


def shown(values, digits):
    deviation = f" ± {np.std(values, ddof=1):.{digits}f}" if np.ptp(values) else ""  # a smooth sphere has no seeds
    return f"{np.mean(values):.{digits}f}{deviation}"


columns = sweep.table
with open(table, "w") as file:
    rows = csv.writer(file, lineterminator="\n")
    rows.writerow(["h_rms, Å", "in", "out", "by energy at zero load", "out over in, %", "lost at instabilities in, eV",
                   "lost at instabilities out, eV"])
    for rms in np.unique(columns["surface.rms"]):
        here = columns["surface.rms"] == rms
        ratios = [columns[f"jkr.{name}_ratio"][here] for name in ("approach", "pull_off", "relaxed")]
        area = runs[0].key("surface.sites")**2 * runs[0].key("surface.spacing")**2 / 1000  # meV/Å² to eV
        lost = [area * columns[f"lost.{name}"][here] for name in ("approach", "pull_off")]
        rows.writerow([f"{rms:g}", *(shown(values, 3) for values in ratios), shown(100 * (ratios[1] / ratios[0] - 1), 1),
                       *(shown(values, 0) for values in lost)])
