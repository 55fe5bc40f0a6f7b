# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Quasi-static cycles of load and unload: the contact area over the load, and what each cycle dissipates.

    python3 examples/load_cycles.py [SITES [--plot FILE]]
"""
import sys

import numpy

import asperity

sites = int(sys.argv[1]) if len(sys.argv) > 1 else 32
statics = asperity.Statics({"surface": {"sites": sites, "rms": 2.0}, "block": {"thickness": 512},
                            "drive": {"mode": "quasistatic", "control": "top"}})
statics.load = "2 GPa"
deep, area = statics.relax().top, (2.6 * sites) ** 2  # Å, Å²
rows = []
for cycle in (1, 2):
    before = statics.now.dissipated
    for top in numpy.concatenate([numpy.linspace(deep, 0, 20), numpy.linspace(0, deep, 20)]):  # out, and in again
        statics.top = top
        point = statics.relax()
        rows.append((160.2 * point.force / area, 100 * point.contact))  # GPa, %
        print(f"cycle {cycle}  {top:7.2f} Å  {rows[-1][0]:7.3f} GPa  {rows[-1][1]:5.1f} % in contact")
    print(f"cycle {cycle} dissipates {1e3 * (point.dissipated - before) / area:.2f} meV/Å²")

if "--plot" in sys.argv:
    import matplotlib.pyplot as plt

    plt.figure(figsize=(5, 3.2), layout="constrained")
    plt.plot(*zip(*rows), "o-")
    plt.xlabel("load (GPa)")
    plt.ylabel("sites in contact (%)")
    plt.savefig(sys.argv[-1])
