// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Two rough solids, one on the other (docs/explanation/model.md). The contact of two elastic solids
// without friction is, for small slopes, that of one solid on a rigid surface whose heights are the
// sum of both, with the compliances of both (BlockOptions::counter). The heights of each are
// outwards from its own solid. The second solid is turned over onto the first, which mirrors its
// map:
//
//     h(x, y) = h_1(x, y) + h_2(-x, y),      (x, y) from the middle of the maps,
//
// and h_2(-x, y) may then be turned about the middle and shifted. Point i of a row of n points
// becomes point n - 1 - i. Quarter turns, and shifts by whole spacings, move points onto points;
// other shifts multiply the waves by a phase; other turns resample the map band-limited, without
// the waves beyond the circle of Nyquist.
#pragma once

#include "engine/scene/surface.hpp"

#include <vector>

namespace asperity {

/// Place of the second solid after it was turned over: first it is turned, then shifted.
struct CounterPlace {
    double turn = 0.0;                   ///< degrees, counter-clockwise from above
    double shift_x = 0.0, shift_y = 0.0; ///< Å

    /// Returns true if the turn moves the points of a map onto points.
    bool is_quarter() const;
};

/// Returns the map of a second solid, turned over and in its place. heights: n x n points at this
/// spacing, Å; the map repeats.
std::vector<double> in_place(std::vector<double> heights, int n, double spacing,
                             const CounterPlace& place);

/// Returns the surface of the second solid in the box of the options. whole: surface of its whole
/// map, of the spacing of the box. The root moves the map, which it holds whole meanwhile.
/// Collective. Throws std::invalid_argument if the map in its place does not
/// cover the box.
Surface counter_in_box(const SurfaceOptions& box, const Surface& whole, const CounterPlace& place);

/// Returns the sum of two surfaces, with the cap of the options and the statistics of both. own,
/// counter: surfaces without a cap. Collective.
Surface pair_of(const SurfaceOptions& box, Surface own, Surface counter);

} // namespace asperity
