// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/over_wall.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace asperity {

OverWall::OverWall(const HeightMap& map, int across, const Tile& tile,
                   const InterfaceOptions& options)
    : law_(*options.wall) {
    const int n = map.sites();
    if (across != n)
        throw std::invalid_argument(fmt::format(
            "interface: a wall needs a height below each site, and {} x {} sites have {} x {}; "
            "take surface.lattice_ratio = 1",
            across, across, n, n));
    if (options.slides) {
        sliding_.emplace(map, tile);
        return;
    }
    height_ = Field<double>(tile, 1, 0);
    const PlaneView<double> below = height_.plane(0);
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x)
            below(x, y) = tile.x0 + x < n && tile.y0 + y < n
                              ? map.at(tile.x0 + x, tile.y0 + y)
                              : std::numeric_limits<double>::quiet_NaN();
    if (!options.adhesion) return;
    if (options.adhesion->sites != n)
        throw std::invalid_argument(
            fmt::format("interface: {} x {} sites have a field of {} x {} works of adhesion", n, n,
                        options.adhesion->sites, options.adhesion->sites));
    factor_ = Field<double>(tile, 1, 0);
    const PlaneView<double> factor = factor_.plane(0);
    for (int y = 0; y < tile.ny; ++y)
        for (int x = 0; x < tile.nx; ++x)
            factor(x, y) = options.adhesion_factor(tile.x0 + x, tile.y0 + y);
}

double OverWall::stiffness_at(int x, int y, double gap) const {
    return std::visit(
        [&]<class Law>(const Law& law) {
            if constexpr (ScaledBySite<Law>)
                if (!factor_.empty()) return law.scaled(factor_.plane(0)(x, y)).stiffness_at(gap);
            return law.stiffness_at(gap);
        },
        law_);
}

void OverWall::sweep_row(const InterfaceSites& sites, int y, SweepOptions how,
                         InterfaceSums& sums) const {
    interface_kernels().wall.sweep[how.observe](
        sites, height(), factor_.empty() ? PlaneView<const double>() : factor_.plane(0), law_, y,
        y + 1, sums);
}

} // namespace asperity
