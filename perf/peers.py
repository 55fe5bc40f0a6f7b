#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The same adhesive rough contact by Asperity, Tamaas and ContactMechanics/Adhesion: peers.py ENV [--sites 128 256] [--loads 0 500]

    python3 -m venv ENV && ENV/bin/pip install tamaas==2.9.0 contactmechanics==1.8.3 adhesion==0.93

makes the environment of the others; without it the exit code is 77. Asperity finds the state under each load (MPa) over a wall with
exponential attraction; the others, at its mean gap, the state over a hard wall, from the same map, E*, w and range. Rows "lattice" are
Asperity with block.model = "lattice" and Adhesion with that block's stiffness for each wave, read off Asperity's own state (pressure over
displacement): all others are the same continuum. Compared: mean pressure
(difference over the largest tension w/range), contact area, energy of the gap (over w), processor seconds of the solution and of the
whole process, largest memory.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
GPA = 1 / 160.21766208
E = 77.2 * GPA / (1 - 0.42**2)
TOLERANCE = 1e-4


def tamaas(case: dict, heights: np.ndarray) -> tuple[np.ndarray, float, int]:
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(1)
    n, edge = heights.shape[0], case["edge"]
    start = time.process_time()
    model = tm.Model(tm.model_type.basic_2d, [edge, edge], [n, n])
    model.E, model.nu = case["modulus"], 0.0
    adhesion = tm.ExponentialAdhesionFunctional(heights)
    adhesion.parameters = {"rho": case["range"], "surface_energy": case["adhesion"]}
    solver = tm.PolonskyKeerRey(model, heights, case["relative"], tm.PolonskyKeerRey.gap, tm.PolonskyKeerRey.gap)
    solver.addFunctionalTerm(adhesion)
    solver.max_iter, solver.dump_freq = 5000, 10**9
    solver.solve(case["gap"])
    return np.array(model["gap"]), time.process_time() - start, -1


def adhesion(case: dict, heights: np.ndarray, softer: np.ndarray | None = None) -> tuple[np.ndarray, float, int]:
    from Adhesion.Interactions import Exponential
    from Adhesion.System import BoundedSmoothContactSystem
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from NuMPI.Optimization.CCGWithoutRestart import constrained_conjugate_gradients
    from SurfaceTopography import Topography

    n, edge = heights.shape[0], case["edge"]
    start = time.process_time()
    substrate = PeriodicFFTElasticHalfSpace((n, n), young=case["modulus"], physical_sizes=(edge, edge))
    if softer is not None:
        substrate.surface_stiffness = substrate.surface_stiffness * softer.T
        substrate.greens_function = substrate.greens_function / softer.T
    system = BoundedSmoothContactSystem(substrate, Exponential(case["adhesion"], case["range"]), Topography(heights, physical_sizes=(edge, edge)))
    offset = -case["gap"] - heights.mean()
    gap = np.maximum(0.0, case["gap"] + heights.mean() - heights)
    gap *= case["gap"] / gap.mean()
    found = constrained_conjugate_gradients(system.primal_objective(offset, gradient=True), system.primal_hessian_product, x0=gap.flatten(),
                                            mean_val=case["gap"], gtol=case["tolerance"], maxiter=5000)
    seconds = time.process_time() - start
    if not found.success:
        sys.exit(str(found.message))
    gap = np.asarray(found.x).reshape(n, n)
    return gap, seconds, int(found.nit)


def observables(case: dict, gap: np.ndarray, heights: np.ndarray, softer: np.ndarray | float = 1.0) -> dict:
    """Pressure, contact, energy for each area and residual of a gap, by one rule for all programs. softer: stiffness over E* q/2 (rfft2)."""
    n, edge, w, rho = gap.shape[0], case["edge"], case["adhesion"], case["range"]
    u = gap + heights
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(n, edge / n)[:, None], np.fft.rfftfreq(n, edge / n)[None, :])
    elastic = np.fft.irfft2(softer * case["modulus"] / 2 * q * np.fft.rfft2(u), s=(n, n))
    pull = w / rho * np.exp(-np.maximum(gap, 0) / rho)
    open_sites = gap > 1e-9 * edge
    pressure = -np.mean((elastic + pull)[open_sites])  # the uniform pressure of the free sites' balance
    return {"pressure": pressure, "area": 1.0 - np.mean(open_sites),
            "energy": float(0.5 * np.mean((u - u.mean()) * elastic) - w * np.mean(np.exp(-np.maximum(gap, 0) / rho))),
            "residual": float(np.max(np.abs((elastic + pull)[open_sites] + pressure)) * (edge / n) ** 2)}


def solve(name: str, case: dict) -> dict:
    """One contact by another program, in its environment. The case has the map (npy, Å), the edge of the box (Å), E* (eV/Å³), w (eV/Å²),
    range (Å), the mean gap (Å), the tolerance of the residual (eV/Å for each site), and for Adhesion "softer" if the block is no
    half-space: its stiffness for each wave over E* q/2 (npy)."""
    heights = np.load(case["map"])
    softer = np.load(case["softer"]) if "softer" in case else None
    gap, seconds, iterations = tamaas(case, heights) if name == "tamaas" else adhesion(case, heights, softer)
    return {"seconds": seconds, "iterations": iterations} | observables(case, gap, heights, 1.0 if softer is None else softer)


