// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxed state of a block of levels, without inertia: downhill with momentum,
//
//     v <- m v + (steps of the forces),      u <- u + v,
//
// where the steps of all nodes come from a hierarchy of grids (coarse_grids.hpp) that carries long
// waves at once, and those of the planes' means from a chain of springs, solved exactly. So the
// iterations hardly grow with the block. Both know how stiff the interface is at each site: its
// force there depends on the site's own place, so the last move and the change of force tell. The
// momentum m grows from 0.8 to 0.95 while it leads the lowest layer downhill, and starts again at
// 0.8 where it does not.
//
// The top plane is rigid. Free to move along z under a load, it ends where the state carries no net
// force but the load; prescribed, it feels what the block exerts. Where the mean height of the
// lowest layer is prescribed, its mean force is left out of the descent, and the free top plane
// comes to rest where none is on it.
//
// No node moves more than max_move in an iteration, and the descent starts from rest: the minimum
// found is the one downhill, not one behind a barrier.
#pragma once

#include "engine/block/block.hpp"
#include "engine/block/constraint.hpp"
#include "engine/block/interface.hpp"
#include "engine/phases.hpp"

#include <functional>
#include <limits>

namespace asperity {

/// What is known of the state that a relaxation starts from.
enum class Start {
    anywhere,
    near,      ///< close to an equilibrium, which may have just been lost
    predicted, ///< a guess at an equilibrium: where none is close, there is no point in going on
};

/// Where the interface's force is worth having at the end, eV/Å.
struct ForceWindow {
    double expected = 0.0;
    double furthest = std::numeric_limits<double>::infinity(); ///< from the one expected
};

struct RelaxOptions {
    Start start = Start::anywhere; ///< waves only
    double tolerance = 1e-4;       ///< largest residual force on a node, eV/Å
    double max_move = 0.2;         ///< Å an iteration
    double site_stiffness = 2.2;   ///< of the interface, for each site, eV/Å^2: waves only
    long long max_iterations = 200000;
    ForceWindow force_window; ///< given up where the force stays outside: waves only
    /// Called now and then, on all ranks, with the iteration and the residual. True: stop here.
    std::function<bool(long long, double)> report;
};

/// Whether a relaxation has come to a standstill.
class Standstill {
public:
    /// What has not halved in 3000 iterations will not any more.
    bool operator()(long long iteration, double residual) {
        if (residual < 0.5 * smallest_) {
            smallest_ = residual;
            found_at_ = iteration;
        }
        return iteration > found_at_ + 3000;
    }

private:
    double smallest_ = std::numeric_limits<double>::infinity();
    long long found_at_ = 0;
};

struct RelaxedState {
    bool converged = false;
    bool interrupted = false; ///< report() asked for it
    bool jumped = false;      ///< given up: the force, set, stayed outside its window
    long long iterations = 0;
    double residual = 0.0;         ///< eV/Å
    double interface_energy = 0.0; ///< U_LJ, eV
    double elastic_energy = 0.0;   ///< U_el, eV
    double force = 0.0;            ///< total normal force on the lowest layer, eV/Å
    /// Elastic force on the top plane along z, eV/Å; where the mean height is prescribed, the force
    /// that this takes, which is `force`.
    double top_force = 0.0;
    double mean_height = 0.0; ///< of the lowest layer above the reference height, Å
    long long in_contact = 0; ///< sites
    long long repulsive = 0;  ///< sites
    double closest = 0.0;     ///< smallest pair distance, Å; infinite out of reach
};

/// Relaxes the block in place, which stands where the constraint has it. Collective. The result is
/// the same bits on any number of ranks.
RelaxedState relax(Block& block, Interface& interface, double reference_height,
                   const Constraint& constraint, const RelaxOptions& options, Phases& phases);

} // namespace asperity
