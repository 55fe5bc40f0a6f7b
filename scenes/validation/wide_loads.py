#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What a quasi-static path to many loads costs beside one to the largest alone (docs/explanation/relaxation.md).

    scenes/validation/wide_loads.py [--first 0] [--scenes 12] [--out results/wide-loads]

Scenes are drawn at random: sites, roughness, Hurst exponent, some on a sphere, modulus, and an exponential wall, two of three
without attraction. Loads, one in each decade, over two to four decades below a twentieth of the modulus, are taken one after the
other, and up and down again. Prints points, iterations over those of the largest load alone, and the largest relative
distance of a pressure from its load. A minute of one core.
"""
import argparse
import os
import pathlib
import random
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402


def scene(number: int) -> tuple[dict, list[float]]:
    """The keys of a scene, by its number, and its loads, MPa."""
    draw = random.Random(number)
    young, sites = round(10 ** draw.uniform(0, 2), 2), draw.choice((32, 48, 64))
    keys = {"surface.sites": sites, "surface.q_max": sites // 4, "surface.seed": draw.randint(1, 99),
            "surface.rms": round(draw.uniform(0.5, 4), 2), "surface.hurst": round(draw.uniform(0.5, 0.9), 2),
            "block.young": f"{young} GPa", "block.thickness": sites // draw.choice((1, 2)), "interface.kind": "wall",
            "interface.adhesion": 0 if number % 3 else f"{draw.uniform(5, 30):.1f} mJ/m^2",
            "interface.range": f"{draw.uniform(2, 6):.1f} Å",
            "drive.mode": "quasistatic", "drive.control": ("top", "mean-height")[number % 2], "output.fields": [],
            "output.checkpoint": "none"}
    if number % 4 == 3:
        keys["surface.radius"] = f"{draw.uniform(20, 60):.0f} nm"
    largest = 50 * young
    return keys, [largest * 10.0**-k for k in range(draw.choice((2, 3, 4, 4)), -1, -1)]


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--first", type=int, default=0)
    words.add_argument("--scenes", type=int, default=12)
    words.add_argument("--out", default="results/wide-loads")
    asked = words.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # few sites
    print("scene  attraction  decades  points: largest, up, up and down   iterations: largest, up/, up and down/   pressure off by")
    for number in range(asked.first, asked.first + asked.scenes):
        keys, up = scene(number)
        runs, off = [], 0.0
        for name, loads in (("largest", up[-1:]), ("up", up), ("back", up + up[-2::-1])):
            run = asperity.run({}, keys | {"drive.path": [f"load {p:.6g} MPa" for p in loads]}, out=f"{asked.out}/{number}-{name}",
                               progress=False)
            ends = [segment["pressure"] for segment in run["segments"]]
            off = max(off, *(abs(end / p - 1.0) for end, p in zip(ends, loads)))
            runs.append(run["run"])
        points = [run["steps"] for run in runs]
        work = [run["iterations"] for run in runs]
        print(f"{number:5}  {'yes' if keys['interface.adhesion'] else 'no':10}  {len(up) - 1:7}  {points[0]:8} {points[1]:8} {points[2]:8}"
              f"  {work[0]:22} {work[1] / work[0]:6.2f} {work[2] / work[0]:6.2f}  {off:22.0e}", flush=True)


if __name__ == "__main__":
    main()
