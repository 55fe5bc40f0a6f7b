#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How often works and losses of quasi-static paths lie within their standard errors (docs/explanation/relaxation.md).

    scenes/validation/works.py [--walls 30] [--atoms 8] [--first 200] [--sites 64] [--out results/works] [--csv FILE]

Walls: scenes of 16 sites, whose modulus, roughness, work and range of an exponential wall are drawn at random, at a held mean height
or a held top. Atoms: surfaces of the paper, by rms height and seed, at the tolerances of the paper's scenes and a smaller one. Works and
losses of approach and pull-off are compared with those of a path at a far smaller tolerance. Prints, for each kind, how many numbers
lie within one and two standard errors, the root mean square of error over standard error, the largest, and the mean standard error and the
root mean square error in meV/Å². Half an hour of one core.
"""
import argparse
import math
import os
import pathlib
import random

import kept
from printed import Printed

import asperity


def soft_wall(number: int) -> dict:
    """Returns the keys of a scene over a soft wall, by its number."""
    draw = random.Random(number)
    return {"surface.sites": 16, "surface.spacing": 10.0, "surface.seed": draw.randint(1, 99),
            "surface.rms": round(draw.uniform(3, 10), 2), "block.young": round(draw.uniform(0.01, 0.08), 4),
            "block.poisson": 0.45, "block.thickness": 16, "interface.kind": "wall",
            "interface.range": round(draw.uniform(5, 15), 2), "interface.adhesion": round(draw.uniform(1, 4), 2),
            "drive.mode": "quasistatic", "drive.control": ("top", "mean-height")[number // 2 % 2],
            "drive.displacement_step": 2.0, "output.fields": [], "output.checkpoint": "none"}


def atoms(sites: int, rms: float, seed: int) -> dict:
    """Returns the keys of a scene of the paper."""
    return {"surface.sites": sites, "surface.rms": rms, "surface.seed": seed, "surface.hurst": 0.8, "surface.rolloff": 3,
            "block.thickness": sites, "drive.mode": "quasistatic", "drive.path": ["approach", "pull-off"],
            "drive.control": "mean-height", "output.fields": [], "output.checkpoint": "none"}


def numbers(run: asperity.Result) -> list[tuple[float, float]]:
    """Returns works and losses of approach and pull-off with their standard errors, meV/Å²."""
    return [(getattr(what, way), getattr(what.uncertainty, way))
            for what in (run.work_of_drive, run.lost) for way in ("approach", "pull_off")]


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--walls", type=int, default=30, help="scenes over soft walls")
    words.add_argument("--atoms", type=int, default=8, help="surfaces of each rms height over atoms")
    words.add_argument("--first", type=int, default=200, help="number of the first scene over a wall")
    words.add_argument("--sites", type=int, default=64, help="sites across the surfaces over atoms")
    words.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/works"))
    words.add_argument("--csv", type=pathlib.Path)
    asked = words.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # few sites
    walls = [soft_wall(number) for number in range(asked.first, asked.first + asked.walls)]
    kinds = [("soft walls", "default", {}, {"drive.tolerance": 5e-6}, walls)]
    for rms in (0.5, 1.0, 1.5, 2.0):
        surfaces = [atoms(asked.sites, rms, seed) for seed in range(1, asked.atoms + 1)]
        kinds += [(f"atoms, rms {rms:g} Å", f"{loose:g}", {"drive.tolerance": loose}, {"drive.tolerance": 2e-5}, surfaces)
                  for loose in (2.5e-3, 1e-3)]
    table = Printed("scenes", "tolerance", "numbers", "within 1", "within 2", "rms of error/standard error", "largest",
                    "mean standard error", "rms error")
    for name, tolerance, loose, tight, scenes in kinds:
        ratios, errors, stated = [], [], []
        for number, keys in enumerate(scenes):
            at = f"{name.replace(' ', '-').replace(',', '')}-{number}"
            runs = [kept.run({}, keys | more, asked.out / f"{at}-{more.get('drive.tolerance', 'default')}") for more in (loose, tight)]
            for (value, error), (exact, _) in zip(numbers(runs[0]), numbers(runs[1])):
                ratios.append(abs(value - exact) / max(error, 1e-9))
                errors.append(abs(value - exact))
                stated.append(error)
        table.add(name, tolerance, f"{len(ratios)}", f"{sum(r <= 1 for r in ratios)}", f"{sum(r <= 2 for r in ratios)}",
                  f"{root_mean_square(ratios):.2f}", f"{max(ratios):.1f}", f"{sum(stated) / len(stated):.2g}", f"{root_mean_square(errors):.2g}")
    table.write(asked.csv)


def root_mean_square(values: list[float]) -> float:
    """Returns the root of the mean of the squares."""
    return math.sqrt(sum(value * value for value in values) / len(values))


if __name__ == "__main__":
    main()
