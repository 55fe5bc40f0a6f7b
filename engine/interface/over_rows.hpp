// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A substrate of one layer with any spacing, swept by rows of atoms.
#pragma once

#include "engine/interface/height_map.hpp"
#include "engine/options/interface_options.hpp"

namespace asperity {

/// A substrate of one layer with any spacing.
class OverRows {
public:
    /// Makes the tables. spacing: spacing of the sites, Å.
    OverRows(const HeightMap& map, const Tile& tile, double spacing,
             const InterfaceOptions& options);

    /// Computes the forces on row y of the sites and adds to the sums. how: options of the sweep.
    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;

    /// Returns a view of the tables for the sweep.
    const RowSubstrate& view() const { return view_; }
    std::size_t bytes() const { return heights_.bytes() + reach_.bytes(); }

    /// Returns the tile of atoms within the cutoff and the margin of a tile's sites. atoms: number
    /// of atoms across the box. The halo adds room for a register and one more row.
    static Tile atoms_under(const Tile& tile, double spacing, int atoms, double cutoff);
    static constexpr int halo = interface_block;

private:
    PairPotential potential_;
    ReachTable reach_;
    TileHeights heights_;
    RowSubstrate view_;
};

} // namespace asperity
