// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic block at rest, as paths use it: the constraint, the displacements, and the time steps
// of a viscoelastic block. response.hpp describes the response to forces.
#pragma once

#include "engine/units.hpp"
#include "engine/waves/response.hpp"

#include <memory>

namespace asperity {

/// The block at rest, as paths use it.
class SpectralBlock : public Response {
public:
    /// Builds the undisplaced block under no load. frictionless: normal displacements only.
    /// Collective. Throws std::invalid_argument if there are more ranks than slabs.
    SpectralBlock(const BlockOptions& options, const Communicator& communicator,
                  bool frictionless = false)
        : Response(options, communicator, frictionless) {}

    /// Returns the displacements of the sites, Å, for writing; apply_constraint() then updates the
    /// waves.
    VectorField<double>& layer() { return layer_; }
    const VectorField<double>& layer() const { return layer_; }
    /// Displaces the whole block by (0, 0, z), Å.
    void set_uniform(double z);
    /// Sets the constraint without moving the block; apply_constraint() then moves the block to it.
    void constrain(const Constraint& constraint) { constraint_ = constraint; }
    /// Sets the constraint and moves the block to it. Collective.
    void hold(const Constraint& constraint) {
        constrain(constraint);
        apply_constraint();
    }

    /// Begins a step of the memories from the present displacements and constraint (TimeStep); an
    /// infinite step relaxes the branches of a viscoelastic block and erases their memory.
    /// Collective.
    void begin_step(double dt, double last = units::forever);
    /// Begins an iteration (turn) towards the steady shape of a moving pattern (moving_pattern.hpp)
    /// from the present shape; begin_step() ends the iterations. Returns the root mean square of
    /// the change of the known forces since the last turn, eV/Å, a measure of the distance from the
    /// steady shape; infinite at the first turn. The block must have branches. Collective.
    double begin_turn(const MovingPattern& pattern);
    /// Sets the extensions of the branches to those of the present shape as a moving pattern, with
    /// the moduli of the last turn. Collective.
    void settle_branches();
    /// Ends the step of the memories at the current displacements.
    void end_step() {
        for (const std::unique_ptr<Memory>& memory : memories_)
            memory->accept();
    }

    /// Returns the memory of the block on this rank, bytes.
    std::size_t bytes() const;
};

} // namespace asperity
