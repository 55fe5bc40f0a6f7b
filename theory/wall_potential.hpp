// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Two flat atom planes, one atom per a² each, with Lennard-Jones between the atoms: the sum over
// one plane replaced by an integral. Per area, at the distance d between the planes,
//     φ(d) = (2π/a⁴) ∫_d^{r_c} [V(r) - V(r_c)] r dr
//          = (8πε/a⁴) [ (r0¹²/10)(d⁻¹⁰ - r_c⁻¹⁰) - (r0⁶/4)(d⁻⁴ - r_c⁻⁴) ] - (π/a⁴) V(r_c) (r_c² -
//          d²),
// which without a cutoff is (4πε/a⁴) [ r0¹²/5d¹⁰ - r0⁶/2d⁴ ], deepest at d = r0: 6πε r0²/5a⁴.
// The corrugation, which makes the hollow sites of the atomic interface some 13 % deeper at a
// smaller distance, is gone after one lattice constant, so for the attraction across gaps this is
// exact.
#pragma once

namespace asperity::theory {

/// Units: any consistent set, e.g. eV and Å.
struct WallPotential {
    double epsilon = 0;          ///< ε, depth of the pair potential [energy]
    double r0 = 0;               ///< where it is zero [length]
    double lattice_constant = 0; ///< a; areal density 1/a² [length]
    double cutoff = 0;           ///< r_c, energy-shifted; 0: none [length]

    [[nodiscard]] double energy(double distance) const; ///< φ(d) [energy/area]
    [[nodiscard]] double equilibrium_distance() const;  ///< where φ is deepest [length]
    [[nodiscard]] double depth() const;                 ///< -φ there [energy/area]

    /// Energy gained per area by a gap u counted from the equilibrium distance: -φ(d0 + u) >= 0.
    [[nodiscard]] double attraction(double gap) const;
};
void check(const WallPotential& wall);

} // namespace asperity::theory
