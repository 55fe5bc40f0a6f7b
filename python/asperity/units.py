# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Units that plots are drawn in. Results are in eV, Å, ps, GPa and meV/Å² (shared with engine/units.hpp)."""

ELECTRONVOLT = 1.602176634e-19
"""J"""
NANONEWTON = 1e-19 / ELECTRONVOLT
"""1 nN in eV/Å"""
GIGAPASCAL = 1e-21 / ELECTRONVOLT
"""1 GPa in eV/Å^3"""
MILLIJOULE = 1e20 * ELECTRONVOLT
"""1 meV/Å² in mJ/m²"""


def shown(unit: str) -> str:
    """Returns a unit as people write it: meV/Å^2 as meV/Å²."""
    for power, sign in (("^2", "²"), ("^3", "³"), ("^4", "⁴")):
        unit = unit.replace(power, sign)
    return unit
