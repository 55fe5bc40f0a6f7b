// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Operations on plain numbers for formulas that are templates over all kinds of values: numbers
// (here), SIMD registers (simd.hpp), lanes of a device (lane.hpp). Operations of the same name
// round in the same way.
#pragma once

#include "kernels/annotations.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace asperity {

/// Type of the numbers in a value.
template <class V>
struct ValueOf {
    using type = typename V::Value;
};
template <>
struct ValueOf<double> {
    using type = double;
};
template <class V>
using Value = typename ValueOf<V>::type;

/// Returns a value with the same number in every lane.
template <class V>
ASPERITY_INLINE V same(double value) {
    return V(static_cast<Value<V>>(value));
}

ASPERITY_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
ASPERITY_INLINE double min(double a, double b) { return a < b ? a : b; }
ASPERITY_INLINE double max(double a, double b) { return a > b ? a : b; }
ASPERITY_INLINE double fma(double a, double b, double c) {
#if defined(__CUDA_ARCH__)
    return ::fma(a, b, c);
#else
    return __builtin_fma(a, b, c);
#endif
}
ASPERITY_INLINE double fms(double a, double b, double c) { return fma(a, b, -c); }
ASPERITY_INLINE double sqrt(double a) { return ::sqrt(a); }

/// Returns 2^n for an integer n within the range of exponents.
ASPERITY_INLINE double power_of_two(double n) {
    const double biased = n + (0x1.8p52 + 1023.0);
    std::uint64_t bits;
    std::memcpy(&bits, &biased, sizeof bits);
    bits <<= 52;
    double power;
    std::memcpy(&power, &bits, sizeof power);
    return power;
}
/// Loads the four numbers of row n (an integer) of a table.
ASPERITY_INLINE void gather_four(const double* table, double n, double (&row)[4]) {
    for (int k = 0; k < 4; ++k)
        row[k] = table[4 * static_cast<std::ptrdiff_t>(n) + k];
}

/// Rounds to the nearest whole number, for |x| < 2^22 (float) or 2^51 (double).
template <class V>
ASPERITY_INLINE V nearest_whole(V x) {
    const V shift = same<V>(std::is_same_v<Value<V>, float> ? 0x1.8p23 : 0x1.8p52);
    return (x + shift) - shift;
}

/// Returns exp(x) to two units of the last place, with x limited to -80 .. 80 (float) or -700 ..
/// 700 (double).
template <class V>
ASPERITY_INLINE V exponential(V x) {
    constexpr bool single = std::is_same_v<Value<V>, float>;
    const V most = same<V>(single ? 80.0 : 700.0);
    x = max(-most, min(most, x));
    // exp(x) = 2^n exp(r), |r| <= ln(2) / 2; n times the first part of ln 2 is exact.
    const V n = nearest_whole(x * same<V>(1.4426950408889634));
    const V r = (x - n * same<V>(single ? 0x1.63p-1 : 0x1.62e42feep-1)) -
                n * same<V>(single ? -2.12194440054690583e-4 : 1.90821492927058770e-10);
    constexpr double inverse_factorials[] = {1.0 / 6227020800.0,
                                             1.0 / 479001600.0,
                                             1.0 / 39916800.0,
                                             1.0 / 3628800.0,
                                             1.0 / 362880.0,
                                             1.0 / 40320.0,
                                             1.0 / 5040.0,
                                             1.0 / 720.0,
                                             1.0 / 120.0,
                                             1.0 / 24.0,
                                             1.0 / 6.0,
                                             0.5,
                                             1.0,
                                             1.0};
    constexpr int terms = 14, first = single ? 6 : 0; // Taylor's series to r^7, r^13
    V sum = same<V>(inverse_factorials[first]);
    ASPERITY_UNROLL(16)
    for (int k = first + 1; k < terms; ++k)
        sum = fma(sum, r, same<V>(inverse_factorials[k]));
    return sum * power_of_two(n);
}

} // namespace asperity
