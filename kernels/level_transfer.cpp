// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/level_transfer.hpp"

#include "kernels/simd.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;

/// One load for a pack of T, or for a single node at the ends of a row.
template <class T>
ASPERITY_INLINE T load(const double* p) {
    if constexpr (sizeof(T) == sizeof(double))
        return *p;
    else
        return T::load(p);
}

/// On the coarse row's place, between rows low and high (the same row twice on even fine rows).
template <class T>
ASPERITY_INLINE T mean(const double* low, const double* high) {
    return T(0.5) * (load<T>(low) + load<T>(high));
}

void interpolate(LevelSeam seam, PlaneView<const double> coarse, PlaneView<double> fine, int y,
                 int halo) {
    const int gy = seam.fine_y0 + y;
    const double* low = coarse.line((gy >> 1) - seam.coarse_y0) - seam.coarse_x0;
    const double* high = coarse.line(((gy + 1) >> 1) - seam.coarse_y0) - seam.coarse_x0;
    double* out = fine.line(y) - seam.fine_x0; // from here on, x over the whole box
    const int first = seam.fine_x0 - halo, last = seam.fine_x0 + fine.nx + halo;
    const auto node = [&](int x) {
        const int X = x >> 1;
        const double left = mean<double>(low + X, high + X);
        return (x & 1) ? 0.5 * (left + mean<double>(low + X + 1, high + X + 1)) : left;
    };
    int x = first;
    if (x & 1) out[x] = node(x), ++x;
    for (; x + 2 * V::width <= last; x += 2 * V::width) {
        const int X = x >> 1;
        const V on = mean<V>(low + X, high + X);
        const V between = V(0.5) * (on + mean<V>(low + X + 1, high + X + 1));
        interleave_low(on, between).store(out + x);
        interleave_high(on, between).store(out + x + V::width);
    }
    for (; x < last; ++x)
        out[x] = node(x);
}

void restrict_forces(LevelSeam seam, PlaneView<const double> fine, PlaneView<double> coarse, int y,
                     int x0, int nx) {
    const double* middle = fine.line(2 * (seam.coarse_y0 + y) - seam.fine_y0) + 2 * seam.coarse_x0 -
                           seam.fine_x0; // fine node 2x belongs to x
    double* out = coarse.line(y);
    const auto pack = [](const double* p) { // half, whole and half of the nodes around 2x
        const V a = V::load(p - 1), b = V::load(p - 1 + V::width);
        const V right = evens(V::load(p + 1), V::load(p + 1 + V::width));
        return V(0.5) * (evens(a, b) + right) + odds(a, b);
    };
    const auto node = [](const double* p) { return 0.5 * (p[-1] + p[1]) + p[0]; };
    int x = x0;
    for (; x + V::width <= x0 + nx; x += V::width) {
        const double* p = middle + 2 * x;
        (V(0.5) * (pack(p + fine.row) + pack(p - fine.row)) + pack(p)).store(out + x);
    }
    for (; x < x0 + nx; ++x) {
        const double* p = middle + 2 * x;
        out[x] = 0.5 * (node(p + fine.row) + node(p - fine.row)) + node(p);
    }
}

} // namespace

extern const TransferKernels transfer_kernels;
const TransferKernels transfer_kernels = {interpolate, restrict_forces};

} // namespace asperity::ASPERITY_VARIANT
