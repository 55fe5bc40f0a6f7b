// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What moves the rigid top plane over the substrate (docs/explanation/model.md), segment after
// segment of the path.
//
// An approach moves down at constant velocity until the total normal force on the lowest layer has
// been attractive and has returned to the prescribed load (zero); a pull-off moves up until the
// force vanishes; a load moves up or down until the force is there; a height, a hold and a slide
// end at rest. Velocities change along smooth ramps: a sudden change by dv would send a plane
// stress wave rho c dv (0.6 GPa for 2 x 5 m/s) through the block, which acts on the interface as a
// load.
//
// A slide moves the substrate under the block by the negative of its distance: seen from the block,
// and from the damping medium that goes with it, nothing else changes.
#pragma once

#include "engine/scene/segment.hpp"
#include "engine/scene/segment_rule.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace asperity {

struct DriveOptions {
    double velocity = 5e-5;  ///< Å/fs
    double ramp = 0.0;       ///< time over which a velocity changes, fs
    double load_force = 0.0; ///< total normal force at which an approach ends, eV/Å
    double area = 1.0;       ///< of the interface, Å^2
    /// Time over which the force that ends a segment is averaged, fs; 0: the force of the step. For
    /// a warm block, whose force fluctuates.
    double average_over = 0.0;
    /// Amounts in the units of the engine: a load in eV/Å, a hold in fs.
    std::vector<Segment> path = {{Segment::approach, 0.0, 0, "approach"},
                                 {Segment::pull_off, 0.0, 0, "pull-off"}};
};

/// Whether a pull-off has come to its end: the top plane is back where the approach started or
/// beyond (top, Å), and the force is no larger than it was there, or small beside the strongest
/// attraction met (eV/Å). The force alone is not enough: it passes through zero on the way out of
/// compression.
bool beyond_range(double top, double force, double strongest, double at_start = 0.0);

/// A velocity over time: from one to another along half a cosine, and, where `cruise` ends, to rest
/// along another.
struct VelocityProfile {
    double from = 0.0, to = 0.0; ///< Å/fs
    double cruise = HUGE_VAL;    ///< when the second ramp begins, fs

    double at(double t, double ramp) const;
    /// When it is at rest, fs.
    double end(double ramp) const;
    /// From this velocity to rest at a distance, Å, at `velocity` (above 0) at most.
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

    void look(double force, double time, double over);
    double mean() const { return 2.0 * once - twice; } ///< eV/Å
    /// Root mean square of the force about its mean, eV/Å.
    double scatter() const { return std::sqrt(square); }

    template <class Visitor>
    void visit(Visitor& v) {
        v("once", once);
        v("twice", twice);
        v("square", square);
        v("last", last);
    }
};

class Drive {
public:
    explicit Drive(const DriveOptions& options);
    /// reference_height: of the lowest layer where the top plane's displacement is 0, Å.
    void begin_at(double reference_height);

    /// Number of the segment under way, from 0; of the last one when the path is done.
    std::size_t segment() const;
    const Segment& now() const { return options_.path[segment()]; }
    bool done() const { return at_ == options_.path.size() && !by_hand_; }
    /// Of the top plane along z at time t, Å/fs.
    double velocity(double t) const;
    /// Of the block over the substrate along an axis, Å/fs.
    double slide_velocity(int axis, double t) const;

    /// What a step has felt: force on the lowest layer, eV/Å, positive upwards; gone:
    /// beyond_range().
    struct Felt {
        double time = 0.0, force = 0.0, top = 0.0;
        bool gone = false;
    };
    /// The average by which segments of a warm block end; empty: the force of each step counts.
    std::optional<AveragedForce> averaged() const {
        return options_.average_over > 0.0 ? std::optional(average_) : std::nullopt;
    }
    /// True at the step at which a segment ends. Throws io::PhysicsError where a pull that a
    /// segment leads to is not there.
    bool observe(const Felt& felt);

    /// By hand: from now on the top plane moves at this velocity, Å/fs, nothing slides, and no
    /// segment ends; none: the segment goes on, and a height, a hold or a slide ends when it would
    /// have, wherever it is. Not in checkpoints.
    void take_over(std::optional<double> velocity) { by_hand_ = velocity; }
    const std::optional<double>& by_hand() const { return by_hand_; }

    /// The state of the machine, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("segment", at_);
        v("begun", begun_);
        v("rule", rule_);
        v("average", average_);
        v("normal", normal_);
        v("slide_x", slide_[0]);
        v("slide_y", slide_[1]);
        v("reference_height", reference_height_);
    }

private:
    void begin(const Felt& felt);
    void begin_rule(double force);
    bool ended(const Felt& felt);

    DriveOptions options_;
    double reference_height_ = 0.0;
    std::size_t at_ = 0;
    double begun_ = 0.0; ///< when the segment began, fs
    SegmentRule rule_;   ///< of one that a force ends
    AveragedForce average_;
    VelocityProfile normal_;
    std::array<VelocityProfile, 2> slide_;
    std::optional<double> by_hand_;
};

} // namespace asperity
