// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The relaxed state of a contact: the spectral block over its substrate, without inertia.
//
// Over atoms there are two stages. While contact spreads, sites jump into contact one after the
// other, and the energy is far from quadratic. A step is useful over some tenths of an angstrom
// only, the range of the attraction, so that steps must be cheap. Every site is a heavy ball of its
// own (heavy_ball.hpp): an iteration takes one sweep of the interface and two transforms per
// component, no energy and no line search. The stiffness k of the preconditioner follows the
// interface's mean, so that a block supported by a few summits converges as fast as one in full
// contact.
//
// Once all sites are close to their targets, a smooth problem with soft modes is left, and the
// direction is Newton's (newton.hpp): (S + H) d = -g by conjugate gradients with the same
// preconditioner, without sweeps and in single precision; g is in double precision. The equation is
// solved loosely, and more closely after a step that has not halved the residual. If a closely
// solved step has not halved the residual either, if the curvature is negative, or if a site would
// move further than move_max, the heavy balls continue.
//
// A relaxation that starts near an equilibrium (Start::near, as at a point of a path) begins with
// Newton's method; steps that would move a site by one to ten times move_max are then shortened.
//
// Over a lattice, sweeps are in mixed precision (SweepOptions) until the forces are near the error
// of mixed precision; the last sweeps, and the reported state, are in double precision.
//
// Over a wall another method solves each site's own law exactly (wall_minimiser.hpp). Near an
// equilibrium Newton's method (wall_newton.hpp) comes first; if it does not converge, as where the
// equilibrium has just become unstable, the other method continues.
//
// The relaxation ends in the minimum downhill of its start: no site moves further than move_max in
// an iteration, and a site that has passed its target stops. A state is reported as not converged
// if its forces cannot be brought below the tolerance, or if the sum of its forces is not the load:
// forces below the tolerance that all point one way add up.
#pragma once

#include "engine/interface/interface.hpp"
#include "engine/options/scales.hpp"
#include "engine/phases.hpp"
#include "engine/waves/constraint.hpp"
#include "engine/waves/spectral_block.hpp"

#include <cmath>
#include <functional>
#include <string>

namespace asperity {

/// Knowledge of the state that a relaxation starts from.
enum class Start {
    anywhere, ///< no knowledge
    near,     ///< close to an equilibrium, which may have just become unstable
};

/// The relaxation is abandoned if the total force leaves this interval, eV/Å.
struct ForceWindow {
    double expected = 0.0;      ///< expected total force, eV/Å
    double furthest = HUGE_VAL; ///< distance from the expected force
};

/// Options of a relaxation.
struct RelaxOptions {
    Start start = Start::anywhere;
    double tolerance = 0.0; ///< largest residual force on a site, eV/Å
    Scales scales;
    /// Largest sum of the residual forces under a prescribed top plane, eV/Å. (Under a load the
    /// largest sum is load_accuracy of the load.)
    double balance = HUGE_VAL;
    long long max_iterations = 200000;
    ForceWindow force_window; ///< atoms only
    /// Called during relaxations, on all ranks, with the iteration and the largest residual force,
    /// eV/Å. Returns true to stop the relaxation.
    std::function<bool(long long, double)> report;
};

/// Relative accuracy of a load. Zero load is met to this fraction of the sum of the absolute forces
/// on the sites (without attraction, to what the tolerance leaves), and a load below a millionth of
/// this sum to this fraction of the millionth.
inline constexpr double load_accuracy = 1e-3;

/// Constants that tune the minimisers, in the scales of the interface (scales.hpp): distances in
/// its length, forces in Scales::interface_force(). As far as was measured, the final states do not
/// depend on these constants; the number of iterations does.
struct RelaxationConstants {
    /// A relaxation ends if the residual has not halved in this many iterations.
    static constexpr long long stagnation_period = 3000;
    /// Iteration of the first comparison of the force with its window, and period of further
    /// comparisons.
    static constexpr long long first_force_check = 20, force_check_period = 5;

