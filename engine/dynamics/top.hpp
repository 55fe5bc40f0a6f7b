// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Position and motion of the rigid top plane of the block. The machine (drive.hpp), or the caller
// of Simulation::step(), moves the plane itself, or the far end of a spring that pulls a plane with
// a mass. The damping medium of the block moves with the machine.
#pragma once

#include "engine/options/block_options.hpp"
#include "engine/step_record.hpp"

#include <array>
#include <cstddef>

namespace asperity {

/// Velocity of the machine over a time step, Å/fs.
struct TopMotion {
    double z = 0.0;                ///< component away from the substrate
    std::array<double, 2> slide{}; ///< components along x and y
};

/// Energies of a top plane with a mass in a step: kinetic and dissipated, eV, and momentum
/// exchanged with the medium (dragged), eV fs/Å.
struct TopEnergies {
    double kinetic = 0.0, dissipated = 0.0, dragged = 0.0;
};

/// The top plane. At time step n its velocities are those between n and n + 1.
class Top {
public:
    /// Makes the plane of a block. mass: mass of the block's nodes, eV fs^2/Å^2; damping: rate of
    /// the drag against the medium, 1/fs.
    Top(const BlockOptions& block, double mass, double damping) : damping_(damping) {
        if (!block.top_spring) return;
        spring_ = block.top_spring;
        if (!(spring_.mass > 0.0)) spring_.mass = mass;
    }

    double z = 0.0;     ///< displacement along z, Å
    double drive = 0.0; ///< displacement of the machine along z, Å; equal to z without a spring
    std::array<double, 2> place{}; ///< place of the block over the substrate, Å
    double velocity = 0.0;         ///< velocity along z, Å/fs
    TopMotion machine{};           ///< velocity of the machine

    /// Puts the plane and the machine at zero displacement, the plane with this velocity along z,
    /// Å/fs.
    void start(double at_velocity) {
        z = drive = 0.0;
        place = {};
        velocity = at_velocity;
        machine = {};
    }
    /// Moves the plane over a step of dt, fs: with the machine, or under the spring, the force of
    /// the block on the plane and the drag. force(): returns the force, eV/Å; called with a spring
    /// only. Returns the plane's energies with the mean of its old and new velocity.
    template <class Force>
    TopEnergies move(double dt, const Force& force) {
        const double before = velocity;
        if (!spring_) {
            velocity = machine.z;
            advance(dt);
            return {};
        }
        const double damped = damping_ * dt, g = 0.5 * damped;
        const double pull = spring_.stiffness * (drive - z) + force();
        velocity =
            ((1.0 - g) * before + dt / spring_.mass * pull + 2.0 * g * machine.z) / (1.0 + g);
        advance(dt);
        const double mean = 0.5 * (before + velocity), slip = mean - machine.z;
        const double drag = spring_.mass * damped;
        return {0.5 * spring_.mass * mean * mean, drag * slip * slip, drag * slip};
    }
    /// Returns the mass of the plane, eV fs^2/Å^2: 0 if the machine moves the plane itself.
    double mass() const { return spring_.mass; }

    // A step before the present one:
    /// Returns the displacement of the plane, Å.
    double z_before(double dt) const { return z - dt * velocity; }
    /// Returns the displacement of the machine, Å.
    double drive_before(double dt) const { return drive - dt * machine.z; }
    /// Returns the force on the machine along z, eV/Å. force: force of the block on the plane.
    double machine_force_before(double dt, double force) const {
        return spring_ ? -pull_before(dt) : force;
    }
    /// Adds the energies of the plane and its spring. of_plane: energies that move() has returned.
    void add_energies(double dt, const TopEnergies& of_plane, Energies& to) const {
        to[Term::kinetic] += of_plane.kinetic;
        to[Term::spring] = 0.5 * pull_before(dt) * (drive_before(dt) - z_before(dt));
        to[Term::elastic] += to[Term::spring];
    }

    /// Passes the plane to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("top", z);
        if (spring_) {
            v("machine", drive);
            v("top_velocity", velocity);
        } else if constexpr (Visitor::restores) {
            drive = z;
        }
    }

private:
    /// Returns the force of the spring on the plane a step before the present one, eV/Å.
    double pull_before(double dt) const {
        return spring_.stiffness * (drive_before(dt) - z_before(dt));
    }
    void advance(double dt) {
        z += dt * velocity;
        drive += dt * machine.z;
        for (std::size_t axis : {0u, 1u})
            place[axis] += dt * machine.slide[axis];
    }

    TopSpring spring_;
    double damping_;
};

} // namespace asperity
