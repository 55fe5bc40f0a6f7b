#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What the seams of the multiscale block return of sound (docs/explanation/seams.md).

    scenes/validation/seams.py returned [--layers 2 4 8] [--angles 0 45] [--long] [--picture FILE]
    scenes/validation/seams.py echoes [--program build/release/perf/seam_echo]
    scenes/validation/seams.py snap | cycles [--leaving] [--program build/release/engine/asperity] [--out results/seams]

returned: fraction of the energy of a plane wave that comes back to level 0, from the equations of the block at
one frequency: the levels on a half-space of the lattice, under a half-space of cells twice as large as the
last level's. echoes: packets of waves through steps of the engine, beside the same numbers. snap: a flat
snap-in, the fast part of the force after it. cycles: energy lost in a cycle on four surfaces; --leaving: with
sound damped in the upper six tenths of the block, so that it does not come back from the rigid top either.
"""
import argparse
import json
import pathlib
import subprocess
import sys

import numpy as np

NU = 0.42
MU, LAME = 1 / (2 * (1 + NU)), NU / ((1 + NU) * (1 - 2 * NU))  # E = 1, density 1, a = 1
C_P = np.sqrt(LAME + 2 * MU)


def cell() -> np.ndarray:
    """Stiffness of a cell (docs/explanation/model.md) whose motion does not vary along y: corners (x, z), three components each."""
    stiff = np.zeros((24, 24))
    corners = [np.array([p & 1, p >> 1 & 1, p >> 2 & 1]) for p in range(8)]
    for p in range(8):
        for q in range(p + 1, 8):
            edge = corners[q] - corners[p]
            if edge @ edge > 2:
                continue
            row = np.zeros(24)
            direction = edge / np.sqrt(edge @ edge)
            row[3 * p:3 * p + 3], row[3 * q:3 * q + 3] = -direction, direction
            stiff += (MU / 4 if edge @ edge == 1 else MU / 2) * np.outer(row, row)
    sigma = np.array([2 * c - 1 for corner in corners for c in corner]) / 4
    stiff += (LAME - MU) * np.outer(sigma, sigma)
    onto = np.zeros((24, 12))
    for p in range(8):
        for i in range(3):
            onto[3 * p + i, 3 * ((p & 1) + 2 * (p >> 2 & 1)) + i] = 1
    return onto.T @ stiff @ onto


STIFF = cell()
ABSORB = np.kron((np.eye(4) - 0.25) / 4, np.eye(3))  # corners relax towards their mean; over mass and rate


def layer(kx: float) -> np.ndarray:
    """Stiffness between two planes of the lattice at this phase along x: (below, above), 6 x 6."""
    phase = np.zeros((12, 6), complex)
    for q in range(4):
        for i in range(3):
            phase[3 * q + i, 3 * (q >> 1) + i] = np.exp(1j * kx * (q & 1))
    return phase.conj().T @ STIFF @ phase


def leaving(kx: float, w: float, mass: float, up: bool) -> np.ndarray:
    """u of the next plane of a half-space from that of its outermost, for waves that leave or decay."""
    k = layer(kx)
    own = k[:3, :3] + k[3:, 3:] - (w * (1 + 1e-7j))**2 * mass * np.eye(3)
    # (down / s + own + up s) u = 0, as an eigenproblem of 1/s; `down` is regular.
    zero, one = np.zeros((3, 3)), np.eye(3)
    inverse = np.linalg.inv(k[3:, :3])
    t, v = np.linalg.eig(np.block([[zero, one], [-inverse @ k[:3, 3:], -inverse @ own]]))
    order = np.argsort(abs(t))
    take = order[3:] if up else order[:3]
    return v[:3, take] @ np.diag(1 / t[take] if up else t[take]) @ np.linalg.inv(v[:3, take])


SPAN = 0.626
"""Time between two absorptions, in a / c_P: 50 fs, that of steps of 10, 25 and 50 fs."""


def rate(level: int, cells: int, z: int) -> float:
    """BlockOptions::absorbed_share over the time between two absorptions, in c_P / s of the level."""
    first = 0 if level else max(0, cells - 2)
    height = (z - first + 0.5) / (cells - first)
    return 0.0 if z < first else min(1.0, SPAN * (3.0 * np.sqrt(height) if level else 2.3 * height)) / SPAN


def returned(layers: int, levels: int, lam: float, angle: float, absorbs: bool) -> dict:
    """Energy that comes back, for P, SV and SH."""
    k = 2 * np.pi / lam
    kx, kz = k * np.sin(np.radians(angle)), k * np.cos(np.radians(angle))
    wide = 2**levels if angle else 1  # nodes of level 0 in a period of the coarsest; uniform motion needs one
    width = [max(1, wide >> n) for n in range(levels + 1)]
    first = np.concatenate([[0], np.cumsum([3 * layers * w for w in width[:levels]])])
    size = first[levels] + 3
    stiff, damp = np.zeros((size, size), complex), np.zeros((size, size), complex)
    mass = np.zeros(size)

    def corner(level: int, z: int, x: int) -> list:
        """Degrees of freedom of a node and their weights."""
        if z == layers and level < levels:
            if not angle:
                return corner(level + 1, 0, 0)
            if x % 2 == 0:
                return corner(level + 1, 0, x // 2)
            return [(i, w / 2) for n in (x // 2, x // 2 + 1) for i, w in corner(level + 1, 0, n)]
        n = width[level]
        return [(first[level] + 3 * (z * n + x % n), np.exp(1j * kx * wide * (x // n)) if angle else 1.0)]

    for level in range(levels):
        s = 2.0**level
        for z in range(layers):
            g = rate(level, layers, z) * C_P / s if absorbs else 0.0
            for x in range(width[level]):
                ends = [corner(level, z + (q >> 1), x + (q & 1)) for q in range(4)]
                where = sorted({i for end in ends for i, _ in end})
                onto = np.zeros((4, len(where)), complex)
                for q, end in enumerate(ends):
                    for i, w in end:
                        onto[q, where.index(i)] += w
                        mass[i:i + 3] += abs(w) * s * s / 4 / (1 if angle else s)
                onto = np.kron(onto, np.eye(3))
                dofs = (np.array(where)[:, None] + np.arange(3)).ravel()
                grid = np.ix_(dofs, dofs)
                # Per area of level 0 where the motion is uniform, per depth along y where it is not.
                stiff[grid] += onto.conj().T @ STIFF @ onto / (1 if angle else s)
                damp[grid] += g * s * s / (1 if angle else s) * onto.conj().T @ ABSORB @ onto
    # Below, a half-space of the lattice; above, one of cells twice as large.
    s = 2.0**levels
    mass[:3 * width[0]] += 0.5
    mass[-3:] += 0.5 * s * s / (1 if angle else s)
    mass_above = s * s
    phases = kx + 2 * np.pi * np.arange(width[0]) / width[0]
    fourier = np.exp(1j * np.outer(np.arange(width[0]), phases))
    bare = layer(kx)
    dynamic = bare[:3, :3] + bare[3:, 3:] + bare[:3, 3:] * np.exp(1j * kz) + bare[3:, :3] * np.exp(-1j * kz)
    along = np.array([np.sin(np.radians(angle)), 0, np.cos(np.radians(angle))])
    across = np.array([along[2], 0, -along[0]])
    found = {}
    # SV and SH are nearly one in an isotropic solid, so they are separated by symmetry: SH moves along y alone.
    for name, direction, part in (("P", along, [0, 2]), ("SV", across, [0, 2]), ("SH", np.array([0, 1, 0]), [1])):
        waves, vectors = np.linalg.eigh(dynamic[np.ix_(part, part)])
        n = int(np.argmax(abs(direction[part] @ vectors)))
        w, shape = np.sqrt(waves[n]), np.zeros(3, complex)
        shape[part] = vectors[:, n]
        matrix = stiff - 1j * w * damp - np.diag(w * w * mass)
        above = layer(kx * s)
        matrix[-3:, -3:] += (above[:3, :3] + above[:3, 3:] @ leaving(kx * s, w, mass_above, True)) / (1 if angle else s)
        down, push, own = (np.zeros((width[0], 3, width[0], 3), complex) for _ in range(3))
        for j, phase in enumerate(phases):
            part, block = np.outer(fourier[:, j], fourier[:, j].conj()) / width[0], layer(phase)
            down += np.einsum("ab,ij->aibj", part, leaving(phase, w, 1.0, False))
            push += np.einsum("ab,ij->aibj", part, block[3:, :3])
            own += np.einsum("ab,ij->aibj", part, block[3:, 3:])
        n = 3 * width[0]
        down, push, own = down.reshape(n, n), push.reshape(n, n), own.reshape(n, n)
        matrix[:n, :n] += own + push @ down
        come = (fourier[:, 0][:, None] * shape).ravel()
        come_below = come * np.exp(-1j * kz)
        source = np.zeros(size, complex)
        source[:n] = push @ (down @ come - come_below)
        u = np.linalg.solve(matrix, source)[:n]
        below = come_below + down @ (u - come)
        power = [np.real(np.vdot(-push @ a, -1j * w * b)) for a, b in ((below, u), (come_below, come))]
        found[name] = 1 - power[0] / power[1]
    return found


WAVES = ("P", "SV", "SH")


def table(layers: list, angles: list, long: bool, picture: str) -> None:
    lengths = [4, 5, 6, 7, 8, 10, 12, 16, 24, 32, 64, 128] if long else [4, 6, 8, 12, 16, 32]
    curves = {}
    for n in layers:
        for absorbs in (False, True):
            print(f"\n{n} layers a level, seams {'absorb' if absorbs else 'reflect'}: fraction of the energy returned")
            print("angle wave " + "".join(f"{lam:>8g}" for lam in lengths))
            for angle in angles if absorbs else [0]:
                found = [returned(n, 7 if not angle else 6 if lam > 40 else 5, lam, angle, absorbs) for lam in lengths]
                for wave in WAVES if angle else ("P", "SV"):
                    curves[n, absorbs, angle, wave] = [f[wave] for f in found]
                    print(f"{angle:5g} {wave:4s} " + "".join(f"{f[wave]:8.3f}" for f in found), flush=True)
    if picture:
        draw(picture, lengths, curves, layers)


def draw(picture: str, lengths: list, curves: dict, layers: list) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    n = 4 if 4 in layers else layers[0]
    figure, ax = plt.subplots(figsize=(6.4, 3.6), constrained_layout=True)
    colours = {"P": "#0072b2", "SV": "#d55e00", "SH": "#009e73"}
    for (count, absorbs, angle, wave), values in curves.items():
        if count != n or (not absorbs and (angle or wave != "P")):
            continue
        label = f"levels, absorbing: {wave}, {angle}°" if absorbs else "levels, reflecting: all of these"
        ax.loglog(lengths, np.maximum(values, 1e-4), ":" if not absorbs else "-" if not angle else "--",
                  color="k" if not absorbs else colours[wave], lw=1.2, label=label)
    ax.axhline(0.05, color="0.6", lw=0.6)
    ax.text(lengths[0], 0.055, "5 %", ha="left", color="0.4", fontsize=8)
    ax.set(xlabel="wavelength (a)", ylabel="fraction of the energy returned", ylim=(1e-4, 2),
           title=f"{n} layers a level; the lattice returns nothing")
    ax.set_xticks(lengths, [f"{lam:g}" for lam in lengths])
    ax.minorticks_off()
    ax.legend(fontsize=7, frameon=False, loc="upper right", bbox_to_anchor=(1, 0.92), ncol=2)
    figure.savefig(picture, dpi=120)


def echoes(program: pathlib.Path) -> None:
    """Packets with a width in wavelength, beside the mean of plane waves over the same spectrum."""
    packets = [(8, w, 0, rise) for w in ("P", "SH") for rise in (5, 8, 16)]
    packets += [(8, w, 1, 8) for w in ("P", "SV", "SH")] + [(16, w, 1, 16) for w in ("P", "SV", "SH")]
    print("wave  angle  wavelength   reflect    absorb   plane waves")
    for sites, wave, across, rise in packets:
        depth, waves = 4 * (1 + 2 + 4 + (8 if rise > 8 else 0)), 2.0  # those levels whose seams matter
        said = [subprocess.run([program, str(sites), "4", "512", span, "25"],
                               input=f"{wave} {across} {rise} {waves} {depth}", capture_output=True,
                               text=True, check=True).stdout.split() for span in ("0", "50")]
        kx, q0 = 2 * np.pi * across / sites, 2 * np.pi / rise
        total = weights = 0.0
        for d in np.linspace(-2, 2, 9):
            q = q0 + d / (waves * rise)
            k, angle = np.hypot(kx, q), np.degrees(np.arctan2(kx, q))
            weight = np.exp(-d * d)
            total += weight * returned(4, 5, 2 * np.pi / k, angle, True)[wave]
            weights += weight
        print(f"{wave:4s} {said[0][1]:>6s} {said[0][2]:>10s} {said[0][3]:>10s} {said[1][3]:>9s} "
              f"{total / weights:12.5f}", flush=True)


BLOCKS = {"lattice": {"block.model": "lattice"},
          "4 layers, reflect": {"block.layers_per_level": 4}, "8 layers, reflect": {"block.layers_per_level": 8},
          "4 layers, absorb": {"block.layers_per_level": 4, "block.seams": "absorb"},
          "8 layers, absorb": {"block.layers_per_level": 8, "block.seams": "absorb"}}


def run(program: pathlib.Path, out: pathlib.Path, keys: dict) -> pathlib.Path:
    """The directory of a finished run of these keys."""
    if not (out / "result.json").exists():
        out.parent.mkdir(parents=True, exist_ok=True)
        text = "".join(f"{key} = {json.dumps(value)}\n" for key, value in keys.items())
        scene = out.with_suffix(".toml")
        scene.write_text(text)
        subprocess.run([program, "run", scene, "--out", out, "--progress", "off"], check=True,
                       stdout=subprocess.DEVNULL)
    return out


def snap(program: pathlib.Path, out: pathlib.Path) -> None:
    import h5py
    base = {"surface.kind": "flat", "surface.sites": 16, "block.thickness": 128, "drive.velocity": 20.0,
            "drive.timestep": 10.0, "drive.path": ["approach", "pull-off"], "drive.max_steps": 5200,
            "output.series": 2, "output.fields": []}
    print("rms of the force's part faster than 1.2 ps, eV/Å, so many ps after the snap")
    print(f"{'':20s}" + "".join(f"{span:>10s}" for span in ("2-4", "4-8", "8-14")) + "   snap at, ps   steps")
    for name, keys in BLOCKS.items():
        done = run(program, out / "snap" / name.replace(", ", "-").replace(" ", "-"), base | keys)
        with h5py.File(done / "run.h5") as file:
            time, force, height = (file["series/" + column][:] for column in ("time", "force", "mean_height"))
        at = int(np.argmax(abs(np.diff(height))))
        step = time[1] - time[0]
        window = int(1.2 / step) | 1
        fast = force - np.convolve(force, np.ones(window) / window, "same")
        spans = [fast[at + int(lo / step):at + int(hi / step)] for lo, hi in ((2, 4), (4, 8), (8, 14))]
        rms = "".join(f"{np.std(s):10.3f}" if len(s) > 10 else "         -" for s in spans)
        print(f"{name:20s}{rms}{time[at]:12.2f} {len(time):8d}", flush=True)


def cycles(program: pathlib.Path, out: pathlib.Path, leaving: bool) -> None:
    base = {"surface.sites": 32, "surface.rms": 0.3, "block.thickness": 64, "drive.velocity": 20.0}
    if leaving:
        base |= {"drive.damping": 1.0, "drive.damping_from": 0.4}
        out = out / "leaving"
    print("meV/Å², four seeds: energy lost in a cycle (work of adhesion in, out)")
    for name, keys in BLOCKS.items():
        row = f"{name:20s}"
        for seed in (1, 2, 3, 4):
            result = json.loads((run(program, out / "cycles" / f"{name.replace(', ', '-').replace(' ', '-')}-{seed}",
                                     base | keys | {"surface.seed": seed}) / "result.json").read_text())
            work = result["work_of_adhesion"]
            row += f"   {result['lost']['cycle']:7.2f} ({work['approach']:.2f}, {work['pull_off']:.2f})"
        print(row, flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("returned", "echoes", "snap", "cycles"))
    parser.add_argument("--layers", type=int, nargs="+", default=[2, 4, 8])
    parser.add_argument("--angles", type=float, nargs="+", default=[0, 45], help="to the vertical, degrees")
    parser.add_argument("--long", action="store_true", help="wavelengths up to 128 a; minutes")
    parser.add_argument("--leaving", action="store_true")
    parser.add_argument("--picture", default="")
    parser.add_argument("--program", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/seams"))
    arguments = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    asperity = arguments.program or root / "build/release/engine/asperity"
    if arguments.what == "returned":
        table(arguments.layers, arguments.angles, arguments.long, arguments.picture)
    elif arguments.what == "echoes":
        echoes(arguments.program or root / "build/release/perf/seam_echo")
    elif arguments.what == "snap":
        snap(asperity, arguments.out)
    else:
        cycles(asperity, arguments.out, arguments.leaving)


if __name__ == "__main__":
    sys.exit(main())
