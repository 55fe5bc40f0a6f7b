// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/absorption.hpp"

#include "kernels/kick.hpp"
#include "kernels/pack_step.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;

/// Of a row of working memory, where node 0 is: a pack before it.
constexpr int left = 8;

/// 1/2 of the middle and 1/4 of what is on both sides of it.
ASPERITY_INLINE V smoothed(V before, V here, V behind) {
    return fma(V(0.25), before + behind, V(0.5) * here);
}

/// q of nodes [-1, nx] of the row at p.
void smooth_row(const double* p, std::ptrdiff_t row, int nx, double* q) {
    const auto across = [&](int x) {
        return smoothed(V::load(p + x - row), V::load(p + x), V::load(p + x + row));
    };
    V before(0.0), here = across(-V::width);
    for (int x = -V::width; x < nx + 1; x += V::width) {
        const V behind = across(x + V::width);
        smoothed(shift_right(before, here), here, shift_left(here, behind)).store(q + x);
        before = here;
        here = behind;
    }
}

/// Half of what one of the two cells around a plane does.
ASPERITY_INLINE V half_change(V half_share, V own, V other, V v) {
    return half_share * fms(V(0.5), own + other, v);
}

void component_changes(const AbsorbingCells& c, const VolumeView<const double>& v,
                       const PlaneView<const double>& constrained, const PlaneView<double>& impulse,
                       int y, double* smooth, double* out) {
    const int nx = v.nx, planes = c.planes();
    const std::ptrdiff_t row = c.row();
    const auto q = [&](int n) { return smooth + n * row + left; }; // of plane first + n
    const bool inside = y >= 0 && y < v.ny;
    for (int n = inside ? 0 : planes - 1; n < planes; ++n)
        smooth_row(v[c.first + n].line(y), v.row, nx, q(n));
    smooth_row(constrained.line(y), constrained.row, nx, q(planes));
    for (int n = 0; n < planes && inside; ++n) {
        const double* const speed = v[c.first + n].line(y);
        const double *const own = q(n), *const above = q(n + 1);
        double* const change = out + n * row;
        const int z = c.first + n;
        const V half_above(0.5 * c.fraction[z] * (z == 0 ? c.mass / c.lowest : 1.0));
        if (n == 0) {
            for (int x = 0; x < nx; x += V::width)
                half_change(half_above, V::load(own + x), V::load(above + x), V::load(speed + x))
                    .store(change + x);
            continue;
        }
        const double* const below = q(n - 1);
        const V half_below(0.5 * c.fraction[z - 1]);
        for (int x = 0; x < nx; x += V::width) {
            const V own_x = V::load(own + x), v_x = V::load(speed + x);
            (half_change(half_above, own_x, V::load(above + x), v_x) +
             half_change(half_below, own_x, V::load(below + x), v_x))
                .store(change + x);
        }
    }
    const double* const speed = constrained.line(y);
    const double *const own = q(planes), *const below = q(planes - 1);
    double* const to = impulse.line(y);
    const V half_below(0.5 * c.fraction[c.cells - 1]);
    for (int x = -V::width; x < nx + 1; x += V::width)
        half_change(half_below, V::load(own + x), V::load(below + x), V::load(speed + x))
            .store_lanes(to + x, -1 - x, nx + 1 - x);
}

void changes(const AbsorbingCells& c, int y, double* smooth, double* out) {
    const std::ptrdiff_t next = c.planes() * c.row();
    component_changes(c, c.v.x, c.constrained.x, c.impulse.x, y, smooth, out);
    component_changes(c, c.v.y, c.constrained.y, c.impulse.y, y, smooth, out + next);
    component_changes(c, c.v.z, c.constrained.z, c.impulse.z, y, smooth, out + 2 * next);
}

/// Adds a change to the velocities at v: mass times change times the mean of before and after, on
/// top of what was given.
ASPERITY_INLINE V added(double* v, int count, V change, V mass, V given) {
    const V old = V::load(v);
    (old + change).store_first(v, count);
    return fma(mass * change, fma(V(0.5), change, old), given);
}

/// Takes from `taken` what was given to the nodes of a column, in one order for every column.
ASPERITY_INLINE void take_away(BasicExactSum<V>& taken, V given, int count) {
    taken.add(first_lanes(-given, count));
}

void apply(const AbsorbingCells& c, int y, const double* changes, ExactSum& taken) {
    const int nx = c.v.x.nx, planes = c.planes();
    const std::ptrdiff_t row = c.row(), plane = c.v.x.plane;
    const double* const of_x = changes;
    const double *const of_y = of_x + planes * row, *const of_z = of_y + planes * row;
    const auto speeds = lines(c.v[c.first], y);
    const V inside(c.mass), lowest(c.first == 0 ? c.lowest : c.mass);
    BasicExactSum<V> lanes;
    for (int x = 0; x < nx; x += V::width) {
        V given(0.0);
        for (int n = 0; n < planes; ++n) {
            const V mass = n == 0 ? lowest : inside;
            const std::ptrdiff_t at = n * plane + x, from = n * row + x;
            given = added(speeds[0] + at, nx - x, V::load(of_x + from), mass, given);
            given = added(speeds[1] + at, nx - x, V::load(of_y + from), mass, given);
            given = added(speeds[2] + at, nx - x, V::load(of_z + from), mass, given);
        }
        take_away(lanes, given, nx - x);
    }
    collect(lanes, taken);
}

void take(const VectorPlane<double>& v, const VectorPlane<const double>& impulse,
          double impulse_mass, double mass, int y, ExactSum& taken) {
    const int nx = v.x.nx;
    const auto speeds = lines(v, y);
    const auto from = lines(impulse, y);
    const V factor(impulse_mass / mass), m(mass);
    BasicExactSum<V> lanes;
    for (int x = 0; x < nx; x += V::width) {
        V given(0.0);
        for (int i = 0; i < 3; ++i)
            given = added(speeds[i] + x, nx - x, factor * V::load(from[i] + x), m, given);
        take_away(lanes, given, nx - x);
    }
    collect(lanes, taken);
}

} // namespace

extern const AbsorptionKernels absorption_kernels;
const AbsorptionKernels absorption_kernels = {changes, apply, take};

} // namespace asperity::ASPERITY_VARIANT
