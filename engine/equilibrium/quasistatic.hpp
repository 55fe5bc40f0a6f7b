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

#include "engine/dynamics/drive.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/equilibrium/continuation.hpp"
#include "engine/equilibrium/dissipation.hpp"
#include "engine/equilibrium/force_trail.hpp"

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
    /// The block as it is.
    void start_here();

    enum class Outcome { point, at_load, apart, there, interrupted };
    /// The next point of a leg. at_load: the approach has come to its load (the path stands there
    /// exactly); apart: nothing is left of the force on the pull-off. Where a relaxation was
    /// interrupted, block and path are back at the last point, and the next call makes the whole
    /// point again. Collective. Throws io::PhysicsError where
    /// no equilibrium is found.
    Outcome advance(Leg leg) { return advance(leg, {}); }
    /// Another end than the leg's own: a place of what is held (Å, in the leg's direction), where
    /// the path stands exactly and is `there`; or a load (eV/Å), at which it is at_load on both
    /// ways.
    struct Goal {
        std::optional<double> at{}, load{};
    };
    Outcome advance(Leg leg, const Goal& goal);

    /// The last point. Without time: step counts points, damped is what was dissipated.
    const StepRecord& now() const { return record_; }
    /// Work of what is held over the last leg of this kind, eV: what it took up on the approach,
    /// what it gave on the pull-off; positive where the solids attract. At a held mean height it is
    /// that of the interface's force, for the mean height does not jump.
    double work(Leg leg) const { return leg == Leg::approach ? approach_ : pull_off_; }
    /// What this, and what was dissipated on the leg, may be wrong by, eV: the sum of the gaps in
    /// the energy balance of its steps, and three times the root of the sum of squares of what the
    /// work of each step with an instability is not known by. (Three, for these errors are not
    /// independent: measured in docs/explanation/relaxation.md.)
    double uncertainty(Leg leg) const {
        const LegError& e = error(leg);
        return e.gap + 3.0 * std::sqrt(e.squares);
    }
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
    struct LegError {
        double gap = 0.0, squares = 0.0; ///< eV, eV^2
    };
    /// A place further on, and the force there, by which steps close in on it. Between the last
    /// point and it the block becomes unstable, or the force is not smooth enough to tell.
    struct Ahead {
        bool known = false;
        double top = 0.0, force = 0.0;
    };
    const LegError& error(Leg leg) const {
        return leg == Leg::approach ? approach_error_ : pull_off_error_;
    }
    StepCheck check(const RelaxedState& state, double top) const;
    double slack(std::int64_t in_contact) const;
    bool passes_load(Leg leg, const RelaxedState& state, double aim) const;
    bool close_in();
    bool work_is_known(double top, double force) const;
    ForceWindow acceptable_force(double top) const;
    void accept(const RelaxedState& state, double top, const StepCheck& step, Leg leg);
    Instability describe(const RelaxedState& state, double energy, Leg leg) const;
    void set_record(const RelaxedState& state, double top);
    void first_point(double top);
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
    bool closing_in_ = false; ///< on the load at which the approach ends
    double length_ = 0.0;     ///< of the next step, Å
    Ahead ahead_;
    double direction_ = 0.0; ///< of the last step
    ForceTrail trail_;
    bool attracted_ = false;
    double strongest_ = 0.0; ///< attraction so far, eV/Å
    double approach_ = 0.0, pull_off_ = 0.0;
    LegError approach_error_, pull_off_error_;
    double energy_at_start_ = 0.0;
    double scale_ = 0.0;   ///< largest energy seen, for the residual, eV
    double allowed_ = 0.0; ///< what the steps so far may have missed, eV
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
    v("pushed", record_.repulsive);
    v("closest", record_.closest);
    v("work", record_.work);
    v("dissipated", record_.damped);
    v("residual", record_.residual);
    v("points", points_);
    v("reversible", reversible_);
    v("predicts", predicts_);
    v("closing_in", closing_in_);
    v("length", length_);
    v("ahead.known", ahead_.known);
    v("ahead.top", ahead_.top);
    v("ahead.force", ahead_.force);
    v("direction", direction_);
    v("trail", trail_);
    v("attracted", attracted_);
    v("strongest", strongest_);
    v("approach_work", approach_);
    v("pull_off_work", pull_off_);
    v("approach_gap", approach_error_.gap);
    v("approach_squares", approach_error_.squares);
    v("pull_off_gap", pull_off_error_.gap);
    v("pull_off_squares", pull_off_error_.squares);
    v("energy_at_start", energy_at_start_);
    v("scale", scale_);
    v("allowed", allowed_);
    v("dissipation", dissipation_);
}

} // namespace asperity
