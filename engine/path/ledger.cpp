// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/ledger.hpp"

#include <cmath>

namespace asperity {

Works Works::operator-(const Works& earlier) const {
    Works between = *this;
    between.flows -= earlier.flows;
    between.lateral -= earlier.lateral;
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
    for (const io::EnergyTerm& row : io::energy_terms)
        if (is_given(row)) ended.energies[row.term] = per_area(works.flows[row.term]);
    ended.stored = per_area(works.stored);
    ended.settling = per_area(works.settling);
    ended.uncertainty = per_area(works.uncertainty);
    if (left && !case_.effects.temperature) {
        ended.energies[Term::kinetic] = per_area(left->kinetic);
        if (case_.effects.spring) ended.energies[Term::spring] = per_area(left->spring);
    }
    results_.segments.push_back(ended);
    results_.begin_segment();

    since_apart_ += works.flows;
    if (segment.kind != Segment::pull_off) return;
    const double moving = left ? left->total() : 0.0;
    // A part of the energy that moved before the cycle is in its losses.
    since_apart_[Term::lost] = since_apart_[Term::lost] + moving - left_in_motion_;
    if (results_.last(Segment::approach))
        for (const io::EnergyTerm& row : io::energy_terms)
            if (row.is_loss() && is_given(row) && !is_heat(row, case_.effects))
                results_.in_cycle[row.term] = per_area(since_apart_[row.term]);
    since_apart_ = {};
    left_in_motion_ = moving;
}

/// Returns true if segments of this case have the term.
bool Ledger::is_given(const io::EnergyTerm& row) const {
    // A held mean height does not jump at instabilities: its force is that of the interface.
    const bool held = case_.simulation.drive.control == Control::mean_height;
    return row.is_flow() &&
           (case_.effects.has(row.effect) || (row.term == Term::work_of_interface && held));
}

bool is_heat(const io::EnergyTerm& row, const Effects& effects) {
    return row.term == Term::lost && effects.temperature;
}

} // namespace asperity
