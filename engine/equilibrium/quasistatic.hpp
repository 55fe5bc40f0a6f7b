// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A quasi-static path: equilibria at one prescribed position of the top plane after another, each
// relaxed from the last, so that hysteresis is kept.
//
// Or the mean height of the lowest layer is prescribed, as by a machine that is hard whatever the
// thickness of the block: the top plane follows, the block is not stretched as a whole, and the
// force that it takes is the interface's, F. A block that would be unstable as a whole on its own
// spring is stable then; only patches of the surface can still be unstable. Below, "top" is then
// that mean height, as a displacement.
//
// A slide changes the place of the block over the substrate, at the same height of what is held.
// Then the force below is that of the substrate along the slide, and "top" is that place.
//
// Between two points, the work of the top plane -int F dz_top is the change of the energy
// U_LJ + U_el, unless the block became unstable in between and went over to another state: the
// energy that is missing then was dissipated. From the last point a step is tried and
//
//   accepted  if nothing is missing;
//   accepted, and what is missing counted as dissipated, if the work is known to be right: the
//             force is smooth, or its jump times the step is too small to matter;
//   halved    otherwise, and tried again from the last point. Where that was and the force there
//             are kept: they tell how close the last point has to come.
//
// So an instability ends up between two points so close that its place and its energy are known.
// Beyond it only one point of the new branch is known, and a step may hide the next instability:
// the force may come back to where it was, and the error of the integral may be what was lost. So
// forces are compared with the slope of the branch before, and a step is halved where that is
// missed by too much. As long as a place further on is kept, steps go half of the way to it. A
// relaxation whose force jumps further than a step of its length may have it is given up on its way
// through the instability: its step would, with few exceptions, be halved anyway.
// "Nothing" is drive.tolerance for each site and Å of the step: errors of the energy are then
// bounded by that on the whole path. To be that good, points are relaxed to a quarter of it. The
// tolerance follows the force that presses, where that is larger than the scale of forces.
// decide() (step_decision.hpp) says which of the three it is.
#pragma once

#include "engine/equilibrium/dissipation.hpp"
#include "engine/equilibrium/last_point.hpp"
#include "engine/equilibrium/step_decision.hpp"
#include "engine/setup/case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace asperity {

struct PathOptions {
    Constraint::Of along = Constraint::Of::top; ///< or mean_height
    double step = 0.25;                         ///< the largest of what is led, Å
    double tolerance = 0.0;                     ///< where little force is there, eV/Å
    Scales scales;
    double load = 0.0;             ///< at which the approach ends, eV/Å
    double reference_height = 0.0; ///< z of the undisplaced lowest layer, Å
    double velocity = 0.0;         ///< of what is led, where the block relaxes in time, Å/fs
    double depth = HUGE_VAL;       ///< energy that flat surfaces of this area bind with, eV
    /// Called during relaxations with their iteration and residual. True: stop.
    std::function<bool(long long, double)> report;
};

/// As a case has them, over its interface; report: as above.
PathOptions path_options(const Case& c, const Interface& interface,
                         std::function<bool(long long, double)> report = {});

class QuasistaticPath {
public:
    QuasistaticPath(SpectralBlock& block, Interface& interface, PathOptions options);

    /// The undisplaced block, beyond the interaction range.
    void start();
    /// The block as it is. from_apart: works are counted from the solids at rest apart, so that the
    /// first point has the energy of this state; otherwise from here. remembers: branches keep
    /// their extensions; otherwise the block has relaxed.
    struct Here {
        bool from_apart = false, remembers = false;
    };
    void start_here(Here here);

    /// A segment of the path, and its number for what is recorded; amounts in the engine's units (a
    /// load in eV/Å).
    void begin(const Segment& segment, std::size_t number = 0);
    /// A segment to a displacement of what is held, Å; exactly there.
    void begin_to(double at);
    enum class Outcome { point, at_load, apart, there, interrupted };
    /// The next point of the segment. at_load: an approach or a load has come to its load (the path
    /// stands there exactly); apart: nothing is left of the force on a pull-off, and the block is
    /// at rest; there: a height or a slide has come to its end, exactly. Where a relaxation was
    /// interrupted, block and path are back at the last point, and the next call makes the whole
    /// point again. Collective. Throws io::PhysicsError where no equilibrium is found, and where
    /// the solids part on the way to a pull.
    Outcome advance();

    /// The last point. On quasi-static paths: step counts points, damped is what was dissipated.
    const StepRecord& now() const { return record_; }
    /// Work that was done on the block in the segment under way, eV. At a held mean height it is
    /// minus that of the interface's force, for the mean height does not jump.
    double work() const { return course_.work; }
    /// What this, and what was dissipated in the segment, may be wrong by, eV: the sum of the gaps
    /// in the energy balance of its steps and of their errors in time, and three times the root of
    /// the sum of squares of what the work of each step with an instability is not known by.
    /// (Three, for these errors are not independent: measured in docs/explanation/relaxation.md.)
    double uncertainty() const { return course_.gap + 3.0 * std::sqrt(course_.squares); }
    /// What a block that relaxes has dissipated in the segment under way, beside the dissipation at
    /// instabilities, eV.
    double relaxed() const { return course_.relaxed; }
    /// Returns the change of the energy of interface and block, branches included, in the segment
    /// under way, eV: work() less this and what was dissipated is 0 to within uncertainty().
    double stored() const { return record_.energy() - course_.stored_at_start; }
    const Dissipation& dissipation() const { return dissipation_; }
    /// What the force of the last point may be wrong by, eV/Å.
    double slack() const { return slack(record_.in_contact); }
    long long iterations() const { return last_.iterations(); }
    /// Puts the block back to the last point, from wherever it was taken.
    void put_back() { last_.put_back(); }

