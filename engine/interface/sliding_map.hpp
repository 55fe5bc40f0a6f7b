// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The heights of a wall under a block that slides over it, and their slopes.
//
// The map is moved under the block by a Fourier shift (decomposition/row_shift.hpp), always from
// its original place, so that heights depend on the present place alone. The spherical cap of a
// curved substrate is not band-limited: it is left out of the shift and added at its new place. Of
// two rough solids the map of the second moves, and that of the block stays with the block's sites.
#pragma once

#include "decomposition/field.hpp"
#include "decomposition/row_shift.hpp"
#include "decomposition/tile.hpp"
#include "engine/interface/height_map.hpp"

#include <array>
#include <vector>

namespace asperity {

/// A map of heights that moves under a tile of sites.
class SlidingMap {
public:
    /// Copies the map; the block is at (0, 0).
    SlidingMap(const HeightMap& map, const Tile& tile);

    /// Moves the block to (x, y) over the map, Å.
    void slide_to(double x, double y);
    /// Returns the heights below the sites of the tile, Å.
    PlaneView<const double> height() const { return height_.plane(0); }
    /// Returns the derivative of height() with respect to the place along axis 0 (x) or 1 (y).
    PlaneView<const double> slope(std::size_t axis) const { return slope_[axis].plane(0); }
    std::size_t bytes() const; ///< returns the memory of the fields, bytes
    /// Returns the memory of the map that moves, which every rank holds whole, bytes.
    std::size_t bytes_of_map() const { return map_.size() * sizeof(double); }

private:
    using Complex = RowShift::Complex;
    void slide_along_y(double y);
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(sites_) +
               static_cast<std::size_t>(x);
    }

    Tile tile_;
    int sites_;
    double spacing_, radius_;
    std::vector<double> map_; ///< heights that move, without the cap, Å
    /// Heights of the block's own surface below the tile, [y * nx + x], Å; empty: it is flat.
    std::vector<double> own_;
    RowShift shift_;
    std::array<double, 2> place_{};
    /// Waves along x of the tile's rows at the present place along y: of the heights, Å, and of
    /// their derivatives along y.
    std::vector<Complex> waves_, waves_of_slope_;
    Field<double> height_;
    std::array<Field<double>, 2> slope_;
};

} // namespace asperity
