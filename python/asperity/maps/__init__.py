# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Measured maps of heights, and substrates of atoms.

    channels             the maps that a file holds, and which of them is meant
    text, arrays, atoms  the formats that are read here
    convert              a map or atoms as the HDF5 that a scene names
    height_map           a map as an array, and the pieces that show what its edges and its place change
    missing_waves        the roughness that a map does not show
"""
