# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The energy that a crack takes up in a solid that relaxes: the factor of Persson and Brener (PRE 71, 036123 (2005)).

Of a modulus E(t)/E = 1 + Σ r exp(-t/τ), a crack that opens at the velocity v takes up
    G0/G = 1 - (2/π) ∫ dω/ω √(1 - ω²/ω_c²) Im(-E/E(ω)),    0 < ω < ω_c = 2πv/a,    a = a0 G/G0:
a is the radius of its tip, whose stress does not depend on v. G/G0 goes from 1 to 1 + Σ r. A solid of finite size gives
a part back: the work of a pull-off has a maximum.

prony: pairs (r, τ), as block.prony. Units: any consistent set.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

Prony = Sequence[tuple[float, float]]


def modulus(prony: Prony, frequency: Any) -> Any:
    """E(ω)/E, complex: storage and loss."""
    iw = 1j * np.asarray(frequency, float)
    return 1 + sum((r * iw * tau / (1 + iw * tau) for r, tau in prony), np.zeros(iw.shape, complex))


def opening_factor(prony: Prony, velocity: Iterable[float] | float, tip_radius: float) -> Any:
    """G(v)/G0 of a crack that opens; tip_radius: a0, of the slowest one."""
    times = [tau for _, tau in prony]
    if not times or min(times) <= 0 or min(r for r, _ in prony) <= 0 or not tip_radius > 0:
        raise ValueError("a crack in a solid that relaxes has branches (ratio, time) and a tip_radius, all above 0")
    stiffest = 1 + sum(r for r, _ in prony)
    cut = np.geomspace(1e-6 / max(times) / stiffest, 1e8 / min(times), 1500)  # ω_c
    s = np.linspace(-35, 0, 3501)  # ln ω/ω_c
    weight = np.sqrt(-np.expm1(2 * s)) * (s[1] - s[0]) * 2 / np.pi
    factor = np.array([1 / (1 - weight @ (-1 / modulus(prony, w * np.exp(s))).imag) for w in cut])
    return np.interp(np.log(np.asarray(velocity, float)), np.log(tip_radius * factor * cut / (2 * np.pi)), factor)
