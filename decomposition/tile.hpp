// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A rank's share of one level of the block: a rectangle of nodes in x and y, all planes in z.
#pragma once

namespace asperity {

/// Nodes of a level that a rank owns.
struct Tile {
    int x0 = 0; ///< first node owned, in nodes of this level, counted over the whole box
    int y0 = 0;
    int nx = 0; ///< number of nodes owned
    int ny = 0;
    int sites = 0; ///< nodes of this level across the whole (periodic, square) box
};

/// Returns i folded into [0, n).
inline int periodic(int i, int n) {
    const int r = i % n;
    return r < 0 ? r + n : r;
}

} // namespace asperity
