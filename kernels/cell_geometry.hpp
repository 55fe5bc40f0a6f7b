// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The springs and signs of one cubic cell.
#pragma once

#include "kernels/annotations.hpp"

namespace asperity {

/// Returns the sign of corner p of a cell along an axis: bit 0 of p is x, bit 1 is y, bit 2 is z.
ASPERITY_HOST_DEVICE constexpr int corner_sign(int corner, int axis) {
    return (corner >> axis & 1) ? 1 : -1;
}
/// Returns the number of axes along which two corners differ: 1 edge, 2 face diagonal, 3 body
/// diagonal.
ASPERITY_HOST_DEVICE constexpr int axes_between(int a, int b) {
    const int bits = a ^ b;
    return (bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1);
}

/// A spring between two corners of a cell.
struct Spring {
    int from, to;   ///< corners
    int dx, dy, dz; ///< direction from -> to in cell edges
    bool diagonal;
};

/// The 12 edges and 12 face diagonals of a cell.
struct CellSprings {
    Spring spring[24] = {};
    ASPERITY_HOST_DEVICE constexpr CellSprings() {
        int n = 0;
        for (int a = 0; a < 8; ++a)
            for (int b = a + 1; b < 8; ++b) {
                const int d[3] = {(b & 1) - (a & 1), (b >> 1 & 1) - (a >> 1 & 1),
                                  (b >> 2 & 1) - (a >> 2 & 1)};
                const int axes = axes_between(a, b);
                if (axes == 3) continue;
                spring[n++] = {a, b, d[0], d[1], d[2], axes == 2};
            }
    }
};

} // namespace asperity
