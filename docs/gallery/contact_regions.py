# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Contact regions of a sweep's points on the gap around them, a row a point and a column a state:
python3 contact_regions.py SWEEP_DIRECTORY PICTURE.png

Needs h5py and matplotlib (Debian: python3-h5py python3-matplotlib)."""
import json
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.colors import Normalize

directory, picture = sys.argv[1:3]
points = json.load(open(directory + "/sweep.json"))["points"]
runs = [h5py.File(f"{directory}/{point['directory']}/run.h5") for point in points]
states = sorted(runs[0]["fields"], key=lambda state: state != "zero-load")
figure, axes = plt.subplots(len(runs), len(states), figsize=(7.2, 3.5 * len(runs)), dpi=80, constrained_layout=True,
                            squeeze=False, sharex=True, sharey=True)
gaps = plt.cm.ScalarMappable(Normalize(0, 25, clip=True), "YlGnBu_r")  # Å
for row, (point, run) in enumerate(zip(points, runs)):
    edge = run["substrate"].attrs["edge"] / 10  # nm
    for axis, state in zip(axes[row], states):
        gap, contact = (run["fields"][state][name][:] for name in ("gap", "contact"))
        colours = gaps.to_rgba(gap)
        colours[contact > 0] = (0.84, 0.37, 0, 1)
        axis.imshow(colours, origin="lower", extent=(0, edge, 0, edge), interpolation="nearest")
        when = "zero load" if state == "zero-load" else state.split(":")[1] + " ps later"
        axis.set_title(f"rms {point['set']['surface.rms']:g} Å, {when}: {100 * contact.mean():.1f} %", fontsize=10)
    axes[row][0].set_ylabel("nm")
for axis in axes[-1]:
    axis.set_xlabel("nm")
figure.colorbar(gaps, ax=axes, label="gap, Å (orange: in contact)", shrink=0.5, extend="max")
figure.savefig(picture)
