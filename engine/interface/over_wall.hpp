// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A wall in place of atoms (kernels/wall_law.hpp). It acts along z alone. The height below site
// (x, y) is value (x, y) of the surface, which has the block's lattice.
#pragma once

#include "decomposition/field.hpp"
#include "engine/interface/height_map.hpp"
#include "engine/interface/sliding_map.hpp"
#include "engine/options/interface_options.hpp"

#include <cstddef>
#include <optional>

namespace asperity {

/// A wall in place of atoms.
class OverWall {
public:
    /// Makes the wall below the sites of a tile. free_edges: the map is below the first N x N of
    /// 2N x 2N sites, and the others have no solid below them; slides: the block is moved over the
    /// wall, which has no free edges.
    OverWall(const HeightMap& map, const Tile& tile, const WallLaw& law, bool free_edges = false,
             bool slides = false);

    /// Moves the block to (x, y) over the wall, Å. Only if it slides.
    void slide_to(double x, double y) { sliding_->slide_to(x, y); }
    /// Returns the derivative of height() with respect to the place along x or y. Only if it
    /// slides.
    PlaneView<const double> slope(std::size_t axis) const { return sliding_->slope(axis); }

    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;

    /// Moves a row of sites to their equilibria, each under its own force.
    WallSums rest_row(const WallRow<double>& row, const WallRule& rule, int sites) const {
        return interface_kernels().wall.rest_double(law_, row, rule, sites);
    }
    WallSums rest_row(const WallRow<float>& row, const WallRule& rule, int sites) const {
        return interface_kernels().wall.rest_single(law_, row, rule, sites);
    }

    /// Returns the height of the wall below each site of the tile, Å; not a number where there is
    /// no solid.
    PlaneView<const double> height() const {
        return sliding_ ? sliding_->height() : height_.plane(0);
    }
    std::size_t bytes() const { return sliding_ ? sliding_->bytes() : height_.bytes(); }

private:
    Field<double> height_; ///< empty if it slides
    std::optional<SlidingMap> sliding_;
    WallLaw law_;
};

} // namespace asperity
