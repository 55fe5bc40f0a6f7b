#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What the spacing costs: error against processor seconds of contacts on several meshes, as a continuum and as a lattice, and by
Tamaas and ContactMechanics on the same maps: mesh.py ENV [--only CASE] [--out FOLDER] [--plot FILE]

ENV is the environment of the others, as peers.py makes it. Cases: a rough wall that repels, under a load of 0.01 E*, and one with an
exponential attraction, without a load (a box of 640 Å, shortest wave 40 Å, 4 to 32 sites); a smooth tip; sliding rubber of four to 16
sites in the shortest wave. The truth is the continuum on a mesh twice as fine as the finest. The others find the state of a rough wall at
the mean gap that Asperity found on the same mesh.
"""
import argparse
import csv
import json
import pathlib
import sys
import tempfile

import numpy as np
import peers

EDGE, WAVES, RANGE = 640.0, 16, 3.0
MODULUS = 1.0 * peers.GPA / (1 - 0.3**2)
WALL = {"block.young": 1, "block.poisson": 0.3, "interface.kind": "wall", "interface.range": RANGE, "drive.mode": "quasistatic",
        "output.checkpoint": "none"}
ROUGH = WALL | {"surface.rms": 3, "surface.hurst": 0.8, "surface.rolloff": 2, "surface.q_max": WAVES, "drive.path": "relax"}
CASES = {
    "repulsion": (EDGE, (64, 128, 256, 512), ROUGH | {"interface.adhesion": 0, "drive.load": 10}, {"area": "contact_area"}),
    "adhesion": (EDGE, (64, 128, 256, 512), ROUGH | {"interface.adhesion": 0.5}, {"area": "contact_area", "energy": "binding_energy"}),
    "tip": (600.0, (32, 48, 64, 96), WALL | {"surface.kind": "flat", "surface.radius": 1000, "surface.boundary": "free", "interface.adhesion": 0.3,
                                            "interface.range": 3, "output.fields": "[]"}, {"pull-off force": "pull_off_force"}),
    "slide": (320.0, (32, 64, 128), WALL | {
        "surface.rms": 3, "surface.hurst": 0.8, "surface.rolloff": 2, "surface.q_max": 8, "interface.adhesion": 0, "drive.control": "mean-height",
        "block.prony": '[[3.0, "10 ns"]]', "drive.velocity": 0.3, "drive.load": 30, "output.fields": "[]",
        "drive.path": '["relax", "slide x 320 Å under load until steady"]'}, {"friction": "steady_friction"})}
"""Edge of the box, meshes, keys, and numbers of a result that are compared."""


def by_asperity(program: str, place: pathlib.Path, name: str, model: str, sites: int) -> dict:
    """The numbers of a case by Asperity, the area as counted, and processor seconds."""
    edge, _, keys, numbers = CASES[name]
    thick = {} if name == "tip" else {"block.thickness": sites * round(max(1.0, 640 / edge))}
    keys = keys | thick | {"surface.sites": sites, "surface.spacing": edge / sites, "block.model": model}
    sets = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    _, seconds, _ = peers.measured([program, "run", "-", "--progress", "off", "--quiet", "--out", str(place), *sets])
    result = json.loads((place / "result.json").read_text())
    last = (result.get("segments") or [{}])[-1]
    return {number: last.get(path, result.get(path)) for number, path in numbers.items()} | {
        "counted": result["contact_fraction"], "seconds": seconds}


def by_peers(environment: pathlib.Path, scratch: pathlib.Path, place: pathlib.Path, adhesion: float) -> list[dict]:
    """The state of a rough wall by the others, at the mean gap of the state in a folder."""
    _, gap, heights = peers.maps(place)
    np.save(scratch / "map.npy", heights)
    given = {"map": f"{scratch}/map.npy", "edge": EDGE, "modulus": MODULUS, "adhesion": max(1e-3 * adhesion, 1e-12), "range": RANGE,
             "gap": float(np.maximum(gap, 0).mean()), "tolerance": peers.TOLERANCE * MODULUS, "relative": 1e-6}
    (scratch / "case.json").write_text(json.dumps(given))
    found = []
    for program, name in (("tamaas", "Tamaas"), ("adhesion", "ContactMechanics")):
        text, seconds, _ = peers.measured([str(environment / "bin/python"), peers.__file__, "--solve", program, f"{scratch}/case.json"])
        solved = json.loads(text.splitlines()[-1])
        found.append({"program": name, "area": solved["area"], "energy": -1e3 * solved["energy"], "seconds": seconds})
    return found


def rows_of(name: str, arguments: argparse.Namespace, scratch: pathlib.Path) -> list[dict]:
    """The rows of a case: program, sites, number, error in per cent, processor seconds."""
    _, meshes, keys, numbers = CASES[name]
    truth = by_asperity(arguments.program, scratch / f"{name}-truth", name, "continuum", 2 * meshes[-1])
    rows = []
    for sites in meshes:
        places = {model: scratch / f"{name}-{model}-{sites}" for model in ("continuum", "lattice")}
        found = [{"program": model, **by_asperity(arguments.program, place, name, model, sites)} for model, place in places.items()]
        if name in ("repulsion", "adhesion"):
            found += by_peers(arguments.environment, scratch, places["continuum"], float(keys["interface.adhesion"]))
        rows += [{"case": name, "program": one["program"], "sites": sites, "number": number, "seconds": one["seconds"],
                  "error %": 100 * (one[number] / truth[number] - 1)} for one in found for number in numbers]
    return rows


def plot(rows: list[dict], file: pathlib.Path) -> None:
    """Draws the errors against processor seconds."""
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    panels = list(dict.fromkeys((r["case"], r["number"]) for r in rows))
    figure, axes = plt.subplots(1, len(panels), figsize=(3.1 * len(panels), 3.4), constrained_layout=True)
    for ax, (case, number) in zip(axes, panels):
        for program in dict.fromkeys(r["program"] for r in rows):
            own = [r for r in rows if (r["case"], r["number"], r["program"]) == (case, number, program)]
            ax.loglog([float(r["seconds"]) for r in own], [abs(float(r["error %"])) for r in own], "o-", label=program)
        ax.set(title=f"{case}: {number}", xlabel="processor seconds")
    axes[0].set_ylabel("error, %")
    axes[0].legend(fontsize=8)
    figure.savefig(file, metadata={"Date": None})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("environment", type=pathlib.Path)
    parser.add_argument("--only", choices=CASES, nargs="+", default=list(CASES))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/mesh-cost"))
    parser.add_argument("--program", default=str(peers.ROOT / "asperity"))
    parser.add_argument("--plot", type=pathlib.Path)
    arguments = parser.parse_args()
    if not (arguments.environment / "bin/python").exists():
        print(f"mesh: no {arguments.environment}/bin/python; make it as peers.py says in its first lines", file=sys.stderr)
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        rows = [row for name in arguments.only for row in rows_of(name, arguments, pathlib.Path(scratch))]
    arguments.out.mkdir(parents=True, exist_ok=True)
    with open(arguments.out / "mesh.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({name: f"{value:.3g}" if isinstance(value, float) else value for name, value in row.items()})
            print("  ".join(f"{value:10.3g}" if isinstance(value, float) else f"{value:>16}" for value in row.values()))
    if arguments.plot:
        plot(rows, arguments.plot)


if __name__ == "__main__":
    main()
