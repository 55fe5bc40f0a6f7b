# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""An observable of one's own: how many separate patches are in contact, over time.

    python3 examples/contact_patches.py [SITES]
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
rows = []
sim.every(200, lambda s: rows.append((s.time, s.contact, patches(s.maps().contact))))
while not sim.done:
    sim.step(1000)
for time, contact, count in rows:
    print(f"{time:8.1f} ps  {100 * contact:5.1f} % in contact  {count:3d} patches")
print("most patches at once:", max(count for _, _, count in rows))
