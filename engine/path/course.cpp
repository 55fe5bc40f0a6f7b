// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/course.hpp"

#include "engine/units.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace asperity {

namespace {

/// Share of the time of a quasi-static approach that goes in proportion to its way.
constexpr double even_share = 0.15;
/// Share of an approach's time that has passed at its largest attraction.
constexpr double at_strongest = 0.6;
/// Part of a segment from which its own pace alone says how long it takes.
constexpr double trusted_part = 0.2;
/// A changed estimate of the time left is followed within this share of the time so far.
constexpr double following = 0.15;
/// Most by which the time left grows, s a second: a larger estimate is come to in time.
constexpr double steepest = 3.0;
/// Most by which the part that is done is told to be larger than by the weights of the segments.
constexpr double ahead = 0.05;

/// Part of a segment that is told at most before its end.
constexpr double nearly = 0.97;

double clamped(double part) { return std::isfinite(part) ? std::clamp(part, 0.0, 1.0) : 0.0; }

/// Returns the expected times of the segments: of a dynamic path the times of the drive, else in
/// units of an approach.
std::vector<double> weights_of(const Case& c, const ExpectedPath& expected, double reach) {
    std::vector<double> weights;
    for (std::size_t i = 0; i < c.path().size(); ++i) {
        const Segment& segment = c.path()[i];
        const double way = expected.ways[i];
        double weight = 0.1;
        if (c.effects.dynamic)
            weight = segment.kind == Segment::hold    ? segment.amount
                     : segment.kind == Segment::relax ? 0.0
                                                      : way / c.simulation.drive.velocity;
        else if (segment.kind == Segment::approach || segment.kind == Segment::pull_off)
            weight = 1.0;
        else if (segment.kind == Segment::slide)
            weight = way / (3.0 * reach);
        else if (segment.kind == Segment::hold || segment.kind == Segment::relax)
            weight = 0.3;
        else
            weight = std::clamp(way / (3.0 * reach), 0.05, 1.0);
        weights.push_back(std::max(weight, 1e-9));
    }
    return weights;
}

} // namespace

Course::Course(const Case& c, double rms, double start)
    : case_(c), expected_(expected_path(c, start)),
      reach_(rms + (c.largest_tension > 0.0 ? c.flat.work_of_adhesion / units::milli_per_unit /
                                                  (c.largest_tension * units::gigapascal)
                                            : c.flat.separation)),
      contact_(c.flat.separation), weights_(weights_of(c, expected_, reach_)) {}

void Course::begin(std::size_t segment, const StepRecord& now, double seconds) {
    if (begun_ && from_beginning_ && segment > segment_) {
        auto& [weight, spent] = ended_[case_.path()[segment_].kind];
        weight += weights_[segment_];
        spent += seconds - first_seconds_;
    }
    from_beginning_ = begun_ || now.step == 0;
    if (!begun_ && now.step > 0) // resumed
        base_ = std::accumulate(weights_.begin(),
                                weights_.begin() + static_cast<std::ptrdiff_t>(segment), 0.0) /
                std::accumulate(weights_.begin(), weights_.end(), 0.0);
    if (!begun_) start_time_ = now.time;
    begun_ = true;
    segment_ = segment;
    first_ = now;
    first_seconds_ = seconds;
    strongest_ = part_ = 0.0;
    if (case_.path()[segment].kind == Segment::approach) descent_.clear();
}

/// Returns the place along approach and pull-off, Å: of what the drive moves.
double Course::place(const StepRecord& now) const {
    return case_.simulation.drive.control == Control::mean_height ? now.mean_height : now.drive;
}

/// Returns the share of an approach's time at which the last one came to this place, 0 to 1.
double Course::profile(double place) const {
    const double all = descent_.back().second;
    if (!(all > 0.0) || place <= descent_.back().first) return 1.0;
    const auto at = std::find_if(descent_.begin(), descent_.end(),
                                 [&](const auto& one) { return one.first <= place; });
    if (at == descent_.begin()) return 0.0;
    const auto [above, earlier] = *std::prev(at);
    return std::lerp(earlier, at->second, (above - place) / (above - at->first)) / all;
}

double Course::part_of_approach(const StepRecord& now) {
    const double way = std::max(expected_.ways[segment_], 1e-9);
    const double even = clamped((first_.top - now.top) / way);
    if (case_.effects.dynamic) return even;
    const auto near = [&](double height) {
        return std::exp(-std::max(0.0, height - contact_) / reach_);
    };
    const double far = near(first_.mean_height);
    double part = even_share * even +
                  (1.0 - even_share) * clamped((near(now.mean_height) - far) / (1.0 - far));
    strongest_ = std::max(strongest_, -now.force);
    if (strongest_ > 0.0 && -now.force < 0.98 * strongest_)
        part = std::max(part, at_strongest +
                                  (1.0 - at_strongest) * clamped(1.0 + now.force / strongest_));
    return part;
}

