// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/drive.hpp"

#include <algorithm>
#include <numbers>

namespace asperity {

double VelocityProfile::at(double t, double ramp) const {
    /// 0 to 1 along half a cosine.
    const auto risen = [&](double since) {
        const double s = ramp > 0.0 ? since / ramp : 1.0;
        return s >= 1.0 ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * s));
    };
    if (t >= cruise) return to - to * risen(t - cruise);
    const double r = risen(t);
    return r == 1.0 ? to : from + (to - from) * r;
}

double VelocityProfile::end(double ramp) const {
    if (to != 0.0) return cruise + ramp;
    return from != 0.0 ? ramp : 0.0;
}

VelocityProfile VelocityProfile::over(double distance, double from, double velocity, double ramp) {
    const double left = distance - 0.5 * from * ramp; // beyond where the first velocity fades out
    if (left == 0.0) return {from, 0.0, units::forever};
    const double fastest = ramp > 0.0 ? std::min(velocity, std::abs(left) / ramp) : velocity;
    return {from, std::copysign(fastest, left), std::abs(left) / fastest};
}

Drive::Drive(const DriveOptions& options) : options_(options) {
    if (options_.path.empty()) return;
    // A path that goes down from beyond the interaction range does so from the first step on.
    const Segment& first = options_.path.front();
    const bool down = first.kind == Segment::approach || first.kind == Segment::load;
    if (down) normal_ = {-options_.velocity, -options_.velocity, units::forever};
    if (first.kind == Segment::pull_off) normal_ = {0.0, options_.velocity, units::forever};
    begin_rule(0.0);
}

void Drive::begin_at(double height) {
    if (at_ == 0 && begun_ == 0.0 && now().kind == Segment::height)
        normal_ =
            VelocityProfile::over(now().amount - height, 0.0, options_.velocity, options_.ramp);
}

std::size_t Drive::segment() const {
    return std::min(at_, options_.path.empty() ? 0 : options_.path.size() - 1);
}

TopMotion Drive::motion(double t) const {
    const auto at = [&](const VelocityProfile& profile) {
        return profile.at(t - begun_, options_.ramp);
    };
    return {at(normal_), {at(slide_[0]), at(slide_[1])}};
}

void AveragedForce::look(double force, double time, double over) {
    const double part = 1.0 - std::exp(-(time - last) / over);
    last = time;
    if (force == 0.0) once = twice = square = 0.0; // nothing is within the interaction range
    once += part * (force - once);
    twice += part * (once - twice);
    square += part * ((force - mean()) * (force - mean()) - square);
}

bool Drive::observe(const Observation& now) {
    Observation step = now;
    if (options_.average_over > 0.0) {
        average_.look(now.force, now.time, options_.average_over);
        step.force = average_.mean();
    }
    if (at_ == options_.path.size() || !ended(step)) return false;
    ++at_;
    if (at_ < options_.path.size()) begin(step);
    return true;
}

/// Begins the next segment with the present velocity of the top plane.
void Drive::begin(const Observation& step) {
    const Segment& next = options_.path[at_];
    const double from = normal_.at(step.time - begun_, options_.ramp), v = options_.velocity;
    begun_ = step.time;
    slide_ = {VelocityProfile{}, VelocityProfile{}};
    switch (next.kind) {
    case Segment::approach:
        normal_ = {from, -v, units::forever};
        break;
    case Segment::pull_off:
        normal_ = {from, v, units::forever};
        break;
    case Segment::load:
        normal_ = {from, step.apart || step.force < next.amount ? -v : v, units::forever};
        break;
    case Segment::height:
        normal_ = VelocityProfile::over(next.amount - step.reference_height - step.at, from, v,
                                        options_.ramp);
        break;
    case Segment::slide:
        normal_ = {from, 0.0, units::forever};
        slide_[static_cast<std::size_t>(next.axis)] =
            VelocityProfile::over(next.amount, 0.0, v, options_.ramp);
        break;
    case Segment::hold:
    case Segment::relax:
        normal_ = {from, 0.0, units::forever};
        break;
    }
    begin_rule(step.force);
}

void Drive::begin_rule(double force) {
    const Segment& segment = options_.path[at_];
    const double load = segment.kind == Segment::load ? segment.amount : options_.load_force;
    rule_.begin(segment.kind, load, normal_.to < 0.0, options_.area, force);
}

bool Drive::ended(const Observation& step) {
    const Segment& now = options_.path[at_];
    const double since = step.time - begun_;
    switch (now.kind) {
    case Segment::height:
        return since >= normal_.end(options_.ramp);
    case Segment::hold:
        return since >= normal_.end(options_.ramp) + now.amount;
    case Segment::slide:
        return since >= slide_[static_cast<std::size_t>(now.axis)].end(options_.ramp);
    case Segment::relax:
        return true;
    default:
        return rule_.look(step.force, step.apart) != SegmentRule::End::no;
    }
}

} // namespace asperity
