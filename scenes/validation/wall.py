#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Problems with closed forms over a wall (interface.kind = "wall"): a table beside each closed form.

    scenes/validation/wall.py westergaard | johnson | load | hertz | gfmd | jkr | area [--out results/wall]

westergaard: contact of a wave without adhesion against pressure. johnson: the adhesive wave at zero load, for several ranges
of the attraction, extrapolated. load: the same wave under pressures from near pull-off to beyond the jump into full contact. hertz:
a paraboloid without adhesion, periodic images corrected for. gfmd: the same by the measure of user-gfmd's tests. jkr:
force against height of an adhesive sphere, as the range falls.
area: contact area of self-affine surfaces against pressure without adhesion, extrapolated in the spacing.
"""
import argparse
import math
import pathlib
import sys

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import asperity  # noqa: E402
from asperity.theories import combined  # noqa: E402

GPA = 1 / 160.21766208  # eV/Å³
E = 77.2 * GPA / (1 - 0.42**2)


class Runs:
    def __init__(self, out: pathlib.Path):
        self.out = out
        out.mkdir(parents=True, exist_ok=True)

    def map(self, name: str, heights: np.ndarray) -> dict:
        """Keys of a surface of these heights."""
        path = (self.out / f"{name}.npy").resolve()
        np.save(path, heights)
        return {"surface.kind": "file", "surface.file": path, "surface.sites": len(heights), "surface.rms": float(np.std(heights))}

    def sine(self, sites: int, amplitude: float) -> dict:
        """Keys of a map of one wave along x, h cos(2πx/λ), λ the box."""
        wave = amplitude * np.cos(2 * math.pi * np.arange(sites) / sites)
        return self.map(f"sine-{sites}-{amplitude:.6g}", np.tile(wave, (sites, 1)))

    def state(self, name: str, keys: dict) -> asperity.Result:
        """The relaxed state of a scene over a wall. A result that is there is an error: it may be of another map."""
        settings = {"numerics.precision": "double", "drive.path": "relax", "interface.kind": "wall",
                    "output.checkpoint": "none", "drive.tolerance": 2.5e-6, **keys}
        settings.setdefault("block.thickness", settings["surface.sites"])
        return asperity.run({}, settings, self.out / name)

    def path(self, name: str, keys: dict) -> dict:
        """Force (eV/Å), mean height (Å), contact fraction along a path at a held mean height, and its result."""
        run = self.state(name, {"drive.mode": "quasistatic", "drive.path": ["approach", "pull-off"], "drive.control": "mean-height",
                          "output.fields": []} | keys)
        with h5py.File(self.out / name / "run.h5") as file:
            series = {k: file[f"series/{k}"][:] for k in ("force", "mean_height", "contact_fraction", "segment")}
        return series | {"run": run}


def westergaard(runs: Runs) -> None:
    print("sites  p/p*   f       closed form  deviation")
    for sites in (128, 256):
        box, amplitude = sites * 2.6, 0.01 * sites * 2.6
        peak = math.pi * E * amplitude / box
        for load in (0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98):
            r = runs.state(f"westergaard-{sites}-{load}",
                           runs.sine(sites, amplitude) | {"interface.adhesion": 0, "drive.load": load * peak / GPA * 1e3})
            f, exact = r["contact_fraction"], 2 / math.pi * math.asin(math.sqrt(load))
            print(f"{sites:5} {load:5} {f:8.4f} {exact:8.4f} {f - exact:12.4f}")


def johnson_exact(alpha: float) -> tuple[float, float]:
    """Contact fraction and binding energy over w at zero load (docs/reports/validation.md)."""
    low, high = 0.0, 0.999

    def branch(f):
        return math.sin(math.pi * f / 2) ** 2 - alpha * math.sqrt(math.tan(math.pi * f / 2))

    low = max((k / 1000 for k in range(1, 900) if branch(k / 1000) < 0 <= branch((k + 1) / 1000)), default=0.0)
    high = low + 0.001
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if branch(middle) < 0 else (low, middle)
    f = low
    # Energies over w, in units where p* = 1: E* h² π / λ = 2 / (π α² ) w ... by quadrature of U = ∫ p C dp.
    steps, U = 20000, 0.0

    def c(x):
        return -math.log(math.sin(math.pi * x / 2))

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


def load(runs: Runs) -> None:
    """States from the attached side; above the largest pressure of partial contact (0.3877 p* at α = 0.3) contact is full."""
    print("α = 0.3: p/p*, contact fraction for each range (sites), closed form")
    w, box, alpha = 0.1, 332.8, 0.3
    cases = ((2.0, 64), (1.0, 128), (0.5, 256))
    print("   p/p* " + "".join(f"{reach:5} Å ({sites:3})" for reach, sites in cases) + "   closed   deviation of the last")
    amplitude = math.sqrt(2 * w * box / (math.pi**2 * E)) / alpha
    peak = math.pi * E * amplitude / box
    f = np.linspace(1e-3, 0.999, 100000)
    closed = np.sin(math.pi * f / 2) ** 2 - alpha * np.sqrt(np.tan(math.pi * f / 2))
    for pressure in (-0.08, -0.04, 0, 0.1, 0.2, 0.3, 0.34, 0.36, 0.38, 0.4, 0.44):
        found = [runs.state(f"load-{pressure}-{sites}", runs.sine(sites, amplitude) | {
            "surface.spacing": box / sites, "interface.adhesion": 1e3 * w, "interface.range": reach,
            "drive.load": pressure * peak / GPA * 1e3})["contact_fraction"] for reach, sites in cases]
        rising = (f > f[np.argmin(closed[f < 0.5])]) & (f < f[np.argmax(closed)])
        exact = float(np.interp(pressure, closed[rising], f[rising])) if pressure < closed.max() else 1.0
        print(f"{pressure:7}" + "".join(f"{x:13.4f}" for x in found) + f"{exact:10.4f}{found[-1] - exact:10.4f}")


# Sums over a square lattice (python/asperity/theories/sphere.py): the images' displacement near the contact.
PHI0, PHI2 = -3.9002649, 9.0336217


def hertz(runs: Runs) -> None:
    """ContactMechanics' values for E* = 5, R = 4, F = 7: δ = 0.6507880, a = 1.6134286, p0 = 1.2839257."""
    unit, radius, modulus, box = 20.0, 4.0, 5.0, 16.0  # Å; the rest in units of the example
    print("sites  F      a       Hertz   deviation  δ        Hertz    deviation  p0      Hertz   deviation  (with images)")
    for sites in (128, 256):
        x = (np.arange(sites) - sites / 2) * box / sites
        cap = -(x[:, None] ** 2 + x[None, :] ** 2) / (2 * radius) * unit
        for force in (0.5, 2.0, 7.0):
            pressed = 1 / radius + PHI2 * force / (2 * math.pi * modulus * box**3)  # the images flatten the sphere's gap
            a = (0.75 * force / modulus / pressed) ** (1 / 3)
            delta, p0 = a * a * pressed, 1.5 * force / (math.pi * a * a)
            r = runs.state(f"hertz-{sites}-{force}", runs.map(f"cap-{sites}", cap) | {
                "surface.spacing": box * unit / sites, "interface.adhesion": 0, "drive.load": force / box**2 / modulus * E / GPA * 1e3})
            with h5py.File(runs.out / f"hertz-{sites}-{force}" / "run.h5") as f:
                highest = f["fields/relaxed/pressure"][:].max() * GPA / E * modulus
                apex = f["substrate/height"][:].max()
            found = box * math.sqrt(r["contact_area"] / math.pi)
            sunk = (apex - r["relaxed"]["mean_height"]) / unit - PHI0 * force / (math.pi * modulus * box)
            print(f"{sites:5} {force:5} {found:8.4f} {a:7.4f} {found / a - 1:9.4f} {sunk:9.4f} {delta:8.4f} {sunk / delta - 1:9.4f} "
                  f"{highest:9.4f} {p0:7.4f} {highest / p0 - 1:9.4f}")


