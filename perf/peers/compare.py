#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The same adhesive rough contact by Asperity, Tamaas and ContactMechanics/Adhesion: compare.py ENV [--sites 128 256] [--loads 0 500].

Asperity finds the state under each load (MPa) over a wall with exponential attraction; the others, at its mean gap, the state over a hard
wall, from the same map, E*, w and range; "lattice" is Adhesion with the stiffness of Asperity's block for each wave, read off Asperity's
own state (pressure over displacement). Compared: mean pressure (difference over the largest tension w/range), contact area, energy of
the gap (over w), processor seconds of the solution and of the whole process, largest memory. ENV: what setup.sh made; without it, exit
code 77.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from peer import observables

ROOT = pathlib.Path(__file__).resolve().parents[2]
GPA = 1 / 160.21766208
E = 77.2 * GPA / (1 - 0.42**2)
TOLERANCE = 1e-4


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


def stiffness(place: pathlib.Path, sites: int) -> np.ndarray:
    """Stiffness of the block for each wave over E* q/2 (rfft2, mean wave 1), from a state's pressure and displacement."""
    with h5py.File(place / "run.h5") as f:
        pressure, u = f["fields/zero-load/pressure"][:] * GPA, f["fields/zero-load/gap"][:] + f["substrate/height"][:]
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(sites, 2.6)[:, None], np.fft.rfftfreq(sites, 2.6)[None, :])
    q[0, 0] = 1.0
    softer = np.abs(np.fft.rfft2(pressure) / np.fft.rfft2(u)) / (E / 2 * q)
    softer[0, 0] = 1.0
    return softer


def main() -> None:
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
        print(f"peers: no {python}; perf/peers/setup.sh {a.environment} makes it", file=sys.stderr)
        sys.exit(77)
    w = 1e-3 * a.adhesion
    print("sites load/MPa program   area    energy/w  pressure-difference  residual  iterations  solve/s  process/s  MB")
    for sites in a.sites:
        for load in a.loads:
            with tempfile.TemporaryDirectory() as scratch:
                place = pathlib.Path(scratch) / "asperity"
                keys = {"drive.path": "zero-load", "block.thickness": sites, "interface.kind": "wall",
                        "interface.adhesion": a.adhesion, "interface.range": a.range, "surface.sites": sites, "surface.rms": 1.5,
                        "surface.cutoff": sites / 8, "theory.renormalised": "false", "output.checkpoint": 0, "drive.load": load,
                        "drive.tolerance": TOLERANCE}
                scene = [a.program, "run", str(ROOT / "scenes/first-contact.toml"), "--progress", "off", "--set"]
                options = lambda keys, place: scene + [f"{k}={v}" for k, v in keys.items()] + ["--out", str(place)]
                _, process, memory = measured(options(keys, place))
                result = json.loads((place / "result.json").read_text())
                with h5py.File(place / "run.h5") as f:
                    heights, gap = f["substrate/height"][:], f["fields/zero-load/gap"][:]
                measured(options(keys | {"drive.tolerance": 1e-7}, f"{place}-tight"))
                softer = stiffness(pathlib.Path(f"{place}-tight"), sites)
                np.save(f"{scratch}/map.npy", heights)
                np.save(f"{scratch}/softer.npy", softer)
                case = {"map": f"{scratch}/map.npy", "softer": f"{scratch}/softer.npy", "edge": sites * 2.6, "modulus": E, "adhesion": w,
                        "range": a.range, "gap": float(gap.mean()), "tolerance": TOLERANCE, "relative": 1e-6}
                pathlib.Path(f"{scratch}/case.json").write_text(json.dumps(case))
                mine = observables(case, gap, heights, softer)["energy"] / w
                print(f"{sites:5} {load:8g} asperity  {result['contact_fraction']:.4f} {mine:9.5f} {0:20} {result['zero_load']['residual_force']:9.1e} "
                      f"{result['run']['iterations']:11} {result['run']['phases']['relax']['seconds']:8.2f} {process:10.2f} {memory:4.0f}")
                for name in ("tamaas", "adhesion", "lattice"):
                    text, process, memory = measured([str(python), str(pathlib.Path(__file__).with_name("peer.py")), name, f"{scratch}/case.json"])
                    r = json.loads(text.splitlines()[-1])
                    difference = (r["pressure"] - load * 1e-3 * GPA) / (w / a.range)
                    print(f"{sites:5} {load:8g} {name:9} {r['area']:.4f} {r['energy'] / w:9.5f} {difference:20.5f} {r['residual']:9.1e} "
                          f"{r['iterations']:11} {r['seconds']:8.2f} {process:10.2f} {memory:4.0f}")


if __name__ == "__main__":
    main()
