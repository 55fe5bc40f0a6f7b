// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Solution of Eq. (2) for the distribution P(σ, ζ) of the stress, by finite differences.
//
// In the variance T = (π/2) E*² ∫ q³ C dq it is ∂P/∂T = ½ ∂²P/∂σ² with P = 0 at the detachment
// stress, σ = -σ_a(ζ). Eq. (3), γ_eff(ζ) A*(ζ) = Δγ A*(ζ_1) - U_el(ζ), seems to couple all
// magnifications in both directions, but does not: with u(ζ) the elastic energy of roughness from
// q_L up to q, U_el(ζ) = u(ζ_1) - u(ζ), so
//     γ_eff(ζ) A*(ζ)/A0 = g0 + u(ζ),    g0 = γ_eff(1),
// and for a given g0 the solution at ζ follows from smaller ζ. The remaining condition, γ_eff(ζ_1)
// = Δγ, is solved for g0 in persson.cpp. Units: any consistent set.
#pragma once

#include <cstddef>
#include <vector>

#include "theory/persson.hpp"

namespace asperity::theory {

/// A magnification at which a step of the solution ends.
struct StressStep {
    double q;       ///< ζ q_L [1/length]
    double T;       ///< stress variance at full contact [stress²]
    double energy;  ///< elastic energy at full contact, (π/2) E* ∫ q² C dq [energy/area]
    double stretch; ///< area factor S
};
/// Returns the steps of a solution: equidistant in ln(q - q_L), which is about ln T at the start
/// and ln q later, refined so that T grows by at most e^spacing in a step; the edges of gaps in the
/// spectrum are steps too.
[[nodiscard]] std::vector<StressStep> stress_steps(const AdhesiveContact& contact, double spacing);

/// Profiles A(ζ)/A0, u(ζ), γ_eff(ζ) and σ_a(ζ) at each magnification.
struct StressPath {
    std::vector<double> area, energy, gamma, detachment_stress;
    /// Index of the last magnification of full contact: the boundary does not meet the
    /// distribution.
    std::size_t start = 0;
};

/// Solves Eqs. (2) and (3) from ζ = 1 to ζ_1 with γ_eff(1) = g0. nodes: least number of nodes of
/// the stress in a standard deviation √T of the distribution. The error is of second order in the
/// steps and of fourth order in 1/nodes.
[[nodiscard]] StressPath stress_path(const AdhesiveContact& contact,
                                     const std::vector<StressStep>& steps, double g0, int nodes);

} // namespace asperity::theory
