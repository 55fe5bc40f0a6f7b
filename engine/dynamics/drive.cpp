// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

std::string_view name(Leg leg) {
    switch (leg) {
    case Leg::approach:
        return "approach";
    case Leg::pull_off:
        return "pull-off";
    case Leg::done:
        break;
    }
    return "done";
}

bool out_of_reach(double top, double force, double strongest, double at_start) {
    return top >= 0.0 && std::abs(force) <= std::max(1e-6 * strongest, std::abs(at_start));
}

Drive::Drive(const DriveOptions& options)
    : options_(options), leg_(options.approach   ? Leg::approach
                              : options.pull_off ? Leg::pull_off
                                                 : Leg::done) {}

double Drive::velocity(double t) const {
    if (by_hand_) return *by_hand_;
    if (leg_ == Leg::approach) return -options_.velocity;
    // From -v (after an approach) or rest to +v along half a cosine.
    const double from = options_.approach ? -options_.velocity : 0.0, to = options_.velocity;
    const double s = options_.ramp > 0.0 ? (t - turned_at_) / options_.ramp : 1.0;
    if (s >= 1.0) return to;
    return from + (to - from) * 0.5 * (1.0 - std::cos(std::numbers::pi * s));
}

bool Drive::observe(double t, double force, bool gone) {
    if (by_hand_) return false;
    if (leg_ == Leg::approach) {
        // Through attraction (beyond the load, if that pulls) and back to the load; or, where
        // nothing attracts that much, pressed.
        // A force of exactly zero is no contact: a warm block's tip was in reach and left it again.
        if (force == 0.0) {
            attracted_ = false;
            return false;
        }
        const double load = options_.load_force;
        if (force < std::min(load, 0.0)) attracted_ = true;
        const bool back = attracted_ && force >= load;
        const bool pressed = force > std::max(load, 0.0);
        if (!back && !pressed) return false;
        leg_ = options_.pull_off ? Leg::pull_off : Leg::done;
        turned_at_ = t;
        return true;
    }
    if (leg_ == Leg::pull_off && gone) {
        leg_ = Leg::done;
        return true;
    }
    return false;
}

} // namespace asperity
