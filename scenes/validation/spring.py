#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Spheres on a spring (drive.stiffness) with free edges against JKR, and rings without images as the range falls.

    scenes/validation/spring.py rings [--ranges 0.4 0.28 ...] | limits | cycles [--range 0.4 --sites 64] [--only 1] |
        table [--out results/spring]

rings: the branches of contact and of approach of an axisymmetric sphere (rings.py) under the law of the wall, for a rigid drive;
those of every spring are a part of them. limits: the contact at the largest
attraction as the range falls. cycles: an approach and a pull-off of the program for each spring. Both leave a CSV in
the directory; table compares them with JKR and extrapolates the range.

Per spring: jump_in, the place of the drive at the jump into contact; after, the force after it; jump_out, the force at the jump
out of contact; pull_off, the largest attraction; lost, the energy of a cycle. Units of Maugis: F0 = pi w R, a0 =
(pi w R^2/K)^(1/3), D0 = a0^2/R, K = 4 E*/3; displacements away from the substrate are positive, attraction too.
"""
import argparse
import csv
import math
import pathlib
import sys
from collections.abc import Callable

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scenes/validation")]
import rings  # noqa: E402

STIFFNESS = (math.inf, 10.0, 3.0, 1.0, 0.3, 0.1)  # F0/D0
NAMES = ("jump_in", "after", "jump_out", "pull_off", "lost")
WORK, MODULUS = 1 / math.pi, 0.75  # R = K = F0 = a0 = D0 = 1
WIDEST = 2.5  # contact


def jkr() -> tuple[np.ndarray, np.ndarray]:
    """Height and attraction of the contact of JKR that is stable for a rigid drive, from deep contact outwards."""
    a = np.linspace(2.6, (1 / 6) ** (1 / 3), 400001)
    return -(a * a - 2 / 3 * np.sqrt(6 * a)), np.sqrt(6 * a**3) - a**3


def largest(values: np.ndarray, radius: np.ndarray, *others: np.ndarray) -> tuple[float, ...]:
    """Returns the maximum of values over the radius, where it is, and the others there, by a polynomial through the 17 points about
    it: single contacts differ by the places of their rings."""
    middle = int(np.argmax(values))
    near = slice(max(0, middle - 8), middle + 9)
    fits = [np.polynomial.Polynomial.fit(radius[near], y[near], 4) for y in (values, *others)]
    turns = [x.real for x in fits[0].deriv().roots() if abs(x.imag) < 1e-9 and radius[near].min() <= x.real <= radius[near].max()]
    at = max([*turns, radius[middle]], key=fits[0])
    return float(fits[0](at)), float(at), *(float(fit(at)) for fit in fits[1:])


def cycle(stiffness: float, contact: tuple[np.ndarray, ...], approach: tuple[np.ndarray, np.ndarray]) -> dict[str, float]:
    """Returns the numbers of a cycle from both branches: radii of the contact that fall, heights of the top plane, attractions; and
    heights that rise and attractions before contact."""
    radius, height, force = contact
    end, _, torn = largest(height + force / stiffness, radius, force)
    last = int(np.argmax(height + force / stiffness))  # the fold of the contact
    at, held = np.append((height + force / stiffness)[:last], end), np.append(force[:last], torn)
    far, weak = approach[0] + approach[1] / stiffness, approach[1]
    first = int(np.argmin(far))
    far, weak, jump_in = far[first:], weak[first:], far[first]
    number = np.arange(len(at))
    fine = np.linspace(0, len(at) - 1, 40 * len(at))
    fine_at, fine_held = np.maximum.accumulate(cubic(fine, number, at)), cubic(fine, number, held)
    z = np.linspace(jump_in, end, 200001)
    lost = np.trapz(np.interp(z, fine_at, fine_held) - np.interp(z, far, weak), z)
    pulled = largest(force, radius)[0]
    return dict(zip(NAMES, (jump_in, np.interp(jump_in, fine_at, fine_held), torn, pulled, lost), strict=True))


def closed(stiffness: float, jump_in: float = 0.0) -> dict[str, float]:
    """JKR with the jump into contact at this place of the drive."""
    height, force = jkr()
    at = height + force / stiffness
    last = int(np.argmax(at))
    z = np.linspace(jump_in, at[last], 200001)
    return {"jump_in": 0.0, "after": float(np.interp(jump_in, at[:last], force[:last])), "jump_out": float(force[last]),
            "pull_off": 1.5, "lost": float(np.trapz(np.interp(z, at[:last + 1], force[:last + 1]), z))}


def rings_about(radius: float, zone: float) -> tuple[rings.Rings, int]:
    """Rings that are fine in the zone of cohesion at this radius of the contact, and wider and wider away from it; the number of
    those inside."""
    fine, widest = zone / 10, 0.03
    inner, outer = [radius], [radius]
    for edges, sign, end in ((inner, -1, 0.0), (outer, 1, 3.8)):
        width = fine
        while sign * (end - edges[-1]) > 1.5 * width:
            edges.append(edges[-1] + sign * width)
            if abs(edges[-1] - radius) > 3 * zone:
                width = min(1.07 * width, widest)
    return rings.Rings(np.array([0.0, *inner[:0:-1], *outer]), MODULUS), len(inner)


class Contact:
    """A sphere in contact out to a radius, under the exponential law. The sites inside press on the wall and those outside are
    attracted; the pressure goes over the edge without a jump, and the height follows. So no ring takes part in both, as they
    would at a given height, where single rings hold the edge."""

    def __init__(self, radius: float, reach: float, work: float, before: "Contact | None" = None,
                 field: Callable[[np.ndarray], np.ndarray] | None = None):
        self.body, self.inside = rings_about(radius, MODULUS * reach**2 / WORK)
        r, inside = self.body.r, np.arange(len(self.body.r)) < self.inside
        shape, law = r**2 / 2, rings.Exponential(work, reach, 500 * math.pi * MODULUS / 0.03)
        gap, height = np.maximum(shape - radius**2 / 2, 0) / 4, -radius**2 / 2
        if before is not None:
            gap, height = np.interp(r - radius, before.body.r - before.radius, before.gap), before.height
        share = np.ones(len(r)) if field is None else field(r)  # of the work of adhesion
        at_edge = 1.0 if field is None else float(field(np.array([radius]))[0])
        edge = np.zeros(len(r))
        edge[self.inside - 2:self.inside] = (-0.5, 1.5)
        for _ in range(60):
            pull = share * law.tension * np.exp(-np.maximum(gap, -3 * reach) / reach)
            pressure = np.where(inside, -law.stiffness * gap - share * law.tension, -pull)
            slope = np.where(inside, -law.stiffness, pull / reach)
            off = np.append(gap - height - shape - self.body.flexibility @ pressure, edge @ pressure + at_edge * law.tension)
            matrix = np.zeros((len(r) + 1, len(r) + 1))
            matrix[:-1, :-1] = np.eye(len(r)) - self.body.flexibility * slope
            matrix[:-1, -1], matrix[-1, :-1] = -1, edge * slope
            change = np.linalg.solve(matrix, off)
            part = min(1.0, 2 * reach / np.abs(change[:-1][~inside]).max())
            gap, height = gap - part * change[:-1], height - part * change[-1]
            if np.abs(change).max() < 1e-10:
                break
        else:
            raise ArithmeticError(f"no contact of radius {radius} a0 with a range of {reach} D0")
        self.radius, self.gap, self.height = radius, gap, height
        self.attraction = float(-self.body.area @ pressure)


def wide_contact(reach: float, field: Callable[[np.ndarray], np.ndarray] | None = None) -> Contact:
    """Returns a contact of the radius WIDEST at this range, from a longer one."""
    before, longest = None, max(0.4, reach)
    for part in (0.05, 0.25, 0.5, 0.75, 1.0):
        before = Contact(WIDEST, longest, part * WORK, before, field)
    for wide in np.geomspace(longest, reach, max(2, math.ceil(math.log(longest / reach) / 0.1))):
        before = Contact(WIDEST, wide, WORK, before, field)
    return before


def contacts(reach: float, field: Callable[[np.ndarray], np.ndarray] | None = None, step: float = 0.01) -> tuple[np.ndarray, ...]:
    """Returns radii, heights and attractions of contacts from a wide one to one past the largest height of small contacts. field:
    the work of adhesion at a radius over w."""
    before = wide_contact(reach, field)
    rows = []
    while before.radius > 0.4:
        rows.append((before.radius, before.height, before.attraction))
        before = Contact(before.radius - step, reach, WORK, before, field)
    return tuple(np.array(rows).T)


def of_rings(reach: float) -> list[dict]:
    """Returns cycles of rings at this range."""
    contact, away = contacts(reach), approach(reach)
    return [{"range": reach, "rings": len(rings_about(0.5, MODULUS * reach**2 / WORK)[0].r), "stiffness": k, **cycle(k, contact, away)}
            for k in STIFFNESS]


def limits(ranges: list[float]) -> None:
    """Prints the cube of the radius, force and height at the largest attraction of rings, and their limits beside JKR's."""
    rows = []
    for reach in sorted(ranges)[:4]:
        radius, height, force = contacts(reach)
        most, at, there = largest(force, radius, height)
        rows.append((at**3, most, there))
        print(f"range {reach}: a^3 {at**3:.4f}, attraction {most:.4f}, height {there:.4f}", flush=True)
    print("limit: ", *(f"{limit(np.array(sorted(ranges)[:4]), np.array(column)):.4f}" for column in zip(*rows, strict=True)),
          "JKR: 1.5 1.5", f"{2 / 3 * math.sqrt(6 * 1.5 ** (1 / 3)) - 1.5 ** (2 / 3):.4f}")


