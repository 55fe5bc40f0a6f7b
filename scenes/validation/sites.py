#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Laws of the sites of a wall against closed forms: spheres without images (docs/reports/validation.md).

    scenes/validation/sites.py maugis | rings [--only X] [--sites N] [--range R] [--out results/sites]

maugis: force against displacement of spheres with Dugdale's law, against Maugis (1992). rings: a sphere on rings of the work of
adhesion w (1 + alpha cos(2 pi r / lambda)), lambda = 0.2 of the unit of length, pressed in by 3 units and pulled off with its far
field held: energy lost and pull-off force against JKR with w at the edge of the contact. --range is in units of D0; the
closed form is the limit of no range.
Units of Maugis: lengths (pi w R^2 / K)^(1/3) along the surface, D0 = (pi^2 w^2 R / K^2)^(1/3) across, forces pi w R; K = 4 E*/3.
"""
import argparse
import math
import pathlib
import sys

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402

GPA = 1 / 160.21766208  # eV/Å³
RADIUS, UNIT, YOUNG, POISSON = 5000.0, 100.0, 1.0, 0.3  # Å, Å, GPa
K = 4 / 3 * YOUNG * GPA / (1 - POISSON**2)
W = UNIT**3 * K / (math.pi * RADIUS**2)  # eV/Å²
F0, D0 = math.pi * W * RADIUS, UNIT**2 / RADIUS


def follow(out: pathlib.Path, name: str, reach: float, keys: dict) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacement, force and segment of the points of a path, in units of D0 and F0. reach: of the law, Å, where paths start."""
    settings = {"surface.kind": "flat", "surface.radius": RADIUS, "surface.boundary": "free", "block.young": YOUNG,
                "block.poisson": POISSON, "interface.kind": "wall", "interface.edge_pinning": "allow", "output.fields": [],
                "output.checkpoint": "none", "drive.mode": "quasistatic", **keys}
    asperity.run({"name": name}, settings, out / name)
    with h5py.File(out / name / "run.h5") as file:
        series = file["series"]
        return -(series["top_displacement"][:] + reach) / D0, series["force"][:] / F0, series["segment"][:]


def maugis(a: float, tabor: float) -> tuple[float, float]:
    """Force and displacement at a contact radius."""
    def excess(m: float) -> float:
        root, angle = math.sqrt(m * m - 1), math.acos(1 / m)
        return (tabor * a * a / 2 * (root + (m * m - 2) * angle) + 4 * tabor**2 * a / 3 * (root * angle - m + 1)) - 1

    low, high = 1.0, 2.0
    while excess(high) < 0:
        high *= 2
    for _ in range(200):
        m = (low + high) / 2
        low, high = (m, high) if excess(m) < 0 else (low, m)
    root, angle = math.sqrt(m * m - 1), math.acos(1 / m)
    return a**3 - tabor * a * a * (root + m * m * angle), a * a - 4 / 3 * tabor * a * root


def check_maugis(out: pathlib.Path, given: argparse.Namespace) -> None:
    print("lambda  range/D0  box  sites  pull-off   Maugis   ratio   largest deviation of the force over the pull-off force")
    for tabor, box, sites in ((0.1, 10.0, 192), (0.3, 7.5, 128), (1.0, 5.5, 96), (2.0, 4.5, 256), (5.0, 4.0, 1024)):
        if given.only and tabor != given.only:
            continue
        sites, reach = given.sites or sites, 2 / (math.pi * tabor)
        curve = np.array([maugis(a, tabor) for a in np.linspace(1e-4, 2.2, 4000)])
        shift, force, segment = follow(out, f"maugis-{tabor}-{sites}", 1.1 * reach * D0, {
            "surface.sites": sites, "surface.spacing": box * UNIT / sites, "interface.law": "dugdale", "interface.adhesion": 1e3 * W,
            "interface.range": reach * D0, "drive.path": ["approach", "pull-off"], "drive.displacement_step": 0.02 * D0})
        out_of = segment == 1
        shift, force = shift[out_of], force[out_of]
        least = curve[:, 0].min()
        lowest = int(np.argmin(curve[:, 1]))  # the stable branch ends at the least displacement
        stable = curve[lowest:]
        there = (np.arange(len(force)) < np.argmin(force)) & (shift > stable[0, 1]) & (force < 0)
        apart = np.abs(np.interp(shift[there], stable[:, 1], stable[:, 0]) - force[there]).max()
        print(f"{tabor:5} {reach:9.4f} {box:6} {sites:5} {force.min():9.4f} {least:9.4f} {force.min() / least:8.4f} "
              f"{apart / -least:8.4f}", flush=True)


def jkr_over_rings(alpha: float, period: float, most: float) -> tuple[float, float]:
    """Energy lost in a cycle and pull-off force with the work of adhesion at the edge of the contact."""
    a = np.linspace(1e-6, 3.0, 150001)
    held = 1 + alpha * np.cos(2 * math.pi * a / period)
    at, work, before, last, pull = 0, 0.0, 0.0, 0.0, 0.0
    for shift in np.concatenate([np.linspace(0, most, 20001), np.linspace(most, -2, 20001)]):
        def way(i: int, shift: float = shift) -> int:
            lifts = a[i] ** 2 > shift and 3 * (shift - a[i] ** 2) ** 2 / (8 * a[i]) > held[i]
            return -1 if lifts else 1

        step = way(at)
        while 0 < at + step < len(a) and way(at + step) == step:
            at += step
        apart = at + step <= 0
        force = 0.0 if apart else a[at] ** 3 + 1.5 * a[at] * (shift - a[at] ** 2)
        work, before, last, pull = work + (force + before) / 2 * (shift - last), force, shift, min(pull, force)
        if apart and shift < 0:
            break
    return work, pull


def check_rings(out: pathlib.Path, given: argparse.Namespace) -> None:
    box, period, most = 5.2, 0.2, 3.0
    sites, reach = given.sites or 384, given.range or 0.14
    print("alpha  range/D0  sites   lost    JKR    ratio   pull-off   JKR    ratio")
    for alpha in (0.0, 0.1, 0.2, 0.4):
        if given.only is not None and alpha != given.only:
            continue
        shift, force, _ = follow(out, f"rings-{alpha}-{sites}-{reach}", 32 * reach * D0, {
            "surface.sites": sites, "surface.spacing": box * UNIT / sites,
            "interface.adhesion": f"rings {1e3 * W} {alpha} {period * UNIT}", "interface.range": reach * D0,
            "drive.path": [f"height {-most * D0} Å", "pull-off"], "drive.displacement_step": 0.05 * D0})
        lost = float(np.sum((force[1:] + force[:-1]) / 2 * np.diff(shift)))
        wanted, pull = jkr_over_rings(alpha, period, most)
        print(f"{alpha:4} {reach:8} {sites:7} {lost:8.3f} {wanted:7.3f} {lost / wanted:7.3f} {force.min():9.3f} {pull:7.3f} "
              f"{force.min() / pull:7.3f}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["maugis", "rings"])
    parser.add_argument("--only", type=float, help="lambda or alpha")
    parser.add_argument("--sites", type=int)
    parser.add_argument("--range", type=float)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/sites"))
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    {"maugis": check_maugis, "rings": check_rings}[given.what](given.out, given)


if __name__ == "__main__":
    main()
