// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The headers of kernels/ as device code: compiled, never run. A thread a node gathers what its
// eight cells give it, a thread a site sums its pairs; views, constants and order-independent sums
// go to the device as they are. What does not: simd.hpp, whose packs are a processor's registers.
#if !defined(__CUDACC__) || defined(__clang__) // clang without NVIDIA's headers
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
#define __CUDACC__
#endif

#include <cmath>

#if defined(__clang__)
namespace std {
__device__ inline double sqrt(double x) { return __nvvm_sqrt_rn_d(x); }
} // namespace std
#define NODE_INDEX(axis) __nvvm_read_ptx_sreg_ctaid_##axis()
#else
#define NODE_INDEX(axis) blockIdx.axis
#endif

#include "kernels/annotations.hpp"
#include "kernels/cell_forces.hpp"
#include "kernels/cell_geometry.hpp"
#include "kernels/elastic_cell.hpp"
#include "kernels/elastic_finite.hpp"
#include "kernels/exact_sum.hpp"
#include "kernels/interface_sweep.hpp"
#include "kernels/lennard_jones.hpp"
#include "kernels/level_transfer.hpp"
#include "kernels/views.hpp"

using namespace asperity;

/// Forces on the nodes of a tile, of small or finite strain: no thread writes what another does, and
/// each sums its cells in one order.
template <class Cell>
__device__ void gather(VectorVolume<const double> u, VectorVolume<double> out, const Cell& cell) {
    const int x = NODE_INDEX(x), y = NODE_INDEX(y), z = NODE_INDEX(z);
    double sum[3] = {0.0, 0.0, 0.0};
    for (int corner = 0; corner < 8; ++corner) { // of the cell, the one at this node
        const int x0 = x - (corner & 1), y0 = y - (corner >> 1 & 1), z0 = z - (corner >> 2 & 1);
        if (z0 < 0 || z0 + 1 >= u.x.nz) continue;
        double at[8][3], f[8][3];
        for (int p = 0; p < 8; ++p) {
            const int xp = x0 + (p & 1), yp = y0 + (p >> 1 & 1), zp = z0 + (p >> 2 & 1);
            at[p][0] = u.x(xp, yp, zp);
            at[p][1] = u.y(xp, yp, zp);
            at[p][2] = u.z(xp, yp, zp);
        }
        cell(at, f);
        for (int i = 0; i < 3; ++i)
            sum[i] += f[corner][i];
    }
    out.x(x, y, z) = sum[0];
    out.y(x, y, z) = sum[1];
    out.z(x, y, z) = sum[2];
}

struct Linear {
    CellElasticity constants;
    __device__ void operator()(const double (&u)[8][3], double (&f)[8][3]) const {
        linear_cell(u, constants, f);
    }
};
struct Finite {
    LevelCell constants;
    __device__ void operator()(const double (&u)[8][3], double (&f)[8][3]) const {
        finite_cell(u, constants, f);
    }
};

__global__ void linear_forces(VectorVolume<const double> u, VectorVolume<double> out,
                              CellElasticity c) {
    gather(u, out, Linear{c});
}
__global__ void finite_forces(VectorVolume<const double> u, VectorVolume<double> out,
                              LevelCell c) {
    gather(u, out, Finite{c});
}

/// Normal force of the substrate's atoms within `reach` offsets on the sites of the lowest layer.
__global__ void interface_forces(InterfaceSites sites, PlaneView<const double> substrate, int reach,
                                 LennardJones pair, ExactSum* total) {
    const int x = NODE_INDEX(x), y = NODE_INDEX(y);
    const double ux = sites.displacement.x(x, y), uy = sites.displacement.y(x, y);
    const double z = sites.reference_height + sites.displacement.z(x, y);
    double force = 0.0;
    for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i) {
            const double dx = ux - (i - 0.5) * sites.spacing, dy = uy - (j - 0.5) * sites.spacing;
            const double dz = z - substrate(x + i, y + j);
            force += pair.force_over_distance(dx * dx + dy * dy + dz * dz) * dz;
        }
    sites.force.z(x, y) = force;
    total[y].add(force);
}
