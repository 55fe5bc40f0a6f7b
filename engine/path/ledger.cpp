// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/ledger.hpp"

#include <cmath>

namespace asperity {

Works Works::operator-(const Works& earlier) const {
    Works between = *this;
    between.on_solids -= earlier.on_solids;
    between.lateral -= earlier.lateral;
    between.dissipated_in_block -= earlier.dissipated_in_block;
    between.lost -= earlier.lost;
    if (between.stored) *between.stored -= earlier.stored.value_or(0.0);
    if (between.interface) *between.interface -= earlier.interface.value_or(0.0);
    return between;
}

std::optional<double> Ledger::per_area(const std::optional<double>& energy) const {
    return energy ? std::optional(per_area(*energy)) : std::nullopt;
}

void Ledger::conclude(std::size_t number, const StepRecord& now, const Works& works,
                      const std::optional<EnergyLeft>& left) {
    const Segment& segment = case_.path()[number];
    SegmentResults ended = results_.ended(number, segment, now, works.lateral,
                                          works.distance.value_or(std::abs(segment.amount)));
    ended.steady = works.steady;
    ended.work = per_area(works.on_solids);
    ended.lost = per_area(works.lost);
    if (case_.effects.branches) ended.dissipated_in_block = per_area(works.dissipated_in_block);
    ended.stored = per_area(works.stored);
    ended.settling = per_area(works.settling);
    ended.interface_work = per_area(works.interface);
    ended.uncertainty = per_area(works.uncertainty);
    if (left && !case_.effects.temperature) {
        ended.kinetic = per_area(left->kinetic);
        if (case_.effects.spring) ended.spring = per_area(left->spring);
    }
    results_.segments.push_back(ended);
    results_.begin_segment();

    lost_since_apart_ += works.lost;
    dissipated_in_block_since_apart_ += works.dissipated_in_block;
    if (segment.kind != Segment::pull_off) return;
    const double moving = left ? left->total() : 0.0;
    // A part of the energy that moved before the cycle is in its losses. Heat goes both ways.
    if (results_.last(Segment::approach) && !case_.effects.temperature)
        results_.lost_in_cycle = per_area(lost_since_apart_ + moving - moved_apart_);
    if (results_.last(Segment::approach) && case_.effects.branches)
        results_.dissipated_in_block_in_cycle = per_area(dissipated_in_block_since_apart_);
    lost_since_apart_ = dissipated_in_block_since_apart_ = 0.0;
    moved_apart_ = moving;
}

} // namespace asperity
