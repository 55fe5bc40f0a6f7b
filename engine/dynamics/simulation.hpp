// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The simulation: a block under its top plane (top.hpp), an interface, and the time step. The
// caller prescribes the velocity of the machine in each step.
//
// Velocity Verlet in its leapfrog form: positions at whole steps n, velocities at half steps. At
// the start of step n the state is u(n), v(n-1/2), halos of u current.
//
// With a device, its memory holds the fields; block() and block_to_write() are the only access.
// block() and block_to_write() copy the fields to the host if those of the device are newer; after
// block_to_write() the fields are copied to the device before the next step. A reference to the
// block is out of date after a step.
#pragma once

#include "engine/block/block.hpp"
#include "engine/dynamics/drive.hpp"
#include "engine/dynamics/external_forces.hpp"
#include "engine/dynamics/step_ledger.hpp"
#include "engine/dynamics/thermostat.hpp"
#include "engine/dynamics/top.hpp"
#include "engine/interface/interface.hpp"
#include "engine/options/simulation_options.hpp"
#include "engine/phases.hpp"
#include "engine/step_record.hpp"

#include <array>
#include <memory>
#include <optional>
#include <utility>

namespace asperity {

class DeviceBlock;

/// A block, its top plane and an interface, advanced step by step.
class Simulation {
public:
    /// Makes block, interface and device; start() must follow. Collective. Throws io::FileError if
    /// a device fails.
    Simulation(const SimulationOptions& options, const Surface& substrate,
               const Communicator& communicator, const ProcessGrid& grid);
    Simulation(Simulation&&) noexcept;
    ~Simulation();

    /// Starts from the undeformed block, with its lowest layer at this height (Å) and all nodes
    /// moving along z at this velocity (Å/fs).
    void start(double height, double velocity);
    /// Makes one time step and returns its record. motion: velocity of the machine during the step;
    /// observe: compute energies and contact counts too. Collective.
    const StepRecord& step(const TopMotion& motion, bool observe);

    /// Returns the record of the last step.
    const StepRecord& now() const { return record_; }
    /// Replaces v, which holds the mean of the lowest layer's velocities half a step before and
    /// after now(), by the velocities at now(), Å/fs. At a temperature these are the velocities
    /// before friction and noise have acted (thermostat.hpp).
    void set_velocities_at_step(const VectorPlane<double>& v) const;
    /// Returns works and dissipation since the start.
    const EnergyBalance& balance() const { return ledger_.balance(); }
    const SimulationOptions& options() const { return options_; }
    /// Returns the top plane at the next step.
    const Top& top() const { return top_; }
    /// Sets the displacement of the top plane and the machine at the next step, Å.
    void set_top(double z);
    /// Returns the mass of the block and of its top plane, eV fs^2/Å^2. Not collective.
    double moving_mass() const { return block_.mass() + top_.mass(); }
    long long steps() const { return step_; } ///< returns the number of steps so far
    /// Returns the time after these steps, fs.
    double time() const { return static_cast<double>(step_) * options_.dt; }
    /// Returns the time in the middle of the next step, fs, at which the machine's velocity is
    /// taken.
    double middle_of_step() const { return (static_cast<double>(step_) + 0.5) * options_.dt; }
    /// Returns the block; with a device its fields are copied to the host.
    const Block& block() const {
        if (device_is_newer_) download();
        return block_;
    }
    /// Returns the block for writing; with a device its fields are copied back before the next
    /// step.
    Block& block_to_write() {
        if (device_is_newer_) download();
        host_is_newer_ = true;
        return block_;
    }
    /// Returns the fields of the lowest level on the host, for views. Values written to the fields
    /// take effect only after block_to_write().
    Block::Fields fields_to_view() {
        if (device_is_newer_) download();
        return block_.fields(std::as_const(block_).levels().front());
    }
    /// Adds external forces to those of the substrate in each step, and counts their work. Keeps
    /// the pointer; nullptr: none. Not available with a device.
    void push(ExternalForces* external) { external_ = external; }
    /// Begins a new energy balance with the next observed step. Called after fields were written,
    /// which is not work.
    void restart_balance() { ledger_.restart(); }
    Interface& interface() { return interface_; }
    const Interface& interface() const { return interface_; }
    const Phases& phases() const { return phases_; }
    const Communicator& communicator() const { return block_.communicator(); }

    /// Passes everything but the fields to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v);

private:
    /// Shares of this rank in the sums of a step.
    struct Sums {
        InterfaceSums interface;
        KickSums kick;
        NoiseSums noise;
        ExactSum top_force, lowest_z, elastic;
        TopEnergies top;                 ///< the same on every rank
        std::array<ExactSum, 2> lateral; ///< force along x and y, of a path that slides
    };
    void step_on_device(bool observe);
    void step_on_processor(bool observe);
    void download() const;
    ThermalNoise noise(long long step) const;
    bool slides() const { return options_.interface.slides; }
    void begin_record(bool observe);
    void sweep_interface(bool observe);
    void advance_block(bool observe);
    void move_top();
    void add_noise();
    void collect(bool observe);
    void enter_in_ledger();

    SimulationOptions options_;
    mutable Block block_; ///< fields of the host; const functions bring them up to date
    Interface interface_;
    Top top_;
    std::optional<Thermostat> thermostat_; ///< thermostat; empty at zero temperature
    std::unique_ptr<DeviceBlock> device_;  ///< block on a device; null: none
    mutable bool device_is_newer_ = false;
    bool host_is_newer_ = true;
    Phases phases_;

    long long step_ = 0;
    StepRecord record_;
    StepLedger ledger_;
    ExternalForces* external_ = nullptr;
    Sums sums_; ///< sums of the current step
};

template <class Visitor>
void Simulation::visit(Visitor& v) {
    v("step", step_);
    double height = interface_.reference_height();
    v("reference_height", height);
    if constexpr (Visitor::restores) interface_.set_reference_height(height);
    top_.visit(v);
    v("record", record_);
    v("ledger", ledger_);
    if (slides()) v("place", top_.place);
    if constexpr (Visitor::restores) {
        block_to_write().set_top(top_.z);
        if (slides()) interface_.slide_to(record_.slide[0], record_.slide[1]);
    }
}

} // namespace asperity
