# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Four pictures of a run: PYTHONPATH=python python3 docs/gallery/plot.py RESULT_DIRECTORY PICTURE.png"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import asperity
from asperity.plots.style import style
from asperity.units import MILLIJOULE

directory, picture = sys.argv[1:3]
run = asperity.load(directory)
with style():
    figure, axes = plt.subplots(2, 2, figsize=(7.8, 6.4), dpi=110, layout="constrained")
    run.plot.height(axes[0, 0]).set_title("substrate")
    run.plot.map("pressure", axes[0, 1]).set_title("pressure at zero load")
    run.plot.map("gap", axes[1, 0]).set_title(f"gap at zero load, {run.contact_fraction:.1%} in contact")
    run.plot.separation(axes[1, 1]).set_title(
        f"binding energy {run.binding_energy:.1f} of {run.delta_gamma:.1f} meV/Å² ({MILLIJOULE * run.binding_energy:.0f} mJ/m²)")
    figure.savefig(picture, dpi="figure")
