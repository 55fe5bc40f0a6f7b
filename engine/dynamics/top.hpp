// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The top plane of the block, which is rigid: where it is, and how it moves. What moves it is the
// machine (drive.hpp), or the caller of Simulation::step(). A machine that is not rigid, with a
// spring between it and a plane with a mass, would change move() alone: the plane's own velocity
// and place are all that the step, the damping medium and the energy balance use.
#pragma once

#include <array>
#include <cstddef>

namespace asperity {

/// Velocity of the top plane over a time step, Å/fs.
struct TopMotion {
    double z = 0.0;                ///< away from the substrate
    std::array<double, 2> slide{}; ///< over the substrate
};

/// The top plane. At a time step n its velocity is that between n and n + 1.
struct Top {
    double z = 0.0;                ///< displacement along z, Å
    std::array<double, 2> place{}; ///< place of the block over the substrate, Å
    TopMotion velocity;

    /// Moves over a step of dt, fs, to the place at the next step.
    void move(double dt) {
        z += dt * velocity.z;
        for (std::size_t axis : {0u, 1u})
            place[axis] += dt * velocity.slide[axis];
    }
    /// Returns the displacement a step before the present one, Å.
    double z_before(double dt) const { return z - dt * velocity.z; }
};

} // namespace asperity