double Course::part_of_pull_off(const StepRecord& now) const {
    if (case_.effects.dynamic || descent_.size() < 3)
        return clamped((now.top - first_.top) /
                       std::max({1e-9, -first_.top, expected_.ways[segment_]}));
    const double from = profile(place(first_));
    return from > 0.0 ? clamped(1.0 - profile(place(now)) / from) : 0.0;
}

/// Returns the part of the segment's time that has passed.
double Course::part_done(const StepRecord& now, double seconds) {
    const Segment& segment = case_.path()[segment_];
    const auto between = [](double from, double at, double to) {
        return from != to ? clamped((at - from) / (to - from)) : 0.0;
    };
    switch (segment.kind) {
    case Segment::approach:
        if (descent_.empty() || place(now) < descent_.back().first - 0.001 * reach_)
            descent_.emplace_back(place(now), seconds - first_seconds_);
        return part_of_approach(now);
    case Segment::pull_off:
        return part_of_pull_off(now);
    case Segment::load:
        return between(first_.force, now.force, segment.amount);
    case Segment::height:
        return between(first_.top, now.top,
                       first_.top + std::copysign(expected_.ways[segment_], now.top - first_.top));
    case Segment::hold:
        return between(0.0, now.time - first_.time, segment.amount);
    case Segment::slide: {
        const auto axis = static_cast<std::size_t>(segment.axis);
        return between(0.0, std::abs(now.slide[axis] - first_.slide[axis]),
                       std::abs(segment.amount));
    }
    case Segment::relax:
        break;
    }
    return 0.0;
}

/// Returns the seconds that a unit of weight takes: of segments of this kind, else of all that have
/// ended; 0: none has.
double Course::rate(Segment::Kind kind) const {
    const auto& [weight, spent] = ended_[kind];
    if (weight > 0.0) return spent / weight;
    double weights = 0.0, seconds = 0.0;
    for (const auto& [w, s] : ended_) {
        weights += w;
        seconds += s;
    }
    return weights > 0.0 ? seconds / weights : 0.0;
}

/// Estimates the time left, s, from the part of the segment that is done; negative: not known.
double Course::time_left(double part, double seconds) const {
    const auto& path = case_.path();
    const double spent = seconds - first_seconds_, own = weights_[segment_];
    double known = rate(path[segment_].kind);
    // A pull-off takes what its approach took.
    if (known == 0.0 && path[segment_].kind == Segment::pull_off) known = rate(Segment::approach);
    if (known == 0.0 && !(part > 0.005 && spent > 0.0)) return -1.0;
    const double trust = known == 0.0 ? 1.0 : std::min(1.0, part / trusted_part);
    const double measured = part > 0.0 ? spent * (1.0 - part) / part : 0.0;
    double left = trust * measured + (1.0 - trust) * known * own * (1.0 - part);
    const double pace = known > 0.0 ? known : spent / (part * own);
    for (std::size_t i = segment_ + 1; i < path.size(); ++i) {
        const double of_kind = rate(path[i].kind);
        left += weights_[i] * (of_kind > 0.0 ? of_kind : pace);
    }
    return left;
}

/// Estimates the time left of a dynamic path, s, whose steps take alike; negative: not known.
double Course::time_left_of_drive(const StepRecord& now, double seconds) const {
    const double simulated = now.time - start_time_, velocity = case_.simulation.drive.velocity;
    if (!(simulated > 0.0 && seconds > 0.0)) return -1.0;
    const Segment& segment = case_.path()[segment_];
    double left = (1.0 - part_) * weights_[segment_];
    if (segment.kind == Segment::pull_off) // the top may turn first
        left = std::max(0.0, -now.top) / velocity;
    for (std::size_t i = segment_ + 1; i < weights_.size(); ++i)
        left += weights_[i] + case_.simulation.drive.ramp;
    return left * seconds / simulated;
}

void Course::look(std::size_t segment, const StepRecord& now, double seconds) {
    if (!begun_ || segment != segment_) begin(segment, now, seconds);
    part_ = std::clamp(part_done(now, seconds), part_, std::max(part_, nearly));
    const double estimate =
        case_.effects.dynamic ? time_left_of_drive(now, seconds) : time_left(part_, seconds);
    const double since = seconds - last_seconds_;
    last_seconds_ = seconds;
    if (estimate < 0.0) return;
    if (left_ < 0.0) {
        left_ = estimate;
    } else {
        const double expected = std::max(0.0, left_ - since);
        left_ =
            std::min(expected + (estimate - expected) * -std::expm1(-since / (following * seconds)),
                     left_ + steepest * since);
    }
    const double all = seconds + left_;
    const double of_time = all > 0.0 ? base_ + (1.0 - base_) * seconds / all : base_;
    const auto here = weights_.begin() + static_cast<std::ptrdiff_t>(segment_);
    const double of_way = (std::accumulate(weights_.begin(), here, 0.0) + part_ * *here) /
                          std::accumulate(weights_.begin(), weights_.end(), 0.0);
    fraction_ = std::max(fraction_, std::min({of_time, of_way + ahead, 0.99}));
}

} // namespace asperity
