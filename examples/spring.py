# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Coupling to something else: a spring drags a patch of the lowest layer sideways, once in contact.

    python3 examples/spring.py [SITES [--plot FILE]]
"""
import sys

import numpy

import asperity

sites = int(sys.argv[1]) if len(sys.argv) > 1 else 64
sim = asperity.Simulation({"surface": {"sites": sites, "rms": 0.8},
                           "drive": {"velocity": 50.0, "timestep": 20.0}})
while sim.segment == "approach":
    sim.step(20)
sim.top.velocity = 0.0

patch = numpy.zeros((sites, sites), bool)
patch[: sites // 4, : sites // 4] = True
stiffness, speed = 0.5, 0.05  # eV/Å² for each site of the patch; Å/ps of the spring's other end
sim.external = numpy.zeros((sites, sites, 3))
start, home, rows = sim.time, sim.u.x[patch].mean(), []
for _ in range(20):
    for _ in range(25):  # the other program's turn: a force from where the patch is
        stretch = speed * (sim.time - start) - (sim.u.x[patch].mean() - home)
        sim.external.x[patch] = stiffness * stretch
        sim.step(2)
    rows.append((sim.time - start, stiffness * stretch * patch.sum()))
    print(f"{sim.time - start:6.1f} ps  patch at {sim.u.x[patch].mean() - home:7.4f} Å  "
          f"pulled with {rows[-1][1]:8.4f} eV/Å")
print(f"work of the spring {sim.external_work:.4f} eV")

if "--plot" in sys.argv:
    import matplotlib.pyplot as plt

    plt.figure(figsize=(5, 3.2), layout="constrained")
    plt.plot(*zip(*rows))
    plt.xlabel("time (ps)")
    plt.ylabel("pull of the spring (eV/Å)")
    plt.savefig(sys.argv[-1])
