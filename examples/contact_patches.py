# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""An observable of one's own: how many separate patches are in contact, over time.

    python3 examples/contact_patches.py [SITES [--plot FILE]]
"""
import sys

import numpy

import asperity


def patches(contact):
    """Connected patches of a periodic map: each takes the largest number among its sites."""
    label = numpy.where(contact, 1 + numpy.arange(contact.size).reshape(contact.shape), 0)
    while True:
        near = [numpy.roll(label, shift, axis) for axis in (0, 1) for shift in (-1, 1)]
        grown = numpy.where(contact, numpy.maximum.reduce([label, *near]), 0)
        if (grown == label).all():
            return len(numpy.unique(label[contact]))
        label = grown


sites = int(sys.argv[1]) if len(sys.argv) > 1 else 64
sim = asperity.Simulation({"surface": {"sites": sites, "rms": 1.0},
                           "drive": {"velocity": 50.0, "timestep": 20.0}})
sim.every(200, lambda s: patches(s.maps().contact), "patches")
while not sim.done:
    sim.step(1000)
path = sim.series
for time, contact, count in zip(path["time"], path["contact_fraction"], path["patches"]):
    print(f"{time:8.1f} ps  {100 * contact:5.1f} % in contact  {count:3.0f} patches")

if "--plot" in sys.argv:
    import matplotlib.pyplot as plt

    plt.figure(figsize=(5, 3.2), layout="constrained")
    plt.plot(path["time"], path["patches"])
    plt.xlabel("time (ps)")
    plt.ylabel("patches in contact")
    plt.savefig(sys.argv[-1])
