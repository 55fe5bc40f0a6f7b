// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/time_path.hpp"

#include "engine/path/guard.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace asperity {

TimePath::TimePath(const Case& c, const Surface& surface, const Communicator& ranks)
    : Path(c, surface), simulation_(c.simulation, surface, ranks, c.grid(ranks.rank())),
      drive_(c.simulation.drive) {
    start_.height = simulation_.interface().start_height();
    if (!c.effects.temperature)
        start_ = approach_start(simulation_.block_to_write(), simulation_.interface());
    drive_.begin_at(start_.height);
    simulation_.start(start_.height, drive_.motion(0.0).z);
}

namespace {

/// Returns the wish for a step that is observed in any case.
Path::Wish observed(Path::Wish wish) {
    wish.energies = true;
    return wish;
}

} // namespace

std::optional<Path::Status> TimePath::make_next(const Wish& wish) {
    make_step(drive_.motion(simulation_.middle_of_step()), wish);
    return end_segment_if_met(now()) ? Status::at_end : Status::under_way;
}

bool TimePath::make_behind_end(const Wish& wish) {
    make_step(drive_.motion(simulation_.middle_of_step()), observed(wish));
    return true;
}

void TimePath::step(const TopMotion& motion, const Wish& wish) {
    if (status() == Status::at_end) {
        make_step(motion, observed(wish));
        come_to(Status::behind_end);
    } else {
        make_step(motion, wish);
        results_.record_force(case_.path()[segment_], now());
    }
}

void TimePath::make_step(const TopMotion& motion, const Wish& wish) {
    copy_fields(wish);
    segment_ = drive_.segment();
    const StepRecord& now = simulation_.step(motion, wish.energies);
    if (wish.velocities) {
        const VectorPlane<const double> after =
            std::as_const(simulation_).block().levels().front().v.view()[0];
        const VectorPlane<double> v = velocities_.plane(0);
        for (const auto& [to, from] :
             {std::pair{&v.x, &after.x}, {&v.y, &after.y}, {&v.z, &after.z}})
            for (int y = 0; y < to->ny; ++y)
                for (int x = 0; x < to->nx; ++x)
                    (*to)(x, y) = 0.5 * ((*to)(x, y) + (*from)(x, y));
        simulation_.set_velocities_at_step(v);
    }
    if (now.step == 0) {
        const double v = case_.simulation.drive.velocity;
        // The energy of a block that starts at full speed is that of the first step, unless noise
        // is part of it.
        const bool as_seen = drive_.motion(0.0).z != 0.0 && !case_.effects.temperature;
        kinetic_at_full_speed_ =
            as_seen ? now[Term::kinetic] : 0.5 * simulation_.moving_mass() * v * v;
        // The drive sets it in motion and brings it within the interaction range before the first
        // step.
        segment_start_ = at_rest_apart(so_far(), start_.energy, kinetic_as_top(0.0));
    }
}

/// Copies layers before a step: after it the block is at the next step, while the interface and the
/// sums are at this one.
void TimePath::copy_fields(const Wish& wish) {
    const Tile tile = grid().tile(0);
    if (wish.layer) {
        if (layer_.empty()) layer_ = VectorField<double>(tile, 1);
        copy_layer(std::as_const(simulation_).block().lowest_layer(), layer_.plane(0));
    }
    if (wish.velocities) {
        if (velocities_.empty()) velocities_ = VectorField<double>(tile, 1);
        copy_layer(std::as_const(simulation_).block().levels().front().v.view()[0],
                   velocities_.plane(0));
    }
}

