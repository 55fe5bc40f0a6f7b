#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How a surface that yields converges up to its hardness, and what it costs beside an elastic one.

    scenes/validation/yielding.py [--maps 20] [--sites 64] [--out results/yielding] [--csv FILE]

Maps are drawn at random: hardness over E* from 0.01 to 0.3, rms slope from 0.02 to 0.5, octaves, every other one with an
attraction of half the hardness. Each is loaded to 0.01, 0.1, 0.5, 0.9 and 0.99 of the hardness and pulled off. Prints the share of
sites at the hardness and the mean set at the largest load, points, iterations and processor time over those of the same path without a
hardness, and the error of the balance of energies. Some minutes of one core.
"""
import argparse
import os
import pathlib
import random
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from printed import Printed  # noqa: E402

import asperity  # noqa: E402


def keys_of(number: int, sites: int) -> tuple[dict, float]:
    """Returns the keys of a map, by its number, and its hardness, GPa."""
    draw = random.Random(number)
    hardness, slope = 10 * 10 ** draw.uniform(-2, -0.523), 10 ** draw.uniform(-1.699, -0.301)
    attraction = "0" if number % 2 == 0 else f"{0.5 * hardness * 2 * 0.1 * 1000:.5g} mJ/m^2"
    return {"surface.sites": sites, "surface.spacing": 2, "surface.q_max": sites // draw.choice((4, 8)),
            "surface.seed": number + 1, "surface.hurst": 0.8, "surface.rms": round(slope * sites * 2 / 25, 4),
            "block.young": "10 GPa", "block.poisson": 0, "interface.kind": "wall", "interface.adhesion": attraction,
            "interface.range": "2 Å", "drive.mode": "quasistatic", "drive.control": "mean-height", "output.fields": [],
            "output.checkpoint": "none"}, hardness


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--first", type=int, default=0)
    words.add_argument("--maps", type=int, default=20)
    words.add_argument("--sites", type=int, default=64)
    words.add_argument("--out", default="results/yielding")
    words.add_argument("--csv", type=pathlib.Path)
    asked = words.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # few sites
    table = Printed("map", "H/E*", "slope", "attraction", "at H", "set/rms", "points", "iterations", "over elastic", "time over elastic",
                    "balance")
    for number in range(asked.first, asked.first + asked.maps):
        keys, hardness = keys_of(number, asked.sites)
        path = [*(f"load {part * hardness * 1000:.8g} MPa" for part in (0.01, 0.1, 0.5, 0.9, 0.99)), "pull-off"]
        runs = [asperity.run({}, keys | {"drive.path": path, "interface.hardness": value}, out=f"{asked.out}/{number}-{name}",
                             progress=False) for name, value in (("yields", f"{hardness:.8g} GPa"), ("elastic", "none"))]
        full = runs[0]["segments"][-2]
        work = [run["run"]["iterations"] for run in runs]
        seconds = [run["run"]["processor_seconds"] for run in runs]
        table.add(f"{number}", f"{hardness / 10:.4f}", f"{runs[0]['surface']['rms_slope']:.4f}",
                     "no" if keys["interface.adhesion"] == "0" else "yes", f"{full['yielding_fraction']:.4f}",
                     f"{full['mean_set'] / runs[0]['surface']['rms']:.4f}", f"{runs[0]['run']['steps']}", f"{work[0]}", f"{work[0] / work[1]:.2f}",
                     f"{seconds[0] / seconds[1]:.2f}", f"{abs(runs[0]['energy']['balance_error']):.1e}")
    table.write(asked.csv)


if __name__ == "__main__":
    main()
