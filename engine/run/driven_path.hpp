// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A path in time as its scene's drive takes it: where it starts, what the drive is told after each
// step, and the works of a leg that has ended. It steps nothing and writes nothing: a run does that
// (dynamic_run.cpp), or a program with a loop of its own (library/asperity.hpp).
//
//     path.start();
//     while (!path.over()) {
//         const StepRecord& now = simulation.step(... || path.must_observe());
//         ... violation(), records ...
//         path.follow(now);
//         if (const auto leg = path.to_conclude()) path.conclude(*leg);
//     }
#pragma once

#include "engine/dynamics/approach_start.hpp"
#include "engine/dynamics/simulation.hpp"
#include "engine/equilibrium/findings.hpp"
#include "engine/setup/case.hpp"
#include "engine/units.hpp"

#include <optional>

namespace asperity {

class DrivenPath {
public:
    /// All are used where they are. findings: attractions, the end of the approach and the works of
    /// legs are noted there.
    DrivenPath(const Case& c, Simulation& simulation, Findings& findings)
        : case_(c), simulation_(simulation), findings_(findings) {}

    /// The undeformed block where the path starts. A warm block starts where nothing is in reach:
    /// the way down is what warms it. Collective.
    void start();
    /// No step is left to be made.
    bool over() const { return !ended_ && !concluding_ && simulation_.drive().done(); }
    /// The step after a leg is to be observed, so that a guard has seen the energy balance before
    /// anything is concluded.
    bool must_observe() const { return ended_.has_value(); }
    /// Tells the drive what this step felt. Throws io::PhysicsError where an approach that was to
    /// end under a pull ended without.
    void follow(const StepRecord& now);
    /// The leg that ended the step before, if one did: before the next step it is concluded.
    const std::optional<Leg>& to_conclude() const { return concluding_; }
    /// Its works, and what was lost where the state at zero load is among the findings.
    void conclude(Leg leg);

    /// For checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("ended", ended_);
        v("concluding", concluding_);
        v("start", start_);
        v("kinetic_at_start", kinetic_at_start_);
        v("turn", turn_);
    }

private:
    /// At an observed step, eV.
    struct Account {
        double drive_work = 0.0; ///< of the top plane and the damping medium, which move alike
        double lost = 0.0;       ///< damped, or taken by absorbing seams
        double energy = 0.0;     ///< kinetic, elastic and of the interface

        template <class Visitor>
        void visit(Visitor& v) {
            v("drive_work", drive_work);
            v("lost", lost);
            v("energy", energy);
        }
    };
    std::optional<Leg> tell_drive(const StepRecord& now);
    void conclude_approach();
    void conclude_pull_off();
    bool reaches_the_state() const;
    Account account() const;

    const Case& case_;
    const Scene& scene_ = case_.scene;
    Simulation& simulation_;
    Findings& findings_;
    const double per_area_ = units::milli_per_unit / (case_.area());
    ApproachStart start_;
    double kinetic_at_start_ = 0.0; ///< of the block moving with the drive, eV
    Account turn_;                  ///< where the approach ended
    std::optional<Leg> ended_;      ///< the leg that the last step ended
    std::optional<Leg> concluding_; ///< the leg that ended the step before
};

} // namespace asperity
