// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The arithmetic of level_transfer.hpp for packs, for single nodes at the ends of rows, and for the
// threads of a device.
#pragma once

#include "kernels/level_transfer.hpp"
#include "kernels/variant.hpp"

namespace asperity::ASPERITY_VARIANT {

template <class V>
ASPERITY_INLINE V mean(V a, V b) {
    return V(0.5) * (a + b);
}
/// Returns the mean of the coarse rows low and high; for an even fine row both are the same row.
template <class V>
ASPERITY_INLINE V mean(const double* low, const double* high) {
    return mean(V::load(low), V::load(high));
}
/// Returns the value of fine node x (counted over the box) between the coarse rows low and high.
ASPERITY_INLINE double interpolated_node(const double* low, const double* high, int x) {
    const int X = x >> 1;
    const double on = mean(low[X], high[X]);
    return (x & 1) ? mean(on, mean(low[X + 1], high[X + 1])) : on;
}

/// Returns before / 2 + here + behind / 2, of nodes or rows.
template <class V>
ASPERITY_INLINE V restricted(V before, V here, V behind) {
    return V(0.5) * (before + behind) + here;
}
/// Returns the force on the coarse node at fine node `at` from the nine fine nodes around it.
ASPERITY_INLINE double restricted_node(const double* at, std::ptrdiff_t row) {
    const auto along_x = [](const double* p) { return restricted(p[-1], p[0], p[1]); };
    return restricted(along_x(at + row), along_x(at), along_x(at - row));
}

} // namespace asperity::ASPERITY_VARIANT
