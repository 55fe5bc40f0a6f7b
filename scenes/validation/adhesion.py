#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Pull-off over an adhesive wall against closed forms and an independent axisymmetric solution (rings.py).

    scenes/validation/adhesion.py punch | sphere [--picture FILE] | sticky [--small] [--out results/adhesion]

punch: a flat round punch against Kendall's force as the range of the attraction falls. sphere: one sphere from nearly rigid (Bradley)
to soft (JKR). sticky: where a rough surface's area against pressure changes the sign of its slope. --small: few sites, in seconds
(tests/python/test_validation.py). The last line is the time of the program's runs.
"""
import argparse
import math
import pathlib
import sys
import time

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "scenes/validation")]
import rings  # noqa: E402

import asperity  # noqa: E402
from asperity.theories import combined  # noqa: E402

GPA = 1 / 160.21766208  # eV/Å³
E = 77.2 * GPA / (1 - 0.42**2)


def wall(spacing: float, w: float, reach: float) -> rings.Exponential:
    """The program's wall at its own choice of stiffness, w in eV/Å²."""
    return rings.Exponential(w, reach, max(500 * math.pi * E / spacing, 50 * w / reach**2))


class Runs:
    def __init__(self, out: pathlib.Path, small: bool):
        self.out, self.small, self.seconds = out, small, 0.0
        out.mkdir(parents=True, exist_ok=True)

    def path(self, name: str, law: rings.Exponential, keys: dict) -> dict:
        """The series of a path at a held mean height over this wall. A result that is there is an error."""
        begun = time.monotonic()
        result = asperity.run({}, {
            "interface.kind": "wall", "interface.adhesion": 1e3 * law.adhesion, "interface.range": law.reach,
            "interface.stiffness": law.stiffness / GPA, "drive.mode": "quasistatic", "drive.control": "mean-height",
            "output.fields": [], "output.checkpoint": "none",
            "block.thickness": keys["surface.sites"], **keys}, self.out / name)
        self.seconds += time.monotonic() - begun
        with h5py.File(result.directory / "run.h5") as file:
            series = {k: file[f"series/{k}"][:] for k in ("force", "mean_height", "contact_fraction", "segment")}
        return series | {"result": result}


def punch(runs: Runs) -> list[dict]:
    """A surface of height 0 in a circle and beyond the interaction range around it. With images the compliance of a punch that sticks is
    C = [1/(2a) + φ0/(πL) + φ2 a²/(6πL³)]/E*, and Griffith's condition, -(P²/2) dC/da = 2πaw, gives Kendall's
    P² = 8πE*wa³ over 1 - 2φ2 a³/(3πL³)."""
    w, box, wanted = 0.1, 100.0, 25.0
    rows = []
    print("range/Å  sites  radius/Å  pull-off over Kendall's  rings   rings, half the range")
    for reach, sites in ((0.7, 64), (0.5, 128), (0.35, 256))[:1 if runs.small else 3]:
        spacing = box / sites
        x = (np.arange(sites) + 0.5) * spacing - box / 2
        inside = np.hypot(x[:, None], x[None, :]) < wanted
        radius = spacing * math.sqrt(inside.sum() / math.pi)
        file = (runs.out / f"punch-{sites}.npy").resolve()
        np.save(file, np.where(inside, 0.0, -40 * reach))
        kendall = math.sqrt(8 * math.pi * E * w * radius**3 / (1 - 2 * rings.PHI2 * radius**3 / (3 * math.pi * box**3)))
        r = runs.path(f"punch-{sites}", wall(spacing, w, reach), {
            "surface.kind": "file", "surface.file": file, "surface.sites": sites, "surface.spacing": spacing,
            "drive.displacement_step": 0.1, "drive.tolerance": 0.04 * reach})
        row = {"range": reach, "sites": sites, "radius": radius, "program": -r["force"].min() / kendall}
        for finer in (1, 2):
            law = wall(spacing / finer**2, w, reach / finer)
            around = rings.Rings(rings.towards(radius, E * law.reach**2 / w / 32), E, box)
            found = rings.pulled(around, np.zeros_like(around.r), law, 0.0, 0.05 * law.reach, 10.0)
            row["rings" if finer == 1 else f"rings/{finer}"] = -found[1].min() / kendall
        rows.append(row)
        print("{:6} {:7} {:9.3f} {:14.4f} {:17.4f} {:10.4f}".format(*row.values()), flush=True)
    return rows


