// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The simulation: a block, an interface, a drive, and the loop over time.
//
// Velocity Verlet in its leapfrog form: positions at whole steps n, velocities at half steps. At
// the start of step n the state is u(n), v(n-1/2), halos of u current.
//
// With a device the fields are in its memory; block() and block_to_write() are the only access.
// Both copy the fields to the host if those of the device are newer; after block_to_write() they
// are copied to the device before the next step. A reference that is kept over a step is out of
// date.
#pragma once

#include "engine/block/block.hpp"
#include "engine/dynamics/drive.hpp"
#include "engine/dynamics/thermostat.hpp"
#include "engine/interface/interface.hpp"
#include "engine/options/simulation_options.hpp"
#include "engine/phases.hpp"
#include "engine/step_record.hpp"

#include <array>
#include <memory>
#include <optional>

namespace asperity {

class DeviceBlock;

/// Work and dissipation since the start, eV.
struct EnergyBalance {
    double top_work = 0.0;  ///< work of the top plane on the block, sideways too
    double lateral = 0.0;   ///< part of top_work that moves the block sideways
    double drag_work = 0.0; ///< work of the moving damping medium on the block
    double damped = 0.0;    ///< energy dissipated against the medium
    double heat = 0.0;      ///< heat given by the thermostat's noise
    double external = 0.0;  ///< work of forces from outside
    double interface = 0.0; ///< int F dz of the mean height
    double drive() const { return top_work + drag_work; }
    double work() const { return drive() + external; }
    /// Returns the net loss: at a temperature both damped and heat grow with time.
    double net_damped() const { return damped - heat; }
};

/// A block, an interface and a drive, advanced step by step.
class Simulation {
public:
    Simulation(const SimulationOptions& options, const Surface& substrate,
               const Communicator& communicator, const ProcessGrid& grid);
    Simulation(Simulation&&) noexcept;
    ~Simulation();

    /// Begins anew with the undeformed block, its lowest layer at this height (Å), moving with the
    /// drive.
    void start(double height);
    /// Makes one time step and returns its record. observe: sum the energies and contacts too.
    /// Collective.
    const StepRecord& step(bool observe);

    const StepRecord& now() const { return record_; }
    /// Replaces v, the mean of the lowest layer's velocities half a step before and after now(), by
    /// its velocities at now(), Å/fs. At a temperature these are the velocities before friction and
    /// noise have acted (thermostat.hpp).
    void take_to_step(const VectorPlane<double>& v) const;
    const EnergyBalance& balance() const { return balance_; }
    const SimulationOptions& options() const { return options_; }
    double reference_height() const { return reference_height_; }
    /// Returns the place of the block over the substrate at the next step, Å.
    const std::array<double, 2>& place() const { return slide_; }
    long long steps() const { return step_; }
    double time() const { return static_cast<double>(step_) * options_.dt; }
    Drive& drive() { return drive_; }
    const Drive& drive() const { return drive_; }
    const Block& block() const {
        if (device_is_newer_) download();
        return block_;
    }
    /// Returns the block for writing; with a device it is copied back before the next step.
    Block& block_to_write() {
        if (device_is_newer_) download();
        host_is_newer_ = true;
        return block_;
    }
    /// Adds forces on the sites of this rank's tile to those of the substrate, eV/Å, from the next
    /// step on; null: none. The field is read in place at each step. Its work is counted. Not
    /// available with a device.
    void push(const VectorField<double>* external) { external_ = external; }
    /// Begins a new energy balance with the next observed step, because writing to the fields from
    /// outside is not work.
    void restart_balance() { energy_brought_.reset(); }
    Interface& interface() { return interface_; }
    const Interface& interface() const { return interface_; }
    const Phases& phases() const { return phases_; }
    const Communicator& communicator() const { return block_.communicator(); }

    /// Passes everything but the fields to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v);
    /// Passes the work and power of forces from outside to a visitor, for checkpoints.
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
    mutable Block block_; ///< fields of the host; const functions bring them up to date
    Interface interface_;
    Drive drive_;
    std::optional<Thermostat> thermostat_; ///< only if the scene has a temperature
    std::unique_ptr<DeviceBlock> device_;  ///< only if the scene asks for one
    mutable bool device_is_newer_ = false;
    bool host_is_newer_ = true;
    Phases phases_;

    double reference_height_ = 0.0; ///< z of the undisplaced lowest layer, Å
    std::array<double, 2> slide_{}; ///< place of the block over the substrate, Å
    long long step_ = 0;
    StepRecord record_;
    EnergyBalance balance_;
    /// Energy at the first observed step, eV, which no work has brought.
    std::optional<double> energy_brought_;
    double scale_ = 0.0;        ///< largest energy seen, for the residual
    bool has_previous_ = false; ///< a step came before: trapezia can be formed
    /// Terms of the step before, eV: integrated with those of the next step.
    struct Pending {
        double dissipated = 0.0, drag = 0.0, heat = 0.0;
    } pending_;

    const VectorField<double>* external_ = nullptr; ///< forces from outside
    /// Power of forces from outside with v(n-1/2) and v(n+1/2), eV/fs
    ExactSum external_before_, external_after_;
    double external_pending_ = 0.0; ///< power with v(n+1/2) at the step before

    // Sums of the current step, this rank's share.
    InterfaceSums interface_sums_;
    KickSums kick_sums_;
    NoiseSums noise_sums_;
    ExactSum top_force_, lowest_z_, elastic_;
    std::array<ExactSum, 2> lateral_; ///< force along x and y, of a path that slides
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
