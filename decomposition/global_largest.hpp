// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The site of the whole box at which a value is largest: the same site on any number of ranks.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/tile.hpp"

#include <cmath>
#include <limits>

namespace asperity {

/// Largest value of the sites, and its site.
struct LargestSite {
    double value = 0.0;
    int x = 0, y = 0; ///< site in the whole box
};

/// Returns the site of the whole box with the largest value(x, y) >= 0, called for the sites of the
/// rank's tile. A value that is not finite counts as the largest. If values are equal, the first
/// site, row by row, is returned. Collective.
template <class Value>
LargestSite global_largest(const Communicator& ranks, const Tile& tile, const Value& value) {
    double worst = -1.0;
    int wx = 0, wy = 0;
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x) {
            double here = value(x, y);
            if (!std::isfinite(here)) here = std::numeric_limits<double>::max();
            if (here > worst) worst = here, wx = x + tile.x0, wy = y + tile.y0;
        }
    const double most = ranks.max(worst), sites = tile.sites;
    const double place = ranks.max(most == worst ? sites * sites - (wy * sites + wx) : 0.0);
    const auto index = static_cast<long long>(sites * sites - place);
    return {most, static_cast<int>(index % tile.sites), static_cast<int>(index / tile.sites)};
}

} // namespace asperity
