// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A substrate of any spacing: rows of atoms.
#pragma once

#include "engine/interface/height_map.hpp"
#include "engine/options/interface_options.hpp"

namespace asperity {

/// A substrate of any spacing.
class OverRows {
public:
    OverRows(const HeightMap& map, const Tile& tile, double spacing,
             const InterfaceOptions& options);

    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;

    /// Returns a view of this object's arrays.
    const RowSubstrate& view() const { return view_; }
    std::size_t bytes() const { return heights_.bytes() + reach_.bytes(); }

    /// Returns the atoms, so many across the box, within the cutoff and the margin of a tile's
    /// sites. Their halo has room for a register, and a row more.
    static Tile atoms_under(const Tile& tile, double spacing, int atoms, double cutoff);
    static constexpr int halo = interface_block;

private:
    PairPotential potential_;
    ReachTable reach_;
    TileHeights heights_;
    RowSubstrate view_;
};

} // namespace asperity
