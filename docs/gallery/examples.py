# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The pictures of the examples, in the style of the package: PYTHONPATH=python python3 docs/gallery/examples.py [NAME ...]"""
import runpy
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

from asperity.plots.style import style

gallery = Path(__file__).resolve().parent
SITES = {"load_cycles": "32", "slide": "32"}
for script in sorted((gallery.parents[1] / "examples").glob("*.py")):
    if sys.argv[1:] and script.stem not in sys.argv[1:]:
        continue
    given, sys.argv = sys.argv, [str(script), SITES.get(script.stem, "64"), "--plot", str(gallery / f"examples-{script.stem}.svg")]
    with style():
        try:
            runpy.run_path(str(script), run_name="__main__")
        finally:
            sys.argv = given
