// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// External forces on the sites of the lowest layer, in addition to those of the substrate, and
// their work. The work between two steps is the mean of the powers at both, F(n).v(n+1/2) and
// F(n+1).v(n+1/2), times dt.
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/block/block.hpp"
#include "kernels/exact_sum.hpp"

namespace asperity {

/// External forces on the sites.
class ExternalForces {
public:
    /// Sets the forces on the sites of this rank's tile from the next step on, eV/Å; nullptr
    /// removes them. Keeps the pointer: each step reads the field.
    void set(const VectorField<double>* field) { field_ = field; }
    /// Returns true if forces act.
    bool act() const { return field_ != nullptr; }
    /// Returns true if forces act or acted in the step before, so that their work must be counted.
    bool work() const { return act() || pending_ != 0.0; }

    /// Adds the forces to those of the interface on the block, before the kick of a step.
    void add_to(Block& block);
    /// Computes the power of the forces with the velocities after the kick.
    void measure_power_after_kick(const Block& block) { after_ = power(block); }
    /// Returns the work between the step before and this one, eV. Collective.
    double work_of_step(const Communicator& ranks, double dt);

    /// Passes the numbers to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("pending", pending_);
    }

private:
    ExactSum power(const Block& block) const;

    const VectorField<double>* field_ = nullptr;
    ExactSum before_, after_; ///< power with v(n-1/2) and v(n+1/2), of this rank, eV/fs
    double pending_ = 0.0;    ///< power with v(n+1/2) at the step before, eV/fs
};

} // namespace asperity
