// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The tiles of the ranks: the box is cut in x and y into px * py tiles, with the same cuts through
// all levels.
//
// Cuts run along nodes of the cut level c, the coarsest level that is tiled, so that each of its
// cells is whole on one rank; finer levels have the same cuts, with twice as many nodes per level.
// Levels coarser than c are too small to cut; every rank holds them whole and computes the same
// numbers.
//
// For transforms of the surface (waves.hpp) the box is cut into slabs of rows instead.
#pragma once

#include "decomposition/tile.hpp"

#include <string>
#include <vector>

namespace asperity {

/// The cut of the box into tiles, one per rank.
class ProcessGrid {
public:
    /// Cuts the box into tiles. sites: nodes of the finest level across the box; levels: number of
    /// levels of the block; level l has sites / 2^l nodes across. Throws std::invalid_argument if
    /// there are more ranks than tiles of at least two nodes.
    ProcessGrid(int ranks, int rank, int sites, int levels);
    /// Cuts one level into slabs of whole rows, whose numbers of rows differ by at most one. Throws
    /// std::invalid_argument if there are more ranks than rows.
    static ProcessGrid slabs(int ranks, int rank, int sites);

    int ranks() const { return px_ * py_; }
    int rank() const { return rank_; }
    int px() const { return px_; }
    int py() const { return py_; }
    /// Returns the coarsest level that is cut; every rank holds coarser levels whole.
    int cut_level() const { return cut_level_; }
    bool tiled(int level) const { return level <= cut_level_ && ranks() > 1; }

    /// Returns this rank's tile of a level, the whole level if it is not cut.
    Tile tile(int level) const { return tile(level, rank_); }
    /// Returns a rank's tile of a level.
    Tile tile(int level, int rank) const;
    /// Returns the part of a level above a rank's finest tile, for cut and whole levels.
    Tile footprint(int level, int rank) const;
    /// Returns the rank whose tile is (dx, dy) tiles away, with periodic boundaries.
    int neighbour(int dx, int dy) const;
    /// Returns the load imbalance: the size of the largest tile divided by the mean, minus one.
    double imbalance() const;
    std::string describe() const; ///< returns the cut as text for the opening of a run

private:
    ProcessGrid() = default;
    int px_ = 1, py_ = 1, rank_ = 0, sites_ = 0, cut_level_ = 0;
    std::vector<int> cut_x_, cut_y_; // boundaries in nodes of the cut level
};

} // namespace asperity
