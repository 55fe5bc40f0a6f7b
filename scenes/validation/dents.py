#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The pull-off of a sphere that was pressed until its whole contact was at the hardness, beside rings and a closed form.

    scenes/validation/dents.py [--sites 64] [--only OM ...] [--rings] [--out results/dents] [--csv FILE]

Unloaded, a half-space that bore the hardness H on a circle of radius A is a body whose height falls from its middle as the displacement
of this pressure does, whatever the sphere was. Its pull-off depends on om = w E*/(H² A) and on l/A, l = E* range²/w. Rings (rings.py)
find it for any range; the closed form (Mesarovic and Johnson 2000) is that of no range. The program presses the sphere and pulls it
off, with a contact whose radius is a third of the box, at a range of l = 1.5 spacings or w/H. --rings leaves the program's runs out.
Prints pull-offs over the largest load; nan where rings find no solution as far out as the contact comes off. The number of no range is
that of a line through the two shortest ranges. In the program the attraction presses as well as the load: rings stand beside it with the
contact of its area at the hardness, which is stated over that under the load alone. Runs take 2 to 24 s of a core at 64 sites, rings up
to some minutes for each om.
"""
import argparse
import math
import os
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scenes/validation")]
import rings  # noqa: E402
from printed import Printed  # noqa: E402

import asperity  # noqa: E402

PARAMETERS = (0.001, 0.01, 0.03, 0.1, 0.3, 1.0)
RANGES = (0.16, 0.08, 0.06, 0.04)
"""l over the radius r at which the contact comes off."""
RATIO, HARDNESS, SPACING = 0.02, 2.0, 10.0
"""Hardness over E*; hardness, GPa; spacing, Å."""
ROUND = 12.83
"""A E*/(R H) at a hundred times the load of the first yield."""
PULLED = 0.02
"""Parameter above which the middle of the contact is in tension before it comes off; rings are then pulled from contact outwards."""


def closed(om: float) -> tuple[float, float]:
    """Returns the pull-off of no range over the largest load, and the radius r/A at which the contact comes off."""
    x = np.linspace(0, 1, 200001)
    held = np.sqrt(8 * om / np.pi) * x**1.5 - 2 / np.pi * (np.arcsin(x) - x * np.sqrt(1 - x * x))
    return float(held.max()), float(x[held.argmax()])


def of_rings(om: float, length: float) -> float:
    """Returns the pull-off over the largest load by rings. length: l/A. Units: A, H, and heights of HA/E*."""
    reach = math.sqrt(om * length)
    held = closed(om)[1]
    finest = min(max(length / 10, held / 500), held / 60)
    edges = list(np.arange(0, min(1.1, 1.6 * held + 4 * length), finest))
    wide = finest
    while edges[-1] < 1.6:
        wide = min(1.06 * wide, 0.05)
        edges.append(edges[-1] + wide)
    body = rings.Rings(np.array(edges), 1.0)
    body.r[0] = 0.0
    one = np.array([1.0])
    top, at_edge = rings.disc(one, np.array([1e-9])), rings.disc(one, np.array([1 - 1e-12]))
    inside = np.minimum(body.r, 1 - 1e-12)
    shape = np.where(body.r < 1, top - rings.disc(one, inside), top - at_edge + ROUND / 2 * (body.r**2 - 1))
    shape[0] = 0.0
    law = rings.Exponential(om, reach, max(400 * om / reach**2, 400 * math.pi / max(held, 0.1)))
    try:
        if om > PULLED:
            force = rings.pulled(body, shape, law, -1.1 * float(top[0]), 0.1 * reach, 3.0)[1]
        else:
            pressed = -np.linspace(0, 1.0, 240)[1:] / law.stiffness
            force = rings.whole(body, shape, law, np.concatenate([np.geomspace(9 * reach, 0.02 * reach, 300), pressed]))[1]
    except ArithmeticError:  # no solution at a place on the way
        return math.nan
    return float(-force.min() / math.pi) if force.argmin() < len(force) - 1 else math.nan  # nan: the way ends before the contact comes off


def run(om: float, sites: int, out: str) -> tuple[float, float, float, float]:
    """Returns the pull-off over the largest load by the program, the contact at the hardness over that under the load alone, l/A, and its
    processor time, s."""
    contact, modulus = sites / 3 * SPACING, HARDNESS / RATIO
    work = om * HARDNESS * RATIO * contact  # GPa Å
    reach = max(work / HARDNESS, math.sqrt(1.5 * SPACING * work / modulus))
    load = math.pi * contact**2 * HARDNESS / (sites * SPACING) ** 2
    found = asperity.run({}, {
        "surface.kind": "flat", "surface.sites": sites, "surface.spacing": SPACING, "surface.boundary": "free",
        "surface.radius": contact / (ROUND * RATIO), "block.young": f"{modulus} GPa", "block.poisson": 0, "interface.kind": "wall",
        "interface.adhesion": f"{0.1 * work:.10g} J/m^2", "interface.range": reach, "interface.hardness": f"{HARDNESS} GPa",
        "interface.edge_pinning": "allow", "drive.mode": "quasistatic", "drive.path": ["approach", f"load {1000 * load:.10g} MPa", "pull-off"],
        "drive.displacement_step": 0.5 * reach, "output.fields": [], "output.checkpoint": "none"},
        out=out, progress=False)
    force = np.asarray(found.series["force"])
    area = found["segments"][1]["yielding_fraction"] * (sites * SPACING / contact) ** 2 / math.pi
    return (float(-force[int(np.argmax(force)):].min() / force.max()), area, modulus * reach**2 / work / contact,
            found["run"]["processor_seconds"])


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--sites", type=int, default=64)
    words.add_argument("--only", type=float, nargs="+", default=PARAMETERS, metavar="OM")
    words.add_argument("--rings", action="store_true")
    words.add_argument("--out", default="results/dents")
    words.add_argument("--csv", type=pathlib.Path)
    asked = words.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # few sites
    table = Printed("om", "closed", f"rings, l/r {RANGES[0]}", *map(str, RANGES[1:]), "to no range", "over closed", "l/A", "area", "program",
                    "rings", "over rings", "processor, s")
    for om in asked.only:
        limit, held = closed(om)
        found = [of_rings(om, part * held) for part in RANGES]
        # A zone of attraction that is short beside the contact changes the pull-off in proportion to its length, about l.
        (far, more), (near, less) = [(part, one) for part, one in zip(RANGES, found, strict=True) if not math.isnan(one)][-2:]
        ends = less - near * (more - less) / (far - near)
        row = [f"{om:g}", f"{limit:.5f}", *(f"{one:.5f}" for one in found), f"{ends:.5f}", f"{ends / limit:.4f}"]
        if asked.rings:
            row += [""] * 6
        else:
            pulled, area, length, seconds = run(om, asked.sites, f"{asked.out}/{om:g}")
            wider = math.sqrt(area)
            same = area * of_rings(om / wider, length / wider)
            row += [f"{length:.4f}", f"{area:.4f}", f"{pulled:.5f}", f"{same:.5f}", f"{pulled / same:.3f}", f"{seconds:.0f}"]
        table.add(*row)
    table.write(asked.csv)


if __name__ == "__main__":
    main()
