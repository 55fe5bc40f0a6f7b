// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The tiles of the ranks: the box is cut in x and y into px * py tiles, the same cut through all
// levels.
//
// Cuts run along nodes of the cut level c, the coarsest level that is tiled, so that each of its
// cells is whole on one rank; finer levels inherit the cut (their nodes double). Levels coarser
// than c are too small to cut and every rank holds them whole, computing the same numbers.
//
// For transforms of the surface (waves.hpp) the box is cut into slabs of rows instead.
#pragma once

#include "decomposition/tile.hpp"

#include <string>
#include <vector>

namespace asperity {

/// The cut of the box into tiles, one a rank.
class ProcessGrid {
public:
    /// Cuts the box into tiles. sites: nodes of the finest level across the box; levels: number of
    /// levels of the block; level l has sites / 2^l nodes across. Throws std::invalid_argument if
    /// there are more ranks than tiles of at least two nodes.
    ProcessGrid(int ranks, int rank, int sites, int levels);
    /// Returns the cut of one level into slabs of whole rows; the numbers of rows differ by at most
    /// one. Throws std::invalid_argument if there are more ranks than rows.
    static ProcessGrid slabs(int ranks, int rank, int sites);

    int ranks() const { return px_ * py_; }
    int rank() const { return rank_; }
    int px() const { return px_; }
    int py() const { return py_; }
    /// Returns the coarsest level that is cut; every rank holds the coarser ones.
    int cut_level() const { return cut_level_; }
    bool tiled(int level) const { return level <= cut_level_ && ranks() > 1; }

    Tile tile(int level) const { return tile(level, rank_); }
    Tile tile(int level, int rank) const;
    /// Returns the part of a level above a rank's finest tile, whether the level is cut or not.
    Tile footprint(int level, int rank) const;
    /// Returns the rank of the tile (dx, dy) tiles away, periodic.
    int neighbour(int dx, int dy) const;
    /// Returns the size of the largest tile over the mean, minus one.
    double imbalance() const;
    std::string describe() const;

private:
    ProcessGrid() = default;
    int px_ = 1, py_ = 1, rank_ = 0, sites_ = 0, cut_level_ = 0;
    std::vector<int> cut_x_, cut_y_; // boundaries in nodes of the cut level
};

} // namespace asperity
