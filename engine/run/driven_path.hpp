// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A path in time as its scene's drive takes it: where it starts, what the drive is told after each
// step, and the works of a segment that has ended. It steps nothing and writes nothing: a run does
// that (dynamic_run.cpp), or a script with a loop of its own (time_path.hpp).
//
//     path.start();
//     while (!path.over()) {
//         const StepRecord& now = simulation.step(... || path.must_observe());
//         ... violation(), records ...
//         path.follow(now);
//         if (const auto segment = path.to_conclude()) path.conclude(*segment);
//     }
#pragma once

#include "engine/dynamics/approach_start.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/equilibrium/path_results.hpp"
#include "engine/setup/case.hpp"
#include "engine/units.hpp"

#include <optional>

namespace asperity {

class DrivenPath {
public:
    /// All are used where they are. results: attractions, the end of the approach and the works of
    /// segments are noted there.
    DrivenPath(const Case& c, Simulation& simulation, PathResults& results)
        : case_(c), simulation_(simulation), results_(results) {}

    /// The undeformed block where the path starts. A warm block starts where nothing is in reach:
    /// the way down is what warms it. Collective.
    void start();
    /// No step is left to be made.
    bool over() const { return !ended_ && !concluding_ && simulation_.drive().done(); }
    /// The step after a segment is to be observed, so that a guard has seen the energy balance
    /// before anything is concluded.
    bool must_observe() const { return ended_.has_value(); }
    /// Tells the drive what this step felt. Throws io::PhysicsError where an approach or a load
    /// that was to end under a pull ended without.
    void follow(const StepRecord& now);
    /// The segment that ended the step before, if one did: before the next step it is concluded.
    const std::optional<std::size_t>& to_conclude() const { return concluding_; }
    /// Its works, and what was lost where the state at zero load is among the results.
    void conclude(std::size_t segment);

    /// For checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("ended", ended_);
        v("concluding", concluding_);
        v("start", start_);
        v("kinetic_at_full_speed", kinetic_at_full_speed_);
        v("apart", apart_);
        v("segment_start", segment_start_);
        v("interface_work", interface_work_);
    }

private:
    /// At an observed step, eV.
    struct Account {
        double drive_work = 0.0;     ///< of the top plane and the damping medium, which move alike
        double lost = 0.0;           ///< damped
        double energy = 0.0;         ///< kinetic, elastic and of the interface
        double bound = 0.0;          ///< of the interface alone
        double interface_work = 0.0; ///< int F dz of the mean height
        double moving = 0.0;         ///< kinetic energy of the block moving as the top plane does
        double lateral_work = 0.0;   ///< of what moves the block sideways

        template <class Visitor>
        void visit(Visitor& v) {
            v("drive_work", drive_work);
            v("lost", lost);
            v("energy", energy);
            v("bound", bound);
            v("interface_work", interface_work);
            v("moving", moving);
            v("lateral_work", lateral_work);
        }
    };
    std::optional<std::size_t> tell_drive(const StepRecord& now);
    void conclude_approach(const Account& now);
    void conclude_pull_off(const Account& now, std::size_t number);
    double lost_since_apart(const Account& now) const;
    bool reaches_the_state() const;
    Account account() const;
    double kinetic_as_top(double time) const;

    const Case& case_;
    const Scene& scene_ = case_.scene;
    Simulation& simulation_;
    PathResults& results_;
    const double per_area_ = units::milli_per_unit / (case_.area());
    ApproachStart start_;
    double kinetic_at_full_speed_ = 0.0;    ///< of the whole block at the drive's velocity, eV
    Account apart_;                         ///< where the solids were last out of reach
    Account segment_start_;                 ///< where the segment under way began
    double interface_work_ = 0.0;           ///< int F dz to where the last segment ended, eV
    std::optional<std::size_t> ended_;      ///< the segment that the last step ended
    std::optional<std::size_t> concluding_; ///< the segment that ended the step before
};

} // namespace asperity
