// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Solution of Eq. (2) for the distribution P(σ, ζ) of the stress, by finite volumes.
//
// In the variance T = (π/2) E*² ∫ q³ C dq it is ∂P/∂T = ½ ∂²P/∂σ² with P = 0 at the detachment
// stress, σ = -σ_a(ζ). Eq. (3), γ_eff(ζ) A*(ζ) = Δγ A*(ζ_1) - U_el(ζ), seems to couple all
// magnifications both ways. It does not: with u(ζ) the elastic energy of roughness from q_L up to
// q, U_el(ζ) = u(ζ_1) - u(ζ), so
//     γ_eff(ζ) A*(ζ)/A0 = g0 + u(ζ),    g0 = γ_eff(1),
// and for a given g0 everything at ζ follows from smaller ζ. The one condition that is left,
// γ_eff(ζ_1) = Δγ, is solved for g0 in persson.cpp. Units: any consistent set.
#pragma once

#include <cstddef>
#include <vector>

#include "theory/persson.hpp"

namespace asperity::theory {

/// Steps of a solution: even in ln(q - q_L), which is ln T at the start and ln q later, with the
/// edges of gaps in the spectrum, and no step over which T grows by more than e^spacing. Members:
/// q, stress variance T, elastic energy at full contact (π/2) E* ∫ q² C dq, area factor S.
struct Magnifications {
    std::vector<double> q, T, energy, stretch;
};
/// Returns the steps for this spacing of ln T.
[[nodiscard]] Magnifications magnifications(const AdhesiveContact& contact, double spacing);

/// Profiles A(ζ)/A0, u(ζ), γ_eff(ζ) and σ_a(ζ) at each magnification.
struct StressPath {
    std::vector<double> area, energy, gamma, detachment_stress;
    /// Index of the last magnification of full contact: the boundary does not meet the
    /// distribution.
    std::size_t start = 0;
};

/// Solves from ζ = 1 to ζ_1 with γ_eff(1) = g0, on so many cells of the stress. Second order in
/// both.
[[nodiscard]] StressPath stress_path(const AdhesiveContact& contact, const Magnifications& at,
                                     double g0, int cells);

} // namespace asperity::theory
