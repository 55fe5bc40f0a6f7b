// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A substrate with the block's own lattice, in which the neighbours of a site are at fixed offsets.
#pragma once

#include "engine/interface/height_map.hpp"
#include "engine/options/interface_options.hpp"

#include <cstdint>
#include <vector>

namespace asperity {

/// A substrate with the block's own lattice.
class OverLattice {
public:
    /// Makes the tables. spacing: lattice constant, Å.
    OverLattice(const HeightMap& map, const Tile& tile, double spacing,
                const InterfaceOptions& options);

    /// Computes the forces on row y of the sites and adds to the sums. how: options of the sweep.
    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;

    /// Returns a view of the tables for the sweep.
    const LatticeSubstrate& view() const { return view_; }
    const TileHeights& heights() const { return heights_; }
    const ReachTable& reach() const { return reach_; }
    const std::vector<std::int32_t>& columns() const { return columns_; }
    std::size_t bytes() const; ///< returns the memory of the tables, bytes

    /// Dimensions of the table of columns: the number of offsets along half an axis, and of lateral
    /// distances.
    struct Offsets {
        double cuts_per_length;
        int half, cuts;
        Offsets(double cutoff, double spacing);
        /// Returns the size of the table.
        std::size_t table() const {
            return static_cast<std::size_t>(half) * static_cast<std::size_t>(cuts);
        }
    };
    /// Returns the width of the halo of heights, with room for every offset and a whole register.
    static int halo(double cutoff, double spacing) { return Offsets(cutoff, spacing).half + 1; }

private:
    void make_fixed(const Tile& tile);

    PairPotential potential_;
    ReachTable reach_;
    TileHeights heights_;
    Field<std::int32_t> fixed_; ///< heights in fixed_quantum, if a sweep may be mixed
    bool mixed_ = false;        ///< all sweeps are mixed
    std::vector<std::int32_t> columns_;
    LatticeSubstrate view_;
};

} // namespace asperity
