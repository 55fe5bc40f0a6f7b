// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What becomes of a step of a quasi-static path (quasistatic.hpp): a function of the last point,
// the one tried, the force on the way and what may be wrong.
#pragma once

#include "engine/equilibrium/force_trail.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

struct PathPoint {
    double at = 0.0;     ///< of what is led, Å
    double force = 0.0;  ///< that leading it there takes, eV/Å
    double energy = 0.0; ///< eV
};

struct StepLimits {
    double missing = 0.0;   ///< energy that counts as nothing in this step, eV
    double uncertain = 0.0; ///< what the work of a step with an instability may be wrong by, eV
    bool last_try = false;  ///< no shorter step is made
    /// It is short beside the times in which the block relaxes: what is missing is then no error of
    /// the step in time.
    bool short_in_time = true;
};

struct StepDecision {
    enum Verdict {
        halve,  ///< the step is tried again from the last point, half as long
        accept, ///< no energy is missing
        jump,   ///< accepted, and the energy that is missing was dissipated
    };
    Verdict verdict = halve;
    double work = 0.0;       ///< of the top plane in this step, eV
    double dissipated = 0.0; ///< eV
    double gap = 0.0;        ///< work less energy gained and dissipated, eV
    double uncertain = 0.0;  ///< of the work, where energy is missing, eV
    bool smooth = true;      ///< the force did not jump
    bool excess = false;     ///< more energy gained than the work can have brought
    double growth = 1.0;     ///< of the step that follows
};

inline StepDecision decide(const PathPoint& last, const PathPoint& trial, const ForceTrail& trail,
                           const StepLimits& limits) {
    const double gained = trial.energy - last.energy;
    const ForceTrail::Integral integral = trail.to(trial.at, trial.force);
    StepDecision d;
    d.work = -integral.value;
    const double missing = d.work - gained;
    const double error =
        limits.short_in_time ? std::min(integral.error, std::abs(missing)) : std::abs(missing);
    // The error of a smooth step goes with the fourth power of its length, for each Å.
    const double margin = limits.missing / std::max(error, 1e-6 * limits.missing);
    d.growth = std::clamp(0.8 * std::sqrt(std::sqrt(margin)), 0.5, 2.0);
    if (std::abs(missing) <= limits.missing) {
        d.verdict = StepDecision::accept;
        d.gap = missing;
        return d;
    }
    // What is less than the work may be wrong by, or allowed, is left unaccounted for: it shows in
    // the residual.
    d.uncertain = integral.error;
    d.smooth = d.uncertain <= limits.missing;
    bool known = d.smooth;
    if (!d.smooth) {
        d.work = -trail.trapezium(trial.at, trial.force);
        d.uncertain = 0.5 * std::abs(trial.at - last.at) * std::abs(trial.force - last.force);
        known = d.uncertain <= limits.uncertain;
    }
    const double least = std::max(d.uncertain, limits.missing);
    if (d.work - gained > least) d.dissipated = d.work - gained;
    d.gap = d.work - gained - d.dissipated;
    d.excess = gained - d.work > least;
    if ((known && !d.excess && limits.short_in_time) || limits.last_try)
        d.verdict = d.dissipated > 0.0 ? StepDecision::jump : StepDecision::accept;
    return d;
}

} // namespace asperity
