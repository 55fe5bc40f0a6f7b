// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The numbers of one time step, or of one point of a quasi-static path. engine/run/series.hpp
// selects and names those that a run records.
#pragma once

#include <array>

namespace asperity {

/// Counts of sites in contact and under repulsion (count_contacts(), interface.hpp).
struct ContactCount {
    long long in_contact = 0, repulsive = 0; ///< numbers of sites
    double closest = 0.0; ///< smallest pair distance, Å; infinite beyond the interaction range

    template <class Visitor>
    void visit(Visitor& v) {
        v("in_contact", in_contact);
        v("repulsive", repulsive);
        v("closest", closest);
    }
};

/// Place of the block at a step or point, and the forces on it.
struct PlaceAndForces {
    double top = 0.0; ///< displacement of the top plane, Å
    double drive =
        0.0; ///< displacement of what the drive moves, Å: the top plane or its spring's end
    double mean_height = 0.0; ///< mean height of the lowest layer above the substrate's zero, Å
    double force = 0.0;       ///< total normal force of the substrate on the lowest layer, eV/Å
    double top_force = 0.0;   ///< elastic force on the top plane along z, eV/Å
    // Numbers along x and y of a path that slides; otherwise 0.
    std::array<double, 2> slide{};         ///< place of the block over the substrate, Å
    std::array<double, 2> lateral_force{}; ///< force of the substrate on the lowest layer, eV/Å

    template <class Visitor>
    void visit(Visitor& v) {
        v("top", top);
        v("drive", drive);
        v("mean_height", mean_height);
        v("force", force);
        v("top_force", top_force);
        v("slide", slide);
        v("lateral_force", lateral_force);
    }
};

/// Energies of an observed step or of a point, eV.
struct Energies {
    double interface_energy = 0.0; ///< U_LJ
    double elastic_energy = 0.0;   ///< U_el, with branches and the spring that holds the top plane
    double kinetic_energy = 0.0;   ///< zero at rest
    /// Energy of the time step at a temperature, -(dt^2/8) sum of F^2/m. The sum of all energies
    /// with this one is what the leapfrog conserves over springs (thermostat.hpp).
    double time_step_energy = 0.0;
    double branch_energy = 0.0;  ///< part of elastic_energy in a block's branches
    double machine_energy = 0.0; ///< part of elastic_energy in the spring that holds the top plane

    /// Returns the elastic energy of the block without that of what holds it, eV.
    double energy_of_block() const { return elastic_energy - machine_energy; }
    /// Returns the energy of block and interface, eV.
    double energy() const { return interface_energy + elastic_energy + kinetic_energy; }

    template <class Visitor>
    void visit(Visitor& v) {
        v("interface_energy", interface_energy);
        v("elastic_energy", elastic_energy);
        v("kinetic_energy", kinetic_energy);
        v("time_step_energy", time_step_energy);
        v("branch_energy", branch_energy);
        v("machine_energy", machine_energy);
    }
};

/// Global numbers of a step or point, bitwise identical on every rank. Energies in eV.
struct StepRecord : ContactCount, PlaceAndForces, Energies {
    long long step = 0; ///< number of the step, or of the point of a quasi-static path
    double time = 0.0;  ///< fs
    // Numbers of observed steps only, like the contacts and the energies:
    bool observed = false;
    /// Work of the drive and of external forces on the solids, counted from rest apart: includes
    /// the energy of the block at the start, and the energy of values that a script writes to its
    /// fields.
    double work = 0.0;
    double dissipated_in_block = 0.0; ///< energy dissipated by the branches since the start
    /// Energy damped since the start, less the heat of a thermostat's noise; on a quasi-static path
    /// the energy dissipated at instabilities.
    double damped = 0.0;
    double interface_work = 0.0; ///< int F dz of the mean height since the start
    /// Residual of the energy balance: (work - energy - time_step_energy - damped) over the largest
    /// of the energies and of the work so far.
    double residual = 0.0;

    /// Passes the members to a visitor, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("step", step);
        v("time", time);
        PlaceAndForces::visit(v);
        v("observed", observed);
        Energies::visit(v);
        ContactCount::visit(v);
        v("work", work);
        v("relaxed", dissipated_in_block);
        v("damped", damped);
        v("interface_work", interface_work);
        v("residual", residual);
    }
};

} // namespace asperity
