# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The stresses below a coated solid: PYTHONPATH=python python3 docs/gallery/coating.py RESULT_DIRECTORY PICTURE.png

RESULT_DIRECTORY is that of the first command of docs/tutorials/coating.md.
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from asperity.plots.stress import section
from asperity.plots.style import style
from asperity.results.result import Result
from asperity.studies.stress import stresses_in

directory, picture = sys.argv[1:3]
found = stresses_in(Result(Path(directory)))[0]
with style():
    figure, axes = plt.subplots(1, 2, figsize=(8.4, 2.9), dpi=110, layout="constrained")
    section(found, axes[0])
    section(found, axes[1], "tension")
    figure.savefig(picture, dpi="figure")
