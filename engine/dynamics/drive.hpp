// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The drive: motion of the rigid top plane over the substrate (docs/explanation/model.md), segment
// after segment of the path.
//
// An approach moves down at constant velocity until the total normal force on the lowest layer has
// been attractive and has returned to the prescribed load (zero); a pull-off moves up until the
// force vanishes; a load moves up or down until the force is the load; a height, a hold and a slide
// end at rest. Velocities change along smooth ramps: a sudden change by dv would send a plane
// stress wave rho c dv (0.6 GPa for 2 x 5 m/s) through the block, which acts on the interface as a
// load.
//
// A slide moves the substrate under the block by the negative of its distance. The block and the
// damping medium, which moves with the block, are unaffected in their own frame.
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

/// Velocity as a function of time: a ramp along half a cosine from one velocity to another and,
/// from the time `cruise`, a ramp to rest.
struct VelocityProfile {
    double from = 0.0, to = 0.0;    ///< Å/fs
    double cruise = units::forever; ///< time at which the second ramp begins, fs

    /// Returns the velocity at time t after the beginning of the profile, Å/fs. ramp: duration of a
    /// ramp, fs.
    double at(double t, double ramp) const;
    /// Returns the time at which the second ramp ends, fs.
    double end(double ramp) const;
    /// Returns the profile that starts with the velocity `from` and comes to rest at a distance
    /// (Å), with a speed of at most `velocity` (Å/fs, above 0).
    static VelocityProfile over(double distance, double from, double velocity, double ramp);

    template <class Visitor>
    void visit(Visitor& v) {
        v("from", from);
        v("to", to);
        v("cruise", cruise);
    }
};

/// A force averaged over thermal noise by double exponential smoothing, so that the average of a
/// steadily changing force does not lag behind.
struct AveragedForce {
    /// Single and double exponential means, eV/Å, and mean square of the deviation, (eV/Å)^2.
    double once = 0.0, twice = 0.0, square = 0.0;
    double last = 0.0; ///< time of the last step, fs

    /// Adds the force of a step to the average. time, over: time of the step and averaging time,
    /// fs.
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
    /// Copies the options; begin_at() must follow.
    explicit Drive(const DriveOptions& options);
    /// Begins the first segment with an undisplaced top plane. height: height of the lowest layer,
    /// Å.
    void begin_at(double height);

    /// Returns the index of the current segment; that of the last segment once the path is done.
    std::size_t segment() const;
    /// Returns the current segment.
    const Segment& now() const { return options_.path[segment()]; }
    /// Returns true once all segments have ended.
    bool done() const { return at_ == options_.path.size(); }
    /// Returns the velocity of the machine at time t, fs.
    TopMotion motion(double t) const;

    /// State after a step: time (fs), force on the lowest layer (eV/Å, positive upwards),
    /// displacement `at` of the machine (Å), the result of are_apart(), and the height of the
    /// lowest layer at zero displacement (Å).
    struct Observation {
        double time = 0.0, force = 0.0, at = 0.0;
        bool apart = false;
        double reference_height = 0.0;
    };
    /// Returns the averaged force that ends the segments of a warm block; empty if the force of
    /// each step is used.
    std::optional<AveragedForce> averaged() const {
        return options_.average_over > 0.0 ? std::optional(average_) : std::nullopt;
    }
    /// Ends the current segment if the step fulfils the rule of its end, and begins the next one.
    /// Returns true if the segment has ended. Throws io::PhysicsError if a segment demands more
    /// tension than the pull-off force.
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
