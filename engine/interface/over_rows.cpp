// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/over_rows.hpp"

#include "engine/options/sweep_limits.hpp"

#include <cmath>

namespace asperity {

Tile OverRows::atoms_under(const Tile& tile, double spacing, int atoms, double cutoff) {
    const double b = tile.sites * spacing / atoms, widest = cutoff + sideways_margin(spacing);
    const auto first = [&](int begin) {
        return static_cast<int>(std::floor(((begin + 0.5) * spacing - widest) / b));
    };
    const auto count = [&](int begin, int sites) {
        const double end = (begin + sites - 0.5) * spacing + widest;
        return static_cast<int>(std::ceil(end / b)) + 1 - first(begin);
    };
    return {first(tile.x0), first(tile.y0), count(tile.x0, tile.nx), count(tile.y0, tile.ny),
            atoms};
}

OverRows::OverRows(const HeightMap& map, const Tile& tile, double spacing,
                   const InterfaceOptions& options)
    : potential_(options.potential),
      reach_(map, tile, spacing, cutoff_of(potential_) + sideways_margin(spacing),
             sideways_margin(spacing), options.skip),
      heights_(map, atoms_under(tile, spacing, map.sites(), cutoff_of(potential_)), halo) {
    const Tile atoms = atoms_under(tile, spacing, map.sites(), cutoff_of(potential_));
    view_.heights = heights_.view();
    view_.i0 = atoms.x0;
    view_.j0 = atoms.y0;
    view_.reach = reach_.view();
    view_.map = map.view();
}

void OverRows::sweep_row(const InterfaceSites& sites, int y, SweepOptions how,
                         InterfaceSums& sums) const {
    interface_kernels().rows.of[how.observe](sites, view_, potential_, y, y + 1, sums);
}

} // namespace asperity
