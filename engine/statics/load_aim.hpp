// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The steps by which a segment of a quasi-static path meets the load at which it ends.
#pragma once

#include "engine/statics/force_trail.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace asperity {

/// Search for the place at which the force is a given load: the nearest known places beyond the
/// load, and the steps that were cut to end at the load.
class LoadAim {
public:
    /// Begins a new search.
    void begin() { *this = {}; }
    /// Notes a place beyond the load. x: last point of the path, Å.
    void pass(const ForceAt& beyond, double x) {
        if (beyond_.empty() || 2.0 * std::abs(beyond.x - x) <= std::abs(beyond_[0].x - x))
            tries_ = 0;
        beyond_.insert(beyond_.begin(), beyond);
        beyond_.resize(std::min<std::size_t>(beyond_.size(), 2));
    }
    /// Counts a step that is tried, once a place beyond the load is known.
    void count() {
        if (!beyond_.empty()) ++tries_;
    }
    /// Returns the length of the next step from the end of a trail, Å: `length`, or less if the
    /// force is expected to equal the load within the step. If a place beyond the load is known,
    /// the estimate interpolates between both sides, or halves the interval if it has not shrunk
    /// for several steps. Otherwise it extrapolates from the points before, only if the force is
    /// smooth. direction: sign of the motion; load: eV/Å.
    double cut(double length, double direction, const ForceTrail& trail, double load, bool smooth) {
        const std::vector<ForceAt>& points = trail.points();
        const std::size_t n = points.size();
        const ForceAt& last = points[n - 1];
        std::optional<double> to_load;
        if (!beyond_.empty()) {
            constexpr int patience = 4;
            const double way = std::abs(beyond_[0].x - last.x);
            const ForceAt* third = beyond_.size() > 1 ? &beyond_[1]
                                   : n > 1            ? &points[n - 2]
                                                      : nullptr;
            const double x = place_of(load, last, beyond_[0], third, 0.0, 1.0);
            to_load = tries_ > patience ? 0.5 * way : std::abs(x - last.x);
            to_load = std::clamp(*to_load, 0.001 * way, 0.999 * way);
        } else if (smooth && n > 1) {
            const ForceAt* third = n > 2 ? &points[n - 3] : nullptr;
            const double x = place_of(load, last, points[n - 2], third, -HUGE_VAL, 0.0);
            to_load = direction * (x - last.x);
        }
        if (!to_load || !(*to_load > 0.0 && *to_load <= length)) return length;
        uncut_ = std::max(uncut_, length);
        was_cut_ = true;
        return *to_load;
    }
    /// Returns true, once, if the last step was cut: a cut step cannot pass the load unnoticed.
    bool take_was_cut() { return std::exchange(was_cut_, false); }
    /// Returns the largest length of a step before it was cut, Å.
    double uncut() const { return uncut_; }

    template <class Visitor>
    void visit(Visitor& v) {
        v("beyond", beyond_);
        v("tries", tries_);
        v("uncut", uncut_);
        v("beside", was_cut_);
    }

private:
    /// Estimates the place at which the force is the load, Å: from the parabola x(f) through three
    /// places, or from the line through the first two if the parabola leaves the part (least, most)
    /// of the way between them or is far from the line. If all forces press, the logarithm of the
    /// force is used for f, because pressing forces grow about exponentially.
    static double place_of(double load, const ForceAt& a, const ForceAt& b, const ForceAt* c,
                           double least, double most) {
        const bool grows = load > 0.0 && a.f > 0.0 && b.f > 0.0 && (c == nullptr || c->f > 0.0);
        const auto y = [&](const ForceAt& p) { return grows ? std::log(p.f / load) : p.f - load; };
        const double slope = (b.x - a.x) / (y(b) - y(a)), line = -y(a) * slope;
        if (c == nullptr) return a.x + line;
        const double other = (c->x - b.x) / (y(*c) - y(b));
        const double curve = line + y(a) * y(b) * (other - slope) / (y(*c) - y(a));
        const double part = curve / (b.x - a.x), of_line = curve / line;
        const bool good = part > least && part < most && of_line > 0.25 && of_line < 4.0;
        return a.x + (good ? curve : line);
    }

    std::vector<ForceAt> beyond_; ///< nearest known places beyond the load, the nearest first
    int tries_ = 0;               ///< number of steps since the way to the load was halved
    double uncut_ = 0.0;          ///< largest length of a step before it was cut, Å
    bool was_cut_ = false;
};

} // namespace asperity
