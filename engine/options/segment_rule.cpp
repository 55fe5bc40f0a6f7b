// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/options/segment_rule.hpp"

#include "engine/units.hpp"
#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace asperity {

bool are_apart(bool beyond, double force, double strongest, double at_start) {
    return beyond && std::abs(force) <= std::max(1e-6 * strongest, std::abs(at_start));
}

void SegmentRule::begin(Segment::Kind kind, double load, bool down, double area, double force,
                        double slack) {
    kind_ = kind;
    load_ = load;
    down_ = down;
    area_ = area;
    attracted_ = kind == Segment::load && force < load - slack;
    strongest_ = std::max(-force, 0.0);
}

SegmentRule::End SegmentRule::look(double force, bool apart, double slack, bool beside) {
    strongest_ = std::max(strongest_, -force);
    if (!down_) {
        if (kind_ == Segment::load && beside && force <= load_ + slack) return End::at_load;
        if (!apart) return End::no;
        if (kind_ != Segment::load) return End::apart;
        if (load_ < -slack) refuse();
        return End::at_load; // an attraction too weak to be told from none
    }
    // A force of exactly zero is no contact: a warm block's tip was within the interaction range
    // and left it again.
    if (force == 0.0) {
        attracted_ = false;
        return End::no;
    }
    const bool there = beside && force >= aim() - slack;
    if (force < load_ - slack) attracted_ = true;
    if (!there) return End::no;
    if (load_ < -slack && !attracted_) refuse();
    return End::at_load;
}

double SegmentRule::aim() const { return !down_ || attracted_ ? load_ : std::max(load_, 0.0); }

void SegmentRule::refuse() const {
    const double to_megapascal = 1.0 / (area_ * units::megapascal);
    throw io::PhysicsError(
        fmt::format("the attraction did not reach the pull of {:.6g} MPa at which \"{}\" ends",
                    -load_ * to_megapascal, word(kind_)),
        fmt::format("the largest attraction on the way was {:.4g} MPa", strongest_ * to_megapascal),
        "take a smaller pull (drive.load, or the load of the segment)");
}

} // namespace asperity
