# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Four pictures of a run: python3 plot.py RESULT_DIRECTORY PICTURE.png

Needs h5py and matplotlib (Debian: python3-h5py python3-matplotlib)."""
import json
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

directory, picture = sys.argv[1:3]
result = json.load(open(directory + "/result.json"))
run = h5py.File(directory + "/run.h5", "r")
edge = run["substrate"].attrs["edge"] / 10  # nm
extent = (0, edge, 0, edge)

figure, axes = plt.subplots(2, 2, figsize=(8.4, 7.4), dpi=110, constrained_layout=True)


def show(axis, values, title, label, **options):
    image = axis.imshow(values, origin="lower", extent=extent, interpolation="nearest", **options)
    axis.set_title(title, fontsize=10)
    axis.set_xlabel("nm")
    figure.colorbar(image, ax=axis, label=label, shrink=0.85)


show(axes[0, 0], run["substrate/height"][:], "substrate", "height, Å", cmap="cividis")
fields = run["fields/zero-load"]
pressure = fields["pressure"][:]
limit = np.percentile(np.abs(pressure), 99.5)
show(axes[0, 1], pressure, "normal pressure at zero load (negative: pulled)", "GPa", cmap="RdBu_r",
     vmin=-limit, vmax=limit)
gap = fields["gap"][:]
show(axes[1, 0], gap, f"gap at zero load; {100 * result['contact_fraction']:.1f} % in contact", "Å", cmap="viridis",
     vmax=np.percentile(gap, 99.5))

axis = axes[1, 1]
leg, height, force = (run["series/" + name][:] for name in ("leg", "mean_height", "force"))
area = (10 * edge) ** 2
for value, name, colour in ((0, "approach", "#0072b2"), (1, "pull-off", "#d55e00")):
    chosen = leg == value
    axis.plot(height[chosen], force[chosen] / area * 160.21766, color=colour, label=name, lw=1.2)
axis.axhline(0, color="0.6", lw=0.6)
axis.set_xlabel("mean height of the lowest layer, Å")
axis.set_ylabel("mean normal stress, GPa")
axis.legend(frameon=False, fontsize=9)
axis.set_title(f"binding energy {result['binding_energy']:.1f} of {result['delta_gamma']:.1f} meV/Å²", fontsize=10)
figure.savefig(picture)
