// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The drive: motion of the rigid top plane over the substrate (docs/explanation/model.md), segment
// after segment of the path.
//
// An approach moves down at constant velocity until the total normal force on the lowest layer has
// been attractive and has returned to the prescribed load (zero); a pull-off moves up until the
// force vanishes; a load moves up or down until the force is there; a height, a hold and a slide
// end at rest. Velocities change along smooth ramps: a sudden change by dv would send a plane
// stress wave rho c dv (0.6 GPa for 2 x 5 m/s) through the block, which acts on the interface as a
// load.
//
// A slide moves the substrate under the block by the negative of its distance: this changes nothing
// else in the frame of the block and of the damping medium that moves with it.
#pragma once

#include "engine/dynamics/top.hpp"
#include "engine/options/drive_options.hpp"
#include "engine/options/segment_rule.hpp"
#include "engine/units.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace asperity {

/// Returns true if a pull-off has come to its end: the top plane is back where the approach started
/// or beyond (top, Å), and the force is no larger than at_start, or small beside the strongest
/// attraction so far (eV/Å). The force alone is not enough: it passes through zero on the way out
/// of compression.
bool beyond_range(double top, double force, double strongest, double at_start = 0.0);

/// Velocity over time: from one value to another along half a cosine, and, from the time `cruise`,
/// to rest along another.
struct VelocityProfile {
    double from = 0.0, to = 0.0;    ///< Å/fs
    double cruise = units::forever; ///< time at which the second ramp begins, fs

    /// Returns the velocity at time t after the beginning of the profile, Å/fs.
    double at(double t, double ramp) const;
    /// Returns the time of rest, fs.
    double end(double ramp) const;
    /// Returns the profile from a velocity (Å/fs) to rest at a distance (Å), at most at `velocity`
    /// (above 0).
    static VelocityProfile over(double distance, double from, double velocity, double ramp);

    template <class Visitor>
    void visit(Visitor& v) {
        v("from", from);
        v("to", to);
        v("cruise", cruise);
    }
};

/// A force averaged over thermal noise: exponentially, twice, so that a steady change of the force
/// does not lag behind.
struct AveragedForce {
    double once = 0.0, twice = 0.0, square = 0.0; ///< eV/Å, eV/Å, (eV/Å)^2
    double last = 0.0;                            ///< time of the last step, fs

    /// Takes the force of a step into the average.
    void look(double force, double time, double over);
    /// Returns the mean force, eV/Å.
    double mean() const { return 2.0 * once - twice; }
    /// Returns the root mean square of the force about its mean, eV/Å.
    double scatter() const { return std::sqrt(square); }

    template <class Visitor>
    void visit(Visitor& v) {
        v("once", once);
        v("twice", twice);
        v("square", square);
        v("last", last);
    }
};

/// The machine, which is rigid: it moves the top plane along the segments of a path.
class Drive {
public:
    explicit Drive(const DriveOptions& options);
    /// Begins with the lowest layer at this height, Å, with no displacement of the top plane.
    void begin_at(double height);

    /// Returns the number of the current segment, from 0; the last one when the path is done.
    std::size_t segment() const;
    const Segment& now() const { return options_.path[segment()]; }
    bool done() const { return at_ == options_.path.size(); }
    /// Returns the motion of the top plane at time t, fs.
    TopMotion motion(double t) const;

    /// State after a step: time (fs), force on the lowest layer (eV/Å, positive upwards),
    /// displacement of the machine (Å), the result of beyond_range(), and the height of the
    /// lowest layer at zero displacement (Å).
    struct Observation {
        double time = 0.0, force = 0.0, at = 0.0;
        bool beyond_range = false;
        double reference_height = 0.0;
    };
    /// Returns the average by which segments of a warm block end; empty: the force of each step
    /// counts.
    std::optional<AveragedForce> averaged() const {
        return options_.average_over > 0.0 ? std::optional(average_) : std::nullopt;
    }
    /// Ends the current segment if this step fulfils its rule, and begins the next one. Returns
    /// true if it did. Throws io::PhysicsError if a segment demands a stronger pull than the
    /// attraction.
    bool observe(const Observation& step);

    /// Passes the state of the machine to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("segment", at_);
        v("begun", begun_);
        v("rule", rule_);
        v("average", average_);
        v("normal", normal_);
        v("slide_x", slide_[0]);
        v("slide_y", slide_[1]);
    }

private:
    void begin(const Observation& step);
    void begin_rule(double force);
    bool ended(const Observation& step);

    DriveOptions options_;
    std::size_t at_ = 0;
    double begun_ = 0.0; ///< time at which the segment began, fs
    SegmentRule rule_;   ///< rule of a segment that ends at a force
    AveragedForce average_;
    VelocityProfile normal_;
    std::array<VelocityProfile, 2> slide_;
};

} // namespace asperity
