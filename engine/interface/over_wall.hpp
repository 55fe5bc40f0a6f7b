// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A wall in place of atoms (kernels/wall_law.hpp). The wall acts along z alone. The height below
// site (x, y) is value (x, y) of the surface, which has the block's lattice.
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
    /// Makes the wall below the first across x across sites of the grid of a tile; the other sites
    /// have no solid below them. With options.slides slide_to() moves the map, which then is below
    /// all sites.
    OverWall(const HeightMap& map, int across, const Tile& tile, const InterfaceOptions& options);

    /// Moves the block to (x, y) over the wall, Å. Requires options.slides.
    void slide_to(double x, double y) { sliding_->slide_to(x, y); }
    /// Returns the derivative of height() with respect to the place along axis 0 (x) or 1 (y).
    /// Requires options.slides.
    PlaneView<const double> slope(std::size_t axis) const { return sliding_->slope(axis); }

    /// Computes the forces on row y of the sites and adds to the sums. how: options of the sweep.
    void sweep_row(const InterfaceSites& sites, int y, SweepOptions how, InterfaceSums& sums) const;

    /// Moves the sites of row y to their equilibria, each under its own external force. row: data
    /// of the row except those of the wall, which are filled in; sites: number of sites.
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
    /// Returns the stiffness -dF/dg of the law of a site of the tile at this gap, Å, in eV/Å^2.
    double stiffness_at(int x, int y, double gap) const;

    /// Returns the height of the wall below each site of the tile, Å; NaN if there is no solid
    /// below the site.
    PlaneView<const double> height() const {
        return sliding_ ? sliding_->height() : height_.plane(0);
    }
    std::size_t bytes() const {
        return (sliding_ ? sliding_->bytes() : height_.bytes()) +
               (factor_.empty() ? 0 : factor_.bytes());
    }

private:
    Field<double> height_; ///< empty with options.slides
    std::optional<SlidingMap> sliding_;
    Field<double> factor_; ///< factor of the law of each site; empty: one law for all
    WallLaw law_;
};

} // namespace asperity
