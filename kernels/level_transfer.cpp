// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "kernels/transfer_node.hpp"

#include "kernels/simd.hpp"

namespace asperity::ASPERITY_VARIANT {

namespace {

using V = Pack<double>;

void interpolate(LevelSeam seam, PlaneView<const double> coarse, PlaneView<double> fine, int y,
                 int halo) {
    const int gy = seam.fine_y0 + y;
    const double* low = coarse.line((gy >> 1) - seam.coarse_y0) - seam.coarse_x0;
    const double* high = coarse.line(((gy + 1) >> 1) - seam.coarse_y0) - seam.coarse_x0;
    double* out = fine.line(y) - seam.fine_x0; // here and below, x is over the whole box
    const int first = seam.fine_x0 - halo, last = seam.fine_x0 + fine.nx + halo;
    const auto node = [&](int x) { return interpolated_node(low, high, x); };
    int x = first;
    if (x & 1) out[x] = node(x), ++x;
    for (; x + 2 * V::width <= last; x += 2 * V::width) {
        const int X = x >> 1;
        const V on = mean<V>(low + X, high + X);
        const V between = mean(on, mean<V>(low + X + 1, high + X + 1));
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
        return restricted(evens(a, b), odds(a, b), right);
    };
    int x = x0;
    for (; x + V::width <= x0 + nx; x += V::width) {
        const double* p = middle + 2 * x;
        restricted(pack(p + fine.row), pack(p), pack(p - fine.row)).store(out + x);
    }
    for (; x < x0 + nx; ++x)
        out[x] = restricted_node(middle + 2 * x, fine.row);
}

} // namespace

extern const TransferKernels transfer_kernels;
const TransferKernels transfer_kernels = {interpolate, restrict_forces};

} // namespace asperity::ASPERITY_VARIANT
