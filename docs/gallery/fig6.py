# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Fig. 6 of the paper: python3 fig6.py RUN_AT_3 RUN_AT_9 PICTURE.png

The contact region of the sphere at zero load and 7 Å later, from the maps in run.h5 of two points of fig6.toml or
fig5.toml. Needs h5py, matplotlib and numpy (Debian: python3-h5py python3-matplotlib)."""
import json
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

runs, picture = sys.argv[1:3], sys.argv[3]
figure, axes = plt.subplots(2, 2, figsize=(8.4, 7.6), dpi=80, constrained_layout=True)
reach = 25.0  # Å of gap that the colours tell apart
for row, directory in enumerate(runs):
    result = json.load(open(directory + "/result.json"))
    rms = result["scene"]["surface"]["rms"]
    with h5py.File(directory + "/run.h5", "r") as run:
        edge = run["substrate"].attrs["edge"] / 10  # nm
        later = next(name for name in run["fields"] if name.startswith("after"))
        for column, state in enumerate(("zero-load", later)):
            gap, contact = (run["fields"][state][name][:] for name in ("gap", "contact"))
            axis = axes[row, column]
            colours = plt.get_cmap("YlGnBu_r")(np.clip(gap / reach, 0, 1))
            colours[contact > 0] = matplotlib.colors.to_rgba("#d55e00")
            axis.imshow(colours, origin="lower", extent=(0, edge, 0, edge), interpolation="nearest")
            letter = "abcd"[2 * row + column]
            when = "zero load" if column == 0 else "7 Å later"
            axis.set_title(f"({letter}) rms {rms:g} Å, {when}: {int((contact > 0).sum())} sites in contact", fontsize=9)
            axis.set_xlabel("nm")
scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, reach), "YlGnBu_r")
figure.colorbar(scale, ax=axes, label="gap, Å (orange: in contact)", shrink=0.5, extend="max")
figure.savefig(picture)
