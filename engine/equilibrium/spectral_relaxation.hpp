// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxed state of a spectral block, in two movements on the waves of its lowest layer.
//
// First the surfaces come together: sites snap in one after the other, contact spreads, and the
// energy is anything but a bowl. Here the direction is that of limited-memory BFGS (Nocedal, Math.
// Comp. 35, 773, 1980) preconditioned with (S(q) + k)^-1, k about the interface's stiffness of a
// site: with it long and short waves relax alike. Each site is moved by max_move at most, whatever
// the others do. An iteration costs one sweep of the interface and nine real transforms.
//
// Once the forces have fallen to a tenth of their largest, the contacts are made but for the
// deepest valleys, and what is left is a smooth problem with soft spots. Here the direction is
// Newton's. The substrate is rigid, so the interface's Hessian is a map of 3 x 3 matrices, had by
// three sweeps (interface_stiffness.hpp), and the elastic one is S: (S + H) d = -g is solved by
// conjugate gradients with the same preconditioner, without sweeps and in single precision, loosely
// while sites still fall, and cut to max_move as well. Where the energy curves down at once, or
// Newton would send a site far away, the first movement goes on.
//
// Sweeps are in mixed precision (where the interface is made for it) until the forces are near
// their error; the last ones, and the state that is reported, are in the interface's own.
//
// The minimum that is found is the one downhill: steps go down, no site moves further than max_move
// in an iteration, and where the force along a step has turned round, the step is cut back to where
// it vanishes. A state whose forces cannot be brought below the tolerance is reported as not
// converged.
#pragma once

#include "engine/block/spectral_block.hpp"
#include "engine/equilibrium/relaxation.hpp"

namespace asperity {

/// Relaxes the block in place, its top plane as it is (held or free; the load acts on a free one).
/// options.max_move may be larger than FIRE's: 0.2 Å, well below the range of the potential, is
/// usual.
RelaxedState relax(SpectralBlock& block, const Interface& interface, double reference_height,
                   const RelaxOptions& options, Phases& phases);
/// What it takes beside the block, bytes.
std::size_t spectral_relaxation_bytes(const SpectralBlock& block);

} // namespace asperity
