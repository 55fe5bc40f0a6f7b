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
        // The drive sets it in motion and brings it within reach before the first step.
        segment_start_ = at_rest_apart({}, start_.energy, kinetic_as_top(0.0));
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
    const StepRecord& now = simulation_.now();
    const double energy = now.interface_energy + now.elastic_energy + now.kinetic_energy;
    Account end = account();
    std::optional<double> kinetic;
    if (segment.kind == Segment::pull_off) {
        // It ends apart: the drive stops the block after the last step.
        const double bound = now.interface_energy, moving = kinetic_as_top(now.time);
        end.interface = simulation_.balance().interface; // to where it is bound so much
        end = at_rest_apart(end, bound, moving);
        kinetic = energy - bound - moving;
    } else if (segment.kind == Segment::approach && results_.zero_load &&
               scene_.drive.load == 0.0) {
        kinetic =
            energy + results_.zero_load->binding_energy * case_.area() / units::milli_per_unit;
    }
    ledger_.conclude(number, now,
                     {.on_solids = end.on_solids - segment_start_.on_solids,
                      .lateral = end.lateral - segment_start_.lateral,
                      .lost = end.lost - segment_start_.lost,
                      .interface = end.interface - segment_start_.interface,
                      .uncertainty = {}},
                     kinetic);
    segment_start_ = end;
}

DrivenPath::Account DrivenPath::account() const {
    const EnergyBalance& balance = simulation_.balance();
    return {balance.drive(), balance.lateral, balance.net_damped(), interface_work_};
}

DrivenPath::Account DrivenPath::at_rest_apart(Account account, double bound, double moving) {
    account.on_solids -= bound + moving;
    account.interface += bound;
    return account;
}

/// Of the block moving as the top plane does at that time, eV.
double DrivenPath::kinetic_as_top(double time) const {
    const double part = simulation_.drive().velocity(time) / case_.simulation.drive.velocity;
    return kinetic_at_full_speed_ * part * part;
}

} // namespace asperity
