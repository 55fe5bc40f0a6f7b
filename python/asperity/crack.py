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
    """Returns the complex modulus of a solid over its relaxed one, E(ω)/E.

    Parameters
    ----------
    prony : sequence of (float, float)
        Branches: modulus over the relaxed one, and relaxation time.
    frequency : float or array
        Angular frequency, in the inverse unit of the relaxation times.

    Returns
    -------
    complex or array
        Storage (real) and loss modulus (imaginary part), dimensionless.
    """
    iw = 1j * np.asarray(frequency, float)
    return 1 + sum((r * iw * tau / (1 + iw * tau) for r, tau in prony), np.zeros(iw.shape, complex))


def opening_factor(prony: Prony, velocity: Iterable[float] | float, tip_radius: float) -> Any:
    """Returns the energy release rate of an opening crack over that of the slowest one, G(v)/G0.

    Parameters
    ----------
    prony : sequence of (float, float)
        Branches: modulus over the relaxed one, and relaxation time.
    velocity : float or array
        Velocity of the crack, in the unit of tip_radius over that of the relaxation times.
    tip_radius : float
        Tip radius a0 of the slowest crack, a length.

    Returns
    -------
    float or array
        G(v)/G0 at each velocity, dimensionless.

    Raises
    ------
    ValueError
        If there is no branch, or a ratio, time or the radius is not positive.
    """
    times = [tau for _, tau in prony]
    if not times or min(times) <= 0 or min(r for r, _ in prony) <= 0 or not tip_radius > 0:
        raise ValueError("a crack in a solid that relaxes has branches (ratio, time) and a tip_radius, all above 0")
    stiffest = 1 + sum(r for r, _ in prony)
    cut = np.geomspace(1e-6 / max(times) / stiffest, 1e8 / min(times), 1500)  # ω_c
    s = np.linspace(-35, 0, 3501)  # ln ω/ω_c
    weight = np.sqrt(-np.expm1(2 * s)) * (s[1] - s[0]) * 2 / np.pi
    factor = np.array([1 / (1 - weight @ (-1 / modulus(prony, w * np.exp(s))).imag) for w in cut])
    return np.interp(np.log(np.asarray(velocity, float)), np.log(tip_radius * factor * cut / (2 * np.pi)), factor)
