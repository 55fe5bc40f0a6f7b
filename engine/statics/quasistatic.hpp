// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A quasi-static path: a sequence of equilibria at prescribed positions of the top plane, each
// relaxed from the one before, so that hysteresis is reproduced.
//
// Alternatively the mean height of the lowest layer is prescribed, as by a machine that is hard for
// a block of any thickness: the top plane follows, the block is not stretched as a whole, and the
// force of the constraint is the interface's, F. A block that would be unstable as a whole on its
// own spring is then stable; only patches of the surface can be unstable. "Top" then means this
// mean height, as a displacement.
//
// A slide changes the place of the block over the substrate at a fixed top or mean height, or under
// a load, whose potential is then a part of the energy. The force is that of the substrate along
// the slide, and "top" means the place. Over a wall the map of heights moves under the block, and
// the force is that of the pressure on the slopes, sum F dh/dx. A slide until steady of a
// viscoelastic block begins in the shape of the steadily sliding block, as far as the iteration of
// moving_pattern.hpp finds this shape: sliding until slow branches are steady would take many
// lengths of the map.
//
// Between two points, the work of the top plane -int F dz_top is the change of the energy U_LJ +
// U_el, unless the block became unstable in between and changed to another state: the missing
// energy was then dissipated. A step from the last point is tried and
//
//   accepted  if hardly any energy is missing;
//   accepted, as an instability, if the work is known well enough: the force is smooth, or its jump
//             times the step is too small to matter;
//   halved    otherwise, and tried again from the last point. The place and force of the failed try
//             are kept: they bound the distance to the instability.
//
// An instability thus ends up between two points so close that its place and its energy are known.
// Beyond the instability only one point of the new branch is known, and a step may hide the next
// instability: the force may return to its former value, and the error of the integral may equal
// the lost energy. Forces are therefore compared with the slope of the branch before, and a step is
// halved if the force misses this slope by too much. This does not find all instabilities
// (docs/explanation/relaxation.md). As long as the place of a failed try is kept, steps go half of
// the way to that place. A relaxation whose force jumps by more than its step allows is abandoned:
// with few exceptions the step would be halved anyway. Steps are accepted in which up to
// drive.tolerance per site and Å of the step is missing. The missing energy is an error of the
// work, which has either sign, or the loss of patches that are small beside the box. All of it
// counts as lost, so that the energy lost does not depend on the size of the box; energy that is
// gained without work is taken from the losses that follow, so that the energy lost never falls.
// Points are relaxed to a quarter of the tolerance. The tolerance grows with a pressing force that
// exceeds the scale of forces, and with the load to which a segment leads without attraction.
// decide() (step_decision.hpp) chooses between accepting and halving.
//
// An elastic block over a wall that only repels has a convex energy, and one state at each
// position: nothing is dissipated, and the work of a step is the energy gained, however long it is.
// (The force has a kink wherever a site touches; integrated, it would take steps of a few
// hundredths of an angstrom.)
#pragma once

#include "engine/options/segment_rule.hpp"
#include "engine/statics/dissipation.hpp"
#include "engine/statics/last_point.hpp"
#include "engine/statics/load_aim.hpp"
#include "engine/statics/path_options.hpp"
#include "engine/statics/step_decision.hpp"
#include "engine/statics/work_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace asperity {

/// Gives a block the memories of the sites of its interface, such as the set of a surface that
/// yields (plastic_set.hpp). Keeps references to both.
void remember_sites(SpectralBlock& block, Interface& interface);

/// A quasi-static path of a block over an interface.
class QuasistaticPath {
public:
    /// Keeps references to block and interface. start(), start_here() or restored() must follow.
    QuasistaticPath(SpectralBlock& block, Interface& interface, PathOptions options);

    /// Starts from the undisplaced block beyond the interaction range. Collective.
    void start();
    /// A start from the present state of the block. from_apart: works count from the solids at rest
    /// apart, otherwise from the present state. remembers: the branches keep their extensions;
    /// otherwise the block has relaxed.
    struct StartOptions {
        bool from_apart = false, remembers = false;
    };
    /// Starts from the present state of the block. Collective.
    void start_here(StartOptions options);

    /// Begins a segment. number: index in the path, for records of instabilities.
    void begin(const Segment& segment, std::size_t number = 0);
    /// Begins a segment that ends exactly at a displacement of the held coordinate, Å.
    void begin_to(double at);
    /// Outcome of advance(): a point within the segment; a point that ends the segment at a load,
    /// apart, or at its end coordinate; or no point, because the relaxation was interrupted.
    enum class Outcome { point, at_load, apart, there, interrupted };
    /// Makes the next point of the segment. Returns at_load if an approach or a load has reached
    /// its load; apart if no force is left on a pull-off and the block is at rest; there if a
    /// height or a slide has reached its end. After an interrupted relaxation, block and path are
    /// restored to the last point, and the next call repeats the point. Collective. Throws
    /// io::PhysicsError if no equilibrium is found, or if the solids separate before a tensile load
    /// is reached.
    Outcome advance();

