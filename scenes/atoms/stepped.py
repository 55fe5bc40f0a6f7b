#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Prints two layers of an fcc (001) solid under a terrace of half the box, as a LAMMPS data file. stepped.h5 is made by

    scenes/atoms/stepped.py > stepped.data
    ./asperity convert stepped.data scenes/atoms/stepped.h5
"""

EDGE, ACROSS = 41.6, 15  # Å, the box of stepped.toml; atoms across: a spacing of 2.7733 Å


def atoms():
    spacing = EDGE / ACROSS
    for layer in range(3):  # from the terrace down
        shift = 0.5 * (layer % 2)
        for j in range(ACROSS):
            for i in range(ACROSS // 2 if layer == 0 else ACROSS):
                yield (i + shift) * spacing, (j + shift) * spacing, -layer * spacing / 2**0.5


places = list(atoms())
print(f"A stepped solid: scenes/atoms/stepped.py\n\n{len(places)} atoms\n1 atom types\n"
      f"0 {EDGE} xlo xhi\n0 {EDGE} ylo yhi\n-4 1 zlo zhi\n\nAtoms # atomic\n")
for n, (x, y, z) in enumerate(places, 1):
    print(f"{n} 1 {x:.5g} {y:.5g} {z:.5g}")
