// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What moves the rigid top plane (docs/explanation/model.md).
//
// It moves down at constant velocity until the total normal force on the lowest layer has been
// attractive and has returned to the prescribed load (zero), then reverses and moves up until the
// force vanishes. The reversal is a smooth ramp: a sudden change of velocity by dv would send a
// plane stress wave rho c dv (0.6 GPa for 2 x 5 m/s) through the block, which acts on the interface
// as a load.
#pragma once

#include <optional>
#include <string_view>

namespace asperity {

enum class Leg { approach, pull_off, done };
std::string_view name(Leg leg);

struct DriveOptions {
    double velocity = 5e-5;  ///< Å/fs
    double ramp = 0.0;       ///< time over which the velocity turns, fs
    double load_force = 0.0; ///< total normal force at which the approach ends, eV/Å
    bool approach = true;
    bool pull_off = true;
};

/// Whether a pull-off has come to its end: the top plane is back where the approach started or
/// beyond (top, Å), and the force is no larger than it was there, or small beside the strongest
/// attraction met (eV/Å). The force alone is not enough: it passes through zero on the way out of
/// compression.
bool out_of_reach(double top, double force, double strongest, double at_start = 0.0);

class Drive {
public:
    explicit Drive(const DriveOptions& options);

    Leg leg() const { return leg_; }
    bool done() const { return leg_ == Leg::done && !by_hand_; }
    /// Velocity of the top plane along z at time t, Å/fs.
    double velocity(double t) const;

    /// Told of the force on the lowest layer at time t (eV/Å, positive upwards). True at the
    /// step at which a leg ends. gone: out_of_reach() at this step.
    bool observe(double t, double force, bool gone);

    /// By hand: from now on the top plane moves at this velocity, Å/fs, and no leg ends; none: the
    /// drive goes on where it was. Not in checkpoints.
    void take_over(std::optional<double> velocity) { by_hand_ = velocity; }
    const std::optional<double>& by_hand() const { return by_hand_; }

    /// The state of the machine, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("leg", leg_);
        v("turned_at", turned_at_);
        v("attracted", attracted_);
    }

private:
    DriveOptions options_;
    Leg leg_;
    double turned_at_ = 0.0;
    bool attracted_ = false;
    std::optional<double> by_hand_;
};

} // namespace asperity