/// Returns true if the segment has ended with this step.
bool TimePath::end_segment_if_met(const StepRecord& now) {
    const Segment& segment = case_.path()[drive_.segment()];
    results_.record_force(segment, now);
    // Neither the top plane nor the machine is below its start.
    const bool apart =
        are_apart(std::min(now.top, now.drive) >= 0.0, now.force, results_.strongest, start_.force);
    if (!drive_.observe(
            {now.time, now.force, now.drive, apart, simulation_.interface().reference_height()}))
        return false;
    end_ = now;
    scatter_.reset();
    if (const auto average = drive_.averaged())
        end_.force = average->mean(), scatter_ = average->scatter();
    interface_work_ = simulation_.balance().interface;
    if (segment.kind == Segment::approach) results_.contact_made = now.time;
    return true;
}

std::optional<LayerAtRest> TimePath::find_state() {
    std::optional<LayerAtRest> found = state_at(now().slide);
    if (found) results_.zero_load = found->numbers;
    return found;
}

std::optional<LayerAtRest> TimePath::state_from_here() {
    return state_at(simulation_.top().place); // the present place of the sites
}

std::optional<LayerAtRest> TimePath::state_at(const std::array<double, 2>& place) {
    LayerAtRest found = bring_to_rest(
        std::as_const(simulation_).block(), surface_, simulation_.interface().reference_height(),
        case_,
        [this](long long iteration, double residual) {
            return stopped_by_watch(iteration, residual);
        },
        place);
    if (!found.numbers) return std::nullopt;
    return found;
}

void TimePath::conclude() {
    const Segment& segment = segment_to_conclude();
    const StepRecord& now = simulation_.now();
    const double energy = now.stored();
    Works end = so_far();
    std::optional<EnergyLeft> left;
    if (segment.kind == Segment::pull_off) {
        // The path ends apart: the drive stops the block after the last step.
        const double bound = now[Term::interface], moving = kinetic_as_top(now.time);
        end.flows[Term::work_of_interface] =
            simulation_.balance().interface; // to where it is bound so much
        end = at_rest_apart(end, bound, moving);
        left = EnergyLeft{energy - bound - moving - now[Term::spring], now[Term::spring]};
    } else if (segment.kind == Segment::approach && results_.zero_load &&
               case_.simulation.drive.load_force == 0.0) {
        const double state =
            -results_.zero_load->binding_energy * case_.area() / units::milli_per_unit;
        left = EnergyLeft{energy - state - now[Term::spring], now[Term::spring]};
    }
    end_.in_contact = now.in_contact; // counted a step later, where it is observed
    ledger_.conclude(concluded(), end_, end - segment_start_, left);
    results_.segments.back().scatter = scatter_;
    segment_start_ = end;
}

/// Returns the sums of the simulation since the start of the path.
Works TimePath::so_far() const {
    const EnergyBalance& balance = simulation_.balance();
    Works works{.flows = {}, .lateral = balance.lateral};
    works.flows[Term::work] = balance.drive();
    works.flows[Term::work_of_interface] = interface_work_;
    works.flows[Term::lost] = balance.net_damped();
    return works;
}

/// Returns the works for a block that is then brought to rest and beyond the interaction range as a
/// rigid body. bound, moving: its energies, eV.
Works TimePath::at_rest_apart(Works works, double bound, double moving) {
    works.flows[Term::work] -= bound + moving;
    works.flows[Term::work_of_interface] += bound;
    return works;
}

/// Returns the kinetic energy of a block moving with the top plane at that time, eV.
double TimePath::kinetic_as_top(double time) const {
    const double part = drive_.motion(time).z / case_.simulation.drive.velocity;
    return kinetic_at_full_speed_ * part * part;
}

std::string TimePath::position() const { return fmt::format("step {}", steps()); }

Path::Remedy TimePath::remedy() const {
    const double set = case_.simulation.dt, limit = case_.longest_timestep;
    return {fmt::format("{}; drive.timestep = {:.4g} fs is stable up to {:.4g} fs in an unloaded "
                        "contact, and less where atoms are pressed into the wall or hit it fast",
                        fastest_site(simulation_), set, limit),
            fmt::format("start again with a smaller drive.timestep (for example {:.2g} fs) or "
                        "drive.velocity",
                        std::min(0.5 * set, 0.2 * limit))};
}

} // namespace asperity
