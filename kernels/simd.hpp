// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One SIMD register, as a number type.
//
// A kernel on Pack<double> reads like scalar arithmetic and is compiled once for each x86-64 level
// (variant.hpp), with the widest register of the level. fma() is a fused multiply-add if the level
// has this instruction, otherwise a multiplication and an addition; the compiler may not contract
// operations (-ffp-contract=off), so that the result for a node depends on the level alone, not on
// the loop that computed it.
//
// The whole file is in a namespace of its level, so that the linker cannot use a function compiled
// for a newer processor on an older one.
#pragma once

#include "kernels/annotations.hpp"
#include "kernels/number.hpp"
#include "kernels/variant.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace asperity::ASPERITY_VARIANT {

#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX2__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

typedef double DoubleRegister __attribute__((vector_size(register_bytes)));
typedef float FloatRegister __attribute__((vector_size(register_bytes)));
typedef std::int64_t DoubleMask __attribute__((vector_size(register_bytes)));
typedef std::int32_t FloatMask __attribute__((vector_size(register_bytes)));

template <class T>
struct RegisterOf;
template <>
struct RegisterOf<double> {
    using type = DoubleRegister;
    using mask = DoubleMask;
};
template <>
struct RegisterOf<float> {
    using type = FloatRegister;
    using mask = FloatMask;
};

/// One SIMD register of numbers.
template <class T>
struct Pack {
    static constexpr int width = register_bytes / static_cast<int>(sizeof(T));
    using Value = T;
    using Register = typename RegisterOf<T>::type;
    using Mask = typename RegisterOf<T>::mask;
    /// Register in memory without alignment. memcpy is no alternative: with the compiler barrier of
    /// load_once(), g++ 12 would pass an AVX2 register through the stack.
    typedef T Unaligned __attribute__((vector_size(register_bytes), aligned(sizeof(T)), may_alias));

    Register r;

    Pack() = default;
    ASPERITY_INLINE Pack(Register value) : r(value) {}
    ASPERITY_INLINE Pack(T value) : r(value - Register{}) {} // value - 0 is value, bit for bit

    static ASPERITY_INLINE Pack load(const T* from) {
        return Pack(static_cast<Register>(*reinterpret_cast<const Unaligned*>(from)));
    }
    /// Loads a pack and prevents the compiler from reading it again for a second use.
    static ASPERITY_INLINE Pack load_once(const T* from) {
        Pack p = load(from);
#if defined(__x86_64__)
        asm("" : "+v"(p.r));
#endif
        return p;
    }
    /// Loads the first count elements; the lanes behind them repeat the last element.
    static ASPERITY_INLINE Pack load_first(const T* from, int count) {
        if (count >= width) return load(from);
        Pack p;
        for (int i = 0; i < width; ++i)
            p.r[i] = from[i < count ? i : count - 1];
        return p;
    }
    ASPERITY_INLINE void store(T* to) const { std::memcpy(to, &r, sizeof(Register)); }
    /// Stores lanes [first, last), for the ends of a row; lane i goes to to[i].
    ASPERITY_INLINE void store_lanes(T* to, int first, int last) const {
        if (first <= 0 && last >= width) return store(to);
        T lane[width];
        std::memcpy(lane, &r, sizeof(Register));
        for (int i = first > 0 ? first : 0; i < (last < width ? last : width); ++i)
            to[i] = lane[i];
    }
    /// Stores the first `count` lanes, for the end of a row.
    ASPERITY_INLINE void store_first(T* to, int count) const { store_lanes(to, 0, count); }
    ASPERITY_INLINE T operator[](int lane) const { return r[lane]; }

    friend ASPERITY_INLINE Pack operator+(Pack a, Pack b) { return a.r + b.r; }
    friend ASPERITY_INLINE Pack operator-(Pack a, Pack b) { return a.r - b.r; }
    friend ASPERITY_INLINE Pack operator*(Pack a, Pack b) { return a.r * b.r; }
    friend ASPERITY_INLINE Pack operator/(Pack a, Pack b) { return a.r / b.r; }
    friend ASPERITY_INLINE Pack operator-(Pack a) { return -a.r; }
    friend ASPERITY_INLINE Mask operator<(Pack a, Pack b) { return a.r < b.r; }
    friend ASPERITY_INLINE Mask operator>(Pack a, Pack b) { return a.r > b.r; }
};

/// Returns a in the lanes in which the mask is set, b in the others.
template <class T>
ASPERITY_INLINE Pack<T> select(typename Pack<T>::Mask mask, Pack<T> a, Pack<T> b) {
    return mask ? a.r : b.r;
}

