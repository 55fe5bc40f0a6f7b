// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/simulation.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/device/device_block.hpp"
#include "kernels/elastic_level.hpp"

#include <array>

namespace asperity {

Simulation::Simulation(const SimulationOptions& options, const Surface& substrate,
                       const Communicator& communicator, const ProcessGrid& grid)
    : options_(options), block_(options.block, communicator, grid),
      interface_(substrate, grid.tile(0), options.block.spacing, options.interface),
      top_(options.block, block_.mass(), options.damping) {
    if (options.temperature > 0.0)
        thermostat_.emplace(options.temperature, options.damping, options.seed);
    if (options.device) device_ = std::make_unique<DeviceBlock>(options.device, block_, interface_);
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::start(double height, double velocity) {
    interface_.set_reference_height(height);
    top_.start(velocity);
    step_ = 0;
    record_ = {};
    ledger_ = {};
    block_.set_uniform(0.0, velocity);
    host_is_newer_ = true;
    device_is_newer_ = false;
}

void Simulation::set_top(double z) {
    top_.z = top_.drive = z;
    block_to_write().set_top(z);
}

// A step, and what must be current when:
//   interpolate   constrained planes of u(n), from coarse planes with current halos
//   interface     forces of the substrate at u(n)          -> transferred of level 0
//   observe       energies of u(n), if this step is observed
//   advance       all forces at u(n), level by level; v(n-1/2) -> v(n+1/2); u(n) -> u(n+1)
//   thermostat    noise on v(n+1/2) and u(n+1), if the scene has a temperature
//   exchange      halos of u(n+1)
//   sums          what the ranks summed at n, added up; work and dissipation integrated
// The top plane moves to n+1 at the end of advance (Top::move()).
const StepRecord& Simulation::step(const TopMotion& motion, bool observe) {
    top_.machine = motion;
    if (device_) {
        phases_.during(Phase::device, [&] { step_on_device(observe); });
        enter_in_ledger();
    } else {
        step_on_processor(observe);
        phases_.during(Phase::sums, [&] { enter_in_ledger(); });
    }
    ++step_;
    return record_;
}

void Simulation::step_on_processor(bool observe) {
    if (block_.has_constrained_planes())
        phases_.during(Phase::interpolate, [&] { block_.interpolate(); });
    phases_.during(Phase::interface, [&] { sweep_interface(observe); });
    phases_.during(Phase::observe, [&] { collect(observe); });
    phases_.during(Phase::advance, [&] { advance_block(observe); });
    if (thermostat_) phases_.during(Phase::thermostat, [&] { add_noise(); });
    if (external_ && external_->act()) external_->measure_power_after_kick(block_);
    phases_.during(Phase::exchange, [&] { block_.exchange(); });
}

/// Makes the same step on a device; kernels/device/device.hpp lists its launches.
void Simulation::step_on_device(bool observe) {
    if (host_is_newer_) device_->upload(block_);
    host_is_newer_ = false;
    device_is_newer_ = true;
    const DeviceSums sums = device_->step(
        block_, interface_.reference_height(),
        {options_.dt, options_.damping, options_.damping_from, top_.machine.z, observe},
        thermostat_ ? std::optional(noise(step_)) : std::nullopt);
    sums_ = {.interface = sums.interface,
             .kick = sums.kick,
             .noise = sums.noise,
             .top_force = sums.top_force,
             .lowest_z = sums.lowest_z,
             .elastic = sums.elastic,
             .top = {},
             .lateral = {}};
    move_top();
    block_.note_top(top_.z);
    begin_record(observe);
}

/// Copies all fields of the host's block: displacements, velocities, halos, prescribed planes.
void Simulation::download() const {
    device_->download(block_);
    block_.set_top(top_.z);
    if (block_.has_constrained_planes()) block_.interpolate();
    device_is_newer_ = false;
}

void Simulation::sweep_interface(bool observe) {
    if (slides()) interface_.slide_to(top_.place[0], top_.place[1]);
    sums_.interface =
        interface_.sweep(block_.lowest_layer(), block_.interface_force(), {.observe = observe});
    if (slides()) {
        const VectorPlane<double> f = block_.interface_force();
        sums_.lateral = {};
        elastic_kernels().sum(f.x, 0, f.x.ny, sums_.lateral[0]);
        elastic_kernels().sum(f.y, 0, f.y.ny, sums_.lateral[1]);
    }
    // The sums are those of the substrate.
    if (external_ && external_->act()) external_->add_to(block_);
}

void Simulation::add_noise() {
    sums_.noise = thermostat_->kick(block_, noise(step_), options_.damping_from);
    sums_.kick.kinetic.merge(sums_.noise.kinetic); // one sum, as on a device
}

/// Returns the noise of a step over which the medium moves with the machine.
ThermalNoise Simulation::noise(long long step) const {
    return thermostat_->noise(options_.dt, step, top_.machine.z);
}

void Simulation::set_velocities_at_step(const VectorPlane<double>& v) const {
    if (thermostat_)
        thermostat_->set_velocities_at_step(block_, noise(record_.step), options_.damping_from, v);
}

void Simulation::advance_block(bool observe) {
    if (thermostat_) thermostat_->keep_velocities(block_, options_.damping_from);
    sums_.kick = {};
    block_.advance({options_.dt, options_.damping, options_.damping_from, top_.machine.z, observe},
                   sums_.kick);
    sums_.top_force = {};
    block_.add_top_force(sums_.top_force);
    move_top();
    block_.set_top(top_.z);
}

void Simulation::move_top() {
    sums_.top = top_.move(options_.dt, [&] { return global_sum(communicator(), sums_.top_force); });
}

/// Sums over u(n), before it moves on.
void Simulation::collect(bool observe) {
    sums_.lowest_z = {};
    sums_.elastic = {};
    block_.add_lowest_z(sums_.lowest_z);
    if (observe) block_.add_elastic_energy(sums_.elastic);
    begin_record(observe);
}

void Simulation::begin_record(bool observe) {
    record_.observed = observe;
    record_.step = step_;
    record_.time = time();
}

/// Adds up the sums of all ranks and enters the step in the ledger.
void Simulation::enter_in_ledger() {
    // One reduction a step (and one for the counts of an observed one).
    const auto sums = global_sums(
        communicator(),
        std::array{sums_.interface.force_z, sums_.lowest_z, sums_.top_force, sums_.kick.dissipated,
                   sums_.kick.dragged, sums_.noise.heat, sums_.interface.energy, sums_.elastic,
                   sums_.kick.kinetic, sums_.kick.of_step});
    const auto [force, lowest, top_force, dissipated, dragged, heat, interface_energy, elastic,
                kinetic, of_step] = sums;
    const double sites = static_cast<double>(options_.block.sites);
    StepTotals now{{.top = top_.z_before(options_.dt),
                    .drive = top_.drive_before(options_.dt),
                    .mean_height = interface_.reference_height() + lowest / (sites * sites),
                    .force = force,
                    .top_force = top_force},
                   {},
                   top_.machine_force_before(options_.dt, top_force),
                   dissipated + sums_.top.dissipated,
                   top_.machine.z * (dragged + sums_.top.dragged),
                   heat};
    now[Term::interface] = interface_energy;
    now[Term::elastic] = elastic;
    now[Term::kinetic] = kinetic;
    now[Term::time_step] = thermostat_ ? of_step : 0.0;
    top_.add_energies(options_.dt, sums_.top, now);
    if (slides()) {
        now.slide = interface_.place();
        now.lateral_force = global_sums(communicator(), sums_.lateral);
    }
    if (external_ && external_->work())
        now.external = external_->work_of_step(communicator(), options_.dt);
    if (record_.observed)
        static_cast<ContactCount&>(record_) = count_contacts(sums_.interface, communicator());
    ledger_.enter(now, record_);
}

} // namespace asperity
