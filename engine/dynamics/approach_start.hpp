// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Begin and end of a dynamic path: the largest height at which the attraction matters.
//
// A rigid block that moves from beyond the interaction range down to the height h does the work
// -U(h), exactly; so this part of the path need not be simulated. It neglects the deformation of
// the block by the force F at h, an energy F²/2k. The block is no softer than if F acted on one
// round patch of as many sites as share it, n = (sum f)² / sum f²: 1/k = 1/(2 E* r) + thickness/(M
// A). The path starts at the height at which that energy is a small fraction of the deepest energy
// of the rigid block, which is no more than the largest binding energy of the elastic one. The
// neglected deformation becomes a wave in the block instead, whose amplitude is proportional to the
// root of the fraction.
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

/// Largest energy of deformation at the start, over the deepest energy of the rigid block.
inline constexpr double share_at_start = 1e-6;

/// Returns the start of a dynamic path; Interface::start_height(), where nothing attracts, if
/// nothing does further down. The block must be undisplaced; its forces are overwritten.
/// Collective.
ApproachStart approach_start(Block& block, const Interface& interface);

} // namespace asperity
