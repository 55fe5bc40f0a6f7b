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
// So an instability ends up between two points so close that its place and its energy are known,
// while many small instabilities that leave the force smooth are counted without looking for each.
// As long as a place further on is kept, steps go half of the way to it. A relaxation whose force
// jumps further than a step of its length may have it is given up on its way
// through the instability: its step would, with few exceptions, be halved anyway.
// "Nothing" is drive.tolerance for each site and Å of the step: errors of the energy are then
// bounded by that on the whole path. To be that good, points are relaxed to a quarter of it.
//
// Where the last steps were reversible, the next one starts from their linear continuation
// (continuation.hpp). That is given up as soon as Newton's method does not help; over a wall none
// is taken. What is not accepted after a prediction, or would be counted as dissipated, is computed
// again without.
#pragma once

#include "engine/dynamics/simulation.hpp"
#include "engine/equilibrium/continuation.hpp"
#include "engine/equilibrium/dissipation.hpp"
#include "engine/equilibrium/force_trail.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace asperity {

/// step: the largest; load: at which the approach ends.
struct PathOptions : SequenceOptions {
    Constraint::Of along = Constraint::Of::top; ///< or mean_height
    double depth = HUGE_VAL; ///< energy that flat surfaces of this area bind with, eV
};

/// As a case has them, over its interface.
PathOptions path_options(const Case& c, const Interface& interface,
                         std::function<bool(long long, double)> report = {});

class QuasistaticPath {
public:
    QuasistaticPath(SpectralBlock& block, Interface& interface, PathOptions options);

    /// The undisplaced block, where nothing is in reach.
    void start();
    /// The block as it is. apart: works are counted from the solids at rest apart, so that the
    /// first point has the energy of this state; otherwise from here.
    void start_here(bool apart = false);

    /// A segment of the path, and its number for what is recorded; amounts in the engine's units (a
    /// load in eV/Å).
    void begin(const Segment& segment, std::size_t number = 0);
    /// A segment to a displacement of what is held, Å; exactly there.
    void begin_to(double at);
    enum class Outcome { point, at_load, apart, there, interrupted };
    /// The next point of the segment. at_load: an approach or a load has come to its load (the path
    /// stands there exactly); apart: nothing is left of the force on a pull-off; there: a height or
    /// a slide has come to its end, exactly. Where a relaxation was interrupted, block and path are
    /// back at the last point, and the next call makes the whole point again. Collective. Throws
    /// io::PhysicsError where no equilibrium is found, and where the solids part on the way to a
    /// pull.
    Outcome advance();

    /// The last point. Without time: step counts points, damped is what was dissipated.
    const StepRecord& now() const { return record_; }
    /// Work that was done on the block in the segment under way, eV. At a held mean height it is
    /// minus that of the interface's force, for the mean height does not jump.
    double work() const { return work_; }
    /// What this, and what was dissipated in the segment, may be wrong by, eV: the sum of the gaps
    /// in the energy balance of its steps, and three times the root of the sum of squares of what
    /// the work of each step with an instability is not known by. (Three, for these errors are not
    /// independent: measured in docs/explanation/relaxation.md.)
    double uncertainty() const { return error_.gap + 3.0 * std::sqrt(error_.squares); }
    const Dissipation& dissipation() const { return dissipation_; }
    /// What the force of the last point may be wrong by, eV/Å.
    double slack() const { return slack(record_.in_contact); }
    long long iterations() const { return points_.iterations(); }
    /// Puts the block back to the last point, from wherever it was taken.
    void put_back() { points_.put_back(); }