template <class T>
ASPERITY_INLINE Pack<T> min(Pack<T> a, Pack<T> b) {
    return a.r < b.r ? a.r : b.r;
}
template <class T>
ASPERITY_INLINE Pack<T> max(Pack<T> a, Pack<T> b) {
    return a.r > b.r ? a.r : b.r;
}

/// Sets bit i if lane i of a is less than that of b.
template <class T>
ASPERITY_INLINE unsigned bits_where_less(Pack<T> a, Pack<T> b) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 8)
        return _mm512_cmp_pd_mask((__m512d)a.r, (__m512d)b.r, _CMP_LT_OQ);
    else
        return _mm512_cmp_ps_mask((__m512)a.r, (__m512)b.r, _CMP_LT_OQ);
#elif defined(__AVX2__)
    if constexpr (sizeof(T) == 8)
        return _mm256_movemask_pd((__m256d)(a < b));
    else
        return _mm256_movemask_ps((__m256)(a < b));
#else
    const auto less = a < b;
    unsigned bits = 0;
    for (int i = 0; i < Pack<T>::width; ++i)
        bits |= less[i] ? 1u << i : 0u;
    return bits;
#endif
}

/// Returns the elements lane_of(0), lane_of(1), ... of the concatenation of packs a and b. lane_of
/// must have no captures.
template <class T, class LaneOf, int... i>
ASPERITY_INLINE Pack<T> shuffle(Pack<T> a, Pack<T> b, LaneOf lane_of,
                                std::integer_sequence<int, i...>) {
    return __builtin_shufflevector(a.r, b.r, lane_of(i)...);
}
template <class T, class LaneOf>
ASPERITY_INLINE Pack<T> shuffle(Pack<T> a, Pack<T> b, LaneOf lane_of) {
    return shuffle(a, b, lane_of, std::make_integer_sequence<int, Pack<T>::width>());
}

/// Returns the pack one element after a, a1 a2 ... b0, given the packs a and b in memory order.
template <class T>
ASPERITY_INLINE Pack<T> shift_left(Pack<T> a, Pack<T> b) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 8) // needs no register for the numbers of lanes
        return (DoubleRegister)_mm512_maskz_alignr_epi64(0xff, (__m512i)b.r, (__m512i)a.r, 1);
#endif
    return shuffle(a, b, [](int i) { return i + 1; });
}
/// Returns the pack one element before b, a_last b0 b1 ..., given the packs a and b in memory
/// order.
template <class T>
ASPERITY_INLINE Pack<T> shift_right(Pack<T> a, Pack<T> b) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 8)
        return (DoubleRegister)_mm512_maskz_alignr_epi64(0xff, (__m512i)b.r, (__m512i)a.r, 7);
#endif
    return shuffle(a, b, [](int i) { return Pack<T>::width - 1 + i; });
}

/// A register of 32-bit integers for fixed-point numbers, whose differences are exact.
struct PackInt32 {
    FloatMask r;

    PackInt32() = default;
    ASPERITY_INLINE PackInt32(FloatMask value) : r(value) {}
    static ASPERITY_INLINE PackInt32 load(const std::int32_t* from) {
        PackInt32 p;
        std::memcpy(&p.r, from, sizeof p.r);
        return p;
    }
    static ASPERITY_INLINE PackInt32 same(std::int32_t value) { return FloatMask{} + value; }
    friend ASPERITY_INLINE PackInt32 operator-(PackInt32 a, PackInt32 b) { return a.r - b.r; }
};
ASPERITY_INLINE Pack<float> to_float(PackInt32 a) {
    return Pack<float>(__builtin_convertvector(a.r, FloatRegister));
}

/// Converts half a register of floats, from lane `first` on, to doubles.
template <int first, int... lane>
ASPERITY_INLINE Pack<double> widen(Pack<float> a, std::integer_sequence<int, lane...>) {
    return Pack<double>(__builtin_convertvector(
        __builtin_shufflevector(a.r, a.r, (first + lane)...), DoubleRegister));
}
ASPERITY_INLINE Pack<double> widen_low(Pack<float> a) {
    return widen<0>(a, std::make_integer_sequence<int, Pack<double>::width>());
}
ASPERITY_INLINE Pack<double> widen_high(Pack<float> a) {
    return widen<Pack<double>::width>(a, std::make_integer_sequence<int, Pack<double>::width>());
}

/// Returns the pack whose lane i is lane i ^ half of a.
template <int half>
ASPERITY_INLINE Pack<double> exchange(Pack<double> a) {
    return shuffle(a, a, [](int i) { return i ^ half; });
}

