#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""What would a step take on GPUs? A model from counted bytes and operations; nothing in it is measured.

    python3 perf/device_model.py build/release/perf [--terms]

volumes (of that folder) counts what the most loaded device holds and sends, for a block as thick as
wide; docs/explanation/device.md explains the terms. --terms prints those of the largest tile of each size alone.
"""
import argparse
import math

import scaling

SITES, DEVICES = (512, 2048, 8192), (1, 8, 16, 32, 64, 128, 256)

# An H100 (SXM), by its maker: memory 3.35 TB/s; 132 processors at 1.755 GHz with 64 double
# instructions, and 128 bytes from their first cache, a cycle each.
CLOCKS = 132 * 1.755e9
MEMORY, FIRST_CACHE, INSTRUCTIONS = 3.35e12, 128 * CLOCKS, 64 * CLOCKS
# Assumed: of the second cache; a launch behind another; a copy by way of the host, its start and its
# bytes a second; the network, likewise, for each device.
SECOND_CACHE = 5.5e12
LAUNCH, COPY, COPY_BYTES, MESSAGE, MESSAGE_BYTES = 3e-6, 10e-6, 50e9, 3e-6, 25e9

# Counted from the texts (docs/explanation/device.md), a node, site, pair, node of an upper or a constrained plane.
# (All upper planes but the top follow a coarser one, and that has a few nodes.)
NODE_MEMORY, NODE_SECOND, NODE_FIRST, NODE_OPERATIONS = 96, 27 * 8 + 72, 81 * 8 + 72, 159
SITE_MEMORY, FACE_MEMORY, CONSTRAINED_MEMORY = 56, 72, 30
PAIR_INSTRUCTIONS = (31 + 16) / 4 + 0.5 * 10  # half a division, of ten instructions (assumed)

SPACING, CUTOFF, SEPARATION = 2.6, 13.12, 3.11  # the paper's block on a flat substrate, Å


def pairs_of_site():
    most = int(CUTOFF / SPACING) + 1
    return sum((i + 0.5) ** 2 * SPACING ** 2 + (j + 0.5) ** 2 * SPACING ** 2 + SEPARATION ** 2 < CUTOFF ** 2
               for i in range(-most, most + 1) for j in range(-most, most + 1))


def terms(v):
    """Seconds of the bounds of a device's step in full contact, in double precision, by name."""
    t = {"advance: memory": v["nodes"] * NODE_MEMORY / MEMORY,
         "advance: second cache": v["nodes"] * NODE_SECOND / SECOND_CACHE,
         "advance: first cache": v["nodes"] * NODE_FIRST / FIRST_CACHE,
         "advance: arithmetic": v["nodes"] * NODE_OPERATIONS / INSTRUCTIONS,
         "forces: pairs": v["sites"] * pairs_of_site() * PAIR_INSTRUCTIONS / INSTRUCTIONS,
         "forces: memory": (v["sites"] * SITE_MEMORY + v["constrained"] * FACE_MEMORY) / MEMORY,
         "follow: memory": v["constrained"] * CONSTRAINED_MEMORY / MEMORY,
         "launches": 3 * LAUNCH}
    if v["ranks"] > 1:
        sent = 2 * (v["x"] + v["y"])
        ways = sum(v[way] > 0 for way in "xy")
        doublings = math.ceil(math.log2(v["ranks"]))
        t["halos: launches and memory"] = 2 * ways * LAUNCH + 4 * sent / MEMORY
        t["halos: by way of the host"] = 2 * ways * COPY + 2 * sent / COPY_BYTES
        t["halos: messages"] = ways * MESSAGE + sent / MESSAGE_BYTES
        if v["gathered"] > 0:
            t["shared level"] = (LAUNCH + 2 * COPY + 2 * v["gathered"] / COPY_BYTES
                                 + doublings * MESSAGE + v["gathered"] / MESSAGE_BYTES)
    return t


def step(t, direct=False):
    """Seconds of a step: each launch by its slowest term. direct: MPI takes device memory."""
    def of(name):
        return [x for key, x in t.items() if key.startswith(name)]
    work = max(of("advance")) + max(of("forces")) + sum(of("follow")) + t["launches"]
    messages = sum(of("halos")) + sum(of("shared"))
    if direct and messages:
        messages -= t["halos: by way of the host"]
    return work, messages


def main():
    parser = argparse.ArgumentParser(description="A model of a step on H100 devices; nothing in it is measured.")
    parser.add_argument("folder", help="where the program volumes is")
    parser.add_argument("--terms", action="store_true", help="every term of a step on one device")
    options = parser.parse_args()
    cases = [(n, n, d) for n in SITES for d in DEVICES]
    volume = scaling.volumes(options.folder, cases)
    if options.terms:
        print("| term, µs | " + " | ".join(f"{n}²" for n in SITES) + " |\n|---|" + "---|" * len(SITES))
        one = [terms(volume[(n, n, 1)]) for n in SITES]
        for name in one[0]:
            print(f"| {name} | " + " | ".join(f"{1e6 * t[name]:.0f}" for t in one) + " |")
        print("| step | " + " | ".join(f"{1e6 * sum(step(t)):.0f}" for t in one) + " |")
        return
    print("| sites | devices | nodes a device | sent, MB | work, µs | messages, µs | step, µs | efficiency | "
          "step with GPU-aware MPI, µs |\n|" + "---|" * 9)
    for n, _, d in cases:
        v = volume[(n, n, d)]
        alone = sum(step(terms(volume[(n, n, 1)])))
        work, messages = step(terms(v))
        sent = 2e-6 * (v["x"] + v["y"])
        print(f"| {n}² | {d} | {1e-6 * v['nodes']:.2f} million | {sent:.2f} | {1e6 * work:.0f} | {1e6 * messages:.0f} "
              f"| {1e6 * (work + messages):.0f} | {alone / d / (work + messages):.2f} "
              f"| {1e6 * sum(step(terms(v), True)):.0f} |")


if __name__ == "__main__":
    main()
