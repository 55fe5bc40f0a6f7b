// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/process_grid.hpp"

#include "kernels/views.hpp"

#include <algorithm>
#include <stdexcept>

namespace asperity {

namespace {

/// Cuts n cells into p runs whose lengths differ by at most one.
std::vector<int> even_cuts(int n, int p) {
    std::vector<int> cut(static_cast<std::size_t>(p) + 1);
    for (int i = 0; i <= p; ++i)
        cut[static_cast<std::size_t>(i)] = static_cast<int>(static_cast<long long>(n) * i / p);
    return cut;
}

/// Returns the number of nodes of the largest tile over that of the mean tile.
double fullest(int n, int px, int py) {
    const auto largest = [n](int p) -> double {
        const int rounded_up = (n + p - 1) / p;
        return rounded_up;
    };
    return largest(px) * largest(py) * px * py / (static_cast<double>(n) * n);
}

} // namespace

ProcessGrid::ProcessGrid(int ranks, int rank, int sites, int levels) : rank_(rank), sites_(sites) {
    // Shortest perimeter, and rows kept long where that ties.
    py_ = ranks;
    for (int p = 1; p <= ranks; ++p)
        if (ranks % p == 0 && p <= ranks / p) px_ = p, py_ = ranks / p;
    const int longest = std::max(px_, py_);
    if (ranks > 1 && sites / longest < halo_width)
        throw std::invalid_argument(
            "a surface of " + std::to_string(sites) + " x " + std::to_string(sites) +
            " sites cannot be cut into " + std::to_string(px_) + " x " + std::to_string(py_) +
            " tiles, because a tile needs at least " + std::to_string(halo_width) +
            " sites each way; use fewer ranks");
    // The coarser the cut, the more levels are shared out; but an uneven cut costs on the finest
    // level, where the work is. Take the coarsest cut within 2 % of the best balance.
    cut_level_ = 0;
    if (ranks == 1) {
        cut_level_ = levels - 1;
    } else {
        const double best = fullest(sites, px_, py_);
        for (int l = 1; l < levels; ++l) {
            const int n = sites >> l;
            if (n / longest < halo_width || n << l != sites) break;
            if (fullest(n, px_, py_) <= 1.02 * best) cut_level_ = l;
        }
    }
    cut_x_ = even_cuts(sites >> cut_level_, px_);
    cut_y_ = even_cuts(sites >> cut_level_, py_);
}

ProcessGrid ProcessGrid::slabs(int ranks, int rank, int sites) {
    if (ranks > sites)
        throw std::invalid_argument("a surface of " + std::to_string(sites) +
                                    " rows cannot be cut into " + std::to_string(ranks) +
                                    " slabs; use fewer ranks");
    ProcessGrid grid;
    grid.py_ = ranks;
    grid.rank_ = rank;
    grid.sites_ = sites;
    grid.cut_x_ = {0, sites};
    for (int r = 0; r <= ranks; ++r)
        grid.cut_y_.push_back(static_cast<int>(static_cast<long long>(sites) * r / ranks));
    return grid;
}

Tile ProcessGrid::footprint(int level, int rank) const {
    const auto ix = static_cast<std::size_t>(rank % px_), iy = static_cast<std::size_t>(rank / px_);
    const int n = sites_ >> level;
    // In nodes of this level; above the cut level a boundary may fall between nodes: the node
    // belongs to the tile that holds its finest node.
    const auto at = [&](int cut) {
        const int finest = cut << cut_level_;
        return (finest + (1 << level) - 1) >> level;
    };
    const int x0 = at(cut_x_[ix]), x1 = at(cut_x_[ix + 1]);
    const int y0 = at(cut_y_[iy]), y1 = at(cut_y_[iy + 1]);
    return {x0, y0, x1 - x0, y1 - y0, n};
}

Tile ProcessGrid::tile(int level, int rank) const {
    const int n = sites_ >> level;
    if (!tiled(level)) return {0, 0, n, n, n};
    return footprint(level, rank);
}

int ProcessGrid::neighbour(int dx, int dy) const {
    const int ix = periodic(rank_ % px_ + dx, px_), iy = periodic(rank_ / px_ + dy, py_);
    return iy * px_ + ix;
}

double ProcessGrid::imbalance() const { return fullest(sites_ >> cut_level_, px_, py_) - 1.0; }

std::string ProcessGrid::describe() const {
    if (ranks() == 1) return "one rank";
    return std::to_string(px_) + " x " + std::to_string(py_) + " tiles, levels 0 to " +
           std::to_string(cut_level_) + " cut";
}

} // namespace asperity
