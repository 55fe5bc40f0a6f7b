# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Quasi-static friction of an adhesive contact: pressed, then slid sideways; it sticks and slips.

    python3 examples/slide.py [SITES [--plot FILE]]
"""
import sys
import tempfile

import numpy

import asperity

sites = int(sys.argv[1]) if len(sys.argv) > 1 else 32
with tempfile.TemporaryDirectory() as directory:
    run = asperity.run({"surface": {"sites": sites, "rms": 1.0}, "block": {"thickness": sites},
                        "drive": {"mode": "quasistatic",
                                  "path": ["approach", "load 300 MPa", "slide x 13 Å"]}},
                       out=directory + "/slide")
    sliding = run.series["segment"] == 2
    place, force, lost = (run.series[name][sliding] for name in ("slide_x", "lateral_force_x", "dissipated"))
    for k in numpy.flatnonzero(numpy.diff(lost) > 0.01 * lost[-1]):
        print(f"slip at {place[k]:6.3f} Å: {-force[k]:7.3f} to {-force[k + 1]:7.3f} eV/Å, "
              f"{lost[k + 1] - lost[k]:.3f} eV lost")
    slide = run.find("segments")[2]
    print(f"friction {slide['friction']:.3f} eV/Å, at most {slide['largest_friction']:.3f}; "
          f"{slide['lost']:.3f} of {slide['work_of_drive']:.3f} meV/Å² lost")

if "--plot" in sys.argv:
    import matplotlib.pyplot as plt

    plt.figure(figsize=(5, 3.2), layout="constrained")
    plt.plot(place, -force)
    plt.xlabel("displacement (Å)")
    plt.ylabel("force against it (eV/Å)")
    plt.savefig(sys.argv[-1])
