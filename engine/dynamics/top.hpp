// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Position and motion of the rigid top plane of the block. The machine (drive.hpp), or the caller
// of Simulation::step(), moves the plane itself, or the far end of a spring that pulls a plane with
// a mass. The damping medium of the block moves with the machine.
#pragma once

#include <array>
#include <cstddef>

namespace asperity {

/// Velocity of the machine over a time step, Å/fs.
struct TopMotion {
    double z = 0.0;                ///< component away from the substrate
    std::array<double, 2> slide{}; ///< components along x and y
};

/// The spring between the machine and the top plane, and the mass of the plane.
struct TopSpring {
    double stiffness = 0.0; ///< eV/Å^2; 0: the machine moves the plane itself
    double mass = 0.0;      ///< eV fs^2/Å^2
    double damping = 0.0;   ///< rate of the drag against the medium, 1/fs
    explicit operator bool() const { return stiffness > 0.0; }
};

/// Energies of a top plane on a spring in a step: kinetic and dissipated, eV, and momentum
/// exchanged with the medium (dragged), eV fs/Å.
struct TopEnergies {
    double kinetic = 0.0, dissipated = 0.0, dragged = 0.0;
};

/// The top plane. At time step n its velocities are those between n and n + 1.
struct Top {
    double z = 0.0;     ///< displacement along z, Å
    double drive = 0.0; ///< displacement of the machine along z, Å; equal to z without a spring
    std::array<double, 2> place{}; ///< place of the block over the substrate, Å
    double velocity = 0.0;         ///< velocity along z, Å/fs
    TopMotion machine{};           ///< velocity of the machine

    /// Moves the plane with the machine over a step of dt, fs.
    void move(double dt) {
        velocity = machine.z;
        advance(dt);
    }
    /// Moves the plane over a step of dt, fs, under the spring, the force of the block on the plane
    /// (eV/Å) and the drag. Returns the plane's energies with the mean of its old and new velocity.
    TopEnergies move(double dt, const TopSpring& spring, double force) {
        const double before = velocity, damped = spring.damping * dt, g = 0.5 * damped;
        const double pull = spring.stiffness * (drive - z) + force;
        velocity = ((1.0 - g) * before + dt / spring.mass * pull + 2.0 * g * machine.z) / (1.0 + g);
        advance(dt);
        const double mean = 0.5 * (before + velocity), slip = mean - machine.z;
        const double drag = spring.mass * damped;
        return {0.5 * spring.mass * mean * mean, drag * slip * slip, drag * slip};
    }
    /// Returns the displacement of the plane a step before the present one, Å.
    double z_before(double dt) const { return z - dt * velocity; }
    /// Returns the displacement of the machine a step before the present one, Å.
    double drive_before(double dt) const { return drive - dt * machine.z; }

private:
    void advance(double dt) {
        z += dt * velocity;
        drive += dt * machine.z;
        for (std::size_t axis : {0u, 1u})
            place[axis] += dt * machine.slide[axis];
    }
};

} // namespace asperity
