// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A rank's share of one level of the block: a rectangle of nodes in x and y, all planes in z.
#pragma once

namespace asperity {

/// Nodes of a level that a rank owns.
struct Tile {
    int x0 = 0;    ///< first node owned along x, counted in nodes of this level over the whole box
    int y0 = 0;    ///< first node owned along y
    int nx = 0;    ///< number of nodes owned along x
    int ny = 0;    ///< number of nodes owned along y
    int sites = 0; ///< number of nodes of this level across the whole (periodic, square) box
};

/// Returns i modulo n, in [0, n).
inline int periodic(int i, int n) {
    const int r = i % n;
    return r < 0 ? r + n : r;
}

} // namespace asperity
