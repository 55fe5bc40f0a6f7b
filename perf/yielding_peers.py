#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Contact of a surface that yields, without adhesion, by Asperity, Tamaas and ContactMechanics on the same maps:
yielding_peers.py ENV [--first 0] [--maps 10] [--sites 64] [--out FOLDER]

ENV is the environment of the others, as peers.py makes it. The maps are those without attraction of scenes/validation/yielding.py, loaded to
0.01, 0.1, 0.5, 0.9 and 0.99 of the hardness one after the other: KatoSaturated of Tamaas, the conjugate gradients of ContactMechanics with a
PlasticTopography. The tolerance of the others is 1e-6. A state counts as found if the mean pressure is the load and the gaps of sites in
contact that do not yield are 0, both to 1e-3 of the load and the rms height. Prints, and appends to yielding.csv, for each map the loads that
were found, the area in contact and the part of it at the hardness at 0.5 and 0.99 of the hardness (counted sites), and processor seconds of
the whole process.
"""
import argparse
import csv
import json
import pathlib
import sys
import tempfile

import numpy as np
import peers

sys.path.insert(0, str(peers.ROOT / "scenes/validation"))
PARTS = (0.01, 0.1, 0.5, 0.9, 0.99)
SHOWN = (0.5, 0.99)
TOLERANCE, MOST = 1e-6, 5000
AT_HARDNESS, FOUND = 0.999, 1e-3


def state(case: dict, load: float, pressure: np.ndarray, gap: np.ndarray) -> dict:
    """Area, part of it at the hardness, and whether the state was found. gap: over the surface with its set, Å."""
    contact, yields = pressure > 1e-6 * case["hardness"], pressure > AT_HARDNESS * case["hardness"]
    held = contact & ~yields
    apart = float(np.abs(gap[held] - gap[held].mean()).max()) if held.any() else 0.0
    return {"area": float(contact.mean()), "yielding": float(yields.mean()),
            "found": bool(abs(pressure.mean() / load - 1) < FOUND and apart < FOUND * case["rms"])}


def tamaas(case: dict, heights: np.ndarray) -> list[dict]:
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(1)
    n, edge, hardness = heights.shape[0], case["edge"], case["hardness"] / case["modulus"]
    model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n])  # in other units than E* and the edge the solver hardly moves
    model.E, model.nu = 1.0, 0.0
    solver = tm.KatoSaturated(model, np.ascontiguousarray(heights / edge), TOLERANCE, hardness)
    solver.max_iter, solver.dump_freq = MOST, 10**9
    found = []
    for part in PARTS:
        solver.solve(part * hardness)
        pressure, gap = case["modulus"] * np.array(model.traction), edge * np.array(model.displacement) - heights
        found.append(state(case, part * case["hardness"], pressure, gap))
    return found


def contact_mechanics(case: dict, heights: np.ndarray) -> list[dict]:
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from ContactMechanics.Factory import make_plastic_system
    from SurfaceTopography import PlasticTopography, Topography

    n, edge = heights.shape[0], case["edge"]
    surface = PlasticTopography(Topography(heights, physical_sizes=(edge, edge)), case["hardness"])
    system = make_plastic_system(substrate=PeriodicFFTElasticHalfSpace((n, n), case["modulus"], (edge, edge)), surface=surface)
    found, before = [], {}
    for part in PARTS:
        load = part * case["hardness"]
        solved = system.minimize_proxy(external_force=load * edge**2, pentol=TOLERANCE * case["rms"], maxiter=MOST, **before)
        if not solved.success:
            found.append({"area": None, "yielding": None, "found": False})
            continue
        pressure = np.asarray(solved.jac) * (n / edge) ** 2
        before = {"initial_displacements": solved.x, "initial_forces": solved.jac}
        found.append(state(case, load, pressure, np.asarray(solved.x) - surface.heights()))
    return found


OTHERS = {"Tamaas": tamaas, "ContactMechanics": contact_mechanics}


def by_asperity(program: str, place: pathlib.Path, keys: dict, hardness: float) -> tuple[list[dict], float, dict]:
    """States and processor seconds by Asperity, and the map as a case for the others."""
    loads = [part * hardness * 1e3 for part in PARTS]
    keys = keys | {"interface.hardness": f"{hardness:.8g} GPa", "output.fields": '["segments"]',
                   "drive.path": json.dumps([f"load {load:.8g} MPa" for load in loads])}
    text = "".join(f"{key} = {json.dumps(value) if not isinstance(value, str) or value[:1] not in '[' else value}\n" for key, value in keys.items())
    (place.parent / "scene.toml").write_text(text)
    _, seconds, _ = peers.measured([program, "run", str(place.parent / "scene.toml"), "--progress", "off", "--quiet", "--out", str(place)])
    import h5py  # not in the environment of the others

    with h5py.File(place / "run.h5") as file:
        heights = file["substrate/height"][:]
        fields = [(file[f"fields/segment-{i}/pressure"][:], file[f"fields/segment-{i}/gap"][:]) for i in range(len(PARTS))]
    np.save(place.parent / "map.npy", heights)
    case = {"map": str(place.parent / "map.npy"), "edge": keys["surface.sites"] * keys["surface.spacing"],
            "modulus": 10 * peers.GPA, "hardness": hardness * peers.GPA, "rms": float(heights.std())}
    states = [state(case, part * case["hardness"], pressure * peers.GPA, gap) for part, (pressure, gap) in zip(PARTS, fields)]
    return states, seconds, case


def row(number: int, program: str, states: list[dict], seconds: float) -> dict:
    """A row of the table."""
    shown = {}
    for part in SHOWN:
        one = states[PARTS.index(part)]
        shown |= {f"area at {part:g} H": one["area"], f"at the hardness at {part:g} H": one["yielding"]}
    return {"map": number, "program": program, "loads found": f"{sum(one['found'] for one in states)} of {len(PARTS)}",
            **shown, "processor seconds": seconds}


def main() -> None:
    if sys.argv[1:2] == ["--solve"]:  # in the environment of the others
        case = json.loads(pathlib.Path(sys.argv[3]).read_text())
        print(json.dumps(OTHERS[sys.argv[2]](case, np.load(case["map"]))))
        return
    from yielding import keys_of

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("environment", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--maps", type=int, default=10)
    parser.add_argument("--sites", type=int, default=64)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/yielding-peers"))
    parser.add_argument("--program", default=str(peers.ROOT / "asperity"))
    asked = parser.parse_args()
    python = asked.environment / "bin/python"
    if not python.exists():
        print(f"yielding: no {python}; make it as peers.py says in its first lines", file=sys.stderr)
        sys.exit(77)
    asked.out.mkdir(parents=True, exist_ok=True)
    with open(asked.out / "yielding.csv", "a", newline="") as file:
        for number in range(2 * asked.first, 2 * (asked.first + asked.maps), 2):  # every other one has no attraction
            keys, hardness = keys_of(number, asked.sites)
            with tempfile.TemporaryDirectory() as scratch:
                states, seconds, case = by_asperity(asked.program, pathlib.Path(scratch) / "asperity", keys, hardness)
                rows = [row(number, "Asperity", states, seconds)]
                (pathlib.Path(scratch) / "case.json").write_text(json.dumps(case))
                for name in OTHERS:
                    text, seconds, _ = peers.measured([str(python), __file__, "--solve", name, f"{scratch}/case.json"])
                    rows.append(row(number, name, json.loads(text.splitlines()[-1]), seconds))
            writer = csv.DictWriter(file, rows[0], lineterminator="\n")
            if file.tell() == 0:
                writer.writeheader()
            for one in rows:
                writer.writerow({name: f"{value:.4g}" if isinstance(value, float) else "-" if value is None else value
                                 for name, value in one.items()})
                print("  ".join(f"{value:.4g}" if isinstance(value, float) else str(value) for value in one.values()), flush=True)
            file.flush()


if __name__ == "__main__":
    main()
