// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Start of a dynamic path: the largest height at which the attraction matters.
//
// Moving a rigid block from beyond the interaction range down to the height h takes exactly the
// work U(h), so that this part of the path need not be simulated. The error is the deformation of
// the block by the force F at h, with an energy F²/2k. The block is at least as stiff as if F acted
// on one round patch of n = (sum f)² / sum f² sites of radius r: 1/k = 1/(2 E* r) + thickness/(M
// A). The path starts at the height at which F²/2k is a small fraction of the deepest energy of the
// rigid block, which does not exceed the largest binding energy of the elastic block. The neglected
// deformation becomes a wave in the block instead, whose amplitude is proportional to the root of
// the fraction.
#pragma once

#include "engine/block/block.hpp"
#include "engine/interface/interface.hpp"

namespace asperity {

/// An undisplaced block over its substrate.
struct ApproachStart {
    double height = 0.0; ///< height of the lowest layer, Å
    double energy = 0.0; ///< energy of the interface, eV
    double force = 0.0;  ///< total normal force, eV/Å

    /// Passes the members to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("energy", energy);
        v("force", force);
    }
};

/// Largest energy of deformation at the start, divided by the deepest energy of the rigid block.
inline constexpr double share_at_start = 1e-6;

/// Finds the start of a dynamic path; Interface::start_height() if the solids do not attract each
/// other. The block must be undisplaced; its forces are overwritten. Collective.
ApproachStart approach_start(Block& block, const Interface& interface);

} // namespace asperity
