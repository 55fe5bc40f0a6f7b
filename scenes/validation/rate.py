#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""A viscoelastic block, against other programs and a crack whose energy release rate is known.

    scenes/validation/rate.py crack [--sites 512] [--release 0.4 0.7 1.2 1.5 2 3]
    scenes/validation/rate.py strips [--release 1.5 2 3]
    scenes/validation/rate.py tamaas ENV

crack: a strip of a viscoelastic solid between a rigid plane and a flat wall, stretched by δ where it adheres and free elsewhere. The crack
between them moves at a steady velocity v, and its tip takes up G = M δ²/2H (M the uniaxial modulus, H the thickness, relaxed), whatever
the law of adhesion. It opens where G exceeds the work of adhesion w and closes where G is less. Beside it the same strip by the
program below: one dimension, the stiffness of the continuum, steps of even length.
strips: that program alone in ever thicker strips, and the steady crack of the same law in an infinite solid, solved apart.
tamaas: a rough surface at a hard wall, loaded and held; Tamaas (in the environment ENV, pip install tamaas==2.9.0) is led by the same
pressures. The exit code is 77 where there is none.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from numpy.fft import irfft, rfft

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

# Lengths in nm, stresses in MPa, work in mJ/m² (MPa nm), times in ns.
E, NU, WORK, RANGE = 20.0, 0.3, 30.0, 3.2
RATIO, TIME = 3.0, 1.0
UNIAXIAL = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
PLANE = E / (1 - NU**2)
HARD = 5 * np.pi * PLANE  # MPa/nm, of the wall's repulsion: ten times the stiffness of the shortest wave


# ---- The strip in one dimension.


def stiffness(sites: int, thickness: float) -> np.ndarray:
    """MPa/nm for each wave of a strip, spacing 1 nm: its upper face does not move, its lower one feels normal forces alone."""
    q = 2 * np.pi * np.fft.rfftfreq(sites)[1:]
    qh, k, mu = np.minimum(q * thickness, 300.0), 3 - 4 * NU, E / (2 * (1 + NU))
    compliance = (1 - NU) / (mu * q) * (k * np.sinh(2 * qh) - 2 * qh) / (k * np.cosh(2 * qh) + (1 + k * k) / 2 + 2 * qh**2)
    return np.concatenate(([UNIAXIAL / thickness], 1 / compliance))


