#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Problems with closed forms over a wall (interface.kind = "wall"): a table beside each closed form.

    scenes/validation/wall.py westergaard | johnson [--out results/wall]

westergaard: contact of a wave without adhesion against pressure. johnson: the adhesive wave at zero load, for several ranges
of the attraction, extrapolated.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
GPA = 1 / 160.21766208  # eV/Å³
E = 77.2 * GPA / (1 - 0.42**2)


class Runs:
    def __init__(self, out: pathlib.Path, program: str):
        self.out, self.program = out, program
        out.mkdir(parents=True, exist_ok=True)

    def sine(self, sites: int, amplitude: float) -> dict:
        """Keys of a map of one wave along x, h cos(2πx/λ), λ the box."""
        path = self.out / f"sine-{sites}-{amplitude:.6g}.txt"
        row = " ".join(f"{amplitude * math.cos(2 * math.pi * x / sites):.9f}" for x in range(sites))
        path.write_text("\n".join([row] * sites) + "\n")
        return {"surface.kind": "file", "surface.file": path.resolve(), "surface.sites": sites, "surface.rms": amplitude / math.sqrt(2)}

    def state(self, name: str, keys: dict) -> dict:
        """The relaxed state of a scene over a wall; a run that is there already is read."""
        place = self.out / name
        if not (place / "result.json").exists():
            settings = {"drive.path": "zero-load", "block.model": "spectral", "interface.kind": "wall", "theory.renormalised": "false",
                        "output.checkpoint": 0, **keys}
            settings.setdefault("block.thickness", settings["surface.sites"])
            command = [self.program, "run", str(ROOT / "scenes/paper/flat-3A.toml"), "--progress", "off", "--out", str(place),
                       "--set", *(f"{k}={v}" for k, v in settings.items())]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode:
                sys.exit(f"{' '.join(command)}\n{done.stderr}")
        return json.loads((place / "result.json").read_text())


def westergaard(runs: Runs) -> None:
    print("sites  p/p*   f       closed form  deviation")
    for sites in (128, 256):
        box, amplitude = sites * 2.6, 0.01 * sites * 2.6
        peak = math.pi * E * amplitude / box
        for load in (0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98):
            r = runs.state(f"westergaard-{sites}-{load}", runs.sine(sites, amplitude) | {"interface.adhesion": 0, "drive.load": load * peak / GPA * 1e3})
            f, exact = r["contact_fraction"], 2 / math.pi * math.asin(math.sqrt(load))
            print(f"{sites:5} {load:5} {f:8.4f} {exact:8.4f} {f - exact:12.4f}")


def johnson_exact(alpha: float) -> tuple[float, float]:
    """Contact fraction and binding energy over w at zero load (docs/validation.md)."""
    low, high = 0.0, 0.999
    branch = lambda f: math.sin(math.pi * f / 2) ** 2 - alpha * math.sqrt(math.tan(math.pi * f / 2))
    low = max((k / 1000 for k in range(1, 900) if branch(k / 1000) < 0 <= branch((k + 1) / 1000)), default=0.0)
    high = low + 0.001
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if branch(middle) < 0 else (low, middle)
    f = low
    # Energies over w, in units where p* = 1: E* h² π / λ = 2 / (π α² ) w ... by quadrature of U = ∫ p C dp.
    steps, U = 20000, 0.0
    c = lambda x: -math.log(math.sin(math.pi * x / 2))
    for k in range(steps):
        a, b = f * k / steps, f * (k + 1) / steps
        x = (a + b) / 2
        U += math.sin(math.pi * x / 2) ** 2 * c(x) * (math.sin(math.pi * b / 2) ** 2 - math.sin(math.pi * a / 2) ** 2)
    p = math.sin(math.pi * f / 2) ** 2
    scale = 4 / alpha**2 / math.pi * 1.0  # 2 λ p*² / (π E* w) = 2 π E* h² / (λ w) = 4 / (π α²)
    return f, f - scale * U + scale * c(f) * p * p / 2


def johnson(runs: Runs) -> None:
    w, box = 0.1, 332.8
    print("alpha  range/Å  sites  f       closed   energy/w  closed   excess")
    for alpha in (0.3, 0.5):
        amplitude = math.sqrt(2 * w * box / (math.pi**2 * E)) / alpha
        f0, g0 = johnson_exact(alpha)
        excess = []
        for reach, sites in ((2.0, 128), (1.0, 256), (0.5, 512)):
            r = runs.state(f"johnson-{alpha}-{reach}-{sites}", runs.sine(sites, amplitude) | {
                "surface.spacing": box / sites, "interface.adhesion": 1e3 * w, "interface.range": reach})
            g = r["binding_energy"] / r["delta_gamma"]
            excess.append(g - g0)
            print(f"{alpha:5} {reach:6} {sites:7} {r['contact_fraction']:8.4f} {f0:8.4f} {g:9.4f} {g0:8.4f} {g - g0:9.4f}")
        a, b, c = excess
        print(f"      extrapolated to range zero: {c - (b - c) ** 2 / ((a - b) - (b - c)):.4f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problem", choices=["westergaard", "johnson"])
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/wall"))
    parser.add_argument("--program", default=str(ROOT / "asperity"))
    arguments = parser.parse_args()
    globals()[arguments.problem](Runs(arguments.out, arguments.program))
