// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One level of the block as its kernels see it, and the table of these kernels: one for small
// strain (elastic_cell.hpp), one for finite strain (elastic_finite.hpp), with the same functions.
//
// A pass works on a band of rows through all planes of the level, from below, so that a plane is in
// the cache when the one above it needs it. A band reads rows of its neighbours and writes its own
// rows only.
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
    VectorPlane<double> transferred;   ///< forces handed to plane 0 from below, eV/Å
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

/// Rows [begin, end) of a tile, out of the share [first, last) of one thread.
struct Band {
    int begin, end;
    int first, last;
};

/// Returns the nodes of the upper plane whose forces belong to a band: at the tile's edges one node
/// more, because coarse nodes inside the tile need it.
inline Patch upper_patch(const ElasticLevel& level, int y0, int y1) {
    const int nx = level.u.x.nx, ny = level.u.x.ny;
    return {-1, nx + 1, y0 == 0 ? -1 : y0, y1 == ny ? ny + 1 : y1};
}

/// Elastic kernels compiled for one processor level.
struct ElasticKernels {
    /// Computes the forces on rows [y0, y1): on moving planes, transferred ones included, into out
    /// (overwritten); on the upper plane into level.upper_force.
    void (*forces)(const ElasticLevel& level, int y0, int y1, VectorVolume<double> out);
    /// Computes the forces of a band and kicks it; computes the force on its upper plane; drifts
    /// those of its rows that no other band needs: all but the first and the last of the thread's
    /// share. scratch: two planes of a band (finite strain only).
    void (*advance)(const ElasticLevel& level, const LevelKicks& kicks, double dt, Band band,
                    VectorVolume<double> scratch, KickSums& sums);
    /// Drifts rows [y0, y1) of all moving planes: u <- u + dt v.
    void (*drift)(const ElasticLevel& level, double dt, int y0, int y1);
    /// Adds the elastic energy of the cells with lower corners in rows [y0, y1), all layers, eV.
    void (*energy)(VectorVolume<const double> u, const LevelCell& cell, int y0, int y1,
                   ExactSum& sum);
    /// Adds the owned nodes of rows [y0, y1) of a plane.
    void (*sum)(PlaneView<const double> plane, int y0, int y1, ExactSum& sum);
};

enum class CellStrain { small, finite };
const ElasticKernels& elastic_kernels(CellStrain strain = CellStrain::small);

} // namespace asperity
