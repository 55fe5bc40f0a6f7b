// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Views of one level of the block for its kernels, and the table of these kernels, for small strain
// (elastic_cell.hpp) and for finite strain (elastic_finite.hpp).
//
// A pass goes through a band of rows of all planes of the level, from below, so that a plane is
// still in the cache when the plane above needs it. A band reads rows of its neighbours and writes
// its own rows only.
#pragma once

#include "kernels/elastic_cell.hpp"

namespace asperity {

/// Cell of a level.
struct LevelCell {
    double edge = 0.0; ///< s, Å
    CellElasticity elasticity;
};

/// Views of a level's fields on one tile, and its constants.
struct ElasticLevel {
    int cells = 0;                     ///< moving planes; plane `cells` is prescribed
    VectorVolume<double> u;            ///< displacement of planes 0 .. cells, Å
    VectorVolume<double> v;            ///< velocity of planes 0 .. cells - 1, Å/fs
    VectorPlane<double> transferred;   ///< forces on plane 0 from below, eV/Å
    VectorPlane<double> upper_force;   ///< forces on plane `cells`, one node beyond the tile, eV/Å
    Stencil lower{}, inner{}, upper{}; ///< small strain
    LevelCell cell;
};

/// Kick of the nodes of each plane of a level.
struct LevelKicks {
    Kick lowest, inside, damped; ///< plane 0; planes above it without and with damping
    int damped_from = 0;         ///< first damped plane

    ASPERITY_HOST_DEVICE const Kick& operator()(int z) const {
        return z == 0 ? lowest : z < damped_from ? inside : damped;
    }
};

/// Rows [begin, end) of a tile, a part of the rows [first, last) of one thread.
struct Band {
    int begin, end;
    int first, last;
};

/// Returns the nodes of the upper plane whose forces belong to rows [y0, y1): one more node at the
/// tile's edges, because coarse nodes inside the tile need its force.
inline Patch upper_patch(const ElasticLevel& level, int y0, int y1) {
    const int nx = level.u.x.nx, ny = level.u.x.ny;
    return {-1, nx + 1, y0 == 0 ? -1 : y0, y1 == ny ? ny + 1 : y1};
}

/// Elastic kernels compiled for one processor level.
struct ElasticKernels {
    /// Computes the forces on rows [y0, y1), eV/Å: on moving planes, transferred forces included,
    /// into out (overwritten); on the upper plane into level.upper_force.
    void (*forces)(const ElasticLevel& level, int y0, int y1, VectorVolume<double> out);
    /// Computes the forces on a band, kicks its nodes, and computes the force on its upper plane.
    /// Drifts the rows that no other thread needs, which are all except the first and the last of
    /// the thread's rows. scratch: two planes of a band (finite strain only).
    void (*advance)(const ElasticLevel& level, const LevelKicks& kicks, double dt, Band band,
                    VectorVolume<double> scratch, KickSums& sums);
    /// Drifts rows [y0, y1) of all moving planes: u <- u + dt v.
    void (*drift)(const ElasticLevel& level, double dt, int y0, int y1);
    /// Adds the elastic energy of the cells of all layers with lower corners in rows [y0, y1), eV.
    void (*energy)(VectorVolume<const double> u, const LevelCell& cell, int y0, int y1,
                   ExactSum& sum);
    /// Adds the values of the owned nodes of rows [y0, y1) of a plane.
    void (*sum)(PlaneView<const double> plane, int y0, int y1, ExactSum& sum);
};

/// Strain measure of the cells.
enum class CellStrain { small, finite };
/// Returns the kernels for the running processor (processor_level()).
const ElasticKernels& elastic_kernels(CellStrain strain = CellStrain::small);

} // namespace asperity