def gfmd(runs: Runs) -> None:
    """user-gfmd's test TEST_Hertz_sc100_128x128: a cubic lattice of constant 1 with springs k = 1, so E* = 8/3, 128 x 128
    sites, a hard sphere of R = 100 over the middle of four of them. Its measure is the sum over the sites of the squared difference
    between force and Hertz's pressure for the same total force, which has to be below 0.01; the force is what an indentation of
    about 2 comes to there."""
    sites, radius, modulus = 128, 100.0, 8 / 3
    x = np.arange(sites) + 0.5 - sites / 2
    distance = np.hypot(x[:, None], x[None, :])
    print("F       a       largest force  Hertz   sum of squared differences (user-gfmd: below 0.01)  over sum of squares")
    for force in (20.0, 40.0, 80.0):
        name, spacing = f"gfmd-{force:g}", 2.6
        runs.state(name, runs.map("gfmd-cap", -(distance**2) / (2 * radius) * spacing) | {
            "surface.spacing": spacing, "interface.adhesion": 0, "drive.load": force / sites**2 / modulus * E / GPA * 1e3})
        with h5py.File(runs.out / name / "run.h5") as file:
            found = file["fields/relaxed/pressure"][:] * GPA / E * modulus
        total = found.sum()
        a = (0.75 * total * radius / modulus) ** (1 / 3)
        hertz = 1.5 * total / (math.pi * a * a) * np.sqrt(np.maximum(0, 1 - (distance / a) ** 2))
        print(f"{total:6.2f} {a:7.3f} {found.max():11.4f} {hertz.max():10.4f} {((found - hertz) ** 2).sum():12.5f} "
              f"{((found - hertz) ** 2).sum() / (hertz**2).sum():40.5f}")


