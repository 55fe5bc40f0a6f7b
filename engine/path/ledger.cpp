// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/ledger.hpp"

namespace asperity {

Works& Works::operator+=(const Works& more) {
    const auto add = [](std::optional<double>& to, const std::optional<double>& number) {
        to = to && number ? std::optional(*to + *number) : std::nullopt;
    };
    on_solids += more.on_solids;
    lateral += more.lateral;
    lost += more.lost;
    add(interface, more.interface);
    add(uncertainty, more.uncertainty);
    return *this;
}

Works Works::operator-(const Works& earlier) const {
    Works between = *this;
    between.on_solids -= earlier.on_solids;
    between.lateral -= earlier.lateral;
    between.lost -= earlier.lost;
    if (between.interface) *between.interface -= earlier.interface.value_or(0.0);
    return between;
}

std::optional<double> Ledger::per_area(const std::optional<double>& energy) const {
    return energy ? std::optional(per_area(*energy)) : std::nullopt;
}

void Ledger::conclude(std::size_t number, const StepRecord& now, const Works& works,
                      const std::optional<double>& kinetic) {
    const Segment& segment = case_.path[number];
    SegmentResults ended = results_.ended(number, segment, now, works.lateral);
    ended.work = per_area(works.on_solids);
    ended.lost = per_area(works.lost);
    ended.interface_work = per_area(works.interface);
    ended.uncertainty = per_area(works.uncertainty);
    results_.segments.push_back(ended);
    results_.begin_segment();

    if (since_apart_)
        *since_apart_ += works;
    else
        since_apart_ = works;
    if (segment.kind == Segment::approach) results_.approach = way(*since_apart_, -1.0, kinetic);
    if (segment.kind != Segment::pull_off) return;
    results_.pull_off = way(works, 1.0, kinetic);
    const double moving = kinetic.value_or(0.0);
    if (results_.approach.lost) // of what moved before the cycle its losses have taken a part
        results_.lost_in_cycle = per_area(since_apart_->lost + moving - moved_apart_);
    since_apart_.reset();
    moved_apart_ = moving;
}

/// sign: of the works, which are counted positive where the solids attract.
WayEnergies Ledger::way(const Works& works, double sign,
                        const std::optional<double>& kinetic) const {
    WayEnergies way;
    way.drive_work = sign * per_area(works.on_solids);
    if (works.interface) way.interface_work = -sign * per_area(*works.interface);
    way.uncertainty = per_area(works.uncertainty);
    if (case_.scene.drive.temperature > 0.0) return way; // heat goes both ways
    way.lost = per_area(works.lost);
    way.kinetic = per_area(kinetic);
    return way;
}

} // namespace asperity
