// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One integration of the theory from ζ = 1 to ζ_1 with the starting energy g0 = γ_eff(1) given.
//
// Eq. (3), γ_eff(ζ) A*(ζ) = Δγ A*(ζ_1) - U_el(ζ), seems to couple all magnifications both ways. It
// does not: with u(ζ) the elastic energy of roughness from q_L up to q, U_el(ζ) = u(ζ_1) - u(ζ), so
//     γ_eff(ζ) A*(ζ)/A0 = g0 + u(ζ),    g0 = Δγ A*(ζ_1)/A0 - u(ζ_1) = γ_eff(1),
// and for a given g0 everything at ζ follows from what came before it. What is left is one scalar
// condition, γ_eff(ζ_1) = Δγ, which persson.cpp solves for g0: nothing to relax, nothing to
// diverge.
//
// Eq. (2) in the variance T = (π/2) E*² ∫ q³ C dq is ∂P/∂T = ½ ∂²P/∂σ²: a Brownian path that starts
// at p and is absorbed at -σ_a(T). `first_passage` solves an integral equation for the absorbed
// fraction; tests/support/diffusion.hpp solves Eq. (2) itself.
//
// Units: any consistent set (stress, energy per area, 1/length).
#pragma once

#include <optional>
#include <vector>

#include "theory/area_factor.hpp"
#include "theory/spectrum.hpp"

namespace asperity::theory {

/// What an integration needs to know beside its grid.
struct IntegrationInput {
    double contact_modulus = 0; ///< E* [stress]
    double pressure = 0;        ///< p [stress], positive when pressing
    double beta = 0;            ///< of W(a) = a [β + (1-β) a²]
    double g0 = 0;              ///< γ_eff(1) [energy/area], any sign
};

/// Nodes in ascending order of the variance; the first is where the boundary begins to be felt.
struct IntegrationGrid {
    std::vector<double> q; ///< [1/length]
    std::vector<double> T; ///< stress variance [stress²]
    std::vector<double>
        energy; ///< (π/2) E* ∫ q² C dq: elastic energy at full contact [energy/area]
    std::vector<double> stretch; ///< area factor S
    bool ever_detaches = true;   ///< false: the boundary stays 9 standard deviations away
};

/// A(ζ)/A0, u(ζ), γ_eff(ζ) and σ_a(ζ) at the nodes of the grid.
struct IntegrationPath {
    std::vector<double> area;
    std::vector<double> energy;
    std::vector<double> gamma;
    std::vector<double> detachment_stress;
};

/// Fraction of the elastic energy of full contact stored at area fraction a (Yang and Persson).
[[nodiscard]] inline double energy_fraction(double a, double beta) {
    return a * (beta + (1 - beta) * a * a);
}

/// Nodes even in ln T + ln q with the given spacing, cut at gaps and kinks of the spectrum, halved
/// `refinement` times. The start is where the full-contact boundary of `input` is 9 standard
/// deviations away: before that a = 1 to rounding. Around `onset`, if given, the spacing shrinks:
/// there a boundary that was held at zero stress (γ_eff < 0) takes off like a square root.
[[nodiscard]] IntegrationGrid make_grid(const Spectrum& spectrum, AreaReading reading,
                                        const IntegrationInput& input, double spacing,
                                        int refinement, std::optional<double> onset = std::nullopt);

[[nodiscard]] IntegrationPath first_passage(const IntegrationGrid& grid,
                                            const IntegrationInput& input);

} // namespace asperity::theory
