// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Absorption in the cells of a level (docs/seams.md).
//
// In a cell that absorbs, the velocities of the eight corners relax towards their mean: each corner
// carries an eighth of the cell's mass and is given the impulse
//
//   m/8 h (mean of the eight - its own),      0 <= h <= 1, the cell's share,
//
// so momentum stays what it is, a uniform velocity is left alone, and kinetic energy is lost. A
// node inside the level that belongs to eight cells with one share changes by h (S v - v), S the
// smoothing by 1/4, 1/2, 1/4 along each axis: a wave with phases k a along the axes loses the share
// h (1 - cos²(kx a/2) cos²(ky a/2) cos²(kz a/2)), all of h where the lattice ends, h k² a²/4 where
// it is long.
//
// The components of the velocity do not mix, and S separates: with q the smoothing within a plane,
// the change of plane z between cells of shares g (below) and h (above) is
//
//   1/2 [ h ((q(z) + q(z+1))/2 - v) + g ((q(z) + q(z-1))/2 - v) ].
#pragma once

#include "kernels/exact_sum.hpp"
#include "kernels/views.hpp"

namespace asperity {

/// One component of the velocity on a level that absorbs.
struct AbsorbingCells {
    int first = 0, cells = 0;        ///< cells [first, cells) absorb
    const double* share = nullptr;   ///< of each cell
    VolumeView<const double> v;      ///< planes 0 .. cells - 1, halo current from plane `first` on
    PlaneView<const double> hanging; ///< of plane `cells`, halo current
    PlaneView<double> impulse;       ///< on plane `cells`, over the mass of a node inside; written

    /// Elements of a row of working memory, and what changes() needs of it.
    std::ptrdiff_t row() const { return (v.nx + 71) / 8 * 8; }
    int planes() const { return cells - first; }
    std::ptrdiff_t smooth_size() const { return (planes() + 2) * row(); }
};

/// The functions compiled for one processor level.
struct AbsorptionKernels {
    /// Changes of row y of the planes first .. cells - 1, plane by plane, `row()` elements each,
    /// for nodes of the mass inside the level; and the row of the impulse, one node beyond the
    /// tile. In the rows -1 and ny beside the tile: the impulse alone. smooth: working memory.
    void (*changes)(const AbsorbingCells& cells, int y, double* smooth, double* changes);
    /// v <- v + factor change, for nx nodes of this mass, and the kinetic energy that they lose.
    void (*add)(double* v, const double* change, double factor, double mass, int nx,
                ExactSum& taken);
};

const AbsorptionKernels& absorption_kernels();

} // namespace asperity
