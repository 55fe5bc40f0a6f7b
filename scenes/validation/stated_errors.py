#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How often the truth lies within the error that `asperity estimate` states (docs/howto/estimate.md).

    scenes/validation/stated_errors.py [--first 0] [--scenes 20] [--jobs 1] [--out results/stated-errors]

Scenes are drawn at random: 64 to 128 sites, pairs by Lennard-Jones and by Morse with short cutoffs, and an exponential
wall. The estimate of each is compared with 16 other surfaces of twice the width, with a tail and twice the cutoff, or
half of the spacing, on a block four times as thick. The same call goes on where it stopped. About half an hour of two cores.
"""
import argparse
import csv
import pathlib
import random
import sys

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402

KINDS = ("lennard-jones", "morse", "wall")
SEEDS = range(101, 117)


def scene(number: int, sites: tuple[int, ...] = (64, 96, 128)) -> dict:
    """The keys of a scene, by its number."""
    draw = random.Random(number)
    kind, n = KINDS[number % 3], draw.choice(sites)
    keys = {"surface.sites": n, "surface.q_max": n // 2, "surface.rms": round(draw.uniform(0.5, 2.2), 2),
            "surface.hurst": round(draw.uniform(0.6, 0.9), 2), "surface.rolloff": round(draw.uniform(2.0, 5.0), 1),
            "surface.seed": draw.randint(1, 90), "drive.path": "relax", "block.thickness": n // 2,
            "block.young": round(draw.uniform(50, 100), 1), "block.poisson": round(draw.uniform(0.2, 0.45), 2)}
    if kind == "wall":
        keys |= {"interface.kind": "wall", "interface.adhesion": round(draw.uniform(60, 140), 1),
                 "interface.range": round(draw.uniform(1.5, 3), 2)}
    else:
        length = {"lennard-jones": 3.28, "morse": 3.6816}[kind]
        keys |= {"interface.potential": kind, "interface.cutoff": round(draw.uniform(2.5, 4.0) * length, 2)}
    return keys


def expensive(keys: dict) -> dict:
    found = {**keys, "block.thickness": 4 * keys["block.thickness"]}
    factor = 4 if "interface.kind" in keys else 2  # half of the spacing too
    found |= {"surface.sites": factor * keys["surface.sites"], "surface.rolloff": 2 * keys["surface.rolloff"],
              "surface.q_max": 2 * keys["surface.q_max"]}
    if "interface.kind" in keys:
        return found | {"surface.spacing": 1.3, "block.thickness": 2 * found["block.thickness"]}
    return found | {"interface.cutoff": 2 * keys["interface.cutoff"], "interface.tail": "true"}


def compared(number: int, out: pathlib.Path, jobs: int = 1, seeds=SEEDS, **given) -> list[dict]:
    """A row for each quantity: estimate, its standard error, truth and its own."""
    keys = scene(number, **given)
    found = asperity.estimate({}, keys, out / f"{number}-estimate", jobs=jobs)
    truth = asperity.sweep({}, {**expensive(keys), "surface.seed": list(seeds)}, out / f"{number}-truth", jobs=jobs).table
    rows = []
    for path, n in found.numbers.items():
        values = numpy.asarray(truth[path], float)
        mean, error = values.mean(), values.std(ddof=1) / len(values) ** 0.5
        rows.append({"scene": number, "kind": KINDS[number % 3], "sites": keys["surface.sites"], "quantity": path,
                     "as it is": n.value, "estimate": n.estimate, "error": n.error, "truth": mean, "of truth": error,
                     "off": (n.estimate - mean) / max(n.error, 1e-6 * abs(mean)), "largest": max(n.parts, key=lambda p: n.parts[p].error)})
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--scenes", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/stated-errors"))
    given = parser.parse_args()
    rows = []
    for number in range(given.first, given.first + given.scenes):
        rows += (new := compared(number, given.out, given.jobs))
        for r in new:
            print(f"{r['scene']:3} {r['kind']:13} {r['sites']:4}  {r['quantity']:20} {r['as it is']:9.4f} "
                  f"{r['estimate']:9.4f} ± {r['error']:.4f}  truth {r['truth']:9.4f} ± {r['of truth']:.4f}  "
                  f"{r['off']:+5.2f} errors", flush=True)
        with open(given.out / "stated-errors.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows(rows)
    for path in dict.fromkeys(r["quantity"] for r in rows):
        off = numpy.array([abs(r["off"]) for r in rows if r["quantity"] == path])
        print(f"{path}: {(off <= 2).sum()} of {len(off)} within twice the standard error, {(off <= 1).sum()} within it")


if __name__ == "__main__":
    main()
