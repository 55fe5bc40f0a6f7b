// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic block at rest as a path leads it: what is held, where the block stands, and the steps
// in time of a viscoelastic one. response.hpp describes how the block responds to forces.
#pragma once

#include "engine/units.hpp"
#include "engine/waves/response.hpp"

#include <vector>

namespace asperity {

class SpectralBlock : public Response {
public:
    /// Builds the undisplaced block under no load. Collective. Throws std::invalid_argument if
    /// there are more ranks than slabs.
    SpectralBlock(const BlockOptions& options, const Communicator& communicator,
                  bool frictionless = false)
        : Response(options, communicator, frictionless) {}

    /// Returns the displacement at the sites, Å, to be written; the waves follow in
    /// apply_constraint().
    VectorField<double>& layer() { return layer_; }
    const VectorField<double>& layer() const { return layer_; }
    /// Displaces the whole block by (0, 0, z), Å.
    void set_uniform(double z);
    /// Sets what is held from now on; apply_constraint() brings the block there.
    void constrain(const Constraint& constraint) { constraint_ = constraint; }
    /// Sets what is held and brings the block there. Collective.
    void hold(const Constraint& constraint) {
        constrain(constraint);
        apply_constraint();
    }

    /// Begins a step of dt, fs, of a viscoelastic block from the state and the constraint as they
    /// are; an infinite step leaves the block relaxed, without memory. last: length of the step
    /// that this one continues, fs; infinite: it continues none. Does nothing without branches.
    /// Collective.
    void begin_step(double dt, double last = units::forever);
    /// Begins a turn of the way to the equilibrium of a moving pattern (moving_pattern.hpp) from
    /// the present shape; begin_step() ends the turns. Returns the root mean square of the change
    /// of the forces since the last turn, eV/Å, by which the shape is no equilibrium yet; infinite
    /// at the first turn. The block has branches. Collective.
    double follow(const MovingPattern& pattern);
    /// Sets the branches to what they are in the moving pattern of the present shape, as the last
    /// turn had it. Collective.
    void settle_branches();
    /// Ends the step of the branches at the current displacements.
    void end_step() {
        if (memory_) memory_->end(from_top());
    }
    /// Returns the extensions of the branches, Å, to be kept and restored; null without branches.
    std::vector<SiteField<double>>* memory() { return memory_ ? &memory_->extensions() : nullptr; }
    const std::vector<SiteField<double>>* memory() const {
        return memory_ ? &memory_->extensions() : nullptr;
    }
    /// Returns what the next step needs of the last one, Å, to be kept and restored; null without
    /// branches.
    std::vector<SiteField<double>>* history() { return memory_ ? &memory_->history() : nullptr; }
    const std::vector<SiteField<double>>* history() const {
        return memory_ ? &memory_->history() : nullptr;
    }

    /// Returns the bytes of the table of stiffness, which each rank has whole, and of all.
    std::size_t table_bytes() const { return table_.bytes(); }
    std::size_t bytes() const;
};

} // namespace asperity
