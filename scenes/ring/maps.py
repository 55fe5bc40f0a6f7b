# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Makes the two synthetic maps of this folder: python3 maps.py

ring.npy: a piston ring, turned and lapped, with marks along x; liner.npy: a cylinder liner, plateau-honed, with grooves at two angles.
128 x 128 heights in micrometres, 0.5 micrometres apart, periodic, outwards from each solid.
"""
from pathlib import Path

import numpy as np

N = 128
there, random = Path(__file__).parent, np.random.default_rng(7)
k = np.fft.fftfreq(N, 1 / N)
kx, ky = np.meshgrid(k, k)


def rough(q, least, most, hurst=0.8):
    """A random periodic map of unit rms height with a power law of the wave number q between two bounds."""
    size = np.where((q >= least) & (q <= most), np.maximum(q, least) ** -(1 + hurst), 0.0)
    heights = np.fft.ifft2(size * np.fft.fft2(random.standard_normal((N, N)))).real
    return heights / heights.std()


ring = 0.10 * rough(np.hypot(4 * kx, ky), 3, 32) + 0.02 * rough(np.hypot(kx, ky), 4, 24)
x, y = np.meshgrid(np.arange(N) / N, np.arange(N) / N)
plateau = 0.06 * rough(np.hypot(kx, ky), 3, 24)
grooves = sum(np.maximum(0, np.cos(2 * np.pi * (a * x + b * y) + phase)) ** 6 for a, b, phase in ((2, 5, 0.3), (-2, 5, 1.9)))
liner = plateau - 0.25 * grooves
for name, heights in (("ring", ring), ("liner", liner)):
    np.save(there / f"{name}.npy", (heights - heights.mean()).astype(np.float32))
