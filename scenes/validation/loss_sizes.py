#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Energy lost on quasi-static paths in boxes of 128 to 1024 sites of one statistical surface (docs/explanation/relaxation.md).

    scenes/validation/loss_sizes.py [--sites 128 256 512 1024] [--out results/loss-sizes] [--csv FILE]

The scene of Fig. 2 with rms 2 Å and a rolloff of three waves on 128 sites: 16 surfaces of 128 sites, 4 of 256, 2 of 512, one of 1024; and the
first of 512 sites at a tenth of the tolerance. Prints for each size the mean losses of approach and pull-off with the standard deviation of
this mean over the surfaces (of one surface none), and the mean standard error that the program states, in meV/Å². Two hours of one core.
"""
import argparse
import math
import os
import pathlib
import statistics

import kept
from printed import Printed

import asperity

ROOT = pathlib.Path(__file__).resolve().parents[2]

SURFACES = {128: 16, 256: 4, 512: 2, 1024: 1}
TOLERANCE, TIGHT = 2.5e-3, {512: 2.5e-4}


def path_over(out: pathlib.Path, sites: int, seed: int, tolerance: float) -> asperity.Result:
    """Returns the path over this surface."""
    return kept.run(ROOT / "scenes/paper/fig2-quasistatic.toml", {
        "surface.rms": 2, "surface.sites": sites, "surface.rolloff": 3 * sites // 128, "surface.seed": seed, "block.thickness": 128,
        "drive.tolerance": tolerance, "output.fields": [], "output.checkpoint": "none"}, out / f"{sites}-{seed}-{tolerance:g}")


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--sites", type=int, nargs="+", choices=SURFACES, default=list(SURFACES))
    words.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/loss-sizes"))
    words.add_argument("--csv", type=pathlib.Path)
    asked = words.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    table = Printed("sites", "tolerance", "surfaces", "lost in", "deviation of mean in", "stated in", "lost out", "deviation of mean out",
                    "stated out")
    kinds = [(sites, TOLERANCE, SURFACES[sites]) for sites in asked.sites]
    kinds += [(sites, TIGHT[sites], 1) for sites in asked.sites if sites in TIGHT]
    for sites, tolerance, surfaces in kinds:
        runs = [path_over(asked.out, sites, seed, tolerance) for seed in range(1, surfaces + 1)]
        cells = []
        for way in ("approach", "pull_off"):
            values = [getattr(run.lost, way) for run in runs]
            deviation = f"{statistics.stdev(values) / math.sqrt(surfaces):.2g}" if surfaces > 1 else ""
            cells += [f"{statistics.mean(values):.3f}", deviation, f"{statistics.mean(getattr(run.lost.uncertainty, way) for run in runs):.2g}"]
        table.add(f"{sites}", f"{tolerance:g}", f"{surfaces}", *cells)
    table.write(asked.csv)


if __name__ == "__main__":
    main()
