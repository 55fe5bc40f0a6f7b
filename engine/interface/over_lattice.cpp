// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/over_lattice.hpp"

#include "engine/interface/sweep_limits.hpp"

#include <cmath>

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
      heights_(map, tile, Offsets(cutoff_of(potential_), spacing).half + 1,
               options.reads_in_double(), options.reads_in_mixed()) {
    const Offsets offsets(cutoff_of(potential_), spacing);
    for (int k = 0; k < offsets.cuts; ++k) {
        const double lateral = k / offsets.cuts_per_length + 1e-9;
        for (int n = 1; n <= offsets.half; ++n) {
            const auto within = [&](int m) {
                return std::hypot((m - 0.5) * spacing, (n - 0.5) * spacing) < lateral;
            };
            int m = 0;
            while (m < offsets.half && within(m + 1))
                ++m;
            columns_.push_back(m);
        }
    }
    view_.heights = heights_.view();
    view_.columns = columns_.data();
    view_.half_offsets = offsets.half;
    view_.cut_count = offsets.cuts;
    view_.cuts_per_length = offsets.cuts_per_length;
    view_.reach = reach_.view();
    view_.map = map.view();
}

void OverLattice::sweep_row(const InterfaceSites& sites, int y, SweepOptions how,
                            InterfaceSums& sums) const {
    interface_kernels().lattice(how)(sites, view_, potential_, y, y + 1, sums);
}

} // namespace asperity
