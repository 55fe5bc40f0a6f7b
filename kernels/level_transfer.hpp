// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Transfer between two levels of the block: bilinear interpolation and its transpose.
//
// Node X of the coarse level lies on node 2X of the fine one (both counted over the whole box). The
// fine level's upper plane is interpolated from the coarse level's lowest plane,
//
//   u_fine(x) = sum_X P(x, X) u_coarse(X),
//
// and its forces are transferred by F_coarse(X) = sum_x P(x, X) F_fine(x). With the same P in both
// directions the forces are the gradient of one energy. Sums are formed in an order fixed by the
// global position.
#pragma once

#include "kernels/views.hpp"

namespace asperity {

/// Positions of two tiles of neighbouring levels, in nodes of their levels over the whole box.
struct LevelSeam {
    int fine_x0 = 0, fine_y0 = 0; ///< first node owned of the fine tile
    /// First node owned of the coarse tile; 0 if the rank holds the whole level.
    int coarse_x0 = 0, coarse_y0 = 0;
};

/// Transfer kernels compiled for one processor level; all levels give bitwise identical results.
struct TransferKernels {
    /// Interpolates the fine nodes of row y, columns [-halo, nx + halo), from coarse nodes (halo
    /// included).
    void (*interpolate)(LevelSeam seam, PlaneView<const double> coarse, PlaneView<double> fine,
                        int y, int halo);
    /// Overwrites the coarse nodes of row y, columns [x0, x0 + nx), in coarse tile coordinates,
    /// with the weighted sums of the fine forces around them.
    void (*restrict_forces)(LevelSeam seam, PlaneView<const double> fine, PlaneView<double> coarse,
                            int y, int x0, int nx);
};

/// Returns the kernels for the running processor (processor_level()).
const TransferKernels& transfer_kernels();

} // namespace asperity