def sphere(runs: Runs) -> list[dict]:
    """A sphere of 300 Å in a box of 332.8 Å, nearly rigid (Bradley: 2πw(R - range) for this law) to soft (JKR: 3πwR/2). In the last
    column the force along the whole pull-off, from zero load to where the rings have no solution or the force is a thousandth of the
    pull-off force, root mean square over the pull-off force."""
    radius, box = 300.0, 332.8
    rows = []
    print("w, meV/Å²  range/Å  sites  λ (Maugis)  pull-off over 2πwR  rings   Maugis-Dugdale  F - F of the rings")
    cases = ((0.7, 1.4, 64), (3.0, 1.4, 64), (10.0, 1.4, 64), (30.0, 1.4, 64), (30.0, 0.7, 128), (30.0, 0.35, 256))
    for energy, reach, sites in cases[3:4] if runs.small else cases:
        w, spacing, unit = 1e-3 * energy, box / sites, 2 * math.pi * 1e-3 * energy * radius
        law = wall(spacing, w, reach)
        r = runs.path(f"sphere-{energy}-{reach}", law, {
            "surface.kind": "flat", "surface.radius": radius, "surface.sites": sites, "surface.spacing": spacing,
            "drive.displacement_step": 0.02 if energy < 30 else 0.1, "drive.tolerance": 1.2e-3 * reach})
        width = min(0.5, E * reach**2 / w / 8)
        around = rings.Rings(np.arange(0, math.sqrt(30 * radius * reach) + 15, width), E, box)
        shape = radius - np.sqrt(radius**2 - around.r**2)
        height, force = rings.pulled(around, shape, law, -2.0, 0.02 * reach, 10 * reach)[:2]
        deepest, largest = height[force.argmin()], -force.min()
        if energy < 30:  # a sharp minimum
            largest = -rings.pulled(around, shape, law, deepest - 0.03 * reach, 0.002 * reach, deepest + 0.03 * reach)[1].min()
        out = (r["segment"] == r["segment"].max()) & (r["mean_height"] < height[np.abs(force) > 1e-3 * -force.min()].max())
        off = np.interp(r["mean_height"][out], height, force) - r["force"][out]
        theory = combined.of_run(r["result"])["theory"]["sphere"]
        rows.append({"energy": energy, "range": reach, "sites": sites, "lambda": theory["maugis_parameter"],
                     "program": -r["force"].min() / unit, "rings": largest / unit,
                     "maugis": 0.75 * theory["maugis_images"] / energy, "along": math.sqrt(np.mean(off**2)) / -force.min(),
                     "path": (r["mean_height"][out] / reach, r["force"][out] / unit), "curve": (height / reach, force / unit)})
        print("{:9} {:8} {:6} {:11.3f} {:19.4f} {:7.4f} {:11.4f} {:17.4f}".format(*rows[-1].values()), flush=True)
    return rows


def picture(rows: list[dict], file: pathlib.Path) -> None:
    """Force against height of the spheres' pull-off, the program's points on the lines of the rings."""
    from matplotlib.figure import Figure

    from asperity.plots.style import COLOURS, style
    with style():
        axes = (figure := Figure(figsize=(6, 4), layout="constrained")).subplots()
        for colour, row in zip(COLOURS, rows):
            axes.plot(*row["curve"], color=colour, lw=1)
            every = 1 + len(row["path"][0]) // 100
            axes.plot(*(values[::every] for values in row["path"]), ".", color=colour, ms=3, label=f"λ = {row['lambda']:.2f}")
        axes.set(xlim=(-6, 6), ylim=(-1.05, 0.2), xlabel="mean height of the surface above the apex (ranges)", ylabel="force (2πwR)")
        axes.legend()
        figure.savefig(file, metadata={"Date": None} if file.suffix == ".svg" else None)