    /// Returns the record of the last point: `step` is the number of the point, Term::lost the
    /// energy lost at instabilities.
    const StepRecord& now() const { return record_; }
    /// Returns the work done on the block and the losses in the current segment, eV. At a
    /// prescribed mean height the work is minus that of the interface's force, because the mean
    /// height does not jump. Work minus stored() minus all losses is zero within uncertainty().
    const Energies& in_segment() const { return segment_.flows; }
    double work() const { return segment_.flows[Term::work]; }
    /// Returns the distance from the beginning of the current segment, Å.
    double way() const { return std::abs(at() - segment_.from); }
    /// Returns the part of work() that moves the block sideways, eV.
    double lateral_work() const { return segment_.lateral; }
    /// Returns the work of the forces in the current segment less work(), eV: the difference of two
    /// ways to the work of a viscoelastic block, of second and fourth order in the steps.
    double work_left_out() const { return segment_.work_left_out; }
    /// Returns the part of work() that brought the block into the shape in which it slides
    /// steadily, before the first step of a slide, eV.
    double settling_work() const { return segment_.settling; }
    /// Returns the uncertainty of work() and of the energy dissipated in the segment, eV
    /// (work_errors.hpp; docs/explanation/relaxation.md states how often the true error is within
    /// it).
    double uncertainty() const { return segment_.errors.total(); }
    /// Returns the change of the energy of interface and block, branches included, in the current
    /// segment, eV.
    double stored() const { return record_.stored() - segment_.start.stored(); }
    const Dissipation& dissipation() const { return dissipation_; }
    /// Returns the uncertainty of the force of the last point, eV/Å.
    double slack() const { return slack(record_.in_contact); }
    long long iterations() const { return last_.iterations(); }
    /// Restores the block to the last point.
    void put_back() { last_.put_back(); }

