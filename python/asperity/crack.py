# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The energy that a crack takes up in a viscoelastic solid: the factor of Persson and Brener (PRE 71, 036123 (2005)).

Of a modulus E(t)/E = 1 + Σ r exp(-t/τ), a crack that opens at the velocity v takes up
    G0/G = 1 - (2/π) ∫ dω/ω √(1 - ω²/ω_c²) Im(-E/E(ω)),    0 < ω < ω_c = 2πv/a,    a = a0 G/G0:
a is the radius of its tip, whose stress does not depend on v. G/G0 goes from 1 to 1 + Σ r. A solid of finite size gives
a part back: the work of a pull-off has a maximum.

prony: pairs (r, τ), as block.prony. Numbers are in the package's units (ps, m/s, Å); a text has its own: "1 ns".
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from numbers import Real
from typing import Any

import numpy as np

from .arguments import checks_call
from .errors import SceneError, WrongValue
from .running.engine import quantity
from .theories import viscoelastic
from .units import ANGSTROM_PER_PS

__all__ = ["modulus", "opening_factor"]
Prony = Sequence[tuple[float, "float | str"]]


def _branches(prony: Prony) -> list[tuple[float, float]]:
    """Returns ratios and times, ps. Raises SceneError for anything but pairs."""
    found = []
    for pair in prony:
        if not isinstance(pair, (Sequence, np.ndarray)) or isinstance(pair, (str, bytes)) or len(pair) != 2 or not isinstance(pair[0], Real):
            raise SceneError("prony", f"has the branch {pair!r:.60}", "a branch is a modulus over the relaxed one, and a relaxation time",
                             'for example [(2.0, "1 ns")]')
        found.append((float(pair[0]), quantity("prony", pair[1], "ps")))
    return found


def _numbers(where: str, given: Any, unit: str) -> np.ndarray:
    """Returns an array in this unit, of numbers, texts or lists of them."""
    values = np.asarray(given)
    if values.dtype.kind in "fiu":
        return values.astype(float)
    return np.array([quantity(where, value, unit) for value in values.ravel().tolist()]).reshape(values.shape)


@checks_call
def modulus(prony: Prony, frequency: Any) -> Any:
    """Returns the complex modulus of a solid over its relaxed one, E(ω)/E.

    Parameters
    ----------
    prony : sequence of (float, float or str)
        Branches: modulus over the relaxed one, and relaxation time (ps, or text with a unit).
    frequency : float, str or array
        Angular frequency (1/ps, or text with a unit).

    Returns
    -------
    complex or array
        Storage (real) and loss modulus (imaginary part), dimensionless.
    """
    return viscoelastic.modulus(_branches(prony), _numbers("frequency", frequency, "1/ps"))


@checks_call
def opening_factor(prony: Prony, velocity: Iterable[float | str] | float | str, tip_radius: float | str) -> Any:
    """Returns the energy release rate of an opening crack over that of the slowest one, G(v)/G0.

        asperity.crack.opening_factor([(9.0, "1 ns"), (1.5, "20 ns")], ["1 mm/s", "1 m/s"], "2 nm")

    Parameters
    ----------
    prony : sequence of (float, float or str)
        Branches: modulus over the relaxed one, and relaxation time (ps, or text with a unit).
    velocity : float, str or array
        Velocity of the crack (m/s, or text with a unit).
    tip_radius : float or str
        Tip radius a0 of the slowest crack (Å, or text with a unit).

    Returns
    -------
    float or array
        G(v)/G0 at each velocity, dimensionless.

    Raises
    ------
    WrongValue
        If there is no branch, or a ratio, time, the radius or a velocity is not positive.
    """
    prony, tip_radius = _branches(prony), quantity("tip_radius", tip_radius, "Å")
    way = _numbers("velocity", velocity, "m/s") * ANGSTROM_PER_PS
    times = [tau for _, tau in prony]
    if not times or min(times) <= 0 or min(r for r, _ in prony) <= 0 or not tip_radius > 0:
        raise WrongValue("opening_factor()", "is given branches or a tip_radius that are not above 0", "a crack in a viscoelastic solid has "
                         "branches (ratio, time) and a tip", 'for example [(2.0, "1 ns")] and tip_radius="10 nm"')
    if not (way > 0).all():
        raise WrongValue("opening_factor()", f"is given the velocity {way.min():g} Å/ps", "a crack that opens moves", 'for example "1 m/s"')
    stiffest = 1 + sum(r for r, _ in prony)
    cut = np.geomspace(1e-6 / max(times) / stiffest, 1e8 / min(times), 1500)  # ω_c
    s = np.linspace(-35, 0, 3501)  # ln ω/ω_c
    weight = np.sqrt(-np.expm1(2 * s)) * (s[1] - s[0]) * 2 / np.pi
    factor = np.array([1 / (1 - weight @ (-1 / modulus(prony, w * np.exp(s))).imag) for w in cut])
    return np.interp(np.log(way), np.log(tip_radius * factor * cut / (2 * np.pi)), factor)
