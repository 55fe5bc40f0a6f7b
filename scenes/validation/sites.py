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
from collections.abc import Callable

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scenes/validation")]
import spring  # noqa: E402

import asperity  # noqa: E402

GPA = 1 / 160.21766208  # eV/Å³
RADIUS, UNIT, YOUNG, POISSON = 5000.0, 100.0, 1.0, 0.3  # Å, Å, GPa
K = 4 / 3 * YOUNG * GPA / (1 - POISSON**2)
W = UNIT**3 * K / (math.pi * RADIUS**2)  # eV/Å²
F0, D0 = math.pi * W * RADIUS, UNIT**2 / RADIUS


def follow(out: pathlib.Path, name: str, reach: float, keys: dict) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacement, force and segment of the points of a path, in units of D0 and F0. reach: of the law, Å, where paths start."""
    # The paths that docs/reports/validation.md states are the lattice's.
    settings = {"surface.kind": "flat", "surface.radius": RADIUS, "surface.boundary": "free", "block.model": "lattice", "block.young": YOUNG,
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
    whole = ["approach", "pull-off"]
    for tabor, box, sites, path in ((0.1, 10.0, 192, whole), (0.3, 7.5, 128, whole), (1.0, 5.5, 96, whole), (2.0, 4.5, 256, whole),
                                    (5.0, 3.3, 768, ["height 0 Å", f"height {0.8 * D0} Å"])):
        if given.only and tabor != given.only:
            continue
        sites, reach = given.sites or sites, 2 / (math.pi * tabor)
        curve = np.array([maugis(a, tabor) for a in np.linspace(1e-4, 2.2, 4000)])
        shift, force, segment = follow(out, f"maugis-{tabor}-{sites}", 1.1 * reach * D0, {
            "surface.sites": sites, "surface.spacing": box * UNIT / sites, "interface.law": "dugdale", "interface.adhesion": 1e3 * W,
            "interface.range": reach * D0, "drive.path": path, "drive.displacement_step": 0.02 * D0})
        out_of = segment == 1
        shift, force = shift[out_of], force[out_of]
        least = curve[:, 0].min()
        lowest = int(np.argmin(curve[:, 1]))  # the stable branch ends at the least displacement
        stable = curve[lowest:]
        there = (np.arange(len(force)) < np.argmin(force)) & (shift > stable[0, 1]) & (force < 0)
        apart = np.abs(np.interp(shift[there], stable[:, 1], stable[:, 0]) - force[there]).max()
        print(f"{tabor:5} {reach:9.4f} {box:6} {sites:5} {force.min():9.4f} {least:9.4f} {force.min() / least:8.4f} "
              f"{apart / -least:8.4f}", flush=True)


def loop(a: np.ndarray, height: np.ndarray, attraction: np.ndarray, jump_in: float, most: float,
         away: tuple[np.ndarray, np.ndarray] = (np.array([-9.0, 9.0]), np.zeros(2))) -> tuple[float, float]:
    """Returns the energy lost between a jump into contact at a height, a displacement of most and the jump out of contact, and the
    largest attraction. a: radii that grow, with the height and the attraction in force balance; the contact grows where it is below
    that height and shrinks where it is above, to the next radius in balance. away: heights and attractions before contact."""
    at = int(np.argmax(height > jump_in))  # past the unstable contact
    lost, pull, down, up = 0.0, 0.0, np.linspace(jump_in, -most, 20001), np.linspace(-most, 2.0, 40001)
    held = []
    for h in down:
        while at + 1 < len(a) and height[at] > h:
            at += 1
        held.append(attraction[at])
    lost += np.trapz(held, down)
    held = []
    for h in up:
        while at > 0 and height[at] < h:
            at -= 1
        if at == 0:
            break
        held.append(attraction[at])
    up = up[:len(held)]
    lost += np.trapz(held, up)
    pull = max(held)
    between = up > jump_in
    return lost - np.trapz(np.interp(up[between], *away), up[between]), pull


def over_rings(alpha: float, period: float) -> Callable[[np.ndarray], np.ndarray]:
    return lambda r: 1 + alpha * np.cos(2 * math.pi * r / period)


def jkr_over_rings(alpha: float, period: float, most: float, jump_in: float) -> tuple[float, float]:
    """Returns the energy lost in a cycle and the pull-off force with the work of adhesion at the edge of the contact."""
    a = np.linspace(1e-6, 3.0, 150001)
    w = over_rings(alpha, period)(a)
    return loop(a, np.sqrt(8 * a * w / 3) - a * a, np.sqrt(6 * w * a**3) - a**3, jump_in, most)


def follow_rings(alpha: float, period: float, most: float, reach: float) -> tuple[float, float, float]:
    """Returns the energy lost in a cycle, the pull-off force and the height of the jump into contact of axisymmetric bodies (spring.py)."""
    field = over_rings(alpha, period)
    radius, height, attraction = (x[::-1] for x in spring.contacts(reach, field, 0.005))
    away = spring.approach(reach, field)
    number = np.arange(len(radius))
    fine = np.linspace(0, len(radius) - 1, 40 * len(radius))
    lost, pull = loop(*(spring.cubic(fine, number, x) for x in (radius, height, attraction)), away[0][0], most, away)
    return lost, pull, away[0][0]


def check_rings(out: pathlib.Path, given: argparse.Namespace) -> None:
    box, period, most = 5.2, 0.2, 3.0
    sites, reach = given.sites or 384, given.range or 0.2
    print("alpha  range/D0  sites   lost  of bodies of rings  ratio   pull-off  of bodies of rings  ratio")
    for alpha in (0.0, 0.1, 0.2, 0.4):
        if given.only is not None and alpha != given.only:
            continue
        shift, force, _ = follow(out, f"rings-{alpha}-{sites}-{reach}", 32 * reach * D0, {
            "surface.sites": sites, "surface.spacing": box * UNIT / sites,
            "interface.adhesion": f"rings {1e3 * W} {alpha} {period * UNIT}", "interface.range": reach * D0,
            "drive.path": [f"height {-most * D0} Å", "pull-off"], "drive.displacement_step": 0.02 * D0})
        lost = float(np.sum((force[1:] + force[:-1]) / 2 * np.diff(shift)))
        wanted, pull, _ = follow_rings(alpha, period, most, reach)
        print(f"{alpha:4} {reach:8} {sites:7} {lost:8.3f} {wanted:7.3f} {lost / wanted:7.3f} {-force.min():9.3f} {pull:7.3f} "
              f"{-force.min() / pull:7.3f}", flush=True)


def check_limits(_: pathlib.Path, given: argparse.Namespace) -> None:
    """Prints what bodies of rings lose, and its limit of no range: what differs from the closed form with the same jump into
    contact is extrapolated."""
    period, most = 0.2, 3.0
    ranges = np.array([0.025, 0.03, 0.035, 0.04])
    print("alpha   JKR: lost  pull-off   range/D0: lost, over the closed form with its jump into contact; pull-off   limits over JKR")
    for alpha in (0.0, 0.1, 0.2, 0.4):
        if given.only is not None and alpha != given.only:
            continue
        lost, pull = jkr_over_rings(alpha, period, most, 0.0)
        print(f"{alpha:4} {lost:9.3f} {pull:8.3f}", end=" ", flush=True)
        rows = []
        for reach in ranges:
            found = follow_rings(alpha, period, most, reach)
            same = jkr_over_rings(alpha, period, most, found[2])
            rows.append((found[0] - same[0], found[1] - same[1]))
            print(f"  {reach:.3g}: {found[0]:.3f}, {found[0] / same[0]:.3f}; {found[1]:.3f}", end=" ", flush=True)
        apart = [spring.limit(ranges, np.array(column)) for column in zip(*rows, strict=True)]
        print(f"  {1 + apart[0] / lost:.3f} {1 + apart[1] / pull:.3f}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["maugis", "rings", "limits"])
    parser.add_argument("--only", type=float, help="lambda or alpha")
    parser.add_argument("--sites", type=int)
    parser.add_argument("--range", type=float)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/sites"))
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    {"maugis": check_maugis, "rings": check_rings, "limits": check_limits}[given.what](given.out, given)


if __name__ == "__main__":
    main()
