#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The numbers of `asperity tip` for smooth tips beside an independent axisymmetric solution (rings.py).

    scenes/validation/tips.py [NAME ...] [--sites N] [--jobs N] [--out results/tips]

Of each tip the largest attraction, the separation at which it jumps in, the contact radius without load and the energy lost, with
their stated errors, and the same of rings on the same spring under the same attraction. Lengths in nm, forces in nN, energies in aJ.
"""
import argparse
import math
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scenes/validation")]
import rings  # noqa: E402

import asperity  # noqa: E402
from asperity.studies.tip import Contact  # noqa: E402

TIPS = {
    "stiff": {"radius": "30 nm", "young": "100 GPa", "poisson": 0.3, "adhesion": "100 mJ/m2", "stiffness": "40 N/m"},
    "diamond": {"radius": "8 nm", "young": "300 GPa", "poisson": 0.2, "adhesion": "200 mJ/m2", "stiffness": "100 N/m"},
    "colloid": {"radius": "1 um", "young": "70 GPa", "poisson": 0.2, "adhesion": "40 mJ/m2", "stiffness": "10 N/m"},
    "silica": {"radius": "50 nm", "young": "70 GPa", "poisson": 0.17, "adhesion": "80 mJ/m2", "stiffness": "20 N/m"},
    "long-ranged": {"radius": "50 nm", "young": "20 GPa", "poisson": 0.3, "adhesion": "60 mJ/m2", "stiffness": "5 N/m", "range": "1 nm"},
    "short-ranged": {"radius": "15 nm", "young": "10 GPa", "poisson": 0.3, "adhesion": "150 mJ/m2", "stiffness": "1 N/m", "range": "0.2 nm"},
    "glassy": {"radius": "100 nm", "young": "3 GPa", "poisson": 0.35, "adhesion": "50 mJ/m2", "stiffness": "2 N/m", "range": "0.6 nm"},
    "polymer": {"radius": "30 nm", "young": "5 GPa", "poisson": 0.35, "adhesion": "80 mJ/m2", "stiffness": "0.5 N/m"},
    "softer": {"radius": "20 nm", "young": "3 GPa", "poisson": 0.3, "adhesion": "50 mJ/m2", "stiffness": "0.2 N/m"},
    "small": {"radius": "10 nm", "young": "1 GPa", "poisson": 0.3, "adhesion": "60 mJ/m2", "stiffness": "0.05 N/m"},
    "rubber": {"radius": "200 nm", "young": "50 MPa", "poisson": 0.49, "adhesion": "30 mJ/m2", "stiffness": "0.1 N/m", "range": "2.4 nm"},
    "gel": {"radius": "2 um", "young": "2 MPa", "poisson": 0.49, "adhesion": "20 mJ/m2", "stiffness": "0.05 N/m", "range": "36 nm"},
}
COLUMNS = ("pull_off_force", "jump_in_distance", "contact_radius", "lost")


def turning(values: np.ndarray, i: int, other: np.ndarray) -> tuple[float, float]:
    """The extremum of values near i by a parabola through three points, and the other values there."""
    near = slice(i - 1, i + 2)
    bend, slope, _ = np.polyfit([-1, 0, 1], values[near], 2)
    at = -slope / (2 * bend)
    return float(np.polyval(np.polyfit([-1, 0, 1], values[near], 2), at)), float(np.polyval(np.polyfit([-1, 0, 1], other[near], 2), at))


def of_rings(contact: Contact, load: float, heights: int = 600) -> dict[str, float]:
    """The numbers by rings; load: nN; heights: number of gaps at the middle from far apart to a contact."""
    R, E, w, rho = contact.radius, contact.modulus, contact.work, contact.range
    largest = contact.radius_at(load)
    finest = max(min(E * rho**2 / w / 8, largest / 160), largest / 800)
    edges = list(np.arange(0, 1.12 * largest + 4 * finest, finest))
    wide, end = finest, min(0.98 * R, max(1.3 * largest + 2 * rho, math.sqrt(40 * R * rho) + largest))
    while edges[-1] < end:
        wide = min(1.06 * wide, max(end / 60, finest))
        edges.append(edges[-1] + wide)
    body = rings.Rings(np.array(edges), E)
    body.r[0] = 0.0
    shape = body.r**2 / (R + np.sqrt(R**2 - body.r**2))
    stiffness = max(50 * math.pi * E / largest * 20, 50 * w / rho**2)
    pressure = 3 * (load + 2 * contact.unit) / (math.pi * largest**2) + w / rho
    pressed = -np.linspace(0, pressure / stiffness, 4 * heights // 5)[1:]
    middle = np.concatenate([np.geomspace(9 * rho, 0.02 * rho, heights), np.linspace(0.018 * rho, 0, 8), pressed])
    height, force, radius = rings.whole(body, shape, rings.Exponential(w, rho, stiffness), middle)
    drive = height - force / contact.stiffness
    found = dict.fromkeys(COLUMNS, math.nan) | {"lost": 0.0}
    folds = np.flatnonzero(np.diff(drive) > 0)
    out = slice(None, None, -1)
    stays = np.flatnonzero((np.diff(drive[out]) < 0) & (np.arange(len(drive) - 1) > 0))
    end_of_contact = stays[0] + 1 if len(stays) else len(drive)
    held, places, radii = force[out][:end_of_contact], drive[out][:end_of_contact], radius[out][:end_of_contact]
    least = int(np.argmin(held))
    found["pull_off_force"] = -(turning(held, least, places)[0] if 0 < least < len(held) - 1 else held[least])
    zero = np.flatnonzero(np.diff(np.sign(held)))[:1]
    for i in zero:
        found["contact_radius"] = float(np.interp(0.0, held[[i + 1, i]], radii[[i + 1, i]]))
    if len(folds):
        found["jump_in_distance"] = turning(drive, folds[0], height)[1]
        approach = slice(folds[0], None, -1)
        at = np.linspace(drive[folds[0]], places[-1], 20001)
        gained = np.interp(at, drive[approach], force[approach]) - np.interp(at, places, held)
        found["lost"] = float(np.sum(0.5 * (gained[1:] + gained[:-1]) * np.diff(at)))
    return found


def compared(name: str, out: pathlib.Path, **options: object) -> dict[str, object]:
    """The row of a tip."""
    found = asperity.tip(**{**TIPS[name], **{key: value for key, value in options.items() if value is not None}}, out=out / name)
    truth = of_rings(found.contact, float(found.result.find("scene.drive.load")) * 1e-3 * (0.1 * found.result.edge) ** 2)
    row: dict[str, object] = {"tip": name, "Maugis": found.contact.parameter}
    for path in COLUMNS:
        number = found.number(path)
        row |= {path: number.estimate, f"error of {path}": number.error, f"{path} of rings": truth[path]}
    return row


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tips", nargs="*", metavar="NAME", default=list(TIPS))
    parser.add_argument("--sites", type=int)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", default="results/tips", type=pathlib.Path)
    args = parser.parse_args()
    rows = [compared(name, args.out, sites=args.sites, jobs=args.jobs) for name in args.tips or TIPS]
    print(",".join(rows[0]))
    for row in rows:
        print(",".join(("no jump" if math.isnan(v) else f"{v:.5g}") if isinstance(v, float) else str(v) for v in row.values()))


if __name__ == "__main__":
    main()
