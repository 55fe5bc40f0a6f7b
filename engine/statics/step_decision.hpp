// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What becomes of a step of a quasi-static path (quasistatic.hpp): a function of the last point,
// the one tried, the force on the way and what may be wrong.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace asperity {

/// The force, eV/Å, that leading takes at a place x, Å.
struct ForceAt {
    double x = 0.0, f = 0.0;
    template <class Visitor>
    void visit(Visitor& v) {
        v("x", x);
        v("f", f);
    }
};

/// The integral of a force along a path that is made point by point.
///
/// From the last point to a new one the force is the polynomial through the new point and up to
/// three before it (Newton's divided differences), so that the error of a step h is of order h^5
/// where the force is smooth. Where it is not, the polynomial through the old points alone misses
/// the new force, and wherever in the step that came about, the integral is wrong by no more than
/// half the step times the miss. Where the force jumps, the trail begins anew: what it has missed
/// is then measured from the slope of the branch before, which a jump of a small part of the
/// contact leaves nearly as it was.
class ForceTrail {
public:
    struct Integral {
        double value = 0.0, error = 0.0; ///< int f dx and its error, eV
    };

    /// Starts the trail with a first point.
    void begin(double x, double f) { points_.assign(1, {x, f}); }
    /// Resets the slope of the branch, because another coordinate is led from here.
    void forget_slope() { branch_slope_ = 0.0; }
    void add(double x, double f) {
        branch_slope_ = (f - points_.back().f) / (x - points_.back().x);
        if (points_.size() == longest) points_.erase(points_.begin());
        points_.push_back({x, f});
    }
    /// Integrates from the last point to (x, f), which is not added.
    Integral to(double x, double f) const {
        const std::size_t n = points_.size();
        const ForceAt& last = points_[n - 1];
        const double h = x - last.x, slope = (f - last.f) / h;
        double value = 0.5 * h * (f + last.f), miss = f - last.f - h * branch_slope_;
        if (n > 1) {
            const ForceAt& second = points_[n - 2];
            const double d = last.x - second.x, old_slope = (last.f - second.f) / d;
            const double bend = (slope - old_slope) / (x - second.x);
            value -= h * h * h / 6.0 * bend;
            miss = bend * h * (x - second.x);
            if (n > 2) {
                const ForceAt& third = points_[n - 3];
                const double old_bend =
                    (old_slope - (second.f - third.f) / (second.x - third.x)) / (last.x - third.x);
                const double twist = (bend - old_bend) / (x - third.x);
                value -= (h / 12.0 + d / 6.0) * h * h * h * twist;
                miss = twist * h * (x - second.x) * (x - third.x);
            }
        }
        return {value, std::abs(0.5 * h * miss)};
    }
    /// Returns true if the trail has one point only.
    bool is_new() const { return points_.size() == 1; }
    /// Returns the force at x on the line through the last point with the slope of its branch,
    /// eV/Å.
    double continued(double x) const {
        return points_.back().f + (x - points_.back().x) * branch_slope_;
    }
    /// Returns the distance of the force f at x from the last or from the continued force,
    /// whichever is larger, eV/Å: after an instability and some way along the new branch f may
    /// equal the last force again.
    double jump(double x, double f) const {
        return std::max(std::abs(f - points_.back().f), std::abs(f - continued(x)));
    }
    /// Integrates to (x, f) by the trapezium alone, eV.
    double trapezium(double x, double f) const {
        return 0.5 * (x - points_.back().x) * (f + points_.back().f);
    }

    template <class Visitor>
    void visit(Visitor& v) {
        v("points", points_);
        v("branch_slope", branch_slope_);
    }

private:
    static constexpr std::size_t longest = 3;
    std::vector<ForceAt> points_;
    double branch_slope_ = 0.0; ///< slope in the last step without a jump, eV/Å^2
};

struct PathPoint {
    double at = 0.0;     ///< prescribed coordinate, Å
    double force = 0.0;  ///< force that holds the coordinate there, eV/Å
    double energy = 0.0; ///< eV
};

struct StepLimits {
    double missing = 0.0;   ///< energy that counts as nothing in this step, eV
    double uncertain = 0.0; ///< uncertainty that the work of an unstable step may have, eV
    bool last_try = false;  ///< no shorter step is made
    /// True if the step is short beside the times in which the block relaxes: missing energy is
    /// then no error of the step in time.
    bool short_in_time = true;
    double in_time = 0.0; ///< error of the step in time, eV (block_memory.hpp)
};

struct StepDecision {
    enum Verdict {
        halve,  ///< the step is tried again from the last point, half as long
        accept, ///< no energy is missing
        jump,   ///< accepted, and the energy that is missing was dissipated
    };
    Verdict verdict = halve;
    double work = 0.0;       ///< work of the top plane in this step, eV
    double dissipated = 0.0; ///< eV
    double gap = 0.0;        ///< work less energy gained and dissipated, eV
    double uncertain = 0.0;  ///< uncertainty of the work if energy is missing, eV
    bool smooth = true;      ///< the force did not jump
    bool excess = false;     ///< more energy gained than the work can have brought
    bool coarse = false;     ///< halved for its error in time, not for an instability
    double growth = 1.0;     ///< factor of the length of the next step
};

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
    // The error of a smooth step goes with the fourth power of its length, for each Å.
    const double margin = limits.missing / std::max(error, 1e-6 * limits.missing);
    d.growth = std::clamp(0.8 * std::sqrt(std::sqrt(margin)), 0.5, 2.0);
    // The error of the integral of a new trail may equal the energy that an instability took.
    const bool hides = trail.is_new() && integral.error > limits.uncertain && !limits.last_try;
    if (std::abs(missing) <= limits.missing && !hides) {
        d.coarse = limits.in_time > limits.missing && !limits.last_try;
        if (!d.coarse) d.verdict = StepDecision::accept;
        d.gap = missing;
        return d;
    }
    d.coarse = !limits.short_in_time;
    // Missing energy below the uncertainty of the work or below the limit is not counted as
    // dissipated: it shows in the residual.
    d.uncertain = integral.error;
    d.smooth = d.uncertain <= limits.missing;
    bool known = d.smooth;
    if (!d.smooth) {
        d.work = -trail.trapezium(trial.at, trial.force);
        d.uncertain = 0.5 * std::abs(trial.at - last.at) * trail.jump(trial.at, trial.force);
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
