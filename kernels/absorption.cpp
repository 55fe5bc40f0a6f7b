// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/absorption.hpp"

#include "kernels/kick.hpp"
#include "kernels/pack_step.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;

/// Of a row of working memory, where node 0 is: packs before it, and the one read beside them.
constexpr int left = 16;

/// 1/2 of the middle and 1/4 of what is on both sides of it.
ASPERITY_INLINE V smoothed(V before, V here, V behind) {
    return fma(V(0.25), before + behind, V(0.5) * here);
}

/// q of nodes [-1, nx] of the row at p, into q. rows: the same before the smoothing along x.
void smooth_row(const double* p, std::ptrdiff_t row, int nx, double* rows, double* q) {
    for (int x = -V::width; x < nx + halo_width; x += V::width)
        smoothed(V::load(p + x - row), V::load(p + x), V::load(p + x + row)).store(rows + x);
    for (int x = -V::width; x < nx + 1; x += V::width)
        smoothed(V::load(rows + x - 1), V::load(rows + x), V::load(rows + x + 1)).store(q + x);
}

/// Half of what one of the two cells around a plane does.
ASPERITY_INLINE V half_change(V half_share, V own, V other, V v) {
    return half_share * fms(V(0.5), own + other, v);
}

void changes(const AbsorbingCells& c, int y, double* smooth, double* out) {
    const int nx = c.v.nx, planes = c.planes();
    const std::ptrdiff_t row = c.row();
    double* const rows = smooth + left;
    const auto q = [&](int n) { return smooth + (n + 1) * row + left; }; // of plane first + n
    const bool inside = y >= 0 && y < c.v.ny;
    for (int n = inside ? 0 : planes - 1; n < planes; ++n)
        smooth_row(c.v[c.first + n].line(y), c.v.row, nx, rows, q(n));
    smooth_row(c.hanging.line(y), c.hanging.row, nx, rows, q(planes));
    for (int n = 0; n < planes && inside; ++n) {
        const double* const v = c.v[c.first + n].line(y);
        const double *const own = q(n), *const above = q(n + 1);
        double* const change = out + n * row;
        const V half_above(0.5 * c.share[c.first + n]);
        if (n == 0) {
            for (int x = 0; x < nx; x += V::width)
                half_change(half_above, V::load(own + x), V::load(above + x), V::load(v + x))
                    .store(change + x);
            continue;
        }
        const double* const below = q(n - 1);
        const V half_below(0.5 * c.share[c.first + n - 1]);
        for (int x = 0; x < nx; x += V::width) {
            const V own_x = V::load(own + x), v_x = V::load(v + x);
            (half_change(half_above, own_x, V::load(above + x), v_x) +
             half_change(half_below, own_x, V::load(below + x), v_x))
                .store(change + x);
        }
    }
    const double* const v = c.hanging.line(y);
    const double *const own = q(planes), *const below = q(planes - 1);
    double* const impulse = c.impulse.line(y);
    const V half_below(0.5 * c.share[c.cells - 1]);
    for (int x = -V::width; x < nx + 1; x += V::width)
        half_change(half_below, V::load(own + x), V::load(below + x), V::load(v + x))
            .store_lanes(impulse + x, -1 - x, nx + 1 - x);
}

void add(double* v, const double* change, double factor, double mass, int nx, ExactSum& taken) {
    const V f(factor), minus_mass(-mass), half(0.5);
    BasicExactSum<V> lanes;
    for (int x = 0; x < nx; x += V::width) {
        const V old = V::load(v + x), by = f * V::load(change + x);
        const V given = minus_mass * by;
        const V mean = fma(half, by, old);
        const int count = nx - x;
        if (count >= V::width) {
            (old + by).store(v + x);
            add_product(lanes, given, mean);
        } else {
            (old + by).store_first(v + x, count);
            add_product(lanes, first_lanes(given, count), first_lanes(mean, count));
        }
    }
    collect(lanes, taken);
}

} // namespace

extern const AbsorptionKernels absorption_kernels;
const AbsorptionKernels absorption_kernels = {changes, add};

} // namespace asperity::ASPERITY_VARIANT