def sticky(runs: Runs) -> list[dict]:
    """Mean pressure p at a repulsive area A of 2 % of a self-affine surface, approached at a held mean height: 1/κ = p A0/(E*h'A), h'
    the rms slope. Pastewka and Robbins (PNAS 111, 3298, 2014) expect surfaces to be sticky, 1/κ < 0, where

        s = (h'E*ρ/(κ0 w)) (h'd/(4ρ))^(2/3) / (π (3/16)^(2/3)) < 1,

    κ0 = 2 without adhesion, d = 4h'/h'' the mean width of a contact, h'' the rms of the Laplacian, w/ρ the stress."""
    sites, spacing, part = (64 if runs.small else 128), 2.6, 0.02
    surface = {"surface.sites": sites, "surface.rms": 3, "surface.rolloff": 2, "surface.q_max": sites / 8, "surface.seed": 1,
               "surface.spacing": spacing}
    rows, statistics = [], None
    print("range/Å  w, meV/Å²  s       1/κ")
    for reach in (1.0,) if runs.small else (2.0, 1.0, 0.5):
        for s in (1.4, 30.0) if runs.small else (1.4, 2.8, 5.6, 11.2):
            if statistics is None:
                statistics = slope_and_curvature(runs, surface)
            slope, curvature = statistics
            width = 4 * slope / curvature
            w = slope * E * reach / 2 * (slope * width / (4 * reach)) ** (2 / 3) / (math.pi * (3 / 16) ** (2 / 3)) / s
            r = runs.path(f"sticky-{reach}-{s}", wall(spacing, w, reach), surface | {
                "drive.path": ["approach"], "drive.load": 0.7 * part * E * slope / GPA * 1e3, "drive.displacement_step": 0.1,
                "drive.tolerance": 2.5e-3})
            first = int(np.argmax(r["contact_fraction"] >= part))
            force = np.interp(part, r["contact_fraction"][first - 1:first + 1], r["force"][first - 1:first + 1])
            rows.append({"range": reach, "w": 1e3 * w, "s": s,
                         "kappa": float(force) / (sites * spacing) ** 2 / (E * slope * part)})
            print("{:6} {:9.2f} {:8.2f} {:9.4f}".format(*rows[-1].values()), flush=True)
        print(f"       h' = {slope:.4f}, d = {width:.1f} Å")
        own = sorted((q["kappa"], q["s"]) for q in rows if q["range"] == reach)
        print(f"       1/κ = 0 at s = {np.interp(0, *zip(*own)):.2f}", flush=True)
    return rows


def slope_and_curvature(runs: Runs, surface: dict) -> tuple[float, float]:
    """Root mean squares of the gradient and of the Laplacian of a surface, 1 and 1/Å."""
    r = asperity.run({}, {**surface, "drive.path": "relax", "interface.kind": "wall", "interface.adhesion": 0,
                          "drive.load": 10, "block.thickness": surface["surface.sites"],
                          "output.checkpoint": "none"}, runs.out / "surface")
    with h5py.File(r.directory / "run.h5") as file:
        height = file["substrate/height"][:]
    wave = 2 * math.pi * np.fft.fftfreq(len(height), surface["surface.spacing"])
    q2 = wave[:, None] ** 2 + wave[None, :] ** 2
    power = np.abs(np.fft.fft2(height)) ** 2 / height.size**2
    return math.sqrt((q2 * power).sum()), math.sqrt((q2**2 * power).sum())


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problem", choices=["punch", "sphere", "sticky"])
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/adhesion"))
    parser.add_argument("--picture", type=pathlib.Path, help="of the spheres, a file to write")
    given = parser.parse_args()
    runs = Runs(given.out, given.small)
    rows = globals()[given.problem](runs)
    if given.picture:
        picture(rows, given.picture)
    print(f"{runs.seconds:.0f} s of the program")
