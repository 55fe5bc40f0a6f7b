// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Work and dissipation of a simulation, integrated over its steps, and its energy balance.
//
// Works are integrated by the trapezium rule between two steps. Half of the energies exchanged with
// the medium and the noise at a step is counted before the energies of the step, half after.
#pragma once

#include "engine/step_record.hpp"

#include <array>
#include <optional>

namespace asperity {

/// Work and dissipation since the start, eV.
struct EnergyBalance {
    /// Work of the machine on the top plane, or on what holds the plane, sideways included.
    double top_work = 0.0;
    double lateral = 0.0;   ///< part of top_work that moves the block sideways
    double drag_work = 0.0; ///< work of the moving damping medium on the block
    double damped = 0.0;    ///< energy dissipated against the medium
    double heat = 0.0;      ///< heat given by the thermostat's noise
    double external = 0.0;  ///< work of external forces
    double interface = 0.0; ///< int F dz of the mean height
    /// Returns the work of the drive.
    double drive() const { return top_work + drag_work; }
    /// Returns all work on the solids.
    double work() const { return drive() + external; }
    /// Returns the net loss, damped minus heat; at a temperature both grow with time.
    double net_damped() const { return damped - heat; }

    template <class Visitor>
    void visit(Visitor& v) {
        v("top_work", top_work);
        v("lateral", lateral);
        v("drag_work", drag_work);
        v("damped", damped);
        v("heat", heat);
        v("external", external);
        v("interface", interface);
    }
};

/// Amounts of a step, summed over all ranks; the energies at an observed step only.
struct StepTotals : PlaceAndForces, Energies {
    double drive_force = 0.0;                        ///< force on the machine along z, eV/Å
    double dissipated = 0.0, drag = 0.0, heat = 0.0; ///< eV
    double external = 0.0; ///< work of external forces since the step before, eV
};

/// Ledger of the steps of a simulation.
class StepLedger {
public:
    const EnergyBalance& balance() const { return balance_; }
    /// Adds a step to works and dissipation. record: record of the step before, overwritten with
    /// the numbers of this step; energies and their balance are included if record.observed.
    void enter(const StepTotals& now, StepRecord& record);
    /// Begins a new energy balance with the next observed step.
    void restart() { energy_brought_.reset(); }

    /// Passes the numbers to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("balance", balance_);
        v("energy.brought", energy_brought_);
        v("energies", energies_);
        v("has_previous", has_previous_);
        v("pending.dissipated", pending_.dissipated);
        v("pending.drag", pending_.drag);
        v("pending.heat", pending_.heat);
        v("pending.drive_force", pending_.drive_force);
    }

private:
    void balance_energies(const StepTotals& now, StepRecord& record);

    EnergyBalance balance_;
    /// Energy at the first observed step, eV, not brought by counted work.
    std::optional<double> energy_brought_;
    Balance energies_;
    bool has_previous_ = false; ///< a step came before: trapezia can be formed
    /// Terms of the step before, eV and eV/Å, to be integrated with those of the next step.
    struct Pending {
        double dissipated = 0.0, drag = 0.0, heat = 0.0, drive_force = 0.0;
    } pending_;
};

} // namespace asperity