    /// For checkpoints: all numbers of the path, and the displacements at its last two points. A
    /// path that has read both and is resumed makes the same points, bit for bit, as one that never
    /// stopped.
    template <class Visitor>
    void visit(Visitor& v);
    std::vector<StateArray> states() { return points_.states(); }
    void resume();

private:
    struct StepCheck {
        bool accepted = false;
        double work = 0.0;       ///< of the top plane in this step, eV
        double dissipated = 0.0; ///< eV
        double gap = 0.0;        ///< work less energy gained and dissipated, eV
        double uncertain = 0.0;  ///< of the work, where energy is missing, eV
        bool smooth = true;      ///< the force did not jump
        bool excess = false;     ///< more energy gained than the work can have brought
        double margin = 0.0;     ///< allowed error over the one found: how much the step may grow
    };
    struct SegmentError {
        double gap = 0.0, squares = 0.0; ///< eV, eV^2
    };
    /// The far end of an interval that is bisected, and the force there. Between the last point and
    /// it the block becomes unstable, or the force is not smooth enough to tell.
    struct Bracket {
        bool known = false;
        double at = 0.0, force = 0.0;
    };
    using Along = Continuation::Along;
    /// Equilibrium at a place of what is led, and the force that leading it there takes, eV/Å.
    struct Trial {
        const RelaxedState& state;
        double at, force;
    };
    double at() const { return along_ == Along::z ? record_.top : record_.slide[axis()]; }
    double force() const {
        return along_ == Along::z ? record_.top_force : record_.lateral_force[axis()];
    }
    std::size_t axis() const { return static_cast<std::size_t>(along_); }
    std::array<double, 2> lateral_force() const;
    void begin(Along along, double direction);
    Outcome outcome();
    [[noreturn]] void refuse_pull(double load) const;
    StepCheck check(const Trial& to) const;
    double slack(std::int64_t in_contact) const;
    /// The segment under way ends at a load.
    bool to_load() const { return !end_ && kind_ != Segment::pull_off; }
    bool passes_load(const RelaxedState& state, double aim) const;
    bool bisect();
    bool work_is_known(double at, double force) const;
    ForceWindow acceptable_force(double at) const;
    void accept(const Trial& to, const StepCheck& step);
    Instability describe(const RelaxedState& state, double energy) const;
    void set_record(const RelaxedState& state, double at);
    void first_point(double top, bool apart);
    double smallest_step() const { return options_.step * 0x1p-16; }
    /// Of the work of a step with an instability, eV.
    double allowed_uncertainty() const { return options_.tolerance * sites_ * options_.step; }

    SpectralBlock& block_;
    Interface& interface_;
    PathOptions options_;
    double sites_ = 0.0; ///< N^2
    Continuation points_;

    StepRecord record_;
    bool reversible_ = false; ///< the last step was: good for a prediction
    bool predicts_ = false;   ///< the next relaxation starts from a prediction
    bool bracketed_ = false;  ///< the load at which the segment ends
    double length_ = 0.0;     ///< of the next step, Å
    Bracket bracket_;
    Segment::Kind kind_ = Segment::approach; ///< of the segment under way
    std::size_t segment_ = 0;                ///< its number
    Along along_ = Along::z;                 ///< what it leads
    double direction_ = 0.0;                 ///< of that; 0: the segment ends where it began
    std::optional<double> end_, load_; ///< where it ends, Å or eV/Å; none: an approach's, or apart
    ForceTrail trail_;
    bool attracted_ = false;
    double strongest_ = 0.0; ///< attraction so far, eV/Å
    double work_ = 0.0;      ///< of the segment, eV
    SegmentError error_;
    double energy_at_start_ = 0.0; ///< of where works are counted from, eV
    double scale_ = 0.0;           ///< largest energy seen, for the residual, eV
    double way_ = 0.0;             ///< so far, in and out, Å
    Dissipation dissipation_;
};

template <class Visitor>
void QuasistaticPath::visit(Visitor& v) {
    v("point", record_.step);
    v("top", record_.top);
    v("mean_height", record_.mean_height);
    v("force", record_.force);
    v("top_force", record_.top_force);
    v("interface_energy", record_.interface_energy);
    v("elastic_energy", record_.elastic_energy);
    v("in_contact", record_.in_contact);
    v("repulsive", record_.repulsive);
    v("closest", record_.closest);
    v("work", record_.work);
    v("dissipated", record_.damped);
    v("residual", record_.residual);
    v("points", points_);
    v("reversible", reversible_);
    v("predicts", predicts_);
    v("bracketed", bracketed_);
    v("length", length_);
    v("bracket.known", bracket_.known);
    v("bracket.top", bracket_.at);
    v("bracket.force", bracket_.force);
    v("kind", kind_);
    v("segment", segment_);
    v("along", along_);
    v("direction", direction_);
    v("end", end_);
    v("load", load_);
    v("slide", record_.slide);
    v("lateral_force", record_.lateral_force);
    v("trail", trail_);
    v("attracted", attracted_);
    v("strongest", strongest_);
    v("work_of_segment", work_);
    v("gap", error_.gap);
    v("squares", error_.squares);
    v("energy_at_start", energy_at_start_);
    v("scale", scale_);
    v("way", way_);
    v("dissipation", dissipation_);
}

} // namespace asperity
