// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/height_map.hpp"

#include "engine/options/sweep_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace asperity {

HeightMap::HeightMap(const Surface& substrate, const Tile& tile, int sites, double spacing,
                     const InterfaceOptions& options)
    : sites_(substrate.sites),
      spacing_(substrate.sites == sites ? spacing : sites * spacing / substrate.sites),
      radius_(substrate.radius), rows_(rows_under(tile, spacing, sites_, spacing_, options)) {
    const Bands bands = substrate.bands();
    if (substrate.height.size() != bands.size())
        throw std::invalid_argument(
            fmt::format("interface: a substrate of {} x {} atoms has {} heights", sites_, sites_,
                        substrate.height.size()));
    height_ = bands.fetch(substrate.height, rows_.first, rows_.count);
    highest_ = -HUGE_VAL;
    for (const double h : substrate.height) // holes do not count
        highest_ = h > highest_ ? h : highest_;
    highest_ = substrate.ranks.max(highest_);
    if (!options.slides || !substrate.pair) return;
    counter_ = bands.fetch(substrate.pair->counter_height, 0, sites_);
    highest_ = substrate.pair->own.highest + substrate.pair->counter.highest;
}

RowRange HeightMap::rows_under(const Tile& tile, double spacing, int atoms, double between,
                               const InterfaceOptions& options) {
    if (options.slides) return {0, atoms};
    // A wall may end below the first sites of the grid.
    if (options.wall) return {tile.y0, std::max(0, std::min(tile.ny, atoms - tile.y0))};
    const double reach = options.pairs().cutoff + farthest_sideways(spacing);
    const int more = interface_block + 1; // for the tables of OverRows
    const int first = static_cast<int>(std::floor(((tile.y0 + 0.5) * spacing - reach) / between));
    const int last =
        static_cast<int>(std::ceil(((tile.y0 + tile.ny - 0.5) * spacing + reach) / between));
    const int count = last + 1 - first + 2 * more;
    return count < atoms ? RowRange{first - more, count} : RowRange{0, atoms};
}

void HeightMap::free_heights() {
    rows_.count = 0;
    height_ = std::vector<double>();
    counter_ = std::vector<double>();
}

void HeightMap::shift(int i, int j) {
    std::vector<double> moved(height_.size());
    for (int y = 0; y < sites_; ++y)
        for (int x = 0; x < sites_; ++x)
            moved[static_cast<std::size_t>(y) * static_cast<std::size_t>(sites_) +
                  static_cast<std::size_t>(x)] = at(x - i, y - j);
    height_.swap(moved); // views of the old array are to be made anew
}

double HeightMap::between(double x, double y) const {
    const double px = x / spacing_, py = y / spacing_;
    const int i = static_cast<int>(std::floor(px)), j = static_cast<int>(std::floor(py));
    const double fx = px - std::floor(px), fy = py - std::floor(py);
    return (1.0 - fy) * ((1.0 - fx) * at(i, j) + fx * at(i + 1, j)) +
           fy * ((1.0 - fx) * at(i, j + 1) + fx * at(i + 1, j + 1));
}

namespace {
/// Highest height of a ring without atoms, Å.
constexpr double nothing_there = -1e30;
/// Widths over the spacing by which ranges are widened, so that rounding leaves no atom out.
constexpr double slack = 1e-3, slack_of_rings = 1e-9;
} // namespace

/// Makes the bounds. An atom counts in all rings between the nearest and the farthest point of the
/// block's row.
ReachTable::ReachTable(const HeightMap& map, const Tile& tile, double spacing, double widest,
                       double margin, bool skip)
    : highest_(size(tile), nothing_there), lowest_(size(tile), -nothing_there) {
    bounds_.offset_margin = margin;
    bounds_.ring_width = widest / interface_rings;
    bounds_.blocks = blocks_in_row(tile);
    const SubstrateMap whole = map.view();
    const double b = whole.spacing;
    const double reach = widest + slack * spacing;
    const auto ring = [&](double lateral) {
        return std::clamp(static_cast<int>(lateral / bounds_.ring_width), 0, interface_rings - 1);
    };
#pragma omp parallel for schedule(static)
    for (int y = 0; y < tile.ny; ++y)
        for (int block = 0; block < bounds_.blocks; ++block) {
            const std::size_t first =
                (static_cast<std::size_t>(y) * static_cast<std::size_t>(bounds_.blocks) +
                 static_cast<std::size_t>(block)) *
                interface_rings;
            double *highest = &highest_[first], *lowest = &lowest_[first];
            const int last = std::min(tile.nx, (block + 1) * interface_block) - 1;
            const double left = (tile.x0 + block * interface_block + 0.5) * spacing;
            const double right = (tile.x0 + last + 0.5) * spacing;
            const double site_y = (tile.y0 + y + 0.5) * spacing;
            const int j_last = static_cast<int>(std::ceil((site_y + reach) / b));
            for (int j = static_cast<int>(std::floor((site_y - reach) / b)); j <= j_last; ++j) {
                const double* row = whole.height + static_cast<std::ptrdiff_t>(
                                                       periodic(j - whole.first, whole.sites)) *
                                                       whole.sites;
                const double dy = site_y - j * b;
                if (std::abs(dy) > reach) continue;
                const double half = std::sqrt(reach * reach - dy * dy);
                const int i_last = static_cast<int>(std::floor((right + half) / b));
                for (int i = static_cast<int>(std::ceil((left - half) / b)); i <= i_last; ++i) {
                    const double x = i * b, h = row[periodic(i, whole.sites)];
                    const double nearest = std::max({left - x, x - right, 0.0});
                    const double farthest = std::min(std::max(x - left, right - x), half);
                    // An atom on the border of two rings counts in both.
                    const int from =
                        ring(std::sqrt(nearest * nearest + dy * dy) - slack_of_rings * spacing);
                    const int to =
                        ring(std::sqrt(farthest * farthest + dy * dy) + slack_of_rings * spacing);
                    for (int r = from; r <= to; ++r) {
                        highest[r] = std::max(highest[r], h);
                        lowest[r] = std::min(lowest[r], h);
                    }
                }
            }
        }
    if (!skip) {
        highest_.assign(size(tile), -nothing_there);
        lowest_.assign(size(tile), nothing_there);
    }
}

ReachBounds ReachTable::view() const {
    ReachBounds bounds = bounds_;
    bounds.highest = highest_.data();
    bounds.lowest = lowest_.data();
    return bounds;
}

TileHeights::TileHeights(const HeightMap& map, const Tile& atoms, int halo)
    : field_(atoms, 1, halo), datum_(map.highest()) {
    const PlaneView<double> height = field_.plane(0);
#pragma omp parallel for schedule(static)
    for (int y = -halo; y < atoms.ny + halo; ++y)
        for (int x = -halo; x < atoms.nx + halo; ++x)
            height(x, y) = map.at(atoms.x0 + x, atoms.y0 + y) - datum_;
}

} // namespace asperity