def cubic(x: np.ndarray, at: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values at x, on cubics through those at `at`."""
    slope, step = np.gradient(values, at), np.diff(at)
    i = np.clip(np.searchsorted(at, x, side="right") - 1, 0, len(step) - 1)
    t, change = (x - at[i]) / step[i], values[i + 1] - values[i]
    bend = (t - t**2) * ((1 - t) * (slope[i] * step[i] - change) + t * (change - slope[i + 1] * step[i]))
    return values[i] + t * change + bend


def approach(reach: float, field: Callable[[np.ndarray], np.ndarray] | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Returns heights and attractions before contact, from the last stable height outwards."""
    body = rings.Rings(np.concatenate([np.linspace(0, 0.45, 46)[:-1], np.arange(0.45, 3.8, 0.025)]), MODULUS)
    law, shape = rings.Exponential(WORK, reach, 500 * math.pi * MODULUS / 0.03), body.r**2 / 2
    if field is not None:
        law.tension = law.tension * field(body.r)
    height, step, rows = 12 * reach + 1, 0.05 * reach, []
    gap = height + shape
    while step > 1e-5 * reach:
        found = rings.solve(body, shape, law, height, gap)
        if found is None or np.abs(found - gap).max() > reach:
            height, step = height + step / 2, step / 2
            continue
        gap = found
        rows.append((height, -float(body.area @ law(gap)[0])))
        height -= step
    return tuple(np.array(rows[::-1]).T)


def of_program(out: pathlib.Path, reach: float, sites: int, k: float, wide: float) -> dict:
    """A cycle of the program."""
    import h5py

    import asperity
    R, E, work = 20.0, 102.0, 0.1  # nm, GPa, N/m
    K = 4 * E / 3
    a0 = math.cbrt(math.pi * work * R * R / K)
    D0, F0, box = a0 * a0 / R, math.pi * work * R, 2 * wide * math.cbrt(6) * a0
    held = {} if math.isinf(k) else {"drive.stiffness": f"{k * F0 / D0} N/m"}
    result = asperity.run({}, {
        # The cycles that docs/reports/validation.md states are the lattice's.
        "interface.kind": "wall", "block.model": "lattice", "interface.adhesion": f"{work} J/m^2", "interface.range": f"{reach * D0} nm",
        "block.poisson": 0.3,
        "block.young": f"{E * 0.91} GPa", "drive.mode": "quasistatic", "drive.displacement_step": f"{0.05 * D0} nm",
        "drive.path": ["height 0 nm", "pull-off"], "surface.kind": "flat", "surface.radius": f"{R} nm",
        "surface.boundary": "free", "surface.sites": sites, "surface.spacing": f"{box / sites} nm", "output.fields": ["segments"],
        "output.checkpoint": "none", **held}, out / f"cycle-{reach}-{sites}-{wide}-{k}")
    with h5py.File(result.directory / "run.h5") as file:
        series = file["series"]
        at = series["drive_displacement" if held else "top_displacement"][:] + file["fields/segment-0"].attrs["reference_height"]
        force, segment = -1.602176634 * series["force"][:] / F0, series["segment"][:]
    into, out_of = (max((jump for jump in result.dissipated.jumps if jump["segment"] == s), key=lambda jump: jump["energy"])
                    for s in (0, 1))
    before, after, torn = (-1.602176634 * f / F0 for f in (*into["force"], out_of["force"][0]))
    jump = int(np.argmin(np.abs(force - after) + (segment != 0)))
    return {"range": reach, "box": wide, "sites": sites, "stiffness": k, "jump_in": 0.1 * at[jump] / D0, "before": before, "after": after,
            "jump_out": torn, "pull_off": force.max(), "lost": 1.602176634e-1 * result.dissipated.energy / (F0 * D0),
            "points": len(force), "iterations": result.run.iterations, "processor": result.run.processor_seconds}


def keep(out: pathlib.Path, row: dict) -> None:
    """Adds a row to the table of this kind of rows."""
    file = out / ("rings.csv" if "rings" in row else "cycles.csv")
    new = not file.exists()
    with file.open("a", newline="") as to:
        writer = csv.DictWriter(to, list(row))
        if new:
            writer.writeheader()
        writer.writerow(row)
    print(", ".join(f"{name} {value:.5g}" for name, value in row.items()), flush=True)


def limit(ranges: np.ndarray, apart: np.ndarray) -> float:
    """Extrapolates a difference that vanishes as a smooth function of the range: quadratic, by least squares, over the four
    smallest ranges."""
    return float(np.polynomial.Polynomial.fit(ranges[:4], apart[:4], 2).convert().coef[0])


def read(file: pathlib.Path) -> list[dict[str, float]]:
    with file.open() as rows:
        return sorted(({key: float(value) for key, value in row.items()} for row in csv.DictReader(rows)), key=lambda row: row["range"])


def table(out: pathlib.Path) -> None:
    """Rings beside JKR as the range falls, and the program beside rings at the same range."""
    circles, cycles = read(out / "rings.csv"), read(out / "cycles.csv")
    print("stiffness  number  JKR  rings extrapolated/JKR - 1  program/rings - 1 at each range")
    for k in STIFFNESS:
        mine = [row for row in circles if row["stiffness"] == k]
        ranges = np.array([row["range"] for row in mine])
        for name in ("after", "jump_out", "pull_off", "lost"):
            wanted = closed(k)[name]
            # the closed form with the jump into contact where it is at this range
            apart = np.array([row[name] - closed(k, row["jump_in"])[name] for row in mine])
            ratios = "  ".join(f"{row['range']:g}: {row[name] / ring[name] - 1:+.4f}" for row in cycles for ring in mine
                               if row["stiffness"] == k and row["range"] == ring["range"])
            print(f"{k:5} {name:9} {wanted:8.4f} {limit(ranges, apart) / wanted:+.4f}  {ratios}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("rings", "limits", "cycles", "table"))
    parser.add_argument("--ranges", type=float, nargs="+", default=[0.4, 0.28, 0.2, 0.14, 0.1, 0.07, 0.05])
    parser.add_argument("--range", type=float, default=0.4)
    parser.add_argument("--sites", type=int, default=64)
    parser.add_argument("--wide", type=float, default=1.25, help="box over the diameter of the contact without a load")
    parser.add_argument("--only", type=float)
    parser.add_argument("--out", default="results/spring", type=pathlib.Path)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    if args.what == "limits":
        return limits(args.ranges)
    if args.what == "table":
        return table(args.out)
    if args.what == "rings":
        for reach in args.ranges:
            for row in of_rings(reach):
                keep(args.out, row)
        return
    for k in STIFFNESS:
        if args.only in (None, k):
            keep(args.out, of_program(args.out, args.range, args.sites, k, args.wide))


if __name__ == "__main__":
    main()
