// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One number with the interface of a SIMD register of one lane (simd.hpp).
//
// A kernel that is a template over its value type runs on packs of a processor's registers and,
// with one node per thread, on a device. Every operation of a lane equals that of the pack of the
// same name in each lane, so that a lane and a pack of a processor level with fused multiply-add
// (fuses(), variant.hpp) give bitwise identical results. The compiler may not contract operations
// (-ffp-contract=off; nvcc: -fmad=false).
#pragma once

#include "kernels/annotations.hpp"
#include "kernels/exact_sum.hpp"
#include "kernels/number.hpp"
#include "kernels/variant.hpp"

#include <cmath>
#include <cstdint>

namespace asperity::ASPERITY_VARIANT {

/// A number with the interface of Pack.
template <class T>
struct Lane {
    static constexpr int width = 1;
    using Value = T;
    using Mask = bool;

    T r;

    Lane() = default;
    ASPERITY_INLINE Lane(T value) : r(value) {}

    static ASPERITY_INLINE Lane load(const T* from) { return *from; }
    static ASPERITY_INLINE Lane load_once(const T* from) { return *from; }
    static ASPERITY_INLINE Lane load_first(const T* from, int) { return *from; }
    ASPERITY_INLINE void store(T* to) const { *to = r; }
    ASPERITY_INLINE void store_first(T* to, int) const { *to = r; }
    ASPERITY_INLINE T operator[](int) const { return r; }

    friend ASPERITY_INLINE Lane operator+(Lane a, Lane b) { return a.r + b.r; }
    friend ASPERITY_INLINE Lane operator-(Lane a, Lane b) { return a.r - b.r; }
    friend ASPERITY_INLINE Lane operator*(Lane a, Lane b) { return a.r * b.r; }
    friend ASPERITY_INLINE Lane operator/(Lane a, Lane b) { return a.r / b.r; }
    friend ASPERITY_INLINE Lane operator-(Lane a) { return -a.r; }
    friend ASPERITY_INLINE bool operator<(Lane a, Lane b) { return a.r < b.r; }
    friend ASPERITY_INLINE bool operator>(Lane a, Lane b) { return a.r > b.r; }
};

template <class T>
ASPERITY_INLINE Lane<T> select(bool mask, Lane<T> a, Lane<T> b) {
    return mask ? a.r : b.r;
}
template <class T>
ASPERITY_INLINE Lane<T> min(Lane<T> a, Lane<T> b) {
    return a.r < b.r ? a.r : b.r;
}
template <class T>
ASPERITY_INLINE Lane<T> max(Lane<T> a, Lane<T> b) {
    return a.r > b.r ? a.r : b.r;
}
template <class T>
ASPERITY_INLINE unsigned bits_where_less(Lane<T> a, Lane<T> b) {
    return a.r < b.r ? 1u : 0u;
}

ASPERITY_INLINE double fused(double a, double b, double c) {
#if defined(__CUDA_ARCH__)
    return ::fma(a, b, c);
#else
    return __builtin_fma(a, b, c);
#endif
}
ASPERITY_INLINE float fused(float a, float b, float c) {
#if defined(__CUDA_ARCH__)
    return ::fmaf(a, b, c);
#else
    return __builtin_fmaf(a, b, c);
#endif
}
template <class T>
ASPERITY_INLINE Lane<T> fma(Lane<T> a, Lane<T> b, Lane<T> c) {
    return fused(a.r, b.r, c.r);
}
template <class T>
ASPERITY_INLINE Lane<T> fms(Lane<T> a, Lane<T> b, Lane<T> c) {
    return fused(a.r, b.r, -c.r);
}
template <class T>
ASPERITY_INLINE Lane<T> fms_where_less(Lane<T> x, Lane<T> y, Lane<T> a, Lane<T> b, Lane<T> c) {
    return x.r < y.r ? fms(a, b, c) : Lane<T>(T(0));
}

template <class T>
ASPERITY_INLINE Lane<T> sqrt(Lane<T> a) {
    return std::sqrt(a.r);
}
ASPERITY_INLINE Lane<double> with_last_bit(Lane<double> a) {
    std::uint64_t bits;
    std::memcpy(&bits, &a.r, sizeof bits);
    bits |= 1;
    std::memcpy(&a.r, &bits, sizeof bits);
    return a;
}
ASPERITY_INLINE Lane<double> power_of_two(Lane<double> n) { return asperity::power_of_two(n.r); }
ASPERITY_INLINE Lane<float> power_of_two(Lane<float> n) {
    const float biased = n.r + (0x1.8p23f + 127.0f);
    std::uint32_t bits;
    std::memcpy(&bits, &biased, sizeof bits);
    bits <<= 23;
    float power;
    std::memcpy(&power, &bits, sizeof power);
    return power;
}
template <class T>
ASPERITY_INLINE void gather_four(const T* table, Lane<T> n, Lane<T> (&row)[4]) {
    for (int k = 0; k < 4; ++k)
        row[k] = table[4 * static_cast<std::ptrdiff_t>(n.r) + k];
}

ASPERITY_INLINE Lane<double> first_lanes(Lane<double> a, int) { return a; }
ASPERITY_INLINE void collect(const BasicExactSum<Lane<double>>& lane, ExactSum& into) {
    into.merge({{lane.bin[0].r, lane.bin[1].r}});
}

/// Returns the smallest of all lanes.
ASPERITY_INLINE double lowest(Lane<double> a) { return a.r; }
/// Returns the sum of all lanes.
ASPERITY_INLINE double total(Lane<double> a) { return a.r; }

/// Family of value types of a device's thread, for kernels.
struct Scalar {
    template <class T>
    using Of = Lane<T>;
};

} // namespace asperity::ASPERITY_VARIANT
