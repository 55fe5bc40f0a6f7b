# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Two rough solids, one on the other: PYTHONPATH=python python3 docs/gallery/pair.py RESULT_DIRECTORY PICTURE.png

RESULT_DIRECTORY is that of the first command of docs/tutorials/ring-and-liner.md.
"""
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from asperity.plots.style import GAP, PRESSURE, style
from asperity.results.result import Result

directory, picture = sys.argv[1:3]
run = Result(Path(directory))
counter, pressure = run.substrate.counter_height, run.fields["relaxed"].pressure
edge = 1e-4 * run.edge  # µm
panels = (("first solid, as measured", run.substrate.height - counter), ("second solid, as measured", counter[:, ::-1]),
          ("second solid, turned over", counter), ("contact", None))
with style():
    figure, axes = plt.subplots(1, 4, figsize=(8.4, 2.5), dpi=110, layout="constrained", sharey=True)
    for ax, (title, heights) in zip(axes, panels):
        box = {"origin": "lower", "extent": (0, edge, 0, edge)}
        if heights is None:
            ax.imshow(run.substrate.height, cmap="Greys_r", alpha=0.5, **box)
            most = np.max(pressure)
            ax.imshow(np.ma.masked_less_equal(pressure, 0), cmap=PRESSURE.with_extremes(bad="none"), vmin=-most, vmax=most, **box)
        else:
            ax.imshow(heights, cmap=GAP, **box)
        ax.set_title(title, fontsize=9)
        ax.set_xlabel("x, µm")
    axes[0].set_ylabel("y, µm")
    for ax, way in ((axes[1], "→"), (axes[2], "←")):  # the mark of x shows the mirror
        ax.annotate(f"x {way}", (0.04, 0.9), xycoords="axes fraction", color="white", fontsize=9,
                    bbox={"boxstyle": "square,pad=0.2", "fc": "black", "lw": 0})
    figure.savefig(picture, dpi="figure")