def jkr(runs: Runs) -> None:
    """A sphere of 300 Å in a box of 332.8 Å, w = 30 meV/Å², paths at a held mean height against JKR and Maugis-Dugdale with images."""
    print("range/Å  sites  λ (Maugis)  pull-off over (3/2)πwR  JKR     Maugis  rms of F - Maugis over pull-off, attached branch  from JKR")
    for reach, sites in ((1.4, 64), (0.7, 128), (0.35, 256)):
        name = f"jkr-{sites}"
        r = runs.path(name, {"surface.kind": "flat", "surface.radius": 300, "surface.sites": sites, "surface.spacing": 332.8 / sites,
                             "interface.adhesion": 30, "interface.range": reach, "drive.tolerance": 1.2e-3 * reach})
        sphere, unit = combined.of_run(r["run"])["theory"]["sphere"], 1.5 * math.pi * 0.03 * 300
        attached = (r["segment"] == r["segment"].max()) & (r["contact_fraction"] > 0.004)
        off = {}
        for label, height, force in combined.sphere_curves(r["run"], r["force"].max()):
            # From the deepest point outwards to where the theory's branch ends at a held height.
            if height[0] > height[-1]:
                height, force = height[::-1], force[::-1]
            end = int(np.argmax(height)) + 1
            height, force = height[:end], force[:end]
            inside = attached & (r["mean_height"] < height.max()) & (r["mean_height"] > height.min())
            apart = np.interp(r["mean_height"][inside], height, force) - r["force"][inside]
            off[label.removeprefix("smooth sphere, ")] = np.sqrt(np.mean(apart**2)) / unit
        print(f"{reach:6} {sites:6} {sphere['maugis_parameter']:9.3f} {-r['force'].min() / unit:15.4f} {sphere['jkr_images'] / 30:20.4f} "
              f"{sphere['maugis_images'] / 30:8.4f} {off['Maugis-Dugdale with images']:16.4f} {off['JKR with images']:40.4f}")


def area(runs: Runs) -> None:
    """κ of A/A0 = κ p/(E* h'), the same surfaces (H = 0.8, waves of 32 lengths down to box/16) at 64, 128 and 256 sites."""
    print("p/(E*h')  A/A0 at 64, 128, 256 sites  extrapolated  κ       Persson, erf  (means of three surfaces)")
    box, modes = 332.8, 16
    surfaces = []
    for seed in (1, 2, 3):
        random = np.random.default_rng(seed)
        k = np.hypot(np.fft.fftfreq(128, 1 / 128)[:, None], np.fft.rfftfreq(128, 1 / 128)[None, :])
        amplitude = np.where((k >= 1) & (k <= modes), np.maximum(k, 1) ** -1.8, 0)
        spectrum = np.fft.rfft2(random.standard_normal((128, 128))) * amplitude
        surfaces.append(spectrum)
    slope = 0.1
    for reduced in (0.01, 0.02, 0.05, 0.1, 0.2, 0.4):
        means = []
        for sites in (64, 128, 256):
            found = []
            for seed, spectrum in enumerate(surfaces, 1):
                whole = np.zeros((sites, sites // 2 + 1), complex)
                whole[:32, :32], whole[-31:, :32] = spectrum[:32, :32], spectrum[-31:, :32]
                gradient = (2j * math.pi / box * np.fft.fftfreq(sites, 1 / sites)[:, None],
                            2j * math.pi / box * np.fft.rfftfreq(sites, 1 / sites)[None, :])
                slopes = [np.fft.irfft2(g * whole, s=(sites, sites)) for g in gradient]
                heights = np.fft.irfft2(whole, s=(sites, sites)) * slope / math.sqrt(sum(np.mean(g**2) for g in slopes))
                r = runs.state(f"area-{reduced}-{sites}-{seed}", runs.map(f"area-{sites}-{seed}", heights) | {
                    "surface.spacing": box / sites, "interface.adhesion": 0, "drive.load": reduced * slope * E / GPA * 1e3})
                found.append(r["contact_area"])
            means.append(np.mean(found))
        a, b, c = means
        limit = 2 * c - b
        print(f"{reduced:7} {a:12.4f} {b:7.4f} {c:7.4f} {limit:13.4f} {limit / reduced:10.3f} {math.erf(reduced * math.sqrt(2)):10.4f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problem", choices=["westergaard", "johnson", "load", "hertz", "gfmd", "jkr", "area"])
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/wall"))
    arguments = parser.parse_args()
    globals()[arguments.problem](Runs(arguments.out))
