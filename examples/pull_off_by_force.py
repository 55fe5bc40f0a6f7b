# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Pull-off controlled by force: a load that grows until the solids part, as on a balance.

    python3 examples/pull_off_by_force.py [SITES [--plot FILE]]
"""
import sys

import numpy

import asperity

sites = int(sys.argv[1]) if len(sys.argv) > 1 else 64
sim = asperity.Simulation({"surface": {"sites": sites, "rms": 0.8}, "block": {"thickness": 16},
                           "drive": {"velocity": 20.0, "timestep": 20.0}})
while sim.segment == "approach":  # the scene's own drive makes contact
    sim.step(20)

rate = 2e-3 * sites**2  # eV/Å each ps
start, pull = sim.time, 0.0
sim.every(50, lambda s: pull, "pull")
while sim.contact > 0.0 and sim.time - start < 1000.0:
    pull = rate * (sim.time - start)
    # The top plane moves as fast as the force is wrong: away while it is less than the pull, m/s.
    lacking = (pull + sim.top_force) / sites**2
    sim.top.velocity = max(-50.0, min(50.0, 200.0 * lacking))
    sim.step(10)

print(f"parted after {sim.time - start:.0f} ps under a pull of {pull:.1f} eV/Å")
path = sim.series
print(f"largest attraction {-path['force'].min():.1f} eV/Å")

if "--plot" in sys.argv:
    import matplotlib.pyplot as plt

    plt.figure(figsize=(5, 3.2), layout="constrained")
    plt.plot(path["time"] - start, numpy.transpose([path["pull"], -path["force"]]))
    plt.xlabel("time (ps)")
    plt.ylabel("force (eV/Å): pull, attraction")
    plt.savefig(sys.argv[-1])
