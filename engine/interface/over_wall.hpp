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
#include <type_traits>

namespace asperity {

/// A wall in place of atoms.
class OverWall {
public:
    /// Makes the wall below the sites of a tile. With free edges the map is below the first N x N
    /// of 2N x 2N sites, and the others have no solid below them. Where the block slides over the
    /// wall, which then has no free edges, the map moves.
    OverWall(const HeightMap& map, const Tile& tile, const InterfaceOptions& options);

    /// Moves the block to (x, y) over the wall, Å. Only if it slides.
    void slide_to(double x, double y) { sliding_->slide_to(x, y); }
    /// Returns the derivative of height() with respect to the place along x or y. Only if it
    /// slides.
    PlaneView<const double> slope(std::size_t axis) const { return sliding_->slope(axis); }

    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;

    /// Moves the sites of row y to their equilibria, each under its own force. row: all but the
    /// wall's own data.
    template <class T>
    WallSums rest_row(int y, WallRow<T> row, const WallRule& rule, int sites) const {
        row.below = height().line(y);
        row.factor = factor_.empty() ? nullptr : factor_.plane(0).line(y);
        const WallKernels& kernels = interface_kernels().wall;
        if constexpr (std::is_same_v<T, double>)
            return kernels.rest_double(law_, row, rule, sites);
        else
            return kernels.rest_single(law_, row, rule, sites);
    }
    /// Returns -dF/dg of a site of the tile at this gap, eV/Å^2.
    double stiffness_at(int x, int y, double gap) const;

    /// Returns the height of the wall below each site of the tile, Å; not a number where there is
    /// no solid.
    PlaneView<const double> height() const {
        return sliding_ ? sliding_->height() : height_.plane(0);
    }
    std::size_t bytes() const {
        return (sliding_ ? sliding_->bytes() : height_.bytes()) +
               (factor_.empty() ? 0 : factor_.bytes());
    }

private:
    Field<double> height_; ///< empty if it slides
    std::optional<SlidingMap> sliding_;
    Field<double> factor_; ///< factor of the law of each site; empty: one law for all
    WallLaw law_;
};

} // namespace asperity
