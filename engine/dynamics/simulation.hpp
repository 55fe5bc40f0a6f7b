// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The simulation: a block, an interface, a drive, and the loop over time.
//
// Velocity Verlet in its leapfrog form: positions at whole steps n, velocities at half steps. At
// the start of step n the state is u(n), v(n-1/2), halos of u current.
//
// With a device the fields are there; block() and block_to_write() are the gates. Both bring them
// to the host where the device's are newer; what was asked for by block_to_write() is copied to the
// device before the next step. A reference that is kept over a step is out of date.
#pragma once

#include "engine/block/block.hpp"
#include "engine/dynamics/drive.hpp"
#include "engine/dynamics/thermostat.hpp"
#include "engine/interface/interface.hpp"
#include "engine/phases.hpp"
#include "engine/scene/device_choice.hpp"
#include "engine/step_record.hpp"

#include <array>
#include <memory>
#include <optional>

namespace asperity {

class DeviceBlock;

struct SimulationOptions {
    BlockOptions block;
    InterfaceOptions interface;
    DriveOptions drive;
    double dt = 10.0;          ///< fs
    double damping = 0.0;      ///< 1/fs
    double damping_from = 0.0; ///< fraction of the thickness
    double temperature = 0.0;  ///< K
    std::uint64_t seed = 1;    ///< of the noise
    DeviceChoice device;       ///< that takes the steps; none: the processor
};

/// Work and dissipation since the start, eV.
struct EnergyBalance {
    double top_work = 0.0;  ///< done on the block by the top plane, sideways too
    double lateral = 0.0;   ///< of this, by what moves the block sideways
    double drag_work = 0.0; ///< done on the block by the moving damping medium
    double damped = 0.0;    ///< dissipated against the medium
    double heat = 0.0;      ///< given by the thermostat's noise
    double external = 0.0;  ///< done by forces from outside
    double interface = 0.0; ///< int F dz of the mean height
    double drive() const { return top_work + drag_work; }
    double work() const { return drive() + external; }
    /// Net: both parts of the heat that goes to and fro at a temperature grow with time.
    double net_damped() const { return damped - heat; }
};

class Simulation {
public:
    Simulation(const SimulationOptions& options, const Surface& substrate,
               const Communicator& communicator, const ProcessGrid& grid);
    Simulation(Simulation&&) noexcept;
    ~Simulation();

    /// The undeformed block at this height of its lowest layer, moving with the drive; also after
    /// steps, of which nothing is left.
    void start(double height);
    /// One time step. observe: sum the energies and contacts too.
    const StepRecord& step(bool observe);

    const StepRecord& now() const { return record_; }
    /// Changes v, the mean of the lowest layer's velocities half a step before and after now(), to
    /// its velocities at now(), Å/fs. At a temperature these are the velocities before friction and
    /// noise have acted (thermostat.hpp).
    void take_to_step(const VectorPlane<double>& v) const;
    const EnergyBalance& balance() const { return balance_; }
    const SimulationOptions& options() const { return options_; }
    double reference_height() const { return reference_height_; }
    /// Of the block over the substrate at the next step, Å.
    const std::array<double, 2>& place() const { return slide_; }
    long long steps() const { return step_; }
    double time() const { return static_cast<double>(step_) * options_.dt; }
    Drive& drive() { return drive_; }
    const Drive& drive() const { return drive_; }
    const Block& block() const {
        if (device_is_newer_) download();
        return block_;
    }
    /// With a device: copied to it before the next step.
    Block& block_to_write() {
        if (device_is_newer_) download();
        host_is_newer_ = true;
        return block_;
    }
    /// Forces on the sites of this rank's tile beside the substrate's, eV/Å, at each step from the
    /// next one on; null: none. The field is read where it is. Its work is counted. Not with a
    /// device.
    void push(const VectorField<double>* external) { external_ = external; }
    /// After fields were written to from outside, which is no work: the energy balance starts anew
    /// with the next observed step.
    void restart_balance() { energy_brought_.reset(); }
    Interface& interface() { return interface_; }
    const Interface& interface() const { return interface_; }
    const Phases& phases() const { return phases_; }
    const Communicator& communicator() const { return block_.communicator(); }

    /// Everything but the fields, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v);
    /// The same of forces from outside.
    template <class Visitor>
    void visit_external(Visitor& v) {
        v("work", balance_.external);
        v("pending", external_pending_);
    }

private:
    void step_on_device(bool observe);
    void step_on_processor(bool observe);
    void download() const;
    double velocity_of_top() const;
    ThermalNoise noise() const;
    bool slides() const { return options_.interface.slides; }
    void slide();
    void update_slide();
    void begin_record(bool observe);
    void sweep_interface(bool observe);
    void add_external();
    ExactSum power_of_external() const;
    void integrate_external_work();
    void advance_block(bool observe);
    void add_noise();
    void collect(bool observe);
    void update_energy_balance();

    SimulationOptions options_;
    mutable Block block_; ///< the host's; const functions bring it up to date
    Interface interface_;
    Drive drive_;
    std::optional<Thermostat> thermostat_; ///< only if the scene has a temperature
    std::unique_ptr<DeviceBlock> device_;  ///< only if the scene asks for one
    mutable bool device_is_newer_ = false;
    bool host_is_newer_ = true;
    Phases phases_;

    double reference_height_ = 0.0; ///< z of the undisplaced lowest layer, Å
    std::array<double, 2> slide_{}; ///< of the block over the substrate, Å
    long long step_ = 0;
    StepRecord record_;
    EnergyBalance balance_;
    /// That no work has brought: set by the first observed step.
    std::optional<double> energy_brought_;
    double scale_ = 0.0;        ///< largest energy seen, for the residual
    bool has_previous_ = false; ///< a step came before: trapezia can be formed
    struct Pending {
        double dissipated = 0.0, drag = 0.0, heat = 0.0;
    } pending_; ///< of the step before, eV: integrated with the next

    const VectorField<double>* external_ = nullptr; ///< forces from outside
    ExactSum external_before_, external_after_;     ///< their power with v(n-1/2), v(n+1/2), eV/fs
    double external_pending_ = 0.0;                 ///< the latter of the step before

    // Sums of the step under way, this rank's share.
    InterfaceSums interface_sums_;
    KickSums kick_sums_;
    NoiseSums noise_sums_;
    ExactSum top_force_, lowest_z_, elastic_;
    std::array<ExactSum, 2> lateral_; ///< of a path that slides
};

template <class Visitor>
void Simulation::visit(Visitor& v) {
    v("step", step_);
    v("reference_height", reference_height_);
    double top = block_.top();
    v("top", top);
    v("drive", drive_);
    v("record", record_);
    v("balance.top_work", balance_.top_work);
    v("balance.drag_work", balance_.drag_work);
    v("balance.damped", balance_.damped);
    v("balance.heat", balance_.heat);
    v("balance.interface", balance_.interface);
    v("energy.brought", energy_brought_);
    v("energy.scale", scale_);
    v("has_previous", has_previous_);
    v("pending.dissipated", pending_.dissipated);
    v("pending.drag", pending_.drag);
    v("pending.heat", pending_.heat);
    if (slides()) {
        v("slide", slide_);
        v("balance.lateral", balance_.lateral);
    }
    if constexpr (Visitor::restores) {
        block_.set_top(top);
        host_is_newer_ = true;
        if (slides()) interface_.slide_to(record_.slide[0], record_.slide[1]);
    }
}

} // namespace asperity
