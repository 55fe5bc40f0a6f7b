#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Bias and coverage of fits of contact models to synthetic force curves, as a table.

    scenes/validation/curves.py [--curves 200] [--points 600] [--noise 0.01 0.05] [--csv FILE]

A paraboloid of 20 nm on E* = 3 GPa, w = 50 mJ/m² and a cantilever of 2 N/m is pulled off from 10 nN, by JKR, DMT and Maugis and Dugdale at
four λ. Each curve has an offset, a tilt, noise (of 1.5πwR) and its own place of the points. A row has, for w and E*, the mean of the
deviations over the mean of the errors ("bias"), and the share of the curves within one of their errors. A minute of one core.
"""
import argparse
import math
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from printed import Printed  # noqa: E402

from asperity.studies.curve_fit import fit, regions  # noqa: E402
from asperity.theories.indentation import Indenter, path  # noqa: E402

TIP, MODULUS, WORK, STIFFNESS, LOAD = Indenter("paraboloid", 20.0), 3.0, 0.05, 2.0, 10.0
CASES = (("jkr", None), ("dmt", None), *(("maugis", parameter) for parameter in (0.1, 0.5, 1.0, 3.0)))


def curve_of(model: str, parameter: float | None, noise: float, points: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns heights of the drive (nm) and forces (nN) of a retraction, from far to near."""
    draw = np.random.default_rng([CASES.index((model, parameter)), round(1000 * noise), seed])
    at, held = path(TIP, model, MODULUS, WORK, 2 * LOAD, parameter or 1.0).on_drive(STIFFNESS)
    height = np.linspace(30, np.interp(-LOAD, -held, at), points)
    height += draw.uniform(-0.5, 0.5) * (height[0] - height[1])
    force = np.where(height < at[-1], np.interp(height, at, held), 0.0) + 0.3 + 0.004 * height
    return height + 123.0, force + noise * 1.5 * math.pi * WORK * TIP.size * draw.normal(size=points)


def row_of(model: str, parameter: float | None, noise: float, points: int, curves: int) -> list[str]:
    """Returns a row of the table."""
    found = []
    for seed in range(curves):
        one = fit(TIP, model, regions(*curve_of(model, parameter, noise, points, seed)), STIFFNESS, parameter=parameter)
        found.append([part for name, truth in (("work", WORK), ("modulus", MODULUS))
                      for part in (math.log(one.values[name] / truth), one.errors[name] / one.values[name])])
    off = np.array(found).T
    cells = [model.upper() if parameter is None else f"λ = {parameter:g}", f"{100 * noise:g}"]
    for deviation, error in (off[:2], off[2:]):
        cells += [f"{100 * error.mean():.2g}", f"{deviation.mean() / error.mean():.2f}", f"{100 * np.mean(np.abs(deviation) < error):.0f}"]
    return cells


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--curves", type=int, default=200)
    words.add_argument("--points", type=int, default=600)
    words.add_argument("--noise", type=float, nargs="+", default=[0.01, 0.05])
    words.add_argument("--csv", type=pathlib.Path, default=pathlib.Path("results/curves.csv"))
    asked = words.parse_args()
    table = Printed("curve and model", "noise, %", "error of w, %", "bias of w", "w within, %", "error of E*, %", "bias of E*", "E* within, %")
    for noise in asked.noise:
        for model, parameter in CASES:
            table.add(*row_of(model, parameter, noise, asked.points, asked.curves))
    table.write(asked.csv)


if __name__ == "__main__":
    main()
