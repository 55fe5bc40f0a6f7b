// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxed state without inertia: FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006).
//
// The top plane is rigid. Free to move along z under the external load (zero by default), it ends
// where the state carries no net force but the load; held, it feels what the block exerts. Or the
// mean height of the lowest layer is held: its mean force is left out of the descent, and the free
// top plane comes to rest where none is on it. Masses
// are fictitious, m ~ 2^l on level l: stiffness grows like 2^l too, so every level has the same
// highest frequency and a signal crosses a coarse cell as fast as a fine one; the iterations then
// grow with the number of layers of nodes, not with the thickness.
//
// No site moves more than max_move in an iteration, and the descent starts from rest: the minimum
// found is the one downhill, not one behind a barrier.
#pragma once

#include "engine/block/block.hpp"
#include "engine/block/interface.hpp"
#include "engine/phases.hpp"

#include <functional>

namespace asperity {

struct RelaxOptions {
    double tolerance = 1e-4;       ///< largest residual force on a node, eV/Å
    double load = 0.0;             ///< force pressing the free top plane down, eV/Å
    bool top_held = false;         ///< the top plane stays where it is
    bool mean_height_held = false; ///< of the lowest layer
    double max_move = 0.05;        ///< Å an iteration
    double site_stiffness = 2.2;   ///< of the interface, for each site, eV/Å^2: sets the step
    long long max_iterations = 200000;
    /// Called now and then, on all ranks, with the iteration and the residual. True: stop here.
    std::function<bool(long long, double)> report;
};

struct RelaxedState {
    bool converged = false;
    bool interrupted = false; ///< report() asked for it
    long long iterations = 0;
    double residual = 0.0;         ///< eV/Å
    double interface_energy = 0.0; ///< U_LJ, eV
    double elastic_energy = 0.0;   ///< U_el, eV
    double force = 0.0;            ///< total normal force on the lowest layer, eV/Å
    /// Elastic force on the top plane along z, eV/Å; where the mean height is held, the force on
    /// what holds it, which is `force`.
    double top_force = 0.0;
    double mean_height = 0.0; ///< of the lowest layer above the reference height, Å
    long long in_contact = 0; ///< sites
    long long pushed = 0;     ///< sites
    double closest = 0.0;     ///< smallest pair distance, Å; infinite out of reach
};

/// Relaxes the block in place. Collective. The result is the same bits on any number of ranks.
RelaxedState relax(Block& block, Interface& interface, double reference_height,
                   const RelaxOptions& options, Phases& phases);

} // namespace asperity
