// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Shapes of the law of a wall; the tables of a ShapedWall (kernels/shaped_wall.hpp). The force of a
// shape is tabulated, with straight lines between the rows; its energy is the exact integral, with
// a depth of one.
//
//     dugdale       f = -(1 - x), x from 0 to 1: a constant tension that falls to zero along a line
//                   from 0.9 to 1.1 (sites that let go at once would hold the edge of a contact
//                   back by a row)
//     power         f = -1 / (1 + x)^n, x >= 0
//     9-3           f = (x^-9 - 3 x^-3) / 2: the atoms of two half-spaces, Lennard-Jones
//     8-2           f = (x^-8 - 4 x^-2) / 3
//     a table       energies at gaps
#pragma once

#include "kernels/shaped_wall.hpp"

#include <functional>
#include <span>
#include <vector>

namespace asperity {

/// A tabulated shape of the law of a wall.
class WallShape {
public:
    static WallShape dugdale();              ///< makes the shape "dugdale"
    static WallShape power(double exponent); ///< makes the shape "power" with exponent n
    static WallShape nine_three();           ///< makes the shape "9-3"
    static WallShape eight_two();            ///< makes the shape "8-2"
    /// Makes a shape from energies at ascending gaps, Å, of which the last is the energy of
    /// separated solids. length() is the depth divided by the largest tension. Throws
    /// std::invalid_argument if the energies have no well, or do not rise above that of separated
    /// solids at small gaps.
    WallShape(std::span<const double> gap, std::span<const double> energy);

    ShapedWall::Shape shape() const; ///< returns a view of the tables
    /// Returns the range of the law of this shape, Å; 0 if the law may have any range.
    double length() const { return length_; }

private:
    /// Makes a shape from x = first to last. force: force as a function of x, in any unit.
    WallShape(double first, double last, bool repels, const std::function<double(double)>& force);

    std::vector<double> force_, convex_;
    ShapedWall::Shape shape_;
    double length_ = 0.0;
};

} // namespace asperity
