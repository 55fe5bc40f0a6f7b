// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What becomes of a pack of forces in a time step: the kick, the drift, and the step's sums. Shared
// by the elastic kernels of small and finite strain.
#pragma once

#include "kernels/elastic_level.hpp"
#include "kernels/simd.hpp"

namespace asperity::ASPERITY_VARIANT {

/// A force, displacement or distance on a pack of nodes.
struct PackVector {
    Pack<double> x, y, z;
};

/// 0, 1, 2, ... as a pack: to switch off lanes behind the end of a row.
ASPERITY_INLINE Pack<double> lane_numbers() {
    double lane[Pack<double>::width];
    for (int i = 0; i < Pack<double>::width; ++i)
        lane[i] = i;
    return Pack<double>::load(lane);
}

ASPERITY_INLINE void collect(const BasicExactSum<Pack<double>>& lanes, ExactSum& into) {
    for (int k = 0; k < ExactSum::bins; ++k)
        for (int i = 0; i < Pack<double>::width; ++i)
            into.bin[k] += lanes.bin[k][i];
}

/// Adds a times b; both parts of it are split off without rounding the product first, which takes
/// an addition and a multiplication less.
ASPERITY_INLINE void add_product(BasicExactSum<Pack<double>>& sum, Pack<double> a, Pack<double> b) {
    using V = Pack<double>;
    const V coarse(sum.shifter(0)), fine(sum.shifter(1));
    const V part = fma(a, b, coarse) - coarse;
    sum.bin[0] = sum.bin[0] + part;
    sum.bin[1] = sum.bin[1] + ((fms(a, b, part) + fine) - fine);
}

/// Kicks the nodes of one plane, pack by pack.
template <bool damped, bool observed>
class Kicker {
    using V = Pack<double>;

public:
    ASPERITY_INLINE Kicker(const Kick& plan, const VectorVolume<double>& v)
        : keep_(plan.keep), kick_(plan.kick), drag_(plan.drag_z), medium_(2.0 * plan.medium_z),
          kinetic_weight_(0.25 * plan.half_mass), loss_weight_(0.25 * plan.drag),
          given_weight_(0.5 * plan.drag), x_(v.x.origin), y_(v.y.origin), z_(v.z.origin) {}

    /// The first count nodes from element `at` of the volume, under the force f.
    ASPERITY_INLINE void operator()(std::ptrdiff_t at, int count, const PackVector& f) {
        const V old_x = V::load(x_ + at), old_y = V::load(y_ + at), old_z = V::load(z_ + at);
        V new_x, new_y, new_z;
        if constexpr (damped) {
            new_x = fma(kick_, f.x, keep_ * old_x);
            new_y = fma(kick_, f.y, keep_ * old_y);
            new_z = fma(kick_, f.z, fma(keep_, old_z, drag_));
        } else {
            new_x = fma(kick_, f.x, old_x);
            new_y = fma(kick_, f.y, old_y);
            new_z = fma(kick_, f.z, old_z);
        }
        // Twice the velocity at the whole step; factors of two are exact.
        V wx = old_x + new_x, wy = old_y + new_y, wz = old_z + new_z;
        V rz = wz - medium_;
        if (count >= V::width) [[likely]] {
            new_x.store(x_ + at);
            new_y.store(y_ + at);
            new_z.store(z_ + at);
        } else {
            new_x.store_first(x_ + at, count);
            new_y.store_first(y_ + at, count);
            new_z.store_first(z_ + at, count);
            const auto inside = lane_numbers() < V(static_cast<double>(count));
            const V zero(0.0);
            wx = select(inside, wx, zero);
            wy = select(inside, wy, zero);
            wz = select(inside, wz, zero);
            rz = select(inside, rz, zero);
        }
        if constexpr (observed)
            add_product(kinetic_, kinetic_weight_, fma(wx, wx, fma(wy, wy, wz * wz)));
        if constexpr (damped) {
            add_product(dissipated_, loss_weight_, fma(wx, wx, fma(wy, wy, rz * rz)));
            add_product(dragged_, given_weight_, rz);
        }
    }

    ASPERITY_INLINE void add_to(KickSums& sums) const {
        if constexpr (observed) collect(kinetic_, sums.kinetic);
        if constexpr (damped) {
            collect(dissipated_, sums.dissipated);
            collect(dragged_, sums.dragged);
        }
    }

private:
    V keep_, kick_, drag_, medium_, kinetic_weight_, loss_weight_, given_weight_;
    double *x_, *y_, *z_;
    BasicExactSum<V> kinetic_, dissipated_, dragged_;
};

/// Drift u <- u + dt v of rows [y0, y1) of plane z.
inline void drift_rows(const ElasticLevel& level, int z, double dt, int y0, int y1) {
    using V = Pack<double>;
    const V step(dt);
    const int nx = level.u.x.nx;
    const auto move = [&](const double* speed, double* place) {
        const auto moved = [&](int x) { return fma(step, V::load(speed + x), V::load(place + x)); };
        int x = 0;
        for (; x + V::width <= nx; x += V::width)
            moved(x).store(place + x);
        if (x < nx) moved(x).store_first(place + x, nx - x);
    };
    const VectorPlane<double> u = level.u[z], v = level.v[z];
    for (int y = y0; y < y1; ++y) {
        move(v.x.line(y), u.x.line(y));
        move(v.y.line(y), u.y.line(y));
        move(v.z.line(y), u.z.line(y));
    }
}

inline void drift(const ElasticLevel& level, double dt, int y0, int y1) {
    for (int z = 0; z < level.cells; ++z)
        drift_rows(level, z, dt, y0, y1);
}

inline void plane_sum(PlaneView<const double> plane, int y0, int y1, ExactSum& into) {
    using V = Pack<double>;
    BasicExactSum<V> lanes;
    for (int y = y0; y < y1; ++y)
        for (int x = 0; x < plane.nx; x += V::width) {
            const auto inside = lane_numbers() < V(static_cast<double>(plane.nx - x));
            lanes.add(select(inside, V::load(plane.line(y) + x), V(0.0)));
        }
    collect(lanes, into);
}

} // namespace asperity::ASPERITY_VARIANT
