#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Contacts without periodic images (surface.boundary = "free") against closed forms and an independent axisymmetric solution.

    scenes/validation/free_edges.py hertz | punch | jkr | images [--small] [--out results/free-edges]

hertz: a sphere without adhesion, in boxes of 1.25 and 2.5 contact diameters. punch: a flat round punch, a map with holes. jkr: an
adhesive sphere at the height of its apex and pulled off, beside rings (rings.py) under the same law, as the range falls. images: the
sphere in a free box of 1.25 contact diameters and in a periodic one of ten, with the time of both. --small: few
sites, in seconds. Lengths in nm, forces in nN.
"""
import argparse
import math
import pathlib
import sys

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scenes/validation")]
import rings  # noqa: E402

import asperity  # noqa: E402

R, E, F, WORK = 20.0, 102.0, 15.0, 0.1  # nm, GPa, nN, N/m
K = 4 * E / 3
HERTZ = math.cbrt(F * R / K)
A0 = math.cbrt(math.pi * WORK * R * R / K)  # Maugis' units
D0, F0 = A0 * A0 / R, math.pi * WORK * R
POISSON = 0.3


class Runs:
    def __init__(self, out: pathlib.Path, small: bool):
        self.out, self.small = out, small
        out.mkdir(parents=True, exist_ok=True)

    def run(self, name: str, sites: int, box: float, keys: dict) -> dict:
        """The series of a quasi-static path over a wall, its result, and its processor time. A result that is there is an error."""
        settings = {"interface.kind": "wall", "interface.adhesion": 0, "drive.mode": "quasistatic",
                    "block.poisson": POISSON,
                    "block.young": f"{E * (1 - POISSON**2)} GPa", "surface.kind": "flat", "surface.boundary": "free",
                    "surface.sites": sites, "surface.spacing": f"{box / sites} nm", "output.fields": ["segments"],
                    "output.checkpoint": "none", **keys}
        result = asperity.run({}, settings, self.out / name)
        with h5py.File(result.directory / "run.h5") as file:
            series = {k: file[f"series/{k}"][:] for k in ("force", "top_displacement", "contact_fraction", "segment")}
            there = file["fields/segment-0"]
            height = there.attrs["reference_height"]
            pressure = there["pressure"][:].max()
        return {"result": result, "seconds": result.run.processor_seconds, "force": 1.602176634 * series["force"], "segment": series["segment"],
                "height": 0.1 * (series["top_displacement"] + height), "pressure": pressure,
                "radius": box * np.sqrt(series["contact_fraction"] / math.pi)}


def hertz(runs: Runs) -> list[dict]:
    """a = (F R/K)^(1/3), a depth of a²/R."""
    rows = []
    for wide, sites in ((1.25, 64), (1.25, 128), (2.5, 256))[:1 if runs.small else 3]:
        r = runs.run(f"hertz-{wide}-{sites}", sites, 2 * wide * HERTZ, {
            "surface.radius": f"{R} nm", "drive.path": ["approach"], "drive.load": f"{F} nN"})
        rows.append({"box/diameters": wide, "sites": sites, "radius/Hertz": r["radius"][-1] / HERTZ,
                     "depth/Hertz": -r["height"][-1] / (HERTZ**2 / R)})
    return rows


def punch(runs: Runs) -> list[dict]:
    """F = 2 a E* depth, a that of the punch's area."""
    rows, radius, depth = [], 10.0, 0.01
    for wide, sites in ((1.25, 80), (1.25, 160), (2.5, 320))[:1 if runs.small else 3]:
        box = 2 * wide * radius
        x = (np.arange(sites) + 0.5) * box / sites - box / 2
        heights = np.where(np.hypot(x[:, None], x[None, :]) < radius, 0.0, np.nan)
        file = (runs.out / f"punch-{wide}-{sites}.npy").resolve()
        np.save(file, heights)
        r = runs.run(f"punch-{wide}-{sites}", sites, box, {
            "surface.kind": "file", "surface.file": file, "surface.file_missing": "hole", "drive.path": [f"height {-depth} nm"],
            "drive.displacement_step": f"{depth} nm"})
        of_area = box / sites * math.sqrt(np.isfinite(heights).sum() / math.pi)
        rows.append({"box/diameters": wide, "sites": sites, "force/2aE*d": r["force"][-1] / (2 * of_area * E * depth)})
    return rows


