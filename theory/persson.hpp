// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Persson's theory of adhesive contact between randomly rough elastic solids, Eqs. (1) to (5) of
// Mulakaluri and Persson, at any load and for any isotropic spectrum.
//
// Interpretation of the equations: σ_a² = γ_eff E* q with γ_eff < 0 counted as zero; U_el(ζ) in Eq.
// (3) is the energy of roughness shorter than L/ζ; A* = A S with S named in area_factor.hpp. Eq.
// (2) is solved by finite differences (stress_distribution.hpp) on a coarse grid and on a grid
// twice as fine in both directions; the difference is the reported error. A state usually takes 2
// ms.
#pragma once

#include <string_view>
#include <vector>

#include "theory/area_factor.hpp"
#include "theory/spectrum.hpp"

namespace asperity::theory {

/// Contact of an elastic solid with a rough surface. Units: any consistent set.
struct AdhesiveContact {
    Spectrum spectrum;
    double contact_modulus = 0;  ///< E* = E/(1-ν²) [stress]
    double work_of_adhesion = 0; ///< Δγ [energy/area], 0: no adhesion
    double pressure = 0; ///< p = F_N/A0 [stress], positive for pressing, negative for pulling
    double beta = 0.45;  ///< β in W = a [β + (1-β) a²], 0..1
    AreaFactor area_factor = AreaFactor::gaussian;
    double tilt_cost = 0; ///< c of AreaFactor::lattice
};

/// Returns the elastic energy at area fraction a divided by that of full contact (Yang and
/// Persson).
[[nodiscard]] inline double energy_fraction(double a, double beta) {
    return a * (beta + (1 - beta) * a * a);
}

/// State of the contact.
enum class Status {
    adhesive,   ///< γ_eff(1) > 0: the surfaces adhere without a load
    pressed,    ///< γ_eff(1) <= 0: only the load maintains the contact
    no_contact, ///< the surfaces separate: all results are exactly zero
};

/// State of the contact at one magnification.
struct ProfilePoint {
    double q = 0;                 ///< ζ q_L [1/length]
    double zeta = 1;              ///< q/q_L
    double area = 1;              ///< A(ζ)/A0, projected
    double real_area = 1;         ///< A*(ζ)/A0
    double gamma_eff = 0;         ///< γ_eff(ζ) of Eq. (3), any sign [energy/area]
    double detachment_stress = 0; ///< σ_a(ζ) [stress]
    double elastic_energy = 0;    ///< U_el(ζ)/A0: roughness from q to q1 [energy/area]
    double stress_variance = 0;   ///< T(q) at full contact [stress²]
};

/// Solution of Eqs. (2) to (5).
struct ContactState {
    Status status = Status::no_contact;
    double gamma_eff = 0;         ///< γ_eff(1) [energy/area]; negative if `pressed`
    double gamma_ratio = 0;       ///< γ_eff(1)/Δγ; 0 if Δγ = 0
    double area = 0;              ///< A(ζ_1)/A0
    double elastic_energy = 0;    ///< U_el(1)/A0 [energy/area]
    double gamma_ratio_error = 0; ///< error of gamma_ratio: difference of the last two grids
    double area_error = 0;
    /// Gamma_ratio_error and area_error are below 1e-3 (relative for a ratio above 1).
    bool converged = true;
    std::vector<ProfilePoint> profile; ///< states on the finest grid, from ζ = 1 to ζ_1
};

/// Solves Eqs. (2) to (5). Throws InvalidInput for an invalid contact.
[[nodiscard]] ContactState solve(const AdhesiveContact& contact);

/// State with A = A0 at all magnifications: γ_full = Δγ S(q1) - (π/2) E* ∫ q² C dq.
struct FullContactState {
    double gamma = 0;          ///< [energy/area], any sign
    double elastic_energy = 0; ///< U_el/A0 [energy/area]
    double real_area = 1;      ///< S(q1)
};
/// Computes the state of full contact. Throws InvalidInput for an invalid contact.
[[nodiscard]] FullContactState full_contact(const AdhesiveContact& contact);

/// Roughness at which adhesion ends. At zero load γ_eff and A vanish there together; under pressure
/// γ_eff(1) changes sign; under tension it is the largest roughness at which the contact withstands
/// the tension. The spectrum gives the shape only.
struct CriticalRoughness {
    double h_rms = 0, error = 0; ///< h_c [length]
    /// Rms height at which γ_eff of full contact vanishes [length].
    double full_contact_h_rms = 0;
};
/// Returns the roughness at which adhesion ends. Throws NoSolution if adhesion does not end.
[[nodiscard]] CriticalRoughness critical_roughness(const AdhesiveContact& contact);

[[nodiscard]] std::string_view name(Status status); ///< returns the name of a state

/// Throws InvalidInput for an invalid contact.
void check(const AdhesiveContact& contact);

} // namespace asperity::theory
