// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Branches of a viscoelastic solid in series with an elastic one. Let the moduli of the two be
// S m(s) and S', with m = 1 + sum r_k s tau_k/(1 + s tau_k) in Laplace's s, and x = S/(S + S') the
// share of S'. Their compliances add up to a modulus with as many branches,
//
//     S S'/(S + S') M(s),    M = m/(1 - x + x m) = 1 + sum R_k s T_k/(1 + s T_k).
//
// The times T are the roots of x sum r_k tau_k/(T - tau_k) = 1, one above each tau_k and below the
// next one, and R_k = (1 - x)/(x^2 T_k sum r_j tau_j/(T_k - tau_j)^2). The energies that springs
// store and dashpots dissipate follow from the modulus alone, so that they too are those of both
// solids. For all waves the branches are the same if x is.
#pragma once

#include "engine/options/block_options.hpp"

#include <vector>

namespace asperity {

/// Returns the branches of two solids in series, their ratios to the relaxed modulus of both.
/// branches: those of one solid, with ascending times; share: its relaxed modulus over the sum of
/// both moduli, above 0 and below 1.
std::vector<Branch> branches_in_series(const std::vector<Branch>& branches, double share);

} // namespace asperity
