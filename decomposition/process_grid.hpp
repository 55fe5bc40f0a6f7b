// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Who owns what: the box is cut in x and y into px * py tiles, the same cut through all levels.
//
// Cuts run along nodes of the cut level c, the coarsest level that is tiled, so that each of its
// cells is whole on one rank; finer levels inherit the cut (their nodes double). Levels coarser
// than c are too small to cut and every rank holds them whole, computing the same numbers.
//
// Where the surface is transformed (waves.hpp), the box is cut into slabs of rows instead.
#pragma once

#include "decomposition/tile.hpp"

#include <string>
#include <vector>

namespace asperity {

class ProcessGrid {
public:
    /// sites: nodes of the finest level across the box; levels: number of levels of the block, of
    /// which level l has sites / 2^l nodes across. Throws std::invalid_argument if there are more
    /// ranks than tiles of at least two nodes.
    ProcessGrid(int ranks, int rank, int sites, int levels);
    /// One level cut into slabs of whole rows, as many on each rank to one row. Throws
    /// std::invalid_argument where there are more ranks than rows.
    static ProcessGrid slabs(int ranks, int rank, int sites);

    int ranks() const { return px_ * py_; }
    int rank() const { return rank_; }
    int px() const { return px_; }
    int py() const { return py_; }
    /// Coarsest level that is cut; coarser ones are held by every rank.
    int cut_level() const { return cut_level_; }
    bool tiled(int level) const { return level <= cut_level_ && ranks() > 1; }

    Tile tile(int level) const { return tile(level, rank_); }
    Tile tile(int level, int rank) const;
    /// The part of a level above a rank's finest tile, whether the level is cut or not.
    Tile footprint(int level, int rank) const;
    /// Rank of the tile (dx, dy) tiles away, periodic.
    int neighbour(int dx, int dy) const;
    /// Share of the largest tile over the mean, minus one.
    double imbalance() const;
    std::string describe() const;

private:
    ProcessGrid() = default;
    int px_ = 1, py_ = 1, rank_ = 0, sites_ = 0, cut_level_ = 0;
    std::vector<int> cut_x_, cut_y_; // boundaries in nodes of the cut level
};

} // namespace asperity
