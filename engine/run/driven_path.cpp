// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/driven_path.hpp"

#include "engine/run/guard.hpp"

#include <algorithm>
#include <utility>

namespace asperity {

void DrivenPath::start() {
    start_.height = simulation_.interface().start_height();
    if (scene_.drive.temperature == 0.0)
        start_ = approach_start(simulation_.block_to_write(), simulation_.interface());
    simulation_.start(start_.height);
}

void DrivenPath::follow(const StepRecord& now) {
    if (now.step == 0) kinetic_at_start_ = now.kinetic_energy;
    if (ended_)
        concluding_ = std::exchange(ended_, std::nullopt);
    else
        ended_ = tell_drive(now);
}

/// The leg that ended with this step, if one did.
std::optional<Leg> DrivenPath::tell_drive(const StepRecord& now) {
    const Leg leg = simulation_.leg();
    double& attraction = leg == Leg::approach ? findings_.attraction_in : findings_.attraction_out;
    attraction = std::max(attraction, -now.force);
    const double strongest = std::max(findings_.attraction_in, findings_.attraction_out);
    const bool gone = out_of_reach(now.top, now.force, strongest, start_.force);
    if (!simulation_.drive().observe(now.time, now.force, gone)) return std::nullopt;
    if (leg == Leg::approach) {
        require_load_reached(simulation_.options().drive.load_force, attraction, 0.0, case_.area());
        findings_.contact_made = now.time;
    }
    return leg;
}

void DrivenPath::conclude(Leg leg) {
    concluding_.reset();
    if (leg == Leg::approach)
        conclude_approach();
    else
        conclude_pull_off();
}

// The path is taken from rest to rest, out of reach: the drive also sets the block in motion
// before the first step and stops it after the last, and brings it in and out as a rigid body
// where what binds it then is the interface's energy.

void DrivenPath::conclude_approach() {
    LegEnergies& in = findings_.approach;
    turn_ = account();
    in.interface_work = per_area_ * (simulation_.ledger().approach - start_.energy);
    in.drive_work = -per_area_ * (turn_.drive_work + start_.energy + kinetic_at_start_);
    if (reaches_the_state())
        in.lost = per_area_ * (turn_.lost + turn_.energy) + findings_.zero_load->binding_energy;
}

void DrivenPath::conclude_pull_off() {
    Findings& found = findings_;
    const double bound = simulation_.now().interface_energy;
    const Account end = account();
    found.pull_off.interface_work = -per_area_ * (simulation_.ledger().pull_off + bound);
    found.pull_off.drive_work =
        per_area_ * (end.drive_work - turn_.drive_work - bound - kinetic_at_start_);
    if (scene_.drive.temperature > 0.0) return; // heat goes both ways
    found.lost_in_cycle = per_area_ * (end.lost + end.energy - bound - kinetic_at_start_);
    if (reaches_the_state()) found.pull_off.lost = *found.lost_in_cycle - *found.approach.lost;
}

/// The approach ends, but for vibrations, in the state at zero load.
bool DrivenPath::reaches_the_state() const {
    return findings_.zero_load && scene_.drive.temperature == 0.0 && scene_.drive.load == 0.0;
}

DrivenPath::Account DrivenPath::account() const {
    const StepRecord& now = simulation_.now();
    const Ledger& ledger = simulation_.ledger();
    return {ledger.top_work + ledger.drag_work, ledger.lost(),
            now.interface_energy + now.elastic_energy + now.kinetic_energy};
}

} // namespace asperity
