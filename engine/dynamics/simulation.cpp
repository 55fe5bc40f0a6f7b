// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/simulation.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/device/device_block.hpp"
#include "kernels/elastic_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace asperity {

Simulation::Simulation(const SimulationOptions& options, const Surface& substrate,
                       const Communicator& communicator, const ProcessGrid& grid)
    : options_(options), block_(options.block, communicator, grid),
      interface_(substrate, grid.tile(0), options.block.spacing, options.interface),
      drive_(options.drive) {
    if (options.temperature > 0.0)
        thermostat_.emplace(options.temperature, options.damping, options.seed);
    if (options.device) device_ = std::make_unique<DeviceBlock>(options.device, block_, interface_);
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::start(double height) {
    reference_height_ = height;
    drive_ = Drive(options_.drive);
    drive_.begin_at(height);
    step_ = 0;
    slide_ = {};
    record_ = {};
    balance_ = {};
    energy_brought_.reset();
    scale_ = 0.0;
    has_previous_ = false;
    pending_ = {};
    external_pending_ = 0.0;
    block_.set_uniform(0.0, drive_.velocity(0.0));
    host_is_newer_ = true;
    device_is_newer_ = false;
}

// A step, and what must be current when:
//   interpolate   constrained planes of u(n), from coarse planes with current halos
//   interface     forces of the substrate at u(n)          -> transferred of level 0
//   observe       energies of u(n), if this step is observed
//   advance       all forces at u(n), level by level; v(n-1/2) -> v(n+1/2); u(n) -> u(n+1)
//   thermostat    noise on v(n+1/2) and u(n+1), if the scene has a temperature
//   exchange      halos of u(n+1)
//   sums          what the ranks summed at n, added up; work and dissipation integrated
// The top plane's displacement at n is set at the end of the step before.
const StepRecord& Simulation::step(bool observe) {
    if (device_) {
        phases_.during(Phase::device, [&] { step_on_device(observe); });
        update_energy_balance();
    } else {
        step_on_processor(observe);
        phases_.during(Phase::sums, [&] { update_energy_balance(); });
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
    if (external_) external_after_ = power_of_external();
    phases_.during(Phase::exchange, [&] { block_.exchange(); });
}

/// Makes the same step on a device; kernels/device/device.hpp lists its launches.
void Simulation::step_on_device(bool observe) {
    if (host_is_newer_) device_->upload(block_);
    host_is_newer_ = false;
    device_is_newer_ = true;
    const double velocity = velocity_of_top();
    const DeviceSums sums =
        device_->step(block_, reference_height_,
                      {options_.dt, options_.damping, options_.damping_from, velocity, observe},
                      thermostat_ ? std::optional(noise()) : std::nullopt);
    block_.note_top(block_.top() + options_.dt * velocity);
    interface_sums_ = sums.interface;
    kick_sums_ = sums.kick;
    top_force_ = sums.top_force;
    lowest_z_ = sums.lowest_z;
    elastic_ = sums.elastic;
    noise_sums_ = sums.noise;
    begin_record(observe);
}

/// Copies all fields of the host's block: displacements, velocities, halos, prescribed planes.
void Simulation::download() const {
    device_->download(block_);
    block_.set_top(block_.top());
    if (block_.has_constrained_planes()) block_.interpolate();
    device_is_newer_ = false;
}

void Simulation::sweep_interface(bool observe) {
    if (slides()) interface_.slide_to(slide_[0], slide_[1]);
    interface_sums_ = interface_.sweep(block_.lowest_layer(), block_.interface_force(),
                                       reference_height_, {.observe = observe});
    if (slides()) {
        const VectorPlane<double> f = block_.interface_force();
        lateral_ = {};
        elastic_kernels().sum(f.x, 0, f.x.ny, lateral_[0]);
        elastic_kernels().sum(f.y, 0, f.y.ny, lateral_[1]);
    }
    if (external_) add_external();
}

/// Adds external forces to those of the substrate, which the sums above contain.
void Simulation::add_external() {
    const VectorPlane<double> to = block_.interface_force();
    const VectorPlane<const double> from = external_->plane(0);
    for (int y = 0; y < to.x.ny; ++y)
        for (int x = 0; x < to.x.nx; ++x) {
            to.x(x, y) += from.x(x, y);
            to.y(x, y) += from.y(x, y);
            to.z(x, y) += from.z(x, y);
        }
    external_before_ = power_of_external();
}

ExactSum Simulation::power_of_external() const {
    const VectorPlane<const double> f = external_->plane(0);
    const VectorPlane<const double> v = std::as_const(block_).levels().front().v.plane(0);
    ExactSum power;
    for (int y = 0; y < f.x.ny; ++y) {
        for (int x = 0; x < f.x.nx; ++x)
            power.add(f.x(x, y) * v.x(x, y) + f.y(x, y) * v.y(x, y) + f.z(x, y) * v.z(x, y));
        power.carry();
    }
    return power;
}

/// Integrates by a trapezium from n-1 to n, as the works above: half with the forces at each end.
void Simulation::integrate_external_work() {
    const auto [before, after] =
        global_sums(communicator(), std::array{external_before_, external_after_});
    if (has_previous_) balance_.external += 0.5 * options_.dt * (before + external_pending_);
    external_pending_ = after;
    external_before_ = external_after_ = {};
}

void Simulation::add_noise() {
    noise_sums_ = thermostat_->kick(block_, noise(), options_.damping_from);
    kick_sums_.kinetic.merge(noise_sums_.kinetic); // one sum, as on a device
}

ThermalNoise Simulation::noise() const {
    return thermostat_->noise(options_.dt, step_, velocity_of_top());
}

void Simulation::take_to_step(const VectorPlane<double>& v) const {
    if (!thermostat_) return;
    const double medium = drive_.velocity((static_cast<double>(record_.step) + 0.5) * options_.dt);
    thermostat_->take_to_step(block_, thermostat_->noise(options_.dt, record_.step, medium),
                              options_.damping_from, v);
}

/// Returns the velocity of the top plane in the middle of this step, Å/fs.
double Simulation::velocity_of_top() const {
    return drive_.velocity((static_cast<double>(step_) + 0.5) * options_.dt);
}

void Simulation::advance_block(bool observe) {
    const double velocity = velocity_of_top();
    if (thermostat_) thermostat_->keep_velocities(block_, options_.damping_from);
    kick_sums_ = {};
    block_.advance({options_.dt, options_.damping, options_.damping_from, velocity, observe},
                   kick_sums_);
    top_force_ = {};
    block_.add_top_force(top_force_);
    block_.set_top(block_.top() + options_.dt * velocity);
    if (slides()) slide();
}

/// Adds force and work of the sideways step by a trapezium, as along z, before the next step.
void Simulation::update_slide() {
    const std::array<double, 2> force = global_sums(communicator(), lateral_);
    const std::array<double, 2>& place = interface_.place();
    double work = 0.0;
    if (has_previous_)
        for (std::size_t axis : {0u, 1u})
            work -= 0.5 * (force[axis] + record_.lateral_force[axis]) *
                    (place[axis] - record_.slide[axis]);
    balance_.top_work += work;
    balance_.lateral += work;
    record_.slide = place;
    record_.lateral_force = force;
}

/// Moves the block over the substrate to its place at the next step.
void Simulation::slide() {
    const double middle = (static_cast<double>(step_) + 0.5) * options_.dt;
    for (int axis : {0, 1})
        slide_[static_cast<std::size_t>(axis)] += options_.dt * drive_.slide_velocity(axis, middle);
}

/// Sums over u(n), before it moves on.
void Simulation::collect(bool observe) {
    lowest_z_ = {};
    elastic_ = {};
    block_.add_lowest_z(lowest_z_);
    if (observe) block_.add_elastic_energy(elastic_);
    begin_record(observe);
}

void Simulation::begin_record(bool observe) {
    record_.observed = observe;
    record_.step = step_;
    record_.time = time();
}

void Simulation::update_energy_balance() {
    // One reduction a step (and one for the counts of an observed one).
    const auto sums =
        global_sums(communicator(), std::array{interface_sums_.force_z, lowest_z_, top_force_,
                                               kick_sums_.dissipated, kick_sums_.dragged,
                                               noise_sums_.heat, interface_sums_.energy, elastic_,
                                               kick_sums_.kinetic, kick_sums_.of_step});
    const auto [force, lowest, top_force, dissipated, dragged, heat, lj, elastic, kinetic,
                of_step] = sums;

    const double sites = static_cast<double>(options_.block.sites);
    const double mean_height = reference_height_ + lowest / (sites * sites);
    const double velocity = velocity_of_top();
    const double top = block_.top() - options_.dt * velocity; // at n; the block is at n + 1 already
    if (has_previous_) {
        // Trapezia from n-1 to n. The top plane pushes the block with minus the force it feels.
        balance_.top_work -= 0.5 * (top_force + record_.top_force) * (top - record_.top);
        balance_.interface += 0.5 * (force + record_.force) * (mean_height - record_.mean_height);
        // Energies that the medium takes or gives and that the noise gives at a step count half
        // before the energies of the step and half after.
        balance_.damped += 0.5 * (dissipated + pending_.dissipated);
        balance_.drag_work -= 0.5 * (velocity * dragged + pending_.drag);
    }
    balance_.heat += 0.5 * (heat + pending_.heat); // half of that of the first step

    if (slides()) update_slide();
    if (external_ || external_pending_ != 0.0) integrate_external_work();

    has_previous_ = true;
    pending_ = {dissipated, velocity * dragged, heat};

    record_.top = top;
    record_.mean_height = mean_height;
    record_.force = force;
    record_.top_force = top_force;
    if (!record_.observed) return;

    static_cast<ContactCount&>(record_) = count_contacts(interface_sums_, communicator());
    record_.interface_energy = lj;
    record_.elastic_energy = elastic;
    record_.kinetic_energy = kinetic;
    record_.time_step_energy = thermostat_ ? of_step : 0.0;
    const double energy = record_.energy() + record_.time_step_energy;
    if (!energy_brought_) energy_brought_ = energy + balance_.net_damped() - balance_.work();
    record_.work = balance_.work() + *energy_brought_;
    record_.interface_work = balance_.interface;
    record_.damped = balance_.net_damped();
    scale_ =
        std::max({scale_, std::abs(lj), elastic, record_.kinetic_energy, std::abs(record_.work)});
    const double balance = record_.work - energy - record_.damped;
    record_.residual = scale_ > 0.0 ? balance / scale_ : 0.0;
}

} // namespace asperity