    /// Passes all numbers of the path to a visitor, for checkpoints. A path that has read numbers
    /// and arrays and is resumed makes points bitwise identical to those of a path that never
    /// stopped.
    template <class Visitor>
    void visit(Visitor& v);
    // Numbers and arrays of the path, as those of Path.
    void collect(auto& numbers) const { numbers.members_of(*this); }
    void restore(auto& numbers) { visit(numbers); }
    std::vector<StateArray> arrays() const { return last_.arrays(); }
    std::vector<RestoredArray> arrays_to_restore() { return last_.arrays_to_restore(); }
    /// Restores the block to the last point after numbers and arrays have been read. Collective.
    void restored();

private:
    using Along = LastPoint::Along;
    /// Numbers of the segment under way.
    struct SegmentState {
        Segment::Kind kind = Segment::approach;
        std::size_t number = 0;     ///< number in the path
        Along along = Along::z;     ///< coordinate that the segment leads
        double direction = -1.0;    ///< sign of the motion; 0: none
        std::optional<double> end;  ///< end, Å; none: at a load, or apart
        std::optional<double> load; ///< load at its end, eV/Å; none: drive.load, or apart
        SegmentRule rule;           ///< rule of a segment that a force ends
        LoadAim aim;                ///< search for a load
        bool comes_to_rest = false; ///< the next point is that of the block at rest, apart
        bool settles = false;       ///< the next point is that of a block that slides steadily
        std::int64_t crept = 0;     ///< consecutive points at the smallest step
        double from = 0.0;          ///< beginning, Å
        std::optional<double> held; ///< load of a slide under load, eV/Å
        Energies start;             ///< energies at the beginning, eV
        Energies flows;             ///< work of the top plane and losses since then, eV
        double lateral = 0.0;       ///< part of the work that moves the block sideways, eV
        double settling = 0.0;      ///< work that brought the block into its steady shape, eV
        /// Work of the forces less that of the energies in steps whose work is that of the
        /// energies, eV.
        double work_left_out = 0.0;
        WorkErrors errors; ///< uncertainty of work and losses
        template <class Visitor>
        void visit(Visitor& v) {
            v("kind", kind);
            v("number", number);
            v("along", along);
            v("direction", direction);
            v("end", end);
            v("load", load);
            v("rule", rule);
            v("aim", aim);
            v("comes_to_rest", comes_to_rest);
            v("settles", settles);
            v("crept", crept);
            v("from", from);
            v("held", held);
            v("start", start);
            v("flows", flows);
            v("lateral", lateral);
            v("settling", settling);
            v("work_left_out", work_left_out);
            v("errors", errors);
        }
    };
    /// A step that is tried.
    struct Try {
        double there = 0.0, way = 0.0; ///< Å
        double length = 0.0;           ///< length before the segment's end cuts it, Å
        bool arrives = false;          ///< the step leads to the end of the segment
        bool all_the_way = false;      ///< the step leads to the far end of the bracket
        bool last = false;             ///< no shorter step is tried
        double tolerance = 0.0;        ///< eV/Å
    };
    Try plan();
    double at() const { return last_.at(); }
    double force() const;
    double time_of(double step) const;
    bool is_short_in_time(double step) const;
    std::size_t axis() const { return static_cast<std::size_t>(segment_.along); }
    /// Returns the last point. Its energy includes the energy that memories have dissipated.
    PathPoint point() const {
        return {at(), force(),
                record_.stored() + record_.dissipated() +
                    segment_.held.value_or(0.0) * record_.top};
    }
    /// Returns the coordinate on which a load acts, Å: the displacement of the top plane, or the
    /// mean height of the lowest layer.
    double lifted(const RelaxedState& state) const {
        return options_.along == Constraint::Of::top ? state.top : state.mean_height;
    }
    /// Returns the point of an equilibrium at this value of the prescribed coordinate.
    PathPoint point(const RelaxedState& state, double at) const;
    std::array<double, 2> lateral_force() const;
    void begin(Along along, double direction);
    void hold_load(std::optional<double> load);
    Outcome outcome();
    Outcome come_to_rest();
    Outcome settle();
    void refuse_to_creep(double way);
    /// Throws io::PhysicsError if the mean pressure of a state is the hardness.
    void refuse_whole_yield(const RelaxedState& state, double at) const;
    [[noreturn]] void refuse_place(const RelaxedState& state, double at) const;
    double slack(std::int64_t in_contact) const;
    double load() const { return segment_.load.value_or(options_.load); }
    /// Returns true if the segment under way ends at a load.
    bool to_load() const { return !segment_.end && segment_.kind != Segment::pull_off; }
    bool passes_load(const RelaxedState& state) const;
    bool bisect();
    StepDecision judge(const RelaxedState& state, const Try& t) const;
    bool work_is_known(double at, double force) const;
    ForceWindow acceptable_force(double at) const;
    void accept(const RelaxedState& state, double at, const StepDecision& step);
    double error_of_place() const;
    Instability describe(const RelaxedState& state, double energy) const;
    void set_record(const RelaxedState& state, double at);
    void first_point(double top, StartOptions options);
    double usual_step() const;
    double longest_step() const;
    double smallest_step() const;
    /// Returns the tolerance under a force that presses, eV/Å: a fraction of the scale of forces
    /// (case/scales.cpp) or, if larger, of the force per site. Without attraction, only sites in
    /// contact bear the force.
    double tolerance_under(double force) const {
        const double count = options_.reversible()
                                 ? std::max(1.0, static_cast<double>(record_.in_contact))
                                 : box_sites_;
        return options_.tolerance * std::max(1.0, force / (count * options_.scales.force));
    }
    double tolerance_at(double force) const;
    double tolerance_to(double at) const;
    double energy_error() const;
    double allowed_missing(double way, double tolerance) const;
    /// Returns allowed_missing() for a step in which a viscoelastic block may also relax by itself,
    /// eV. Collective.
    double allowed_missing_in_time(double way, double tolerance) const;
    /// Notes that the displacements change direction: the next time step continues none, and is
    /// short.
    void turn();
    /// Returns the largest uncertainty allowed for the work of a step with an instability, eV.
    double allowed_uncertainty(double tolerance) const {
        return allowed_missing(usual_step(), tolerance);
    }

    SpectralBlock& block_;
    Interface& interface_;
    PathOptions options_;
    double sites_ = 0.0;     ///< number of sites of the block
    double box_sites_ = 0.0; ///< N^2, those above the substrate

    LastPoint last_;
    StepRecord record_; ///< record of the last point
    ForceTrail trail_;
    SegmentState segment_;
    double length_ = 0.0; ///< length of the next step, Å
    /// Far end of an interval that is bisected: between the last point and this place the block
    /// becomes unstable, or the force is not smooth enough to exclude an instability.
    std::optional<ForceAt> bracket_;
    Dissipation dissipation_;
    double strongest_ = 0.0; ///< strongest attraction so far, eV/Å
    Balance balance_;
    double owed_ = 0.0; ///< energy gained without work, below zero, eV: the next losses pay it
    double way_ = 0.0;  ///< length of the path so far, Å
};

template <class Visitor>
void QuasistaticPath::visit(Visitor& v) {
    v("record", record_);
    v("last", last_);
    v("trail", trail_);
    v("course", segment_); // the name in checkpoints
    v("length", length_);
    v("bracket", bracket_);
    v("dissipation", dissipation_);
    v("strongest", strongest_);
    v("balance", balance_);
    v("owed", owed_);
    v("way", way_);
}

} // namespace asperity
