// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Decision on a step of a quasi-static path (quasistatic.hpp): a function of the last point, the
// tried point, the force at the points before, and the errors of the energies.
#pragma once

#include "engine/statics/force_trail.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

/// A point of a quasi-static path.
struct PathPoint {
    double at = 0.0;     ///< prescribed coordinate, Å
    double force = 0.0;  ///< force that holds the coordinate there, eV/Å
    double energy = 0.0; ///< energy of block and interface, eV
};

/// Limits that decide on a step.
struct StepLimits {
    double missing = 0.0;   ///< largest missing energy that counts as zero, eV
    double uncertain = 0.0; ///< largest uncertainty of the work of a step with an instability, eV
    bool last_try = false;  ///< no shorter step is tried
    /// The step is short compared with the relaxation times of a viscoelastic block, so that
    /// missing energy is not an error of the time step.
    bool short_in_time = true;
    double in_time = 0.0; ///< error of the time step, eV (block_memory.hpp)
};

/// Decision on a step, with its work.
struct StepDecision {
    /// Fate of the tried point.
    enum Verdict {
        halve,  ///< the step is tried again from the last point, half as long
        accept, ///< accepted, without an instability that could be told from the others
        jump,   ///< accepted, and the block became unstable in the step
    };
    Verdict verdict = halve;
    double work = 0.0; ///< work of the top plane in this step: of the forces or, in a long
                       ///< step in time, the energy gained and dissipated, eV
    /// Energy lost: work of the forces less energy gained, eV. Below zero it is an error of the
    /// work.
    double lost = 0.0;
    /// Error that adds up over steps, eV: work of the forces less energy gained in a long step in
    /// time, or the error of an energy.
    double gap = 0.0;
    /// Standard deviation of the work of the forces, eV; at least what a step gains without work,
    /// which can only be an error.
    double sigma = 0.0;
    double uncertain = 0.0; ///< largest error of the work of a step that passes an instability, eV
    bool smooth = true;     ///< the force did not jump
    bool excess = false;    ///< the energy gained exceeds the work and its uncertainty
    bool coarse = false;    ///< the step is halved because of the error of the time step
    double growth = 1.0;    ///< factor from this length to that of the next step
    bool of_energies = false; ///< the work is the energy gained and dissipated
};

/// Returns the decision for a path on which nothing can be dissipated: accepted, with the energy
/// gained as work. error: error of the energy of a point, eV.
inline StepDecision reversible_step(const PathPoint& last, const PathPoint& trial, double error) {
    StepDecision d;
    d.verdict = StepDecision::accept;
    d.work = trial.energy - last.energy;
    d.gap = error;
    d.growth = 2.0;
    return d;
}

/// Decides on the step from `last` to `trial`: accepted, accepted as an instability, or halved. All
/// energy that is missing in an accepted step is lost, however small: patches that jump unseen lose
/// as much for each site in a box of any size. The errors of the works of steps have both signs.
/// trail: forces of the points so far.
inline StepDecision decide(const PathPoint& last, const PathPoint& trial, const ForceTrail& trail,
                           const StepLimits& limits) {
    const double gained = trial.energy - last.energy;
    const ForceTrail::Integral integral = trail.to(trial.at, trial.force);
    StepDecision d;
    d.work = -integral.value;
    const double missing = d.work - gained;
    const double error = std::max(limits.short_in_time ? std::min(integral.error, std::abs(missing))
                                                       : std::abs(missing),
                                  limits.in_time);
    // The error of a smooth step, divided by its length, scales as the fourth power of the length.
    const double margin = limits.missing / std::max(error, 1e-6 * limits.missing);
    d.growth = std::clamp(0.8 * std::sqrt(std::sqrt(margin)), 0.5, 2.0);
    // The error of the integral of a new trail may equal the energy that an instability took.
    const bool hides = trail.is_new() && integral.error > limits.uncertain && !limits.last_try;
    if (std::abs(missing) <= limits.missing && !hides) {
        d.coarse = limits.in_time > limits.missing && !limits.last_try;
        if (!d.coarse) d.verdict = StepDecision::accept;
        // In a long step in time energies and dissipation are of fourth order in the step, the
        // forces at its ends of second.
        d.of_energies = !limits.short_in_time;
        if (d.of_energies) {
            d.work = gained;
            d.gap = missing;
        } else {
            d.lost = missing;
            d.sigma = std::max(integral.sigma, -d.lost);
        }
        return d;
    }
    d.coarse = !limits.short_in_time;
    d.uncertain = integral.error;
    d.sigma = integral.sigma;
    d.smooth = d.uncertain <= limits.missing;
    bool known = d.smooth;
    if (!d.smooth) {
        d.work = -trail.trapezium(trial.at, trial.force);
        d.uncertain = 0.5 * std::abs(trial.at - last.at) * trail.jump(trial.at, trial.force);
        d.sigma = d.uncertain / std::sqrt(3.0); // at an unknown place in the step
        known = d.uncertain <= limits.uncertain;
    }
    const double least = d.uncertain + limits.missing;
    d.lost = d.work - gained;
    d.excess = -d.lost > least;
    d.sigma = std::max(d.sigma, -d.lost);
    if ((known && !d.excess && limits.short_in_time) || limits.last_try)
        d.verdict = d.lost > least ? StepDecision::jump : StepDecision::accept;
    return d;
}

} // namespace asperity
