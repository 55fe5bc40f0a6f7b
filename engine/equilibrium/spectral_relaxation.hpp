// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxed state of a spectral block, in two stages.
//
// While contact spreads, sites snap into contact one after the other, and the energy is far from
// quadratic. However well a step is chosen, it is good for some tenths of an angstrom only, the
// range of an attraction; so steps must be cheap. Every site is a heavy ball of its own
// (heavy_ball.hpp): one sweep of the interface, two transforms a component, no energy, no line
// search. The stiffness k of the preconditioner follows the interface's mean, so that a block
// supported by a few summits converges as fast as one in full contact.
//
// Once no site has far to go, what is left is a smooth problem with soft modes, and the direction
// is Newton's. The substrate is rigid, so the interface's Hessian is a map of 3 x 3 matrices,
// computed by three sweeps (interface_stiffness.hpp), and the elastic one is S: (S + H) d = -g is
// solved by conjugate gradients with the same preconditioner, without sweeps and in single
// precision, and g is in double. Where the curvature is negative, where Newton's step would move a
// site further than max_move, or where the last step has not halved the residual, the heavy balls
// go on.
//
// A relaxation that starts near an equilibrium (Start::near, as at a point of a path) begins with
// Newton's method; steps that would move a site further than max_move, but no further than ten
// times that, are then shortened to max_move. One that starts from a prediction ends where Newton's
// method does not help: a surface that has become unstable is then followed from its last
// equilibrium, not from a guess.
//
// Sweeps of the first stage are in mixed precision (where the interface is made for it), and so are
// Newton's until the forces are near their error; the last ones, and the state that is reported,
// are in the interface's own.
//
// The minimum that is found is the one downhill: no site moves further than max_move in an
// iteration, and one that has passed its goal stops. A state whose forces cannot be brought below
// the tolerance is reported as not converged.
#pragma once

#include "engine/block/spectral_block.hpp"
#include "engine/equilibrium/relaxation.hpp"

namespace asperity {

/// Relaxes the block in place, under its constraint; over a wall by wall_descent.hpp.
/// options.max_move: 0.3 Å, well below the range of the potential, is usual.
RelaxedState relax(SpectralBlock& block, const Interface& interface, double reference_height,
                   const RelaxOptions& options, Phases& phases);

} // namespace asperity
