// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Persson's theory of contact without adhesion for a solid that yields (B. N. J. Persson, J. Chem.
// Phys. 115, 3840 (2001)): with the roughness up to more and more wavevectors the pressure of a
// point of the contact diffuses from the mean pressure P, by a variance of V = E*² <|∇h|²>/4 in
// all, and ends at 0, where the contact is lost, or at the hardness H. No adhesion, no history:
// P is the largest pressure so far. Units: any consistent set.
#pragma once

namespace asperity::theory {

/// Area of contact over the nominal area.
struct CappedContact {
    double elastic = 0;  ///< area under pressures between 0 and the hardness
    double yielding = 0; ///< area at the hardness
    [[nodiscard]] double area() const { return elastic + yielding; }
};

/// Returns the contact at a mean pressure. variance: variance of the pressure at full contact, E*²
/// times a quarter of the mean square slope. Throws InvalidInput unless 0 <= pressure < hardness
/// and variance >= 0.
[[nodiscard]] CappedContact capped_contact(double pressure, double hardness, double variance);

} // namespace asperity::theory
