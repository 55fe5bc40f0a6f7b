// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What is known of one time step, or of one point of a quasi-static path. Which of these numbers a
// run records, and under which names: engine/run/series.hpp.
#pragma once

#include <array>

namespace asperity {

/// What is counted of the sites that the substrate acts on (count_contacts(), interface.hpp).
struct ContactCount {
    long long in_contact = 0, repulsive = 0; ///< sites
    double closest = 0.0; ///< smallest pair distance, Å; infinite beyond the interaction range

    template <class Visitor>
    void visit(Visitor& v) {
        v("in_contact", in_contact);
        v("repulsive", repulsive);
        v("closest", closest);
    }
};

/// Global values, bitwise identical on every rank. Energies in eV.
struct StepRecord : ContactCount {
    long long step = 0;       ///< its number; of a quasi-static path, of the point
    double time = 0.0;        ///< fs
    double top = 0.0;         ///< displacement of the top plane, Å
    double mean_height = 0.0; ///< of the lowest layer above the substrate's zero, Å
    double force = 0.0;       ///< total normal force of the substrate on the lowest layer, eV/Å
    double top_force = 0.0;   ///< elastic force on the top plane along z, eV/Å
    // Along x and y, of a path that slides; else 0.
    std::array<double, 2> slide{};         ///< place of the block over the substrate, Å
    std::array<double, 2> lateral_force{}; ///< of the substrate on the lowest layer, eV/Å
    // Only where the step was observed, like the contacts:
    bool observed = false;
    double interface_energy = 0.0, elastic_energy = 0.0, kinetic_energy = 0.0;
    /// At a temperature: -(dt^2/8) sum of F^2/m. With it the energies are what the leapfrog
    /// conserves over springs (thermostat.hpp).
    double time_step_energy = 0.0;
    /// Done on the solids by the drive and by forces from outside, from rest apart: it includes
    /// what the block had at the start, and what was written to its fields.
    double work = 0.0;
    double branch_energy = 0.0; ///< of elastic_energy, that of a block's branches
    double relaxed = 0.0;       ///< what these have dissipated since the start
    /// Since the start: damped, less the heat that a thermostat's noise gave; of a quasi-static
    /// path what was dissipated at instabilities.
    double damped = 0.0;
    double interface_work = 0.0; ///< int F dz of the mean height, likewise
    /// (work - energy - time_step_energy - damped) over the largest of the energies and of the
    /// work so far.
    double residual = 0.0;

    double energy() const { return interface_energy + elastic_energy + kinetic_energy; }

    /// For checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("step", step);
        v("time", time);
        v("top", top);
        v("mean_height", mean_height);
        v("force", force);
        v("top_force", top_force);
        v("slide", slide);
        v("lateral_force", lateral_force);
        v("observed", observed);
        v("interface_energy", interface_energy);
        v("elastic_energy", elastic_energy);
        v("kinetic_energy", kinetic_energy);
        v("time_step_energy", time_step_energy);
        ContactCount::visit(v);
        v("work", work);
        v("branch_energy", branch_energy);
        v("relaxed", relaxed);
        v("damped", damped);
        v("interface_work", interface_work);
        v("residual", residual);
    }
};

} // namespace asperity
