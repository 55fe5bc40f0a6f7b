// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The first move of a relaxation over a wall that starts from an equilibrium: along the tangent of
// its branch. With H the interface's stiffness at the sites, the linear response to a change (of
// the constraint, of the memory of branches) is
//
//     (S + H) d = -g,
//
// or, for a prescribed mean height that changes by l, the d with mean l that minimises this
// quadratic energy.
//
// A minimiser alone does not follow the branch: its short waves respond before its long ones, and
// until the long waves have responded, sites at the edge of the contact carry more than in
// equilibrium. Sites near their instability then separate too early by a part of the step.
//
// Conjugate gradients over the sites, preconditioned by 1 / (L + max(H, 0)), with L the stiffness
// of the block's stiffest wave: the repulsion, a thousand times as stiff as the block, is at most 1
// after preconditioning. The number of products scales as the square root of the number of sites
// across the box, like the minimiser's iterations.
#pragma once

#include "engine/interface/interface.hpp"
#include "engine/waves/spectral_block.hpp"

namespace asperity {

/// Moves a frictionless block over a wall, in equilibrium under an earlier constraint, along the
/// tangent of its branch to the new constraint. furthest: limit of the move of a site relative to
/// the mean height, Å; a longer move is shortened. Returns the number of products with S.
/// Collective.
long long follow_tangent(SpectralBlock& block, const Interface& interface,
                         const Constraint& constraint, double furthest);

} // namespace asperity
