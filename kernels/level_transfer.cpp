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
    for (int x = -halo; x < fine.nx + halo; ++x) {
        const int gx = seam.fine_x0 + x;
        const int a = (gx >> 1) - seam.coarse_x0, b = ((gx + 1) >> 1) - seam.coarse_x0;
        out[x] = 0.5 * (0.5 * (low[a] + low[b]) + 0.5 * (high[a] + high[b]));
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
