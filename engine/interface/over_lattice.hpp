// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A substrate of the block's own lattice: the neighbours of a site are known offsets.
#pragma once

#include "engine/interface/height_map.hpp"
#include "engine/interface/interface_options.hpp"

#include <cstdint>
#include <vector>

namespace asperity {

class OverLattice {
public:
    OverLattice(const HeightMap& map, const Tile& tile, double spacing,
                const InterfaceOptions& options);

    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;

    /// Of this object's arrays.
    const LatticeSubstrate& view() const { return view_; }
    const TileHeights& heights() const { return heights_; }
    const ReachTable& reach() const { return reach_; }
    const std::vector<std::int32_t>& columns() const { return columns_; }

    /// Offsets along half an axis, and lateral distances in the table of columns.
    struct Offsets {
        double cuts_per_length;
        int half, cuts;
        Offsets(double cutoff, double spacing);
        std::size_t table() const {
            return static_cast<std::size_t>(half) * static_cast<std::size_t>(cuts);
        }
    };

private:
    PairPotential potential_;
    ReachTable reach_;
    TileHeights heights_;
    std::vector<std::int32_t> columns_;
    LatticeSubstrate view_;
};

} // namespace asperity
