// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The force of a path that is made point by point, its integral and its slope.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace asperity {

/// Force f, eV/Å, at a value x of the prescribed coordinate, Å.
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
/// The force from the last point to a new one is the polynomial through the new point and up to
/// three before it (Newton's divided differences), so that the error of a step h is of order h^5
/// where the force is smooth. Otherwise the polynomial through the old points misses the new force,
/// and the error of the integral is at most half the step times the miss, wherever in the step the
/// force has changed. After a jump of the force the trail begins anew; the miss is then measured
/// from the slope of the branch before, which hardly changes if a small part of the contact jumps.
///
/// A fall J of the force anywhere in one of equal steps h, each place as likely as the others,
/// makes an error of the integral with a standard deviation of h J/sqrt(12): what the polynomials
/// of the steps that follow add has the mean of this error with the opposite sign. The misses of
/// these steps are J, -2 J and J (through three points: J and -J; through two: J). The variance is
/// shared among the steps as the squares of the misses are.
class ForceTrail {
public:
    /// Integral of the force over a step.
    struct Integral {
        double value = 0.0; ///< int f dx, eV
        double error = 0.0; ///< largest error of the value, eV
        double sigma = 0.0; ///< standard deviation of the value, for sums of its square, eV
    };

    /// Starts the trail with a first point.
    void begin(double x, double f) { points_.assign(1, {x, f}); }
    /// Resets the slope of the branch. Called when another coordinate is prescribed from here on.
    void reset_slope() { branch_slope_ = 0.0; }
    /// Adds a point and keeps the last three.
    void add(double x, double f) {
        branch_slope_ = (f - points_.back().f) / (x - points_.back().x);
        if (points_.size() == longest) points_.erase(points_.begin());
        points_.push_back({x, f});
    }
    /// Integrates from the last point to (x, f). The point is not added.
    Integral to(double x, double f) const {
        const std::size_t n = points_.size();
        const ForceAt& last = points_[n - 1];
        const double h = x - last.x, slope = (f - last.f) / h;
        double misses = 1.0; // sum of the squares of the misses of one fall of the force
        double value = 0.5 * h * (f + last.f), miss = f - last.f - h * branch_slope_;
        if (n > 1) {
            const ForceAt& second = points_[n - 2];
            const double d = last.x - second.x, old_slope = (last.f - second.f) / d;
            const double bend = (slope - old_slope) / (x - second.x);
            value -= h * h * h / 6.0 * bend;
            miss = bend * h * (x - second.x);
            misses = 2.0;
            if (n > 2) {
                const ForceAt& third = points_[n - 3];
                const double old_bend =
                    (old_slope - (second.f - third.f) / (second.x - third.x)) / (last.x - third.x);
                const double twist = (bend - old_bend) / (x - third.x);
                value -= (h / 12.0 + d / 6.0) * h * h * h * twist;
                miss = twist * h * (x - second.x) * (x - third.x);
                misses = 6.0;
            }
        }
        const double error = std::abs(0.5 * h * miss);
        return {value, error, error / std::sqrt(3.0 * misses)};
    }
    const ForceAt& last() const { return points_.back(); }
    const std::vector<ForceAt>& points() const { return points_; }
    /// Returns true if the trail has one point only.
    bool is_new() const { return points_.size() == 1; }
    /// Returns the force at x on the line through the last point with the slope of its branch,
    /// eV/Å.
    double continued(double x) const {
        return points_.back().f + (x - points_.back().x) * branch_slope_;
    }
    /// Returns the larger of the differences of f from the last force and from the continued force
    /// at x, eV/Å. Both are needed: after an instability, some way along the new branch, f may
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

} // namespace asperity