def traction(gap: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of the wall on the surface, and its derivative."""
    pull = -WORK / RANGE * np.exp(-np.maximum(gap, 0) / RANGE)
    return pull - HARD * np.minimum(gap, 0), np.where(gap > 0, -pull / RANGE, -HARD)


def balance(s: np.ndarray, known: np.ndarray, w: np.ndarray, stretch: float) -> np.ndarray:
    """w, displacement from the upper face, where traction(w + stretch) = S w + known: Newton's method with conjugate gradients."""
    n = len(w)
    for _ in range(100):
        pull, slope = traction(w + stretch)
        r = pull - irfft(s * rfft(w), n) - known
        if np.max(np.abs(r)) < 1e-8 * WORK / RANGE:
            return w
        diagonal = np.maximum(s.mean() - slope, 0.3 * s.mean())
        x, z = np.zeros(n), r / diagonal
        p, rz, enough = z, r @ z, 1e-3 * np.sqrt(r @ r)
        while np.sqrt(r @ r) > enough:
            ap = irfft(s * rfft(p), n) - slope * p
            if p @ ap <= 0:
                break
            a = rz / (p @ ap)
            x, r = x + a * p, r - a * ap
            z = r / diagonal
            rz, old = r @ z, rz
            p = z + rz / old * p
        w = w + (x if x.any() else p) * min(1.0, RANGE / max(np.max(np.abs(x)), 1e-300))
    raise RuntimeError("no balance")


def starting(sites: int, thickness: float, stretch: float) -> np.ndarray:
    """Displacement from the upper face: stretched over the part that adheres, relaxed beside it."""
    x = np.arange(sites)
    beside = np.minimum(np.maximum(x - sites // 2 + 1, 0), sites - x)
    return -stretch * np.exp(-beside / (0.5 * thickness))


def stretch_of(release: float, thickness: float) -> float:
    """δ of G/w, nm; w is what parting the wall and the free part of the strip at the distance δ takes."""
    spring, delta, work = UNIAXIAL / thickness, 0.0, WORK
    for _ in range(200):
        delta = np.sqrt(2 * release * work / spring)
        gap = delta
        for _ in range(50):
            gap = delta - WORK / RANGE * np.exp(-gap / RANGE) / spring
        work = WORK * (1 - np.exp(-gap / RANGE)) + 0.5 * spring * (delta - gap) ** 2
    return float(delta)


def velocity(advance, sites: int, thickness: float, stride: float) -> float:
    """m/s of either edge: advance(dt) does a step, or several, and gives the part of the box that adheres. The contact is followed over
    thickness/2 of the way of each edge, and v is taken from the second half; positive opens."""
    t, dt, way = [0.0], 0.02 * TIME, [0.0]
    first = None
    while abs(way[-1]) < 0.5 * thickness:
        part = advance(dt)
        first = part if first is None else first
        t.append(t[-1] + dt)
        way.append(0.5 * (first - part) * sites)
        v = abs(way[-1] - way[-2]) / dt
        dt = float(np.clip(stride / max(v, 1e-12), dt / 1.5, 1.5 * dt))
        if t[-1] > 1e6 * TIME:
            return 0.0
    second = np.abs(way) > 0.25 * thickness
    return float(np.polyfit(np.array(t)[second], np.array(way)[second], 1)[0])


def strip(sites: int, thickness: float, release: float, stride: float) -> float:
    """v by the program of one dimension."""
    s, delta = stiffness(sites, thickness), stretch_of(release, thickness)
    state = [starting(sites, thickness, delta), np.zeros(sites)]

    def advance(dt: float) -> float:
        w, h = state
        e = np.exp(-dt / TIME)
        b = (1 - e) * TIME / dt
        new = balance((1 + RATIO * b) * s, irfft(s * rfft(RATIO * (e * h - b * w)), sites), w, delta)
        state[:] = new, e * h + b * (new - w)
        return float(np.mean(np.exp(-np.maximum(new + delta, 0) / RANGE)))

    return velocity(advance, sites, thickness, stride)


# ---- The steady crack in an infinite solid.


def steady(v: float, nodes: int = 700) -> float:
    """G/w of a crack that opens at v m/s (Greenwood, J. Phys. D 40, 1769 (2007), with this law of the wall). Behind its tip, where the
    gap g begins, an elastic solid would open by θ(x) under the tractions σ(g) and the K that cancels their singularity; a viscoelastic one
    opens by g = ∫ J((x - x')/v) dθ, J the creep compliance over the relaxed one."""
    zone = np.pi / 4 * PLANE * RANGE**2 / WORK
    edge = np.linspace(0.0, np.sqrt(60 * zone * (1 + RATIO)), nodes + 1)  # p = √x
    a, lower, upper = edge[:, None], edge[None, :-1], edge[None, 1:]

    def primitive(p):  # of p ln|(a + p)/(a - p)|
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(p == a, 0.0, 0.5 * (p * p - a * a) * np.log(np.abs((a + p) / (a - p)))) + a * p

    theta = 4 / (np.pi * PLANE) * (2 * a * (upper - lower) - (primitive(upper) - primitive(lower)))
    theta[0] = 0.0
    retarded = TIME * (1 + RATIO)  # of J = 1 - r/(1 + r) exp(-t/retarded)
    at = edge**2 / v
    with np.errstate(over="ignore"):
        remembered = retarded * np.exp(-np.maximum(at[:, None] - at[None, :], 0) / retarded)
    mean = (remembered[:, 1:] - remembered[:, :-1]) / np.diff(at)
    creep = np.where(at[:, None] >= at[None, 1:], 1 - RATIO / (1 + RATIO) * mean, 0.0)
    gap_of = creep @ np.diff(theta, axis=0)
    gap_of = 0.5 * (gap_of[1:] + gap_of[:-1])
    gap = RANGE * np.linspace(0, 12, nodes)
    for _ in range(200):
        pull = WORK / RANGE * np.exp(-np.maximum(gap, 0) / RANGE)
        step = np.linalg.solve(np.eye(nodes) + gap_of * (pull / RANGE), gap_of @ pull - gap)
        gap = gap + step * min(1.0, RANGE / np.max(np.abs(step)))
        if np.max(np.abs(step)) < 1e-9 * RANGE:
            break
    return float(4 / (np.pi * PLANE) * np.sum(pull * np.diff(edge)) ** 2 / WORK)


# ---- The same strip in Asperity.


def crack_keys(sites: int, thickness: int) -> dict:
    return {"surface.kind": "flat", "surface.sites": sites, "surface.spacing": "1 nm", "block.thickness": thickness, "block.young": f"{E} MPa",
            "block.poisson": NU, "block.prony": [[RATIO, f"{TIME} ns"]], "interface.kind": "wall",
            "interface.adhesion": f"{WORK} mJ/m^2",
            "interface.range": f"{RANGE} nm", "interface.stiffness": HARD / 1e4, "interface.edge_pinning": "allow", "drive.mode": "quasistatic",
            "drive.control": "top", "drive.velocity": "1 m/s", "drive.path": ["approach", "pull-off"]}


def asperity_strip(sites: int, thickness: int, release: float, stride: float) -> float:
    """v by Asperity."""
    import asperity
    from asperity.running.engine import State

    keys = crack_keys(sites, thickness)
    statics = asperity.Statics(keys)
    delta, z0 = stretch_of(release, thickness), statics.now.mean_height / 10
    u = np.zeros((3, sites, sites))
    u[2] = 10 * (starting(sites, thickness, delta) + delta - z0)
    statics.restore(State(u, 10 * (delta - z0), np.zeros((1, sites, sites))))
    closed = -WORK * 1e-3 / 1.602176634e-19 * 1e-20 * statics.area  # eV

    return velocity(lambda dt: statics.hold(f"{dt} ns").interface_energy / closed, sites, thickness, stride)


def crack(sites: int, releases: list[float]) -> None:
    thickness = sites // 8
    print("| G/w | v, m/s | one dimension | ratio |\n|---|---|---|---|")
    for release in releases:
        v, other = asperity_strip(sites, thickness, release, 1.0), strip(sites, thickness, release, 0.5)
        print(f"| {release} | {v:.4g} | {other:.4g} | {v / other:.3f} |", flush=True)


def strips(releases: list[float]) -> None:
    thicknesses = (80, 160, 320)
    heads = ["G/w", *(f"H = {t} nm" for t in thicknesses), "to 1/H = 0", "infinite solid"]
    print(f"| {' | '.join(heads)} |\n{'|---' * len(heads)}|")
    for release in releases:
        v = [strip(2 ** int(np.ceil(np.log2(8 * t))), t, release, 0.5) for t in thicknesses]
        low, high = 1e-4, 1e6
        while high / low > 1.001:
            middle = np.sqrt(low * high)
            low, high = (middle, high) if steady(middle, 350) < release else (low, middle)
        print(f"| {release} | " + " | ".join(f"{x:.4g}" for x in (*v, 2 * v[-1] - v[-2], low)) + " |", flush=True)


# ---- A rough surface at a hard wall.


def rough(sites: int) -> np.ndarray:
    """Heights, nm: random phases, waves of at least an eighth of the box, spectrum of H = 0.8, rms 0.5."""
    random = np.random.default_rng(1)
    q = np.hypot(np.fft.fftfreq(sites, 1 / sites)[:, None], np.fft.rfftfreq(sites, 1 / sites)[None, :])
    size = np.where((q >= 1) & (q <= 8), np.maximum(q, 1) ** -1.8, 0.0)
    h = np.fft.irfft2(size * np.exp(2j * np.pi * random.random(q.shape)), s=(sites, sites))
    return 0.5 * (h - h.mean()) / h.std()


def in_tamaas(case: dict) -> list[list[float]]:
    """Contact fraction and mean gap, nm, after each step of even length under the given mean pressures (MPa); then those of its elastic
    solver at the last pressure. Its memory has the closed form in full contact for ν = -1/2 alone; E* is all that the contact knows of."""
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(1)
    heights = np.load(case["map"])
    n = len(heights)

    def model():
        m = tm.Model(tm.model_type.basic_2d, [float(n), float(n)], [n, n])
        m.E, m.nu = PLANE * 0.75, -0.5
        return m

    def observed(m):
        gap = np.array(m["displacement"]) - heights
        return [float(np.mean(np.array(m["traction"]) > 0)), float(np.mean(gap - gap.min()))]

    found = []
    relaxing = model()
    solver = tm.MaxwellViscoelastic(relaxing, heights, 1e-10, case["dt"], [RATIO * relaxing.mu], [TIME])
    for p in case["pressures"]:
        solver.solve(p)
        found.append(observed(relaxing))
    elastic = model()
    solver = tm.PolonskyKeerRey(elastic, heights, 1e-10)
    solver.solve(case["pressures"][-1])
    return [*found, observed(elastic)]


def tamaas(environment: pathlib.Path) -> None:
    import asperity

    python, sites = environment / "bin/python", 128
    if not python.exists():
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        place = pathlib.Path(name)
        np.save(place / "map.npy", rough(sites))
        np.save(place / "map-A.npy", 10 * rough(sites))
        print("| velocity, m/s | t, ns | pressure, MPa | contact | Tamaas | mean gap, nm | Tamaas |\n|---|---|---|---|---|---|---|")
        for velocity, holds in ((100.0, 0), (1.0, 500)):
            dt = 0.02 / velocity  # ns, of 0.02 nm
            statics = asperity.Statics(crack_keys(sites, 2 * sites) | {
                "surface.kind": "file", "surface.file": place / "map-A.npy", "interface.adhesion": 0, "interface.stiffness": "auto",
                "drive.velocity": velocity, "drive.control": "mean-height"})
            statics.mean_height = 10 * rough(sites).max() + 0.1
            statics.relax()
            points = []
            for i in range(50 + holds):
                if i < 50:
                    statics.mean_height = statics.now.mean_height - 0.2
                point = statics.relax() if i < 50 else statics.hold(f"{dt} ns")
                gap = statics.maps().gap
                points.append((point.force / statics.area * 160217.66, np.mean(gap <= 0), np.mean(gap) / 10))
            case = {"map": str(place / "map.npy"), "dt": dt, "pressures": [p for p, _, _ in points]}
            (place / "case.json").write_text(json.dumps(case))
            there = json.loads(subprocess.run([python, __file__, "--solve", place / "case.json"], check=True, stdout=subprocess.PIPE).stdout)
            for i in (24, 49, 74, 99, 149, 299, 549):
                if i < len(points):
                    (pressure, contact, gap), (other, other_gap) = points[i], there[i]
                    print(f"| {velocity:g} | {dt * (i + 1):.4g} | {pressure:.4f} | {contact:.4f} | {other:.4f} | {gap:.4f} | {other_gap:.4f} |")
            print(f"| {velocity:g}, its elastic solver | | {points[-1][0]:.4f} | | {there[-1][0]:.4f} | | {there[-1][1]:.4f} |")


def main() -> None:
    if sys.argv[1:2] == ["--solve"]:  # in the environment of Tamaas
        print(json.dumps(in_tamaas(json.loads(pathlib.Path(sys.argv[2]).read_text()))))
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    of_crack = commands.add_parser("crack")
    of_crack.add_argument("--sites", type=int, default=512)
    of_crack.add_argument("--release", type=float, nargs="+", default=[0.7, 0.85, 1.2, 1.5, 2])
    of_strips = commands.add_parser("strips")
    of_strips.add_argument("--release", type=float, nargs="+", default=[1.2, 1.5, 2, 3])
    of_tamaas = commands.add_parser("tamaas")
    of_tamaas.add_argument("environment", type=pathlib.Path)
    a = parser.parse_args()
    if a.command == "crack":
        crack(a.sites, a.release)
    elif a.command == "strips":
        strips(a.release)
    else:
        tamaas(a.environment)


if __name__ == "__main__":
    main()
