// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Where a dynamic path begins and ends: as close as the attraction can be told from nothing.
//
// A rigid block that comes down from beyond the interaction range to the height h does the work
// -U(h), exactly; so that part of the path need not be stepped through. Left out is how the block
// yields to the force F met there, an energy F²/2k. It is no softer than if F acted on one round
// patch of as many sites as share it, n = (sum f)² / sum f²: 1/k = 1/(2 E* r) + thickness/(M A).
// The path starts where that energy is a small fraction of the deepest energy of the rigid block,
// which is no more than the largest binding energy of the elastic one. What the block would have
// yielded is a wave in it instead, with an amplitude that goes as the root of the fraction.
#pragma once

#include "engine/block/block.hpp"
#include "engine/interface/interface.hpp"

namespace asperity {

/// An undisplaced block over its substrate.
struct ApproachStart {
    double height = 0.0; ///< of its lowest layer, Å
    double energy = 0.0; ///< of the interface, eV
    double force = 0.0;  ///< total normal force, eV/Å

    /// For checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("energy", energy);
        v("force", force);
    }
};

/// Of the deepest energy of the rigid block: what the block may have yielded at the start.
inline constexpr double share_at_start = 1e-6;

/// Interface::start_height(), from where nothing attracts, if nothing does further down. The block
/// must be undisplaced; its forces are overwritten. Collective.
ApproachStart approach_start(Block& block, const Interface& interface);

} // namespace asperity
