// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Launches that do nothing but move memory, or multiply: what the launches of a step are held
// against.
#pragma once

#include "kernels/lane.hpp"

#include "kernels/device/launch.hpp"

namespace asperity::ASPERITY_VARIANT {

struct Triad {
    double* a;
    const double *b, *c;
    ASPERITY_HOST_DEVICE void operator()(long long i, PassSums&) const {
        a[i] = fused(c[i], 1e-9, b[i]);
    }
};

/// Chains that do not depend on one another.
template <class T>
struct Fused {
    T* out;
    int rounds;
    ASPERITY_HOST_DEVICE void operator()(long long i, PassSums&) const {
        const T factor = T(1) - static_cast<T>(i) * T(1e-7), term = T(1e-3);
        T x[fused_chains];
        ASPERITY_UNROLL(8)
        for (int k = 0; k < fused_chains; ++k)
            x[k] = static_cast<T>(k);
        ASPERITY_UNROLL(1)
        for (int r = 0; r < rounds; ++r) {
            ASPERITY_UNROLL(8)
            for (int k = 0; k < fused_chains; ++k)
                x[k] = fused(x[k], factor, term);
        }
        T sum = T(0);
        ASPERITY_UNROLL(8)
        for (int k = 0; k < fused_chains; ++k)
            sum = sum + x[k];
        out[i] = sum;
    }
};

inline const char* triad(double* a, const double* b, const double* c, long long n) {
    return launch<false>(Triad{a, b, c}, n, nullptr);
}
template <class T>
const char* fused_chain(T* out, long long threads, int rounds) {
    return launch<false>(Fused<T>{out, rounds}, threads, nullptr);
}

} // namespace asperity::ASPERITY_VARIANT