    // The heavy-ball method (heavy_ball.hpp): see HeavyBallRule.
    static constexpr float momentum_decay = 0.7f, step_cut = 0.7f, step_growth = 1.12f;
    static constexpr float step_size_max = 2.0f;
    /// Largest move of a site in an iteration: well below the range of the potential, so that no
    /// site passes a barrier.
    static constexpr double move_max = 0.17;
    /// Stiffness k of the preconditioner divided by the interface's mean stiffness, and the least k
    /// divided by Scales::stiffness, for few sites in contact.
    static constexpr double stiffness_share = 0.35, stiffness_share_min = 1e-4;
    /// Period of the measurement of the interface's mean stiffness, in iterations, and the relative
    /// change of the stiffness from which k is changed.
    static constexpr long long tuning_period = 8;
    static constexpr double stiffness_change = 0.2;

    // Newton's method (newton.hpp).
    /// A relaxation begins with Newton's method if the mean force is below this, for each Start.
    static constexpr double newton_below_anywhere = 8e-4, newton_below_near = 0.08;
    /// Newton's method follows the heavy balls if the largest distance to a target is below this...
    static constexpr double newton_distance = 4e-3;
    /// ... after at least this many iterations of theirs.
    static constexpr long long heavy_balls_min = 20;
    /// Share of the residual that conjugate gradients leave: at first, and after a step that has
    /// not halved the residual.
    static constexpr double forcing_loose = 0.3, forcing_tight = 0.1;
    static constexpr int products_max = 100; ///< limit of the iterations of conjugate gradients
    /// Least fraction of Newton's step that is made near an equilibrium.
    static constexpr double step_fraction_min = 0.1;
    /// Sweeps are in mixed precision if the mean residual is above this, ten times their error.
    static constexpr double mixed_precision_above = 2.6e-6;
    /// Displacement over which the interface's stiffness is measured.
    static constexpr double stiffness_displacement = 6e-4;

    // Newton's method over a wall (wall_newton.hpp).
    /// Share of the residual, measured by the preconditioner, that conjugate gradients leave.
    static constexpr double wall_forcing = 3e-3;
    /// Newton's method gives up if the residual has not halved in this many whole steps, or after
    /// this many steps that were cut to move_max.
    static constexpr int wall_stagnation_period = 8, wall_cut_steps_max = 10;

    // The minimiser over a wall (wall_minimiser.hpp).
    /// Largest residual mean force, divided by the tolerance. The secant converges faster than
    /// linearly, so that a small value costs few steps.
    static constexpr double mean_force_share = 1e-3;
    /// Error of the equilibrium places of sites with elastic forces in single precision, divided by
    /// the largest displacement of a site from the mean.
    static constexpr double single_precision_error = 4e-6;
};

/// Result of a relaxation.
struct RelaxedState : ContactCount, StepEnergies {
    bool converged = false;
    bool interrupted = false; ///< report() stopped the relaxation
    bool jumped = false;      ///< abandoned: the force has left ForceWindow
    bool balanced = true;     ///< the total force is the prescribed one
    long long iterations = 0;
    double residual = 0.0; ///< largest residual force on a site, eV/Å
    double rounding = 0.0; ///< estimate of the residual left by rounding, eV/Å
    double force = 0.0;    ///< total normal force on the lowest layer, eV/Å
    /// Elastic force on the top plane along z, eV/Å. If the mean height is prescribed, the force
    /// that holds the mean height, which equals `force`.
    double top_force = 0.0;
    double top = 0.0;         ///< displacement of the top plane, Å
    double mean_height = 0.0; ///< mean height of the lowest layer above the reference, Å
};

/// Estimates the residual force that rounding leaves at sites of this height (Å), eV/Å: rounded
/// positions times the stiffness of interface and block.
double rounding_of_forces(const Scales& scales, const BlockOptions& block, double height);

/// Explains, for an error message, why the relaxation found no equilibrium.
std::string why_not_converged(const RelaxedState& state, double tolerance);

/// Sets the constraint and relaxes the block in place. Collective.
RelaxedState relax(SpectralBlock& block, const Interface& interface, const Constraint& constraint,
                   const RelaxOptions& options, Phases& phases);

} // namespace asperity
