// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The kernels use g++'s __builtin_shuffle, which clang does not have. Included before them in the
// preset `fuzz`; slow, and no kernel is called there.
#pragma once

template <class Vector, class Lanes>
inline Vector clang_shuffle(Vector a, Vector b, Lanes lanes) {
    constexpr int n = sizeof(Vector) / sizeof(a[0]);
    Vector result = a;
    for (int i = 0; i < n; ++i)
        result[i] = lanes[i] < n ? a[lanes[i]] : b[lanes[i] - n];
    return result;
}
#define __builtin_shuffle clang_shuffle
