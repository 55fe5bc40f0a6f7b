#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Force curves that `asperity tip` simulates, fitted for what was put in, as a table.

    scenes/validation/tip_curves.py [--sites N] [--only NUMBER ...] [--out results/tip-curves] [--csv FILE]

A sphere of 20 nm with 50 mJ/m² on a cantilever of 2 N/m, pressed with 8 nN onto samples from DMT's to JKR's limit. The curve is interpolated
at 1500 points of each direction, with a noise of 0.5 % of 1.5πwR. A row has, over what was put in, w and E* fitted with the range known
(--range) and with the model unknown, each with its error, and w of JKR alone. Half a minute to two minutes a row.
"""
import argparse
import math
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from printed import Printed  # noqa: E402

import asperity  # noqa: E402

SAMPLES = ((30.0, 0.3), (3.0, 0.9), (3.0, 0.3), (0.5, 0.5), (0.5, 0.2))
"""Young's modulus, GPa, and range of the attraction, nm."""
RADIUS, WORK, STIFFNESS, POISSON = 20.0, 0.05, 2.0, 0.3
NOISE, POINTS = 0.005, 1500


def curve_of(found: asperity.Tip, seed: int) -> np.ndarray:
    """Returns height of the drive (nm), force (nN) and 1 on the way out, evenly spaced, inwards and out."""
    draw, parts = np.random.default_rng(seed), []
    for out in (False, True):
        here = found.retracting == out
        at = np.linspace(found.drive[here][0], found.drive[here][-1], POINTS)
        order = 1 if out else -1
        force = np.interp(at, found.drive[here][::order], found.force[here][::order])
        force += NOISE * 1.5 * math.pi * WORK * RADIUS * draw.normal(size=POINTS)
        parts.append(np.column_stack([at, force, np.full(POINTS, float(out))]))
    return np.vstack(parts)


def row_of(number: int, sites: int | None, out: pathlib.Path) -> list[str]:
    """Returns a row of the table."""
    young, reach = SAMPLES[number]
    made = asperity.tip(radius=f"{RADIUS} nm", E=f"{young} GPa", nu=POISSON, w=f"{1000 * WORK} mJ/m2", stiffness=f"{STIFFNESS} N/m",
                        range=f"{reach} nm", load="8 nN", sites=sites, out=out / f"{number}-tip", jobs=2)
    file = out / f"{number}.csv"
    np.savetxt(file, curve_of(made, number), delimiter=",", header="height (nm),force (nN),retraction", comments="")
    row = [f"{young:g} GPa, {reach:g} nm", f"{made.contact.parameter:.2f}"]
    for name, known in (("known", {"range": f"{reach} nm"}), ("unknown", {}), ("jkr", {"model": "jkr"})):
        found = asperity.curve(file, radius=f"{RADIUS} nm", stiffness=f"{STIFFNESS} N/m", out=out / f"{number}-{name}", **known)
        for path, truth in (("work", 1000 * WORK), ("modulus", young / (1 - POISSON**2))):
            one = found.number(path)
            truth *= 1000 if one.unit == "MPa" else 1
            row.append(f"{one.estimate / truth:.3f}" + f" ± {one.error / truth:.3f}" * (name != "jkr"))
    return row[:-1]


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--sites", type=int)
    words.add_argument("--only", type=int, nargs="+", default=range(len(SAMPLES)), metavar="NUMBER")
    words.add_argument("--out", default="results/tip-curves", type=pathlib.Path)
    words.add_argument("--csv", type=pathlib.Path)
    asked = words.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    table = Printed("sample", "λ", "known range: w", "E*", "unknown: w", "E*", "JKR alone: w")
    for number in asked.only:
        table.add(*row_of(number, asked.sites, asked.out))
    table.write(asked.csv)


if __name__ == "__main__":
    main()
