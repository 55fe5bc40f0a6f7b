// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Johnson, Kendall and Roberts: an adhesive sphere whose forces act only inside the contact.
// In Maugis' units, a in (πwR²/K)^{1/3}, F in πwR, δ in (π²w²R/K²)^{1/3}, K = 4E*/3,
//     F = a³ - √(6a³),    δ = a² - (2/3)√(6a).
// Forces are positive pressing. Units of AdhesiveSphere: any consistent set.
#pragma once

namespace asperity::theory {

struct AdhesiveSphere {
    double radius = 0;           ///< R [length]
    double contact_modulus = 0;  ///< E* = E/(1-ν²) [stress]
    double work_of_adhesion = 0; ///< w = Δγ [energy/area]

    [[nodiscard]] double stiffness() const { return 4 * contact_modulus / 3; } ///< K
    [[nodiscard]] double force_unit() const;                                   ///< πwR
    [[nodiscard]] double radius_unit() const;                                  ///< (πwR²/K)^{1/3}
    [[nodiscard]] double approach_unit() const; ///< (π²w²R/K²)^{1/3}
};
void check(const AdhesiveSphere& sphere);

struct SphereState {
    double force = 0;    ///< F [force], negative pulling
    double radius = 0;   ///< a [length]
    double approach = 0; ///< δ [length], negative: a neck
};

namespace jkr {

/// On the equilibrium curve at contact radius a.
[[nodiscard]] SphereState at_radius(const AdhesiveSphere& sphere, double radius);
/// Where a controlled load pulls off: F = -(3/2)πwR.
[[nodiscard]] SphereState pull_off(const AdhesiveSphere& sphere);

/// γ from a measured pull-off force, γ = |F|/(3πR/2): the paper's Eq. (6) turned round.
[[nodiscard]] double work_from_pull_off(double pull_off_force, double radius);
/// γ from the energy U > 0 that it takes to part a sphere without a load (JKR 1971),
/// U = (6πγR)^{5/3} / (10 K^{2/3} R^{1/3}). It needs no largest force.
[[nodiscard]] double work_from_binding_energy(double energy, double radius, double contact_modulus);

} // namespace jkr
} // namespace asperity::theory
