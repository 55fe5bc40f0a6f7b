# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Force against height of rough spheres without time, beside Maugis-Dugdale with the renormalised law:
python3 docs/gallery/spheres.py SWEEP_DIRECTORY PICTURE.svg

Of scenes/paper/small/fig5-quasistatic.toml. Needs h5py and matplotlib (Debian: python3-h5py python3-matplotlib)."""
import json
import pathlib
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

directory, picture = sys.argv[1:3]
matplotlib.rcParams.update({"svg.hashsalt": "asperity", "font.size": 9, "axes.linewidth": 0.7, "legend.frameon": False,
                            "xtick.direction": "in", "ytick.direction": "in", "xtick.top": True, "ytick.right": True})
NANONEWTON = 1.602176634  # of an eV/Å
points = [p for p in json.load(open(directory + "/sweep.json"))["points"] if (pathlib.Path(directory) / p["directory"] / "result.json").exists()]
figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.4), constrained_layout=True)
for axis, rms in zip(axes, (0, 3, 6)):
    chosen = [p for p in points if p["set"]["surface.rms"] == rms]
    lowest, left, right = 0.0, 1e9, -1e9
    for number, point in enumerate(chosen):
        with h5py.File(f"{directory}/{point['directory']}/run.h5") as run:
            leg, height, force = (run["series/" + n][:] for n in ("leg", "mean_height", "force"))
            for which, colour, name in ((0, "#0072b2", "approach"), (1, "#d55e00", "pull-off")):
                axis.plot(height[leg == which], force[leg == which] * NANONEWTON, color=colour, lw=1,
                          label=name if number == 0 else None)
            felt = abs(force) > 0.01 * -force.min()
            lowest, left, right = min(lowest, force.min()), min(left, height[felt].min()), max(right, height[felt].max())
            for key, line, colour, name in (("maugis_images", ":", "0.4", "smooth sphere, Maugis-Dugdale"),
                                            ("renormalised", "--", "#cc79a7", "the same, renormalised law")):
                if key in run["curves"] and (key != "maugis_images" or number == 0):
                    curve = run["curves"][key]
                    axis.plot(curve["height"][:], curve["force"][:] * NANONEWTON, line, color=colour, lw=1.1,
                              label=name if number == 0 else None, zorder=1)
    axis.axhline(0, color="0.6", lw=0.5)
    axis.set(title=f"rms {rms} Å", xlabel="mean height above the apex, Å", xlim=(left - 2, right + 3))
    axis.set_ylim(1.6 * lowest * NANONEWTON, -0.4 * lowest * NANONEWTON)
axes[0].set_ylabel("force, nN (repulsion positive)")
axes[1].legend(fontsize=7.5, loc="lower right")
figure.savefig(picture, metadata={"Date": None})
