// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The substrate's heights on a square lattice, in the rows that a tile of sites needs; used by all
// substrates of one layer.
#pragma once

#include "decomposition/field.hpp"
#include "decomposition/tile.hpp"
#include "engine/options/interface_options.hpp"
#include "engine/options/substrate.hpp"
#include "kernels/substrates.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace asperity {

/// Returns the number of blocks of sites in a row of a tile; the reach is bounded per block.
inline int blocks_in_row(const Tile& tile) {
    return (tile.nx + interface_block - 1) / interface_block;
}

/// Rows of a periodic map.
struct RowRange {
    int first = 0, count = 0;
};

/// Heights of the substrate's atoms on a square lattice, periodic.
class HeightMap {
public:
    /// Copies the heights that a tile needs. sites: number of the block's sites across the box;
    /// spacing: spacing of the block's sites, Å; slides: the block slides over the substrate, or
    /// over the second solid of a pair, and the tile needs all heights. Collective.
    HeightMap(const Surface& substrate, const Tile& tile, int sites, double spacing,
              const InterfaceOptions& options);

    /// Returns the rows of the map that a tile needs: over a wall those of its sites, over atoms
    /// those within the cutoff and farthest_sideways() of them, all if the block slides. atoms:
    /// number of atoms across the box; between: their spacing, Å.
    static RowRange rows_under(const Tile& tile, double spacing, int atoms, double between,
                               const InterfaceOptions& options);

    /// Returns the height of atom (i, j), which stands at (i b, j b), Å; NaN if its row is not
    /// held.
    double at(int i, int j) const {
        const int row = periodic(j - rows_.first, sites_);
        if (row >= rows_.count) return std::numeric_limits<double>::quiet_NaN();
        return height_[static_cast<std::size_t>(row) * static_cast<std::size_t>(sites_) +
                       static_cast<std::size_t>(periodic(i, sites_))];
    }
    int sites() const { return sites_; }        ///< returns the number of atoms across the box
    double spacing() const { return spacing_; } ///< returns b, Å
    /// Returns the largest height, Å; an upper bound if the second solid of a pair slides.
    double highest() const { return highest_; }
    /// Returns the part of the heights that moves under a block that slides: those of the second
    /// solid of a pair, or all.
    const std::vector<double>& moving() const { return counter_.empty() ? height_ : counter_; }
    /// Returns true if a part of the heights belongs to the block and does not move under it.
    bool is_pair() const { return !counter_.empty(); }
    /// Returns the radius of the spherical cap in the heights, Å; 0: none.
    double radius() const { return radius_; }
    SubstrateMap view() const {
        return {height_.data(), sites_, spacing_, rows_.first, rows_.count};
    }
    const std::vector<double>& heights() const { return height_; } ///< returns the rows held

    /// Moves all atoms by (i, j) spacings b. Requires that the map slides.
    void shift(int i, int j);
    /// Frees the heights, for a substrate that has its own copy of them.
    void free_heights();

    /// Returns the height at (x, y), Å, interpolated bilinearly between the four nearest atoms.
    double between(double x, double y) const;
    /// Calls visit(lateral distance, height), both in Å, for every atom within the lateral distance
    /// `reach` of (x, y), Å.
    template <class Visit>
    void around(double x, double y, double reach, Visit visit) const {
        const auto first = [&](double at) {
            return static_cast<int>(std::floor((at - reach) / spacing_));
        };
        const auto last = [&](double at) {
            return static_cast<int>(std::ceil((at + reach) / spacing_));
        };
        for (int j = first(y); j <= last(y); ++j)
            for (int i = first(x); i <= last(x); ++i) {
                const double dx = x - i * spacing_, dy = y - j * spacing_;
                const double lateral = std::sqrt(dx * dx + dy * dy);
                if (lateral <= reach) visit(lateral, at(i, j));
            }
    }

private:
    int sites_;
    double spacing_, highest_, radius_;
    RowRange rows_;
    std::vector<double> height_;  ///< rows_ of the map, Å
    std::vector<double> counter_; ///< heights of a second solid that slides; empty: none
};

/// Largest and smallest heights of the substrate around each block of sites, for rings of lateral
/// distance (ReachBounds).
class ReachTable {
public:
    /// Makes the tables. widest: lateral distance of the outermost ring, Å; margin: lateral
    /// displacement of sites allowed for, Å; skip: false sets bounds with which no pair is skipped.
    ReachTable(const HeightMap& map, const Tile& tile, double spacing, double widest, double margin,
               bool skip);

    ReachBounds view() const; ///< returns a view of the tables for the sweep
    const std::vector<double>& highest() const { return highest_; }
    const std::vector<double>& lowest() const { return lowest_; }
    std::size_t bytes() const { return (highest_.size() + lowest_.size()) * sizeof(double); }
    /// Returns the number of bounds in each of the two tables.
    static std::size_t size(const Tile& tile) {
        return static_cast<std::size_t>(blocks_in_row(tile)) * static_cast<std::size_t>(tile.ny) *
               interface_rings;
    }

private:
    ReachBounds bounds_;
    std::vector<double> highest_, lowest_;
};

/// Heights of a tile of atoms with a halo, relative to the highest atom, for the sweeps.
class TileHeights {
public:
    /// Copies the heights. halo: width of the halo, atoms.
    TileHeights(const HeightMap& map, const Tile& atoms, int halo);

    SubstrateHeights view() const { return {field_.plane(0), datum_}; }
    const Field<double>& field() const { return field_; }
    std::size_t bytes() const { return field_.bytes(); }

private:
    Field<double> field_;
    double datum_;
};

} // namespace asperity
