# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Contact regions of a sweep's points on the gap around them, a row a point and a column a state:
PYTHONPATH=python python3 docs/gallery/contact_regions.py SWEEP_DIRECTORY PICTURE.png"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.colors import Normalize, to_rgba

import asperity
from asperity.plots.style import RC, RED

matplotlib.rcParams.update(RC)
directory, picture = sys.argv[1:3]
runs = asperity.load_sweep(directory).results()
states = sorted(runs[0].fields, key=lambda state: state != "relaxed")
figure, axes = plt.subplots(len(runs), len(states), figsize=(5.6, 2.7 * len(runs)), layout="constrained",
                            squeeze=False, sharex=True, sharey=True)
gaps = plt.cm.ScalarMappable(Normalize(0, 25, clip=True), "YlGnBu_r")  # Å
for row, run in zip(axes, runs):
    for axis, state in zip(row, states):
        gap, contact = run.fields[state].gap, run.fields[state].contact
        colours = gaps.to_rgba(gap)
        colours[contact > 0] = to_rgba(RED)
        axis.imshow(colours, origin="lower", extent=(0, run.edge / 10, 0, run.edge / 10), interpolation="nearest")
        when = "zero load" if state == "relaxed" else state.split(":")[1] + " ps later"
        axis.set_title(f"rms {run.key('surface.rms'):g} Å, {when}: {contact.mean():.1%}", fontsize=8)
    row[0].set_ylabel("nm")
for axis in axes[-1]:
    axis.set_xlabel("nm")
figure.colorbar(gaps, ax=axes, label="gap, Å (orange: in contact)", shrink=0.5, extend="max")
figure.savefig(picture, dpi=100)
