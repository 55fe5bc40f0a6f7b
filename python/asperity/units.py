# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""Units of the package. Results are in eV, Å, ps, GPa and meV/Å² (shared with engine/units.hpp)."""

ELECTRONVOLT = 1.602176634e-19
"""J"""
NANONEWTON = 1e-19 / ELECTRONVOLT
"""1 nN in eV/Å"""
GIGAPASCAL = 1e-21 / ELECTRONVOLT
"""1 GPa in eV/Å^3"""
MEGAPASCAL = 1e-3 * GIGAPASCAL
"""1 MPa in eV/Å^3"""
MILLIJOULE = 1e20 * ELECTRONVOLT
"""1 meV/Å² in mJ/m²"""
ANGSTROM_PER_PS = 0.01
"""1 m/s in Å/ps"""
LENGTHS = {"Å": 0, "\u212b": 0, "A": 0, "Ang": 0, "angstrom": 0, "Angstrom": 0, "fm": -5, "pm": -2, "nm": 1, "um": 4,
           "\u00b5m": 4, "\u03bcm": 4, "\u00c2\u00b5m": 4, "mm": 7, "cm": 8, "m": 10, "km": 13}
"""Powers of ten of units of length, in Å. Âµm is µm in UTF-8 that a program took for Latin-1."""


def shown(unit: str) -> str:
    """Returns a unit as people write it: meV/Å^2 as meV/Å²."""
    for power, sign in (("^2", "²"), ("^3", "³"), ("^4", "⁴")):
        unit = unit.replace(power, sign)
    return unit
