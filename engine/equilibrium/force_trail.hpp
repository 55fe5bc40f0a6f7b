// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The integral of a force along a path that is made point by point.
//
// From the last point to a new one the force is the polynomial through the new point and up to
// three before it (Newton's divided differences), so that the error of a step h is of order h^5
// where the force is smooth. Where it is not, the polynomial through the old points alone misses
// the new force, and wherever in the step that came about, the integral is wrong by no more than
// half the step times the miss. Where the force jumps, the trail begins anew.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace asperity {

class ForceTrail {
public:
    struct Integral {
        double value = 0.0, error = 0.0; ///< int f dx, and what it may be wrong by
    };

    /// A first point, with nothing behind it.
    void begin(double x, double f) { points_.assign(1, {x, f}); }
    void add(double x, double f) {
        if (points_.size() == longest) points_.erase(points_.begin());
        points_.push_back({x, f});
    }
    /// From the last point to (x, f), which stays outside.
    Integral to(double x, double f) const {
        const std::size_t n = points_.size();
        const Point& last = points_[n - 1];
        const double h = x - last.x, slope = (f - last.f) / h;
        double value = 0.5 * h * (f + last.f), miss = f - last.f;
        if (n > 1) {
            const Point& second = points_[n - 2];
            const double d = last.x - second.x, old_slope = (last.f - second.f) / d;
            const double bend = (slope - old_slope) / (x - second.x);
            value -= h * h * h / 6.0 * bend;
            miss = bend * h * (x - second.x);
            if (n > 2) {
                const Point& third = points_[n - 3];
                const double old_bend =
                    (old_slope - (second.f - third.f) / (second.x - third.x)) / (last.x - third.x);
                const double twist = (bend - old_bend) / (x - third.x);
                value -= (h / 12.0 + d / 6.0) * h * h * h * twist;
                miss = twist * h * (x - second.x) * (x - third.x);
            }
        }
        return {value, std::abs(0.5 * h * miss)};
    }
    /// From the last point but one to the last; none of one alone.
    double slope() const {
        if (points_.size() == 1) return 0.0;
        const Point &last = points_.back(), &second = points_[points_.size() - 2];
        return (last.f - second.f) / (last.x - second.x);
    }
    /// The force at x on the line through the last two points; of one alone, its own.
    double continued(double x) const { return points_.back().f + (x - points_.back().x) * slope(); }
    /// By the trapezium, whatever came before.
    double trapezium(double x, double f) const {
        return 0.5 * (x - points_.back().x) * (f + points_.back().f);
    }

    template <class Visitor>
    void visit(Visitor& v) {
        v("points", points_);
    }

private:
    struct Point {
        double x = 0.0, f = 0.0;
        template <class Visitor>
        void visit(Visitor& v) {
            v("x", x);
            v("f", f);
        }
    };
    static constexpr std::size_t longest = 3;
    std::vector<Point> points_;
};

} // namespace asperity