def around(reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Heights and forces of rings without images from contact at the height 0 outwards. The contact is made at a long range, which
    then falls."""
    finest = min(E * reach**2 / WORK / 10, 0.01 * A0)
    edges = np.concatenate([np.linspace(0, 0.9 * A0, 90)[:-1], np.arange(0.9 * A0, 1.6 * A0, finest), np.arange(1.6 * A0, 3 * A0, A0 / 40)])
    body = rings.Rings(edges, E)
    shape, stiffness = body.r**2 / (2 * R), 500 * math.pi * E / 0.03

    def step(law: rings.Exponential, height: float, gap: np.ndarray) -> np.ndarray:
        found = rings.solve(body, shape, law, height, gap)
        if found is None:
            raise ArithmeticError(f"no solution at {height} nm with a range of {law.reach} nm")
        return found

    longest = max(0.4 * D0, reach)
    gap = np.minimum(shape, 0)
    for part in (0.25, 0.5, 0.75, 1.0):
        gap = step(rings.Exponential(part * WORK, longest, stiffness), 0.0, gap)
    for falling in np.geomspace(longest, reach, max(2, math.ceil(math.log(longest / reach) / 0.03))):
        gap = step(rings.Exponential(WORK, falling, stiffness), 0.0, gap)
    law, heights, forces = rings.Exponential(WORK, reach, stiffness), [], []
    while len(heights) < 4 or forces[-1] <= forces[-2]:
        heights.append(0.1 * reach * len(heights))
        gap = step(law, heights[-1], gap)
        forces.append(body.area @ law(gap)[0])
    return np.array(heights), np.array(forces)


def jkr(runs: Runs) -> list[dict]:
    """-4/3 F0 at the height of the apex, -3/2 F0 at most. The box is 1.25 times as wide as the contact without a load."""
    rows = []
    for reach, wide, sites in ((0.4, 1.25, 64), (0.4, 2.5, 128), (0.28, 1.25, 128), (0.2, 1.25, 256))[:1 if runs.small else 4]:
        r = runs.run(f"jkr-{reach}-{wide}-{sites}", sites, 2 * wide * math.cbrt(6) * A0, {
            "surface.radius": f"{R} nm", "interface.adhesion": f"{WORK} J/m^2", "interface.range": f"{reach * D0} nm",
            "drive.displacement_step": f"{0.05 * D0} nm", "drive.path": ["height 0 nm", f"height {0.6 * D0} nm"]})
        row = {"range/D0": reach, "box/diameters": wide, "sites": sites, "at the apex/F0": r["force"][r["segment"] == 0][-1] / F0,
               "largest/F0": r["force"][r["segment"] == 1].min() / F0}
        heights, forces = around(reach * D0)
        row |= {"rings at the apex/F0": forces[0] / F0, "rings, largest/F0": forces.min() / F0}
        rows.append(row)
    return rows


def images(runs: Runs) -> list[dict]:
    """Hertz' contact, and the pull-off at a range of 0.4 D0, of a paraboloid."""
    rows = []
    for boundary, wide in (("free", 1.25), ("periodic", 10)):
        for kind in ("hertz", "jkr"):
            sites = (16 if runs.small else 64) * (1 if boundary == "free" else 8)
            box = 2 * wide * (HERTZ if kind == "hertz" else math.cbrt(6) * A0)
            x = (np.arange(sites) - sites // 2) * box / sites
            file = (runs.out / f"images-{boundary}-{kind}.npy").resolve()
            np.save(file, -(x[:, None] ** 2 + x[None, :] ** 2) / (2 * R))
            keys = {"surface.kind": "file", "surface.file": file, "surface.file_unit": "nm", "surface.boundary": boundary,
                    "drive.control": "top" if boundary == "free" else "mean-height"}
            if kind == "hertz":
                keys |= {"drive.path": ["approach"], "drive.load": f"{F} nN"}
            else:
                keys |= {"interface.adhesion": f"{WORK} J/m^2", "interface.range": f"{0.4 * D0} nm", "drive.displacement_step": f"{0.1 * D0} nm",
                         "drive.path": ["approach", "pull-off"]}
            r = runs.run(f"images-{boundary}-{kind}", sites, box, keys)
            row = {"box": boundary, "box/diameters": wide, "sites": sites, "contact": kind}
            if kind == "hertz":
                row |= {"radius/Hertz": r["radius"][-1] / HERTZ, "pressure/Hertz": r["pressure"] / (1.5 * F / (math.pi * HERTZ**2))}
            else:
                row |= {"largest attraction/F0": -r["force"].min() / F0}
            rows.append(row | {"processor/s": r["seconds"]})
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("hertz", "punch", "jkr", "images"))
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--out", default="results/free-edges", type=pathlib.Path)
    args = parser.parse_args()
    rows = globals()[args.what](Runs(args.out, args.small))
    columns = list(dict.fromkeys(k for row in rows for k in row))
    print(",".join(columns))
    for row in rows:
        print(",".join(f"{row[k]:.6g}" if isinstance(row.get(k), (int, float)) else row.get(k, "") for k in columns))


if __name__ == "__main__":
    main()
