// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The springs and signs of one cubic cell, shared by the energy kernels.
#pragma once

namespace asperity {

/// Corner p of a cell: bit 0 is x, bit 1 is y, bit 2 is z.
constexpr int corner_sign(int corner, int axis) { return (corner >> axis & 1) ? 1 : -1; }

struct Spring {
    int from, to;   ///< corners
    int dx, dy, dz; ///< direction from -> to in cell edges
    bool diagonal;
};

/// The 12 edges and 12 face diagonals.
struct CellSprings {
    Spring spring[24] = {};
    constexpr CellSprings() {
        int n = 0;
        for (int a = 0; a < 8; ++a)
            for (int b = a + 1; b < 8; ++b) {
                const int d[3] = {(b & 1) - (a & 1), (b >> 1 & 1) - (a >> 1 & 1),
                                  (b >> 2 & 1) - (a >> 2 & 1)};
                const int length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                if (length2 == 3) continue;
                spring[n++] = {a, b, d[0], d[1], d[2], length2 == 2};
            }
    }
};
inline constexpr CellSprings cell_springs{};

} // namespace asperity
