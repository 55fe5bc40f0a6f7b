// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Persson's theory of adhesive contact between randomly rough elastic solids, Eqs. (1) to (5) of
// Mulakaluri and Persson, at any load and for any isotropic spectrum.
//
//     AdhesiveContact contact;                      // eV and Å here; any consistent units will do
//     contact.spectrum = Spectrum::self_affine({.q_L = qL, .q0 = 3 * qL, .q1 = 512 * qL,
//                                               .hurst = 0.8, .h_rms = 5});
//     contact.contact_modulus = E / (1 - nu * nu);
//     contact.work_of_adhesion = 0.1;
//     ContactState s = solve(contact);              // s.gamma_ratio = 0.1516, s.area = 0.6663
//
// Equations as read: σ_a² = γ_eff E* q with γ_eff < 0 counted as zero; U_el(ζ) in Eq. (3) is the
// energy of roughness shorter than L/ζ; A* = A S with S named in area_factor.hpp. How they are
// solved is in integration.hpp; in short, one scalar root of a causal integration, on three nested
// grids, extrapolated; the distance between extrapolations is the error reported.
//
// Cost: ~30 ms a state at the default tolerance.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "theory/area_factor.hpp"
#include "theory/spectrum.hpp"

namespace asperity::theory {

struct IntegrationGrid;
struct IntegrationInput;
struct IntegrationPath;

/// What is pressed (or pulled) against what. Units: any consistent set.
struct AdhesiveContact {
    Spectrum spectrum;
    double contact_modulus = 0;  ///< E* = E/(1-ν²) [stress]
    double work_of_adhesion = 0; ///< Δγ [energy/area], 0: no adhesion
    double pressure = 0;         ///< p = F_N/A0 [stress], positive pressing, negative pulling
    double beta = 0.45;          ///< β in W = a [β + (1-β) a²], 0..1
    AreaFactor area_factor = AreaFactor::gaussian;
    double tilt_cost = 0; ///< of AreaFactor::lattice
    [[nodiscard]] AreaReading area_reading() const { return {area_factor, tilt_cost}; }
};

/// How Eq. (2) is solved on a grid of the given spacing, and the power of the spacing in its error.
struct Integration {
    IntegrationPath (*follow)(const IntegrationGrid& grid, const IntegrationInput& input,
                              double spacing);
    double order;
    static const Integration first_passage; ///< Volterra equation
};

struct SolverOptions {
    Integration integration = Integration::first_passage;
    double spacing = 0.4;    ///< of the coarsest grid, in ln T + ln q
    double tolerance = 1e-5; ///< on γ_eff/Δγ (relative above 1) and A/A0; grids are added until met
    int max_refinement = 5; ///< the finest grid has spacing / 2^max_refinement
};

enum class Status {
    adhesive,   ///< γ_eff(1) > 0: bound without any load
    pressed,    ///< in contact, but only because of the load: γ_eff(1) <= 0
    no_contact, ///< the surfaces come apart: everything below is exactly zero
};

/// Everything at one magnification.
struct ProfilePoint {
    double q = 0;                 ///< ζ q_L [1/length]
    double zeta = 1;              ///< q/q_L
    double area = 1;              ///< A(ζ)/A0, projected
    double real_area = 1;         ///< A*(ζ)/A0
    double gamma_eff = 0;         ///< γ_eff(ζ) as Eq. (3) gives it, any sign [energy/area]
    double detachment_stress = 0; ///< σ_a(ζ) [stress]
    double elastic_energy = 0;    ///< U_el(ζ)/A0: roughness from q to q1 [energy/area]
    double stress_variance = 0;   ///< T(q), at full contact [stress²]
};

struct ContactState {
    Status status = Status::no_contact;
    std::string reason;        ///< one sentence on the status, with the values
    double gamma_eff = 0;      ///< γ_eff(1) [energy/area]; negative if `pressed`
    double gamma_ratio = 0;    ///< γ_eff(1)/Δγ; 0 if Δγ = 0
    double area = 0;           ///< A(ζ_1)/A0
    double real_area = 0;      ///< A*(ζ_1)/A0
    double elastic_energy = 0; ///< U_el(1)/A0 [energy/area]
    double contact_stress = 0; ///< ∫ σ P(σ, ζ_1) dσ [stress]: p plus what detachment took away
    double gamma_ratio_error = 0; ///< estimated from the refinement of the grid
    double area_error = 0;
    bool converged = true;             ///< both errors below the tolerance asked for
    int nodes = 0;                     ///< of the finest grid
    std::vector<ProfilePoint> profile; ///< on the finest grid, from ζ = 1 to ζ_1
};

/// Solves Eqs. (2) to (5).
[[nodiscard]] ContactState solve(const AdhesiveContact& contact, const SolverOptions& options = {});

/// A = A0 throughout: γ_full = Δγ S(q1) - (π/2) E* ∫ q² C dq.
struct FullContactState {
    double gamma = 0;          ///< [energy/area], any sign
    double gamma_ratio = 0;    ///< γ_full/Δγ; 0 if Δγ = 0
    double elastic_energy = 0; ///< U_el/A0 [energy/area]
    double real_area = 1;      ///< S(q1)
};
[[nodiscard]] FullContactState full_contact(const AdhesiveContact& contact);

/// The roughness at which adhesion ends: at zero load γ_eff and A vanish there together; pressing,
/// γ_eff(1) goes through zero; pulling, the last roughness that withstands the pull. The spectrum
/// gives the shape only. NoSolution if adhesion does not end (possible with `small_slope`: both
/// terms grow as h²).
struct CriticalRoughness {
    double h_rms = 0;              ///< h_c [length]
    double error = 0;              ///< estimated [length]
    double full_contact_h_rms = 0; ///< where the full-contact approximation vanishes [length]
};
[[nodiscard]] CriticalRoughness critical_roughness(const AdhesiveContact& contact,
                                                   const SolverOptions& options = {});

/// Without adhesion: A(ζ)/A0 = erf(p/√(2T)) (0 when pulling).
[[nodiscard]] double nonadhesive_area(double pressure, double stress_variance);

/// T(q) = (π/2) E*² ∫_{q_L}^{q} q'³ C dq' [stress²].
[[nodiscard]] double stress_variance(const AdhesiveContact& contact, double q);

/// θ = E* h² q0/Δγ, on which alone γ_eff/Δγ depends once the area factor is off.
[[nodiscard]] double adhesion_parameter(double contact_modulus, double h_rms, double q0,
                                        double work_of_adhesion);

[[nodiscard]] std::string_view name(Status status);

/// Throws InvalidInput if the contact makes no sense.
void check(const AdhesiveContact& contact);
void check(const SolverOptions& options);

} // namespace asperity::theory
