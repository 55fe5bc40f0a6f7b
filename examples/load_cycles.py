# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Cycles of load and unload, without time: the contact area over the load, and what each cycle dissipates.

    python3 examples/load_cycles.py [SITES [--plot FILE]]
"""
import sys

import asperity

sites = int(sys.argv[1]) if len(sys.argv) > 1 else 32
statics = asperity.Statics({"surface": {"sites": sites, "rms": 2.0}, "block": {"thickness": sites},
                            "drive": {"mode": "quasistatic", "hold": "top"}})
statics.load = 0.0  # into contact
statics.relax()
per_site = 1e3 / (sites * 2.6) ** 2  # eV of the whole to meV/Å²
rows = []
for cycle in (1, 2):
    before = statics.now.dissipated
    for load in (500, 1000, 2000, 4000, 2000, 1000, 500, 0, -500, 0):  # MPa
        statics.load = load
        point = statics.relax()
        rows.append((load, 100 * point.contact))
        print(f"cycle {cycle}  {load:5d} MPa  {point.mean_height:6.3f} Å  {100 * point.contact:5.1f} % in contact")
    print(f"cycle {cycle} dissipates {(point.dissipated - before) * per_site:.3f} meV/Å²")

if "--plot" in sys.argv:
    import matplotlib.pyplot as plt

    plt.figure(figsize=(5, 3.2), layout="constrained")
    plt.plot(*zip(*rows), "o-")
    plt.xlabel("load (MPa)")
    plt.ylabel("sites in contact (%)")
    plt.savefig(sys.argv[-1])
