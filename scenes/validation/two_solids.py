#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Two rough solids, and the stresses below the surface, beside numbers that do not come from the program.

    scenes/validation/two_solids.py [--out results/two-solids]

Writes two-solids.csv and stresses-below.csv (docs/reports/two-solids.md): each number of the program beside the expected one, which
stands in this file: closed forms, and of rough contacts those of other programs. Two minutes of one core.
"""
import argparse
import os
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
import h5py  # noqa: E402
from printed import Printed  # noqa: E402

import asperity  # noqa: E402
from asperity.running import program  # noqa: E402
from asperity.running.scene import scene_file  # noqa: E402
from asperity.studies.estimates import surface_made  # noqa: E402
from asperity.studies.stress import COMPONENTS, von_mises  # noqa: E402

SITES = 32
SHIFTS = {1: (0.0239, 0.0870, 0.0475), 2: (0.0926, 0.3268, 0.1809), 4: (0.3275, 1.0227, 0.5989), 8: (0.8965, 1.7704, 1.3027),
          16: (1.8112, 2.0607, 1.9722), 32: (2.3249, 2.0808, 2.1905)}
AREAS = {(90.0, 0.0): (0.1013, 0.1889, 0.3469), (0.0, -8.0): (0.1256, 0.2173, 0.3664)}
"""By the turn and the shift of the test map on itself, at 0.005, 0.01 and 0.02 E*."""
WAVE = {0.25: (-0.9735, -0.5841, 0.4591), 0.5: (-0.9098, -0.3033, 0.5786), 1.0: (-0.7358, 0.0, 0.6540), 2.0: (-0.4060, 0.1353, 0.4719)}
HERTZ = {0.25: (-0.9412, -0.3985), 0.48: (-0.8127, -0.1927), 1.0: (-0.5, -0.0290)}
PUNCH = {0.25: (-1.0519, -0.6976), 0.5: (-1.12, -0.48), 1.0: (-1.0, -0.15), 2.0: (-0.52, 0.0)}
SLIDING = {0.0: 0.620, 0.1: 0.62, 0.2: 0.64, 0.3: 0.66, 0.5: 0.93}
LAYERS = {(10, 0.3): (-0.9136, 1.2019, -0.2322, -3.5216), (10, 1): (-0.4096, 2.5311, 0.0951, -3.2347),
          (10, 3): (-0.0485, 0.5130, 0.0326, -1.1472), (0.1, 1): (-0.8379, -0.3470, -0.2384, -0.5019)}


def banded(n: int, low: int, high: int) -> np.ndarray:
    """Returns a map of n x n points in a box of edge 1 with waves low <= |k| <= high of the amplitude |k|^-1.8, given phases, and an rms
    slope of 0.08."""
    waves = np.zeros((n, n), complex)
    for kx in range(high + 1):
        for ky in range(-high, high + 1):
            k = np.hypot(kx, ky)
            if low <= k <= high and (kx > 0 or ky > 0):
                phase = 2 * np.pi * np.modf(0.6180339887 * kx**2 + 0.4142135624 * ky**2 + 0.7320508076 * kx * ky)[0]
                waves[ky % n, kx] += k**-1.8 * np.exp(1j * phase)
    heights = np.fft.ifft2(waves).real * n**2
    return heights * 0.08 / slope(heights)


def _moment(heights: np.ndarray, order: int) -> float:
    """Returns the sum of q^order |h_q|^2 of a map in a box of edge 1."""
    k = np.fft.fftfreq(len(heights), 1 / len(heights))
    q = 2 * np.pi * np.hypot(k, k[:, None])
    return float((q**order * abs(np.fft.fft2(heights) / heights.size)**2).sum())


def slope(heights: np.ndarray) -> float:
    """Returns the rms slope of a map in a box of edge 1."""
    return _moment(heights, 2)**0.5


def full(heights: np.ndarray) -> float:
    """Returns the energy of full contact over E* of a map in a box of edge 1."""
    return 0.25 * _moment(heights, 1)


def scene(place: pathlib.Path, own: np.ndarray, counter: np.ndarray, n: int = SITES, **surface: object) -> dict:
    """Writes two maps in units of the box, whose spacing is 1 Å. Returns the scene of their state under a load."""
    for name, heights in (("own", own), ("counter", counter)):
        np.save(place / f"{name}.npy", n * heights)
    return {"surface": {"kind": "file", "file": str(place / "own.npy"), "file_unit": "Å", "sites": n, "spacing": 1.0,
                        "counter": str(place / "counter.npy"), "counter_unit": "Å", **surface},
            "block": {"young": 10, "poisson": 0.3},
            "interface": {"kind": "wall", "adhesion": 2.0, "range": 1.5},
            "drive": {"mode": "quasistatic", "path": ["relax"], "load": 300.0, "tolerance": 1e-6}}


class Rows(Printed):
    """Numbers beside the expected ones."""

    def __init__(self) -> None:
        super().__init__("number", "expected", "program")

    def number(self, what: str, expected: float, found: float, digits: int = 4) -> None:
        """Adds a number beside the expected one."""
        self.add(what, *(f"{0.0 if abs(value) < 1e-9 else value:.{digits}g}" for value in (expected, found)))


def composite(place: pathlib.Path) -> Rows:
    """Heights, full contact and areas of the test map on itself, and moduli of two solids."""
    rows, n = Rows(), 256
    h = banded(n, 4, 32)
    rows.number("test map, rms height over its width", 1.42107e-3, h.std(), 6)
    rows.number("test map, energy of full contact over E*", 2.39918e-5, full(h), 6)
    for d, expected in SHIFTS.items():
        with scene_file(scene(place, h, -h[:, ::-1], n)) as file:
            s = surface_made(file, [f"surface.counter_shift_x={-d}"]).heights / n
        for name, one, found in zip(("rms^2", "slope^2", "energy of full contact"), expected,
                                    (s.var() / h.var(), slope(s)**2 / slope(h)**2, full(s) / full(h))):
            rows.number(f"h(x) - h(x + {d}) over h, {name}", one, found)
    with scene_file(scene(place, h, h[:, ::-1], n, counter_turn=90.0)) as file:
        s = surface_made(file).heights / n
    rows.number("h + h turned by 90 degrees, slope", 0.112447, slope(s), 6)
    rows.number("h + h turned by 90 degrees, energy of full contact over E*", 4.7904e-5, full(s), 5)
    for (turn, shift), areas in AREAS.items():  # of gaps of the test map
        name = "h + h turned by 90 degrees" if turn else "h(x) - h(x + 8)"
        made = scene(place, -h, (-h if turn else h)[:, ::-1], n, counter_turn=turn, counter_shift_x=shift)
        made["interface"] = {"kind": "wall", "adhesion": 0.0, "range": 1.0}
        for pressure, area in zip((0.005, 0.01, 0.02), areas):
            made["drive"] |= {"load": pressure * 1e4 / (1 - 0.3**2), "tolerance": 1e-3}
            found = asperity.run(made, out=place / f"area-{turn:g}-{pressure}", progress=False).contact_fraction
            rows.number(f"{name}, area at {pressure} E*", area, found)
    n = 32
    state = asperity.run(scene(place, banded(n, 2, 8), banded(n, 3, 7), n, counter_young=70, counter_poisson=0.2), {"block.thickness": 4 * n},
                         out=place / "moduli", progress=False).fields["relaxed"]
    pressure, both, counter = (np.fft.fft2(one)[0, 2] for one in (state.pressure, state.u_z, state.u_z_counter))
    rows.number("10 GPa, 0.3 on 70 GPa, 0.2: E*, GPa", 9.5498, (2 * pressure / (2 * np.pi * 2 / n * both)).real, 5)
    rows.number("the same, share of the first in the displacement", 0.86903, ((both + counter) / both).real, 5)
    return rows


def below(pressure: np.ndarray, depth: float, place: pathlib.Path, friction: float = 0.0, free: bool = True, depths: int = 2,
          **block: object) -> list[dict[str, np.ndarray]]:
    """Returns the stresses of a pressure, GPa, by the program, from the surface to a depth, Å; sites of 1 Å."""
    n = len(pressure)
    with h5py.File(place / "pressure.h5", "w") as file:
        file["fields/given/pressure"] = pressure
    made = {"surface": {"kind": "flat", "sites": n, "spacing": 1.0, "boundary": "free" if free else "periodic"},
            "block": {"young": 1.0, "poisson": 0.3, "model": "continuum", **({} if free else {"thickness": 16 * n}), **block},
            "interface": {"kind": "wall"}, "drive": {"path": ["relax"]}}
    out = place / "stress.h5"
    out.unlink(missing_ok=True)
    with scene_file(made) as file:
        program.stress_below(file, ["output.stress=volume", f"output.stress_depth={depth!r}", f"output.stress_depths={depths}",
                                    f"output.stress_friction={friction}"], str(place / "pressure.h5"), "given", False, str(out))
    with h5py.File(out) as file:
        volume = file["stress/given/volume"][:]
    return [dict(zip(COMPONENTS, volume[:, k])) for k in range(depths)]


def averaged(n: int, of_radius: object, parts: int) -> np.ndarray:
    """Returns a pressure of the distance from the middle site, averaged over parts of sites."""
    at = np.arange(n * parts) / parts + (0.5 / parts - 0.5) - n // 2
    r = np.hypot(at, at[:, None])
    return of_radius(r).reshape(n, parts, n, parts).mean(axis=(1, 3))


def stresses(place: pathlib.Path) -> Rows:
    """Stresses of a wave, below a sphere, a punch and a sphere that slides, and in a layer."""
    rows, n = Rows(), 64
    q = 2 * np.pi / n
    wave = np.tile(np.cos(q * np.arange(n)), (n, 1))
    for z, expected in WAVE.items():
        s = below(wave, z / q, place, free=False)[1]
        for name, one, found in zip(("szz", "sxx", "von Mises"), expected, (s["zz"][0, 0], s["xx"][0, 0], von_mises(s).max())):
            rows.number(f"wave, qz = {z}: {name}", one, found)
    a, n = 16.0, 256
    sphere = averaged(n, lambda r: np.sqrt(np.maximum(0, 1 - (r / a)**2)), 1)
    punch = averaged(n, lambda r: np.where(r < a, 1 / np.sqrt(np.maximum(1e-12, 1 - (r / a)**2)), 0), 10)
    for name, pressure, table in (("sphere", sphere, HERTZ), ("punch", punch, PUNCH)):
        for z, expected in table.items():
            s = below(pressure, z * a, place)[1]
            for component, one in zip(("zz", "xx"), expected):
                rows.number(f"{name}, z = {z} a: s{component}", one, s[component][n // 2, n // 2])
    n = 128
    sphere = averaged(n, lambda r: np.sqrt(np.maximum(0, 1 - (r / a)**2)), 4)
    for friction, expected in SLIDING.items():
        found = max(von_mises(s).max() for s in below(sphere, 0.875 * a, place, friction, depths=8))
        rows.number(f"sphere that slides, friction {friction}: largest von Mises", expected, found)
    n, t = 64, 2.0
    for (ratio, qt), expected in LAYERS.items():
        waves = round(qt / t * n / (2 * np.pi)) or 1
        q = 2 * np.pi * waves / n
        thick = qt / q  # of the wave that fits into the box
        wave = np.tile(np.cos(q * np.arange(n)), (n, 1))
        surface, coat = below(wave, thick * (1 - 1e-9), place, free=False, layers=[[thick, float(ratio), 0.3]])
        inside = below(wave, thick * (1 + 1e-9), place, free=False, layers=[[thick, float(ratio), 0.3]])[1]
        for name, one, found in zip(("szz at the interface", "sxx in the layer there", "sxx below it", "sxx at the surface"), expected,
                                    (coat["zz"][0, 0], coat["xx"][0, 0], inside["xx"][0, 0], surface["xx"][0, 0])):
            rows.number(f"layer, E1/E2 = {ratio}, qt = {qt}: {name}", one, found)
    return rows


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--out", default="results/two-solids")
    place = pathlib.Path(words.parse_args().out).resolve()
    place.mkdir(parents=True)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    composite(place).write(place / "two-solids.csv")
    stresses(place).write(place / "stresses-below.csv")


if __name__ == "__main__":
    main()
