#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Time of a step on larger machines, extrapolated from the scaling study on two cores.

    python3 perf/extrapolate.py bench.json    # of ./asperity bench --scaling --out bench.json

A step of the most loaded rank takes

    nodes x t_node + sites x t_site + constrained x t_constrained     work
    (wrapped + 2 x sent) x t_byte                                     copies into and out of halos
    swap(x) + swap(y)                                                 messages to neighbours
    log2(ranks) x t_sum                                               the reduction
    log2(ranks) x latency + gathered x t_gathered                     the levels that every rank holds

Volumes are counted by the rules of decomposition/process_grid.cpp and level_shapes() of engine/block.
Times of work and copies are measured on one core, interpolated in the number of nodes and constant
beyond the largest block measured; times of messages are measured between two ranks of one machine, or
those of the assumed NETWORK. Not included: waiting for late ranks, and memory shared by more cores.
"""
import json
import math
import sys

SITES, RANKS = (512, 2048, 8192), (4, 16, 64, 256, 1024)
# Assumed, not measured: seconds; bytes a second of each rank; longer messages wait for the receiver
# (two more latencies).
NETWORK = {"latency": 2e-6, "bandwidth": 5e9, "eager": 65536.0}
HALO, VECTOR = 2, 24  # nodes; bytes
LAYERS_PER_LEVEL = 4  # the default of block.layers_per_level


def level_cells(sites, thickness):
    """Cells above each other in each level."""
    cells, rest = [], thickness
    while True:
        here = LAYERS_PER_LEVEL + (rest - LAYERS_PER_LEVEL) % 2
        if sites % 2 or (rest - here) // 2 < LAYERS_PER_LEVEL:
            return cells + [rest]
        cells.append(here)
        rest, sites = (rest - here) // 2, sites // 2


def process_grid(sites, ranks, levels):
    """Ranks along x and y, and the coarsest level that is cut."""
    px = max(p for p in range(1, ranks + 1) if ranks % p == 0 and p * p <= ranks)
    py = ranks // px
    if ranks == 1:
        return px, py, levels - 1

    def fullest(n):
        return math.ceil(n / px) * math.ceil(n / py) * ranks / n**2

    cut = 0
    for level in range(1, levels):
        n = sites >> level
        if n // py < HALO or n << level != sites:
            break
        if fullest(n) <= 1.02 * fullest(sites):
            cut = level
    return px, py, cut


def volumes(sites, thickness, ranks):
    """What the rank with the most nodes works on (counts) and sends (bytes) in a step."""
    cells = level_cells(sites, thickness)
    px, py, cut = process_grid(sites, ranks, len(cells))
    v = dict.fromkeys(("nodes", "held", "constrained", "x", "y", "wrapped", "gathered"), 0)
    for level, layers in enumerate(cells):
        n, tiled, last = sites >> level, level <= cut, level + 1 == len(cells)
        nx, ny = n, n
        if tiled:  # the tile at the upper end of an uneven cut
            nx, ny = (n - (((sites >> cut) * (p - 1) // p << cut) + (1 << level) - 1 >> level) for p in (px, py))
        v["nodes"] += nx * ny * layers
        v["held"] += 0 if tiled else nx * ny * layers
        v["constrained"] += 0 if last else nx * ny
        columns, rows = HALO * ny * layers * VECTOR, HALO * (nx + 2 * HALO) * layers * VECTOR
        for way, many, size in (("x", px, columns), ("y", py, rows)):
            if tiled and many > 1:
                v[way] += size
            else:
                v["wrapped"] += 2 * size
        if level == cut and not last:
            v["gathered"] = n * n // 4 * VECTOR
        if level == 0:
            v["sites"] = nx * ny
    return v | {"ranks": ranks}


def between(points, x):
    """Straight lines through (x, y); constant before the first, the last line goes on."""
    points = sorted(points)
    if x <= points[0][0]:
        return points[0][1]
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x <= x1 or x1 == points[-1][0]:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return points[-1][1]


class Model:
    """Seconds of a step, of measured steps in contact on one core and measured messages."""

    def __init__(self, singles, messages):
        self.cost = {"node": [], "site": [], "constrained": [], "byte": []}
        for s in singles:
            v, p = volumes(s["sites"], s["layers"], 1), s["phases"]
            for name, seconds, many in (("node", p["advance"], v["nodes"]), ("byte", p["exchange"], v["wrapped"]),
                                        ("site", p["interface"] + p["observe"], v["sites"]),
                                        ("constrained", p.get("interpolate", 0.0), max(v["constrained"], 1))):
                self.cost[name].append((math.log(v["nodes"]), seconds / many))
        self.swap = [(m["bytes"], m["seconds"]) for m in messages["swap"]]
        longest = messages["ping"][-1]
        self.latency, self.sum = messages["ping"][0]["seconds"], messages["sum"]
        self.gathered = longest["seconds"] / longest["bytes"]

    def use(self, network):
        """Messages over an assumed network: two leave and two arrive at once, both ways."""
        latency, per_byte, eager = network["latency"], 1.0 / network["bandwidth"], network["eager"]
        self.swap = [(size, waits * latency + 2 * size * per_byte) for size, waits in
                     ((0.0, 1), (eager, 1), (eager + 1, 3), (1e6, 3))]
        self.latency = self.sum = latency
        self.gathered = per_byte

    def predict(self, v):
        """Seconds of work, and of copies and messages."""
        size = min(math.log(v["nodes"]), max(self.cost["node"])[0])
        t = {name: between(points, size) for name, points in self.cost.items()}
        doublings = math.ceil(math.log2(v["ranks"]))
        messages = doublings * self.sum + sum(between(self.swap, v[way]) for way in "xy" if v[way])
        if v["gathered"]:
            messages += doublings * self.latency + v["gathered"] * self.gathered
        return (v["nodes"] * t["node"] + v["sites"] * t["site"] + v["constrained"] * t["constrained"],
                (v["wrapped"] + 4 * (v["x"] + v["y"])) * t["byte"] + messages)


def extrapolate(scaling):
    """The model against two ranks that were measured ("check"), and larger machines ("larger")."""
    contact = [e for e in scaling["single"] if e["place"] == "contact"]
    here, network = (Model(contact, scaling["messages"]) for _ in range(2))
    network.use(NETWORK)
    check = []
    for e in scaling["strong"]:
        if e["place"] == "contact" and e["ranks"] == 2:
            v = volumes(e["sites"], e["layers"], 2)
            work, communication = here.predict(v)
            check.append({"sites": e["sites"], "measured": e["seconds"], "predicted": work + communication,
                          "halo_bytes": e["halo_bytes"], "predicted_halo_bytes": 2 * (v["x"] + v["y"])})
    larger = []
    for n in SITES:
        alone = sum(here.predict(volumes(n, n, 1)))
        for ranks in RANKS:
            v = volumes(n, n, ranks)
            parts = {"here": here.predict(v), "network": network.predict(v)}
            larger.append({"sites": n, "ranks": ranks, "held": v["held"] / v["nodes"], **{
                kind: {"seconds": sum(p), "efficiency": alone / ranks / sum(p), "communication": p[1] / sum(p)}
                for kind, p in parts.items()}})
    return check, larger


def tables(scaling):
    """(title, note, header, rows) of both, for the page and the terminal."""
    check, larger = extrapolate(scaling)
    yield ("The model compared with two ranks",
           "In contact. The model uses measurements on one core and of the messages, and no run on two ranks.",
           ["sites", "measured, ms/step", "model, ms/step", "model / measured", "halo measured, kB", "halo counted, kB"],
           [[f"{c['sites']}", f"{1e3 * c['measured']:.3g}", f"{1e3 * c['predicted']:.3g}",
             f"{c['predicted'] / c['measured']:.2f}", f"{1e-3 * c['halo_bytes']:.4g}",
             f"{1e-3 * c['predicted_halo_bytes']:.4g}"] for c in check])
    both = [(kind, name) for kind in ("here", "network") for name in ("steps/s", "efficiency", "communication")]
    yield ("Larger machines, predicted",
           "In contact, as many layers as sites, ranks of one thread. Here: messages as measured within this machine. "
           f"Network: {1e6 * NETWORK['latency']:g} µs and {1e-9 * NETWORK['bandwidth']:g} GB/s a rank, assumed; messages "
           "over 64 kB wait for two more latencies. Held by all: fraction of a rank's nodes that every rank computes alike.",
           ["sites", "ranks", *(f"{kind}: {name}" for kind, name in both), "held by all"],
           [[f"{e['sites']}", f"{e['ranks']}",
             *(f"{1 / e[kind]['seconds']:.4g}" if name == "steps/s" else f"{e[kind][name]:.2f}" for kind, name in both),
             f"{e['held']:.2f}"] for e in larger])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1]) as file:
        numbers = json.load(file)
    if "scaling" not in numbers:
        sys.exit(f"extrapolate: {sys.argv[1]} has no scaling study: make it by ./asperity bench --scaling --out FILE")
    for title, note, header, rows in tables(numbers["scaling"]):
        print(f"\n{title}\n{note}\n" + "\n".join("  ".join(f"{c:>14}" for c in row) for row in [header, *rows]))


if __name__ == "__main__":
    main()