/// Returns the elements at even places of the concatenation of two packs.
template <class T>
ASPERITY_INLINE Pack<T> evens(Pack<T> a, Pack<T> b) {
    return shuffle(a, b, [](int i) { return 2 * i; });
}
/// Returns the elements at odd places of the concatenation of two packs.
template <class T>
ASPERITY_INLINE Pack<T> odds(Pack<T> a, Pack<T> b) {
    return shuffle(a, b, [](int i) { return 2 * i + 1; });
}
/// Returns the first pack of a0 b0 a1 b1 ..., the inverse of evens() and odds().
template <class T>
ASPERITY_INLINE Pack<T> interleave_low(Pack<T> a, Pack<T> b) {
    return shuffle(a, b, [](int i) { return i / 2 + (i & 1) * Pack<T>::width; });
}
/// Returns the second pack of a0 b0 a1 b1 ...
template <class T>
ASPERITY_INLINE Pack<T> interleave_high(Pack<T> a, Pack<T> b) {
    return shuffle(a, b, [](int i) { return (Pack<T>::width + i) / 2 + (i & 1) * Pack<T>::width; });
}

/// Returns the square root, rounded once.
template <class T>
ASPERITY_INLINE Pack<T> sqrt(Pack<T> a) {
    using Register = typename Pack<T>::Register;
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>((Register)_mm512_maskz_sqrt_pd(0xff, (__m512d)a.r));
    else
        return Pack<T>((Register)_mm512_maskz_sqrt_ps(0xffff, (__m512)a.r));
#elif defined(__AVX2__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>((Register)_mm256_sqrt_pd((__m256d)a.r));
    else
        return Pack<T>((Register)_mm256_sqrt_ps((__m256)a.r));
#elif defined(__x86_64__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>((Register)_mm_sqrt_pd((__m128d)a.r));
    else
        return Pack<T>((Register)_mm_sqrt_ps((__m128)a.r));
#elif defined(__aarch64__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>((Register)vsqrtq_f64((float64x2_t)a.r));
    else
        return Pack<T>((Register)vsqrtq_f32((float32x4_t)a.r));
#else
    for (int i = 0; i < Pack<T>::width; ++i)
        a.r[i] = std::sqrt(a.r[i]);
    return a;
#endif
}

/// Returns a * b + c, rounded once if the processor level has a fused operation.
template <class T>
ASPERITY_INLINE Pack<T> fma(Pack<T> a, Pack<T> b, Pack<T> c) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>(
            (typename Pack<T>::Register)_mm512_fmadd_pd((__m512d)a.r, (__m512d)b.r, (__m512d)c.r));
    else
        return Pack<T>(
            (typename Pack<T>::Register)_mm512_fmadd_ps((__m512)a.r, (__m512)b.r, (__m512)c.r));
#elif defined(__FMA__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>(
            (typename Pack<T>::Register)_mm256_fmadd_pd((__m256d)a.r, (__m256d)b.r, (__m256d)c.r));
    else
        return Pack<T>(
            (typename Pack<T>::Register)_mm256_fmadd_ps((__m256)a.r, (__m256)b.r, (__m256)c.r));
#elif defined(__aarch64__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>((typename Pack<T>::Register)vfmaq_f64((float64x2_t)c.r, (float64x2_t)a.r,
                                                             (float64x2_t)b.r));
    else
        return Pack<T>((typename Pack<T>::Register)vfmaq_f32((float32x4_t)c.r, (float32x4_t)a.r,
                                                             (float32x4_t)b.r));
#else
    return a.r * b.r + c.r;
#endif
}
/// Returns a * b - c, rounded once if the processor level has a fused operation.
template <class T>
ASPERITY_INLINE Pack<T> fms(Pack<T> a, Pack<T> b, Pack<T> c) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>(
            (typename Pack<T>::Register)_mm512_fmsub_pd((__m512d)a.r, (__m512d)b.r, (__m512d)c.r));
    else
        return Pack<T>(
            (typename Pack<T>::Register)_mm512_fmsub_ps((__m512)a.r, (__m512)b.r, (__m512)c.r));
#elif defined(__FMA__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>(
            (typename Pack<T>::Register)_mm256_fmsub_pd((__m256d)a.r, (__m256d)b.r, (__m256d)c.r));
    else
        return Pack<T>(
            (typename Pack<T>::Register)_mm256_fmsub_ps((__m256)a.r, (__m256)b.r, (__m256)c.r));
#elif defined(__aarch64__)
    return fma(a, b, -c);
