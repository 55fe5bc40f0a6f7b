// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Functions on packs for the elastic kernels of small and finite strain: sums over lanes, drift.
#pragma once

#include "kernels/simd.hpp"

#include "kernels/elastic_level.hpp"

namespace asperity::ASPERITY_VARIANT {

/// Returns the pack 0, 1, 2, ..., with which lanes behind the end of a row are masked.
ASPERITY_INLINE Pack<double> lane_numbers() {
    double lane[Pack<double>::width];
    for (int i = 0; i < Pack<double>::width; ++i)
        lane[i] = i;
    return Pack<double>::load(lane);
}

/// Returns the first count lanes, and zero in the others.
ASPERITY_INLINE Pack<double> first_lanes(Pack<double> a, int count) {
    return select(lane_numbers() < Pack<double>(static_cast<double>(count)), a, Pack<double>(0.0));
}

/// Adds the sums of all lanes to one sum. The number of terms of all lanes since the last carry
/// must not exceed longest_run.
ASPERITY_INLINE void collect(const BasicExactSum<Pack<double>>& lanes, ExactSum& into) {
    ExactSum mine;
    for (int k = 0; k < ExactSum::bins; ++k)
        for (int i = 0; i < Pack<double>::width; ++i)
            mine.bin[k] += lanes.bin[k][i];
    into.merge(mine);
}

/// Drifts rows [y0, y1) of plane z: u <- u + dt v.
inline void drift_rows(const ElasticLevel& level, int z, double dt, int y0, int y1) {
    using V = Pack<double>;
    const V step(dt);
    const int nx = level.u.x.nx;
    const auto move = [&](const double* speed, double* place, int count) {
        fma(step, V::load(speed), V::load(place)).store_first(place, count);
    };
    const VectorPlane<double> u = level.u[z], v = level.v[z];
    for (int y = y0; y < y1; ++y) {
        double *const ux = u.x.line(y), *const uy = u.y.line(y), *const uz = u.z.line(y);
        const double *const vx = v.x.line(y), *const vy = v.y.line(y), *const vz = v.z.line(y);
        const auto move_all = [&](int x, int count) {
            move(vx + x, ux + x, count);
            move(vy + x, uy + x, count);
            move(vz + x, uz + x, count);
        };
        int x = 0;
        for (; x + V::width <= nx; x += V::width)
            move_all(x, V::width);
        if (x < nx) move_all(x, nx - x);
    }
}

inline void drift(const ElasticLevel& level, double dt, int y0, int y1) {
    for (int z = 0; z < level.cells; ++z)
        drift_rows(level, z, dt, y0, y1);
}

/// Adds energies(i), the energies of a pack of cells from element i on, eV, over rows [y0, y1) of
/// all layers.
template <class Energies>
ASPERITY_INLINE void cell_sum(const VectorVolume<const double>& u, int y0, int y1, ExactSum& into,
                              const Energies& energies) {
    using V = Pack<double>;
    BasicExactSum<V> lanes;
    for (int z = 0; z + 1 < u.x.nz; ++z)
        for (int y = y0; y < y1; ++y) {
            const auto line = z * u.x.plane + y * u.x.row;
            for (int x = 0; x < u.x.nx; x += V::width)
                lanes.add(first_lanes(energies(line + x), u.x.nx - x));
            lanes.carry();
        }
    collect(lanes, into);
}

inline void plane_sum(PlaneView<const double> plane, int y0, int y1, ExactSum& into) {
    using V = Pack<double>;
    BasicExactSum<V> lanes;
    for (int y = y0; y < y1; ++y) {
        for (int x = 0; x < plane.nx; x += V::width)
            lanes.add(first_lanes(V::load(plane.line(y) + x), plane.nx - x));
        if (y % 32 == 31) lanes.carry();
    }
    collect(lanes, into);
}

} // namespace asperity::ASPERITY_VARIANT
