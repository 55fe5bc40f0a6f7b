// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/drive.hpp"

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

Drive::Drive(const DriveOptions& options)
    : options_(options), leg_(options.approach   ? Leg::approach
                              : options.pull_off ? Leg::pull_off
                                                 : Leg::done) {}

double Drive::velocity(double t) const {
    if (leg_ == Leg::approach) return -options_.velocity;
    // From -v (after an approach) or rest to +v along half a cosine.
    const double from = options_.approach ? -options_.velocity : 0.0, to = options_.velocity;
    const double s = options_.ramp > 0.0 ? (t - turned_at_) / options_.ramp : 1.0;
    if (s >= 1.0) return to;
    return from + (to - from) * 0.5 * (1.0 - std::cos(std::numbers::pi * s));
}

bool Drive::observe(double t, double force, bool out_of_reach) {
    if (leg_ == Leg::approach) {
        if (force < 0.0) attracted_ = true;
        // With a load to reach, or a substrate that does not attract, the first contact is the way
        // there.
        if (!attracted_ && force <= options_.load_force) return false;
        if (force < options_.load_force || (attracted_ && force < 0.0)) return false;
        leg_ = options_.pull_off ? Leg::pull_off : Leg::done;
        turned_at_ = t;
        return true;
    }
    if (leg_ == Leg::pull_off && out_of_reach) {
        leg_ = Leg::done;
        return true;
    }
    return false;
}

} // namespace asperity
