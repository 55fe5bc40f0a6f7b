// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/over_lattice.hpp"

#include "engine/options/sweep_limits.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity {

// A sixteenth of a spacing is fine enough a cut and keeps the table in the nearest cache.
OverLattice::Offsets::Offsets(double cutoff, double spacing) : cuts_per_length(16.0 / spacing) {
    const double widest = cutoff + sideways_margin(spacing);
    half = static_cast<int>(std::ceil(widest / spacing + 0.5));
    cuts = static_cast<int>(widest * cuts_per_length) + 2;
}

OverLattice::OverLattice(const HeightMap& map, const Tile& tile, double spacing,
                         const InterfaceOptions& options)
    : potential_(options.potential),
      reach_(map, tile, spacing, cutoff_of(potential_) + sideways_margin(spacing),
             sideways_margin(spacing), options.skip),
      heights_(map, tile, halo(cutoff_of(potential_), spacing)) {
    const bool formula = !std::holds_alternative<Tabulated>(potential_);
    mixed_ = options.mixed && formula;
    if (mixed_ || (options.mixed_on_request && formula)) make_fixed(tile);
    const Offsets offsets(cutoff_of(potential_), spacing);
    for (int k = 0; k < offsets.cuts; ++k) {
        const double lateral = k / offsets.cuts_per_length + 1e-9 * spacing;
        for (int n = 1; n <= offsets.half; ++n) {
            const auto within = [&](int m) {
                const double x = (m - 0.5) * spacing, y = (n - 0.5) * spacing;
                return std::sqrt(x * x + y * y) < lateral;
            };
            int m = 0;
            while (m < offsets.half && within(m + 1))
                ++m;
            columns_.push_back(m);
        }
    }
    view_.heights = heights_.view();
    if (!fixed_.empty()) view_.fixed = std::as_const(fixed_).plane(0);
    view_.columns = columns_.data();
    view_.half_offsets = offsets.half;
    view_.cut_count = offsets.cuts;
    view_.cuts_per_length = offsets.cuts_per_length;
    view_.reach = reach_.view();
    view_.map = map.view();
}

std::size_t OverLattice::bytes() const {
    return heights_.bytes() + (fixed_.empty() ? 0 : fixed_.bytes()) + reach_.bytes() +
           columns_.size() * sizeof(std::int32_t);
}

/// Makes heights in units of fixed_quantum, for the mixed sweep.
void OverLattice::make_fixed(const Tile& tile) {
    const int halo = heights_.field().halo();
    fixed_ = Field<std::int32_t>(tile, 1, halo);
    const PlaneView<const double> from = heights_.field().plane(0);
    const PlaneView<std::int32_t> to = fixed_.plane(0);
#pragma omp parallel for schedule(static)
    for (int y = -halo; y < tile.ny + halo; ++y)
        for (int x = -halo; x < tile.nx + halo; ++x)
            to(x, y) = static_cast<std::int32_t>(
                std::nearbyint(std::max(from(x, y), -fixed_depth) / fixed_quantum));
}

void OverLattice::sweep_row(const InterfaceSites& sites, int y, SweepOptions how,
                            InterfaceSums& sums) const {
    const InterfaceKernels::LatticeSweeps& kernels = interface_kernels().lattice;
    const bool mixed = mixed_ || (how.mixed_precision && !fixed_.empty());
    (mixed ? kernels.mixed : kernels.in_double)[how.observe](sites, view_, potential_, y, y + 1,
                                                             sums);
}

} // namespace asperity
