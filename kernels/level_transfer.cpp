// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/level_transfer.hpp"

namespace asperity {

void interpolate(LevelSeam seam, PlaneView<const double> coarse, PlaneView<double> fine, int y,
                 int halo) {
    const int gy = seam.fine_y0 + y;
    const double* low = coarse.line((gy >> 1) - seam.coarse_y0);
    const double* high = coarse.line(((gy + 1) >> 1) - seam.coarse_y0); // the same row on even gy
    double* out = fine.line(y);
    const int first = seam.fine_x0 - halo,
              last = seam.fine_x0 + fine.nx + halo; // over the whole box
    const auto mean = [&](int coarse_x) {
        const int a = coarse_x - seam.coarse_x0;
        return 0.5 * (low[a] + high[a]);
    };
    double left = mean(first >> 1);
    for (int X = first >> 1; 2 * X < last; ++X) {
        const double right = mean(X + 1);
        if (2 * X >= first) out[2 * X - seam.fine_x0] = left;
        if (2 * X + 1 < last) out[2 * X + 1 - seam.fine_x0] = 0.5 * (left + right);
        left = right;
    }
}

void restrict_forces(LevelSeam seam, PlaneView<const double> fine, PlaneView<double> coarse, int y,
                     int x0, int nx) {
    const auto row = fine.row;
    const double* middle = fine.line(2 * (seam.coarse_y0 + y) - seam.fine_y0);
    double* out = coarse.line(y);
    for (int x = x0; x < x0 + nx; ++x) {
        const double* p = middle + 2 * (seam.coarse_x0 + x) - seam.fine_x0;
        const double above = 0.5 * (p[row - 1] + p[row + 1]) + p[row];
        const double below = 0.5 * (p[-row - 1] + p[-row + 1]) + p[-row];
        out[x] = 0.5 * (above + below) + (0.5 * (p[-1] + p[1]) + p[0]);
    }
}

} // namespace asperity
