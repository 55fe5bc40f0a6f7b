// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Absorption in the cells of a level (docs/explanation/seams.md).
//
// In a cell that absorbs, the velocities of the eight corners relax towards their mean: each corner
// carries an eighth of the cell's mass and is given the impulse
//
//   m/8 h (mean of the eight - its own),      0 <= h <= 1, the cell's fraction,
//
// so momentum stays what it is, a uniform velocity is left alone, and kinetic energy is lost. A
// node inside the level that belongs to eight cells with one fraction changes by h (S v - v), S the
// smoothing by 1/4, 1/2, 1/4 along each axis: a wave with phases k a along the axes loses the
// fraction h (1 - cos²(kx a/2) cos²(ky a/2) cos²(kz a/2)), all of h where the lattice ends, h k²
// a²/4 where it is long.
//
// The components of the velocity do not mix, and S separates: with q the smoothing within a plane,
// the change of plane z between cells of fractions g (below) and h (above) is
//
//   1/2 [ h ((q(z) + q(z+1))/2 - v) + g ((q(z) + q(z-1))/2 - v) ].
#pragma once

#include "kernels/exact_sum.hpp"
#include "kernels/views.hpp"

namespace asperity {

/// A level that absorbs.
struct AbsorbingCells {
    int first = 0, cells = 0;              ///< cells [first, cells) absorb
    const double* fraction = nullptr;      ///< of each cell
    double mass = 0.0, lowest = 0.0;       ///< of a node inside, and of plane 0, eV fs^2/Å^2
    VectorVolume<double> v;                ///< planes 0 .. cells - 1, halo current from `first` on
    VectorPlane<const double> constrained; ///< velocity of plane `cells`, halo current
    VectorPlane<double> impulse;           ///< on plane `cells`, over `mass`; written

    int planes() const { return cells - first; }
    /// Elements of a row of working memory; what changes() needs of it, and what it leaves.
    std::ptrdiff_t row() const { return (v.x.nx + 71) / 8 * 8; }
    std::ptrdiff_t smooth_size() const { return (planes() + 1) * row(); }
    std::ptrdiff_t changes_size() const { return 3 * planes() * row(); }
};

/// The functions compiled for one processor level.
struct AbsorptionKernels {
    /// Changes of row y of the planes first .. cells - 1; and the row of the impulse, one node
    /// beyond the tile. In the rows -1 and ny beside the tile: the impulse alone. smooth: working
    /// memory.
    void (*changes)(const AbsorbingCells& cells, int y, double* smooth, double* changes);
    /// Makes these changes of row y. taken: the kinetic energy that is lost, eV.
    void (*apply)(const AbsorbingCells& cells, int y, const double* changes, ExactSum& taken);
    /// Nodes of this mass, row y of a plane, take impulses, given over another mass.
    void (*take)(const VectorPlane<double>& v, const VectorPlane<const double>& impulse,
                 double impulse_mass, double mass, int y, ExactSum& taken);
};

const AbsorptionKernels& absorption_kernels();

} // namespace asperity
