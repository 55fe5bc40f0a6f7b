#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Energy lost on quasi-static paths in boxes of several widths of one statistical surface (docs/explanation/relaxation.md).

    scenes/validation/loss_sizes.py [--block thin thick] [--sites 64 128 256 512] [--out results/loss-sizes] [--csv FILE]

The scene of Fig. 2 with rms 2 Å. Thin: 16 layers of 20 GPa and waves of at most 8 sites (a rolloff of 8 waves on 64 sites), so that nothing
is as large as the box. Thick: 128 layers of the scene's solid and waves of at most 43 sites. Many surfaces of small boxes, few of large ones.
Prints for each size the mean losses of approach and pull-off with the standard deviation of this mean over the surfaces (of one surface none),
and the mean standard error that the program states, in meV/Å². Hours of one core.
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

#: The keys of a block, and the sites of a longest wave.
BLOCKS = {"thin": ({"block.thickness": 16, "block.young": 20}, 8), "thick": ({"block.thickness": 128}, 128 / 3)}
SURFACES = {"thin": {64: 16, 128: 4, 256: 1, 512: 1}, "thick": {128: 16, 256: 4}}
TOLERANCE, TIGHT = 2.5e-3, 2.5e-4


def path_over(out: pathlib.Path, block: str, sites: int, seed: int, tolerance: float) -> asperity.Result:
    """Returns the path over this surface."""
    keys, longest = BLOCKS[block]
    return kept.run(ROOT / "scenes/paper/fig2-quasistatic.toml", keys | {
        "surface.rms": 2, "surface.sites": sites, "surface.rolloff": round(sites / longest), "surface.seed": seed,
        "drive.tolerance": tolerance, "output.fields": [], "output.checkpoint": "none"}, out / f"{block}-{sites}-{seed}-{tolerance:g}")


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--block", nargs="+", choices=BLOCKS, default=list(BLOCKS))
    words.add_argument("--sites", type=int, nargs="+", default=[64, 128, 256, 512])
    words.add_argument("--tight", type=int, nargs="*", default=[128],
                       help="sizes of thin blocks whose first surface is run at a tenth of the tolerance as well")
    words.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/loss-sizes"))
    words.add_argument("--csv", type=pathlib.Path)
    asked = words.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    table = Printed("block", "sites", "tolerance", "surfaces", "lost in", "deviation of mean in", "stated in", "lost out", "deviation of mean out",
                    "stated out")
    kinds = [(block, sites, TOLERANCE, SURFACES[block][sites]) for block in asked.block for sites in asked.sites if sites in SURFACES[block]]
    kinds += [("thin", sites, TIGHT, 1) for sites in asked.tight if "thin" in asked.block]
    for block, sites, tolerance, surfaces in kinds:
        runs = [path_over(asked.out, block, sites, seed, tolerance) for seed in range(1, surfaces + 1)]
        cells = []
        for way in ("approach", "pull_off"):
            values = [getattr(run.lost, way) for run in runs]
            deviation = f"{statistics.stdev(values) / math.sqrt(surfaces):.2g}" if surfaces > 1 else ""
            cells += [f"{statistics.mean(values):.3f}", deviation, f"{statistics.mean(getattr(run.lost.uncertainty, way) for run in runs):.2g}"]
        table.add(block, f"{sites}", f"{tolerance:g}", f"{surfaces}", *cells)
    table.write(asked.csv)


if __name__ == "__main__":
    main()
