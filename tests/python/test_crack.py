# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""The factor of Persson and Brener against its closed form for one branch, and its limits."""

import numpy as np
import pytest
from asperity.crack import modulus, opening_factor


@pytest.mark.parametrize("ratio", [0.1, 2.0, 99.0])
def test_one_branch_has_a_closed_form(ratio):
    """∫ √(1 - y²) / (1 + b²y²) dy = (π/2) (√(1 + b²) - 1)/b², so G0/G = 1 - (r/R) (√(1 + b²) - 1)/b, b = R ω_c τ, R = 1 + r."""
    time, tip, whole = 3.0, 0.2, 1 + ratio
    cut = np.geomspace(1e-3, 1e3, 25) / time
    b = whole * cut * time
    factor = 1 / (1 - ratio / whole * (np.sqrt(1 + b * b) - 1) / b)
    velocity = tip * factor * cut / (2 * np.pi)
    assert opening_factor([(ratio, time)], velocity, tip) == pytest.approx(factor, rel=2e-4)


def test_limits_of_slow_and_fast():
    prony = [(9.0, 1.0), (1.5, 20.0)]
    slow, fast = opening_factor(prony, [1e-9, 1e7], 1.0)
    assert slow == pytest.approx(1, abs=1e-4)
    assert fast == pytest.approx(11.5, rel=1e-3)
    factors = opening_factor(prony, np.geomspace(1e-6, 1e6, 50), 1.0)
    assert (np.diff(factors) > 0).all()
    assert modulus(prony, 1e9) == pytest.approx(11.5)


@pytest.mark.parametrize("prony, tip", [([], 1.0), ([(-1.0, 1.0)], 1.0), ([(1.0, 0.0)], 1.0), ([(1.0, 1.0)], 0.0)])
def test_nonsense_is_refused(prony, tip):
    with pytest.raises(ValueError, match="above 0"):
        opening_factor(prony, 1.0, tip)
