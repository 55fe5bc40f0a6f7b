// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/driven_path.hpp"

#include "engine/run/guard.hpp"

#include <utility>

namespace asperity {

void DrivenPath::start() {
    start_.height = simulation_.interface().start_height();
    if (scene_.drive.temperature == 0.0)
        start_ = approach_start(simulation_.block_to_write(), simulation_.interface());
    simulation_.start(start_.height);
}

void DrivenPath::follow(const StepRecord& now) {
    if (now.step == 0) {
        const BlockOptions& block = case_.simulation.block;
        const double v = case_.simulation.drive.velocity, sites = block.sites;
        // What the block has that starts at full speed; of one that starts at rest, by its mass.
        kinetic_at_full_speed_ =
            simulation_.drive().velocity(0.0) != 0.0
                ? now.kinetic_energy
                : 0.5 * block.atom_mass * sites * sites * block.thickness * v * v;
        const double moving = kinetic_as_top(0.0);
        apart_ =
            segment_start_ = {0.0, 0.0, start_.energy + moving, start_.energy, 0.0, moving, 0.0};
    }
    if (ended_)
        concluding_ = std::exchange(ended_, std::nullopt);
    else
        ended_ = tell_drive(now);
}

/// The segment that ended with this step, if one did.
std::optional<std::size_t> DrivenPath::tell_drive(const StepRecord& now) {
    Drive& drive = simulation_.drive();
    if (drive.done()) return std::nullopt;
    const std::size_t number = drive.segment();
    const Segment& segment = case_.path[number];
    results_.feel(segment, now);
    if (drive.by_hand()) return std::nullopt;
    const bool gone = out_of_reach(now.top, now.force, results_.strongest, start_.force);
    if (!drive.observe({now.time, now.force, now.top, gone})) return std::nullopt;
    interface_work_ = simulation_.balance().interface;
    if (segment.kind == Segment::approach) {
        require_load_reached(simulation_.options().drive.load_force, results_.attraction_in, 0.0,
                             case_.area());
        results_.contact_made = now.time;
    }
    return number;
}

void DrivenPath::conclude(std::size_t number) {
    concluding_.reset();
    const Segment& segment = case_.path[number];
    const Account now = account();
    SegmentResults ended = results_.ended(number, segment, simulation_.now(),
                                          per_area_ * (now.drive_work - segment_start_.drive_work),
                                          now.lateral_work - segment_start_.lateral_work);
    ended.interface_work = per_area_ * (now.interface_work - segment_start_.interface_work);
    ended.lost = per_area_ * (now.lost - segment_start_.lost);
    results_.segments.push_back(ended);
    if (segment.kind == Segment::approach) conclude_approach(now);
    if (segment.kind == Segment::pull_off) conclude_pull_off(now, number);
    segment_start_ = now;
    results_.begin_segment();
}

// The path is taken from rest to rest, out of reach: the drive also sets the block in motion
// before the first step and stops it after the last, and brings it in and out as a rigid body
// where what binds it then is the interface's energy.

void DrivenPath::conclude_approach(const Account& now) {
    WayEnergies& in = results_.approach;
    in.interface_work = per_area_ * (now.interface_work - apart_.interface_work - apart_.bound);
    in.drive_work =
        -per_area_ * (now.drive_work - apart_.drive_work + apart_.bound + apart_.moving);
    in.lost.reset();
    if (reaches_the_state())
        in.lost =
            per_area_ * (lost_since_apart(now) + now.energy) + results_.zero_load->binding_energy;
}

void DrivenPath::conclude_pull_off(const Account& now, std::size_t number) {
    WayEnergies& out = results_.pull_off;
    const double interface_work = simulation_.balance().interface; // to where it is bound so much
    out.interface_work = -per_area_ * (interface_work - segment_start_.interface_work + now.bound);
    out.drive_work =
        per_area_ * (now.drive_work - segment_start_.drive_work - now.bound - now.moving);
    if (scene_.drive.temperature == 0.0) { // else heat goes both ways
        results_.lost_in_cycle =
            per_area_ * (lost_since_apart(now) + now.energy - now.bound - now.moving);
        const bool straight = number > 0 && case_.path[number - 1].kind == Segment::approach;
        out.lost.reset();
        if (straight && reaches_the_state())
            out.lost = *results_.lost_in_cycle - *results_.approach.lost;
    }
    apart_ = now;
}

/// Damped since the solids were last apart, less what vibrated there, eV.
double DrivenPath::lost_since_apart(const Account& now) const {
    return now.lost - apart_.lost - (apart_.energy - apart_.bound - apart_.moving);
}

/// The approach ends, but for vibrations, in the state at zero load.
bool DrivenPath::reaches_the_state() const {
    return results_.zero_load && scene_.drive.temperature == 0.0 && scene_.drive.load == 0.0;
}

DrivenPath::Account DrivenPath::account() const {
    const StepRecord& now = simulation_.now();
    const EnergyBalance& balance = simulation_.balance();
    return {balance.top_work + balance.drag_work,
            balance.damped,
            now.interface_energy + now.elastic_energy + now.kinetic_energy,
            now.interface_energy,
            interface_work_,
            kinetic_as_top(now.time),
            balance.lateral};
}

/// Of the block moving as the top plane does at that time, eV.
double DrivenPath::kinetic_as_top(double time) const {
    const double part = simulation_.drive().velocity(time) / case_.simulation.drive.velocity;
    return kinetic_at_full_speed_ * part * part;
}

} // namespace asperity
