# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The two force curves of a tip: PYTHONPATH=python python3 docs/gallery/tip.py RESULT_DIRECTORY PICTURE.png

RESULT_DIRECTORY is that of the first command of docs/tutorials/tip.md.
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import asperity
from asperity.plots.style import style
from asperity.plots.tip import force_curve

directory, picture = sys.argv[1:3]
found = asperity.tip(radius="20 nm", young="3 GPa", poisson=0.3, adhesion="50 mJ/m2", stiffness="0.2 N/m", out=directory)
with style():
    figure, axes = plt.subplots(1, 2, figsize=(7.8, 3.2), dpi=110, layout="constrained")
    force_curve(found, axes[0])
    force_curve(found, axes[1], "tip")
    axes[0].set_title("as the instrument shows it")
    axes[1].set_title("less the cantilever's deflection")
    figure.savefig(picture, dpi="figure")
