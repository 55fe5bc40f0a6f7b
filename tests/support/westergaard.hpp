// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The periodic contact: a half-space on the wave h cos(2πx/λ), Westergaard (1939) without adhesion,
// Johnson (1995) with it, in the manner of JKR. With p* = πE*h/λ, the pressure of full contact, and
// f the fraction of the surface in contact (half-width fλ/2),
//     p/p* = sin²(πf/2) - α √tan(πf/2),    α = √(2wλ/(π²E*h²)).
// The last term is a flat-punch solution whose edges carry just the energy release rate w.
// Pressures positive pressing. Units: any consistent set.
#pragma once

namespace asperity::theory {

struct AdhesiveSine {
    double amplitude = 0;        ///< h, half of crest to trough [length]
    double wavelength = 0;       ///< λ [length]
    double contact_modulus = 0;  ///< E* [stress]
    double work_of_adhesion = 0; ///< w [energy/area], 0: Westergaard

    [[nodiscard]] double full_contact_pressure() const; ///< p* = πE*h/λ
    [[nodiscard]] double alpha() const;
};

namespace westergaard {

/// Reduced mean pressure p/p* at contact fraction f.
[[nodiscard]] double reduced_pressure(double alpha, double fraction);
/// Mean pressure with dimensions.
[[nodiscard]] double pressure(const AdhesiveSine& sine, double fraction);

/// Extremes of the curve: pull-off (minimum) and the jump into full contact (maximum).
struct Extremes {
    bool exist = true; ///< false above merging_alpha(): the curve only falls
    double pull_off = 0, pull_off_fraction = 0;
    double jump_in = 0, jump_in_fraction = 0;
};
[[nodiscard]] Extremes extremes(double alpha);

/// Above this α = 0.56988 the maximum is below zero: full contact without any load.
[[nodiscard]] double spontaneous_alpha();
/// Above this α = 1.06521 minimum and maximum have merged: no partial contact is stable at any
/// load.
[[nodiscard]] double merging_alpha();

/// Contact fraction of the stable branch (between pull-off and jump) at p/p*; NoSolution outside.
[[nodiscard]] double contact_fraction(double alpha, double reduced_pressure);

} // namespace westergaard
} // namespace asperity::theory
