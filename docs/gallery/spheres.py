# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Force against height of rough spheres without time, beside Maugis-Dugdale with the renormalised law, of
scenes/paper/small/fig5-quasistatic.toml:
PYTHONPATH=python python3 docs/gallery/spheres.py SWEEP_DIRECTORY PICTURE.svg"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import asperity
from asperity.plots.style import BLUE, GREY, PINK, RED, style
from asperity.units import NANONEWTON

directory, picture = sys.argv[1:3]
runs = [run for run in asperity.load_sweep(directory).results() if run]
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
            for label, x, y in run.curves:
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