#else
    return a.r * b.r - c.r;
#endif
}
/// Returns a * b - c in the lanes with x < y, zero in the others; the mask costs no more than the
/// comparison.
template <class T>
ASPERITY_INLINE Pack<T> fms_where_less(Pack<T> x, Pack<T> y, Pack<T> a, Pack<T> b, Pack<T> c) {
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 8)
        return Pack<T>((typename Pack<T>::Register)_mm512_maskz_fmsub_pd(
            _mm512_cmp_pd_mask((__m512d)x.r, (__m512d)y.r, _CMP_LT_OQ), (__m512d)a.r, (__m512d)b.r,
            (__m512d)c.r));
    else
        return Pack<T>((typename Pack<T>::Register)_mm512_maskz_fmsub_ps(
            _mm512_cmp_ps_mask((__m512)x.r, (__m512)y.r, _CMP_LT_OQ), (__m512)a.r, (__m512)b.r,
            (__m512)c.r));
#else
    return select(x < y, fms(a, b, c), Pack<T>(T(0)));
#endif
}
/// Returns 1 / sqrt(a) to about one unit of the last place. With AVX-512, one step of fourth order
/// refines the instruction's estimate of 14 bits, which reduces the time of a pass with nine
/// inverse roots per node to a third; the last bits therefore differ from those of other levels.
ASPERITY_INLINE Pack<double> inverse_sqrt(Pack<double> a) {
    using P = Pack<double>;
#if defined(__AVX512F__)
    const P y = (DoubleRegister)_mm512_maskz_rsqrt14_pd(0xff, (__m512d)a.r);
    const P e = fma(-(a * y), y, P(1.0)); // 1/sqrt(1 - e) = 1 + e/2 + 3/8 e^2 + 5/16 e^3 + ...
    return fma(y * e, fma(e, fma(e, P(0.3125), P(0.375)), P(0.5)), y);
#else
    return P(1.0) / sqrt(a);
#endif
}
/// Returns the numbers with the last bit of their fractions set.
ASPERITY_INLINE Pack<double> with_last_bit(Pack<double> a) {
    return Pack<double>((DoubleRegister)((DoubleMask)a.r | 1));
}
/// Returns 2^n in each lane, bitwise identical to power_of_two() of a number.
ASPERITY_INLINE Pack<double> power_of_two(Pack<double> n) {
    return Pack<double>(
        (DoubleRegister)((DoubleMask)(n + Pack<double>(0x1.8p52 + 1023.0)).r << 52));
}
ASPERITY_INLINE Pack<float> power_of_two(Pack<float> n) {
    return Pack<float>((FloatRegister)((FloatMask)(n + Pack<float>(0x1.8p23f + 127.0f)).r << 23));
}
/// Loads rows n of a table of four numbers each, one row for each lane.
template <class T>
ASPERITY_INLINE void gather_four(const T* table, Pack<T> n, Pack<T> (&row)[4]) {
    constexpr int width = Pack<T>::width;
    alignas(64) T lane[4][width];
    for (int i = 0; i < width; ++i)
        for (int k = 0; k < 4; ++k)
            lane[k][i] = table[4 * static_cast<std::ptrdiff_t>(n[i]) + k];
    for (int k = 0; k < 4; ++k)
        row[k] = Pack<T>::load(lane[k]);
}
/// Combines all lanes pairwise, in log2(width) steps.
template <int half, class Combine>
ASPERITY_INLINE double halve(Pack<double> v, Combine combine) {
    v = combine(v, exchange<half>(v));
    if constexpr (half > 1)
        return halve<half / 2>(v, combine);
    else
        return v[0];
}
/// Returns the smallest of all lanes.
ASPERITY_INLINE double lowest(Pack<double> v) {
    using P = Pack<double>;
    return halve<P::width / 2>(v, [](P a, P b) { return min(a, b); });
}
/// Returns the sum of all lanes.
ASPERITY_INLINE double total(Pack<double> v) {
    using P = Pack<double>;
    return halve<P::width / 2>(v, [](P a, P b) { return a + b; });
}

/// Family of value types of a processor's registers, for kernels.
struct Simd {
    template <class T>
    using Of = Pack<T>;
};

/// Returns a * b + c for scalar code of a kernel, fused if the level fuses: bitwise identical to a
/// pack's lane.
ASPERITY_INLINE double fma(double a, double b, double c) {
#if defined(__FMA__) || defined(__aarch64__)
    return __builtin_fma(a, b, c);
#else
    return a * b + c;
#endif
}

} // namespace asperity::ASPERITY_VARIANT
