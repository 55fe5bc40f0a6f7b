#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The energies of random quasi-static paths against each other (docs/reports/validation.md).

    scenes/validation/identities.py [--count 12] [--seed 1] [--out results/identities]

Each scene is drawn at random, over atoms and over a wall in turn, and followed with the top plane and with the mean height held. Two
in four are scaled: their lengths times a factor from 0.3 to 100 and their energies from 1e-4 to 30, by which results are divided.
A row has the error of work in + lost in = state and of state = work out - lost out, in meV/Å², and over the stated uncertainty of
the work and the state. Below, the mean of these over all rows, which is zero if the errors have no bias, and their root mean square.
"""
import argparse
import pathlib
import random
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402


def drawn(random_numbers, wall):
    u = random_numbers.uniform
    sites = random_numbers.choice([32, 48, 64])
    keys = {"surface.sites": sites, "surface.seed": random_numbers.randrange(10**6), "surface.hurst": round(u(0.4, 1), 3),
            "surface.rolloff": random_numbers.choice([2, 3, 4]), "surface.rms": round(u(0.2, 3), 3),
            "block.young": round(u(30, 150), 1), "block.poisson": round(u(0, 0.45), 3),
            "block.thickness": random_numbers.choice([24, 48, 96]), "drive.mode": "quasistatic",
            "drive.tolerance": random_numbers.choice([2.5e-4, 2.5e-3])}
    if wall:
        keys |= {"interface.kind": "wall", "interface.law": "exponential", "interface.adhesion": round(u(30, 120), 1),
                 "interface.range": round(u(0.8, 2.5), 2)}
    else:
        r0 = round(u(2.8, 4), 3)
        keys |= {"interface.epsilon": round(u(0.05, 0.2), 4), "interface.r0": r0, "interface.cutoff": round(4 * r0, 3)}
    return keys


POWERS = {  # of length and energy
    "surface.spacing": (1, 0), "surface.rms": (1, 0), "drive.displacement_step": (1, 0), "interface.range": (1, 0), "interface.r0": (1, 0),
    "interface.cutoff": (1, 0), "interface.epsilon": (0, 1), "interface.adhesion": (-2, 1), "block.young": (-3, 1)}


def scaled_by(keys, length, energy):
    keys = {"surface.spacing": 2.6, "drive.displacement_step": 0.25} | keys
    return {k: v * length ** POWERS[k][0] * energy ** POWERS[k][1] if k in POWERS else v for k, v in keys.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/identities"))
    given = parser.parse_args()
    numbers = random.Random(given.seed)
    over = []
    print("scene, held          state   work in    lost    error  /unc.  work out    lost    error  /unc.")
    for n in range(given.count):
        keys, unit = drawn(numbers, wall=n % 2 == 1), 1.0
        if n % 4 > 1:
            length, energy = 10 ** numbers.uniform(-0.5, 2), 10 ** numbers.uniform(-4, 1.5)
            keys, unit = scaled_by(keys, length, energy), energy / length**2
        for hold in ("top", "mean-height"):
            r = asperity.run({}, {**keys, "drive.control": hold}, out=given.out / f"{n}-{hold}")
            row = f"{n:2d} {'wall ' if n % 2 else 'atoms'} {hold:11s} {r.binding_energy / unit:8.3f}"
            for way, sign in (("approach", 1), ("pull_off", -1)):
                work, lost = r.number(f"work_of_drive.{way}"), r.number(f"lost.{way}")
                error = work + sign * lost - r.binding_energy
                stated = r.number(f"work_of_drive.uncertainty.{way}") + r.binding_energy_uncertainty
                over.append(error / stated)
                row += f" {work / unit:9.3f} {lost / unit:8.3f} {error / unit:8.4f} {over[-1]:6.2f}"
            print(row, flush=True)
    print(f"error over uncertainty: mean {statistics.mean(over):.3f}, root mean square "
          f"{statistics.mean(x * x for x in over) ** 0.5:.3f}, largest {max(map(abs, over)):.3f} of {len(over)}")


main()
