#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""How often a number over walls at a quarter of the spacing lies within the error that a run states (docs/reports/mesh.md).

    scenes/validation/mesh.py [--first 0] [--scenes 30] [--finer 1] [--jobs 1] [--out results/mesh]

Scenes are drawn at random by their number: rough walls with and without a coating, smooth and rough tips, sliding rubber; walls by
the exponential law, Dugdale's and powers; 32 sites along the edge, or a finer mesh of the same scenes. The same call goes on where
it stopped. Ten minutes of one core for 30 scenes.
"""
import argparse
import concurrent.futures
import csv
import math
import pathlib
import random
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402

GPA = 1 / 160.21766208  # eV/Å³
KINDS = ("rough", "tip", "coated", "rough tip", "slide")
LAWS = ("exponential", "dugdale", "power")
SPACING = 10.0  # Å
STATED = {"binding_energy": ("binding_energy_uncertainty", "mesh_error.binding_energy"), "contact_area": ("contact_area_uncertainty",),
          **{f"work_of_drive.{way}": (f"work_of_drive.uncertainty.{way}", f"mesh_error.work_of_drive.{way}") for way in ("approach", "pull_off")},
          "approach_force": ("mesh_error.approach_force",), "pull_off_force": ("mesh_error.pull_off_force",),
          "slide.steady_friction": ("slide.steady_friction_error",)}
"""Numbers and the errors that are stated with them, of the solver and of the spacing."""


def scene(number: int) -> dict[str, object]:
    """Returns the keys of a scene, by its number. The attraction reaches two to twelve sites beside the edge of a contact; a rough
    surface has four or eight sites in its shortest wave."""
    draw = random.Random(number)
    kind, law = KINDS[number % len(KINDS)], LAWS[number // len(KINDS) % len(LAWS)]
    sites = 32
    young, poisson = 10 ** draw.uniform(-1, 2), draw.uniform(0.2, 0.48)
    modulus = young * GPA / (1 - poisson**2)
    zone, waves, slope = draw.uniform(2, 12) * SPACING, draw.choice([sites // 8, sites // 4]), draw.uniform(0.05, 0.25)
    shortest = 2 * math.pi * waves / (sites * SPACING)
    work = draw.uniform(0.2, 1.5) * modulus * slope**2 / (2 * shortest)  # beside the elastic energy of full contact
    radius = draw.uniform(60, 200) * SPACING
    if "tip" in kind:
        work = modulus * 2 * (draw.uniform(4, 8) * SPACING) ** 3 / (9 * math.pi * radius**2)  # of a contact of 4 to 8 sites
    keys: dict[str, object] = {
        "surface.sites": sites, "surface.spacing": SPACING, "block.young": young, "block.poisson": poisson, "interface.kind": "wall",
        "interface.law": law, "interface.range": math.sqrt(zone * work / modulus), "interface.adhesion": 1e3 * work,
        "interface.edge_pinning": "allow", "output.fields": [], "output.checkpoint": "none", "drive.mode": "quasistatic",
        "drive.path": ["approach", "pull-off"]}
    if kind != "tip":
        keys |= {"surface.rms": 2 * slope / shortest, "surface.seed": number, "surface.hurst": round(draw.uniform(0.6, 0.9), 2), "surface.rolloff": 2,
                 "surface.q_max": waves}
    if "tip" in kind:
        keys |= {"surface.radius": radius, "surface.boundary": "free"}
        keys |= {"surface.kind": "flat"} if kind == "tip" else {"surface.rms": draw.uniform(0.2, 0.8) * keys["interface.range"]}
        return keys
    keys |= {"drive.control": "mean-height", "block.thickness": 2 * sites}
    if kind == "slide":
        keys |= {"block.prony": [[draw.uniform(1, 5), "10 ns"]], "drive.velocity": 10 ** draw.uniform(-1.5, 0.5),
                 "drive.load": 1e3 * young * draw.uniform(0.02, 0.1), "drive.path": ["relax", "slide x 320 Å under load until steady"],
                 "interface.law": "exponential", "interface.adhesion": 0.0, "interface.range": 2.0}
        del keys["interface.edge_pinning"]
    elif kind == "coated":
        keys["block.layers"] = [[draw.uniform(1, 6) * SPACING, young * 10 ** draw.uniform(-1, 1), 0.3]]
    return keys


def meshed(keys: dict[str, object], factor: int) -> dict[str, object]:
    """Returns the scene at a spacing divided by a factor, with the same waves of its surface."""
    thick = {"block.thickness": factor * keys["block.thickness"]} if "block.thickness" in keys else {}
    return {**keys, "surface.sites": factor * keys["surface.sites"], "surface.spacing": keys["surface.spacing"] / factor, **thick}


def run(number: int, factor: int, out: pathlib.Path) -> asperity.Result:
    """Returns the result of a scene at a spacing divided by a factor, run if its folder has none."""
    place = out / f"{number}-{factor}"
    return asperity.load(place) if (place / "result.json").exists() else asperity.run({"name": "mesh"}, meshed(scene(number), factor), place)


def of(result: asperity.Result, path: str) -> float:
    """Returns a number of a result, those of a segment from its last; NaN: it is not there."""
    slid = path.startswith("slide.")
    found = result.find(path) if not slid else result["segments"][-1].get(path[6:]) if "segments" in result else None
    return math.nan if found is None else float(found)


def compared(number: int, finer: int, out: pathlib.Path) -> list[dict[str, object]]:
    """Returns a row for each number with an error: the number, its error, and the one at a quarter of the spacing."""
    own, truth = run(number, finer, out), run(number, 4 * finer, out)
    keys = scene(number)
    rows = []
    for path, error in STATED.items():
        value, right = of(own, path), of(truth, path)
        stated = math.hypot(*(of(own, one) for one in error))
        if math.isnan(value) or math.isnan(right):
            continue
        rows.append({"scene": number, "kind": KINDS[number % len(KINDS)], "law": keys["interface.law"], "number": path, "value": value,
                     "error": stated, "quarter": right, "off": (value - right) / stated if stated else math.nan,
                     "relative": stated / abs(value) if value else math.nan})
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--scenes", type=int, default=30)
    parser.add_argument("--finer", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/mesh"))
    given = parser.parse_args()
    rows: list[dict[str, object]] = []
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        for new in pool.map(lambda number: compared(number, given.finer, given.out), range(given.first, given.first + given.scenes)):
            rows += new
            for r in new:
                print(f"{r['scene']:3} {r['kind']:9} {r['law']:11} {r['number']:28} {r['value']:11.5g} ± {r['error']:8.2g}  "
                      f"quarter {r['quarter']:11.5g}  {r['off']:+6.2f} errors", flush=True)
    with open(given.out / "mesh.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: f"{value:.5g}" if isinstance(value, float) else value for name, value in row.items()} for row in rows)
    for path in STATED:
        some = [r for r in rows if r["number"] == path and not math.isnan(r["error"])]
        off = np.array([abs(r["off"]) for r in some])
        print(f"{path}: {(off <= 1).sum()} of {len(off)} within the error, {sum(r['relative'] < 0.05 for r in some)} errors below 5 %")
    scenes = {r["scene"]: [one for one in rows if one["scene"] == r["scene"]] for r in rows}.values()
    small = sum(all(r["relative"] < 0.05 for r in some) for some in scenes)
    right = sum(all(math.isnan(r["error"]) or abs(r["off"]) <= 1 for r in some) for some in scenes)
    print(f"{right} of {len(scenes)} scenes with all numbers within their errors, {small} with all errors below 5 %, "
          f"{sum(any(math.isnan(r['error']) for r in some) for some in scenes)} say of a number that the mesh is not included")


if __name__ == "__main__":
    main()