def measured(command: list[str]) -> tuple[str, float, float]:
    """Output, processor seconds and MB of a command."""
    with tempfile.TemporaryFile("w+") as out:
        child = subprocess.Popen(command, stdout=out, stderr=sys.stderr, env=os.environ | {"OMP_NUM_THREADS": "1"})
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = status
        if status:
            sys.exit(f"failed: {' '.join(command)}")
        out.seek(0)
        return out.read(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def maps(place: pathlib.Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pressure (GPa), gap and heights (Å) of a state."""
    import h5py  # not in the environment of the others

    with h5py.File(place / "run.h5") as f:
        return tuple(f[name][:] for name in ("fields/relaxed/pressure", "fields/relaxed/gap", "substrate/height"))


def stiffness(place: pathlib.Path, sites: int) -> np.ndarray:
    """Stiffness of the block for each wave over E* q/2 (rfft2, mean wave 1), from a state's pressure and displacement."""
    pressure, gap, heights = maps(place)
    pressure, u = pressure * GPA, gap + heights
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(sites, 2.6)[:, None], np.fft.rfftfreq(sites, 2.6)[None, :])
    q[0, 0] = 1.0
    softer = np.abs(np.fft.rfft2(pressure) / np.fft.rfft2(u)) / (E / 2 * q)
    softer[0, 0] = 1.0
    return softer


def compare(a: argparse.Namespace, python: pathlib.Path, sites: int, load: float, model: str, others: tuple[str, ...]) -> None:
    """Prints the rows of a contact of Asperity's block of this model and of other programs."""
    w = 1e-3 * a.adhesion
    attraction = w / a.range * 2.6**2  # of a site, eV/Å: what drive.tolerance is a fraction of
    label = "" if model == "continuum" else f", {model}"
    with tempfile.TemporaryDirectory() as scratch:
        place = pathlib.Path(scratch) / "asperity"
        keys = {"drive.path": "relax", "block.model": model, "block.thickness": sites, "interface.kind": "wall",
                "interface.adhesion": a.adhesion, "interface.range": a.range, "surface.sites": sites, "surface.rms": 1.5,
                "surface.q_max": sites / 8, "output.checkpoint": "none", "drive.load": load, "drive.tolerance": TOLERANCE / attraction}

        def options(keys: dict, place: pathlib.Path) -> list[str]:
            return [a.program, "run", str(ROOT / "scenes/first-contact.toml"), "--progress", "off", "--set",
                    *(f"{k}={v}" for k, v in keys.items()), "--out", str(place)]

        _, process, memory = measured(options(keys, place))
        result = json.loads((place / "result.json").read_text())
        _, gap, heights = maps(place)
        measured(options(keys | {"drive.tolerance": 1e-7 / attraction}, pathlib.Path(f"{place}-tight")))
        softer = stiffness(pathlib.Path(f"{place}-tight"), sites)
        np.save(f"{scratch}/map.npy", heights)
        case = {"map": f"{scratch}/map.npy", "edge": sites * 2.6, "modulus": E, "adhesion": w, "range": a.range,
                "gap": float(gap.mean()), "tolerance": TOLERANCE, "relative": 1e-6}
        if model == "lattice":
            np.save(f"{scratch}/softer.npy", softer)
            case["softer"] = f"{scratch}/softer.npy"
        pathlib.Path(f"{scratch}/case.json").write_text(json.dumps(case))
        mine = observables(case, gap, heights, softer)["energy"] / w
        print(f"{sites:5} {load:8g} {'asperity' + label:18} {result['contact_fraction']:.4f} {mine:9.5f} {0:20} "
              f"{result['relaxed']['residual_force']:9.1e} {result['run']['iterations']:11} "
              f"{result['run']['phases']['relax']['seconds']:8.2f} {process:10.2f} {memory:4.0f}", flush=True)
        for name in others:
            text, process, memory = measured([str(python), __file__, "--solve", name, f"{scratch}/case.json"])
            r = json.loads(text.splitlines()[-1])
            difference = (r["pressure"] - load * 1e-3 * GPA) / (w / a.range)
            print(f"{sites:5} {load:8g} {name + label:18} {r['area']:.4f} {r['energy'] / w:9.5f} {difference:20.5f} {r['residual']:9.1e} "
                  f"{r['iterations']:11} {r['seconds']:8.2f} {process:10.2f} {memory:4.0f}", flush=True)


def main() -> None:
    if sys.argv[1:2] == ["--solve"]:  # in the environment of the others
        print(json.dumps(solve(sys.argv[2], json.loads(pathlib.Path(sys.argv[3]).read_text()))))
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("environment", type=pathlib.Path)
    parser.add_argument("--sites", type=int, nargs="+", default=[128, 256])
    parser.add_argument("--loads", type=float, nargs="+", default=[0, 500])
    parser.add_argument("--adhesion", type=float, default=30.0, help="meV/Å²")
    parser.add_argument("--range", type=float, default=1.0, help="Å")
    parser.add_argument("--program", default=str(ROOT / "asperity"))
    a = parser.parse_args()
    python = a.environment / "bin/python"
    if not python.exists():
        print(f"peers: no {python}; make it as {__file__} says in its first lines", file=sys.stderr)
        sys.exit(77)
    print("sites load/MPa program            area    energy/w  pressure-difference  residual  iterations  solve/s  process/s  MB")
    for sites in a.sites:
        for load in a.loads:
            compare(a, python, sites, load, "continuum", ("tamaas", "adhesion"))
            compare(a, python, sites, load, "lattice", ("adhesion",))


if __name__ == "__main__":
    main()
