// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A dynamic path as its scene's drive takes it: where it starts, what the drive is told after each
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
#include "engine/run/ledger.hpp"
#include "engine/setup/case.hpp"

#include <optional>

namespace asperity {

class DrivenPath {
public:
    /// All are used where they are. results: attractions, the end of the approach and the works of
    /// segments are noted there.
    DrivenPath(const Case& c, Simulation& simulation, PathResults& results)
        : case_(c), simulation_(simulation), results_(results), ledger_(c, results) {}

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
    /// Its works and losses.
    void conclude(std::size_t segment);

    /// For checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("ended", ended_);
        v("concluding", concluding_);
        v("start", start_);
        v("kinetic_at_full_speed", kinetic_at_full_speed_);
        v("segment_start", segment_start_);
        v("work_of_interface", interface_work_);
        v("ledger", ledger_);
    }

private:
    /// Since the start of the path, eV: what the simulation has summed up.
    struct Account {
        double on_solids = 0.0; ///< by the top plane and the damping medium, which move alike
        double lateral = 0.0;   ///< of this, sideways
        double lost = 0.0;      ///< net damped
        double interface = 0.0; ///< int F dz of the mean height

        template <class Visitor>
        void visit(Visitor& v) {
            v("on_solids", on_solids);
            v("lateral", lateral);
            v("lost", lost);
            v("interface", interface);
        }
    };
    std::optional<std::size_t> tell_drive(const StepRecord& now);
    Account account() const;
    /// The same, if the block were brought to rest and beyond the interaction range from there as a
    /// rigid body: bound, moving: its energies, eV.
    static Account at_rest_apart(Account account, double bound, double moving);
    double kinetic_as_top(double time) const;

    const Case& case_;
    const Scene& scene_ = case_.scene;
    Simulation& simulation_;
    PathResults& results_;
    Ledger ledger_;
    ApproachStart start_;
    double kinetic_at_full_speed_ = 0.0;    ///< of the whole block at the drive's velocity, eV
    Account segment_start_;                 ///< where the segment under way began
    double interface_work_ = 0.0;           ///< int F dz to where the last segment ended, eV
    std::optional<std::size_t> ended_;      ///< the segment that the last step ended
    std::optional<std::size_t> concluding_; ///< the segment that ended the step before
};

} // namespace asperity