    /// For checkpoints: all numbers of the path, and the displacements at its last point. A path
    /// that has read both and is resumed makes the same points, bit for bit, as one that never
    /// stopped.
    template <class Visitor>
    void visit(Visitor& v);
    std::vector<StateArray> states() { return last_.states(); }
    void resume();

private:
    using Along = LastPoint::Along;
    /// Of the segment under way.
    struct Course {
        Segment::Kind kind = Segment::approach;
        std::size_t number = 0;       ///< in the path
        Along along = Along::z;       ///< what it leads
        double direction = -1.0;      ///< of that; 0: the segment ends where it began
        std::optional<double> end;    ///< where it ends, Å; none: at a load, or apart
        std::optional<double> load;   ///< eV/Å; none: an approach's, or apart
        SegmentRule rule;             ///< of one that a force ends
        bool bracketed = false;       ///< the load at which the segment ends
        bool comes_to_rest = false;   ///< the next point is that of the block at rest, apart
        double work = 0.0;            ///< of the top plane, eV
        double relaxed = 0.0;         ///< dissipated by the block, eV
        double stored_at_start = 0.0; ///< energy of interface and block, eV
        double gap = 0.0;             ///< the sum of those of its steps, with errors in time, eV
        double squares = 0.0;         ///< of what the works of its steps are not known by, eV^2
        template <class Visitor>
        void visit(Visitor& v) {
            v("kind", kind);
            v("number", number);
            v("along", along);
            v("direction", direction);
            v("end", end);
            v("load", load);
            v("rule", rule);
            v("bracketed", bracketed);
            v("comes_to_rest", comes_to_rest);
            v("work", work);
            v("relaxed", relaxed);
            v("stored_at_start", stored_at_start);
            v("gap", gap);
            v("squares", squares);
        }
    };
    double at() const { return last_.at(); }
    double force() const;
    double time_of(double step) const;
    bool is_short_in_time(double step) const;
    std::size_t axis() const { return static_cast<std::size_t>(course_.along); }
    /// What the block dissipates in time is a part of the energy that a step takes up.
    PathPoint point() const {
        return {at(), force(), record_.interface_energy + record_.elastic_energy + record_.relaxed};
    }
    /// An equilibrium with what is led there.
    PathPoint point(const RelaxedState& state, double at) const;
    std::array<double, 2> lateral_force() const;
    void begin(Along along, double direction);
    Outcome outcome();
    Outcome come_to_rest();
    [[noreturn]] void refuse_place(const RelaxedState& state, double at) const;
    double slack(std::int64_t in_contact) const;
    double load() const { return course_.load.value_or(options_.load); }
    /// The segment under way ends at a load.
    bool to_load() const { return !course_.end && course_.kind != Segment::pull_off; }
    bool passes_load(const RelaxedState& state, double aim) const;
    bool bisect();
    bool work_is_known(double at, double force) const;
    ForceWindow acceptable_force(double at) const;
    void accept(const RelaxedState& state, double at, const StepDecision& step);
    Instability describe(const RelaxedState& state, double energy) const;
    void set_record(const RelaxedState& state, double at);
    void first_point(double top, Here here);
    double longest_step() const;
    double smallest_step() const;
    /// Returns the tolerance under a force that presses, eV/Å: a fraction of the scale of forces
    /// (setup/scales.cpp), or of a site's part of this force, if that is larger.
    double tolerance_under(double force) const {
        return options_.tolerance * std::max(1.0, force / (sites_ * options_.scales.force));
    }
    double tolerance_to(double at) const;
    double allowed_missing(double way, double tolerance) const;
    /// Returns the same of a step in which a block that relaxes may go on without the drive, eV.
    /// Collective.
    double allowed_missing_in_time(double way, double tolerance) const;
    /// Sets the displacements to change their course in time: the next step continues none, and is
    /// short.
    void turn();
    /// Returns the uncertainty that the work of a step with an instability may have, eV.
    double allowed_uncertainty(double tolerance) const {
        return allowed_missing(options_.step, tolerance);
    }

    SpectralBlock& block_;
    Interface& interface_;
    PathOptions options_;
    double sites_ = 0.0; ///< N^2

    LastPoint last_;
    StepRecord record_; ///< of the last point
    ForceTrail trail_;
    Course course_;
    double length_ = 0.0; ///< of the next step, Å
    /// The far end of an interval that is bisected. Between the last point and it the block becomes
    /// unstable, or the force is not smooth enough to tell.
    std::optional<ForceAt> bracket_;
    Dissipation dissipation_;
    double strongest_ = 0.0;       ///< attraction so far, eV/Å
    double energy_at_start_ = 0.0; ///< of where works are counted from, eV
    double scale_ = 0.0;           ///< largest energy seen, for the residual, eV
    double way_ = 0.0;             ///< so far, in and out, Å
};

template <class Visitor>
void QuasistaticPath::visit(Visitor& v) {
    v("record", record_);
    v("last", last_);
    v("trail", trail_);
    v("course", course_);
    v("length", length_);
    v("bracket", bracket_);
    v("dissipation", dissipation_);
    v("strongest", strongest_);
    v("energy_at_start", energy_at_start_);
    v("scale", scale_);
    v("way", way_);
}

} // namespace asperity
