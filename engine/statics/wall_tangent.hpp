// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The first move of a relaxation over a wall that starts from an equilibrium: along the tangent of
// its branch. With H the interface's stiffness at the sites, the linear response to what has
// changed (the constraint, the memory of branches) is
//
//     (S + H) d = -g,
//
// or, at a mean height that changes by l, the d of mean l that minimises the same quadratic energy.
//
// A minimiser alone does not follow the branch: its short waves respond before its long ones, and
// until these have, sites at the edge of the contact carry more than in equilibrium. Those near
// their instability then come off too early, by a part of the step, and always too early.
//
// Conjugate gradients over the sites, preconditioned by 1 / (L + max(H, 0)), L the stiffness of the
// block's stiffest wave: the repulsion is a thousand times as stiff as the block, and in this
// measure no stiffer than 1. The number of products goes with the root of the number of sites
// across the box, as that of the minimiser's iterations.
#pragma once

#include "engine/interface/interface.hpp"
#include "engine/waves/spectral_block.hpp"

namespace asperity {

/// Moves a frictionless block over a wall along the tangent and brings it to the constraint. The
/// block is in equilibrium under an earlier constraint. furthest: the tangent is cut where a site
/// would move further than this beside the change of the mean height, Å. Returns the number of
/// products with S. Collective.
long long follow_tangent(SpectralBlock& block, const Interface& interface,
                         const Constraint& constraint, double furthest);

} // namespace asperity
