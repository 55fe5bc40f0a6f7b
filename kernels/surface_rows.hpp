// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A row of a surface at a time: what a relaxation does with its vectors, at the sites and as waves
// (decomposition/waves.hpp), compiled for each processor level (variant.hpp).
//
// Waves are pairs (real, imaginary), sites / 2 + 1 of them in a row. Arithmetic is in the wider of
// the two types that meet, inner products always in double. Orders of sums belong to the level: the
// same on any number of threads, others on another level.
#pragma once

#include <cstdint>

namespace asperity {

/// A number in two bytes: the upper half of a float, good to 1/256 of itself. For what is only to
/// be remembered roughly, where memory traffic is the cost.
struct ShortFloat {
    std::uint16_t bits = 0;
};

/// What one row of waves sees of a table of 3 x 3 matrices, each acting on (u_x, u_y, i u_z).
template <class T>
struct MatrixRow {
    enum Entry { xx, yy, zz, xy, xz, yz, entries };
    const T* at[entries]; ///< [wave]; of one component only zz is looked at
    T sign;               ///< of q_y: on xy and yz
};

/// The rows' arithmetic for one processor level.
struct RowKernels {
    template <class A, class B>
    using Dot = double (*)(const A*, const B*, int sites);
    template <class From, class To>
    using Combine = void (*)(double, const From*, double, To*, int);
    template <class M, class U, class F>
    using Multiply = void (*)(const MatrixRow<M>&, int, int, const U* const*, double, F* const*);

    Dot<double, double> dot_double;
    Dot<double, float> dot_mixed;
    Dot<float, float> dot_float;
    Dot<double, ShortFloat> dot_short;
    Combine<double, double> combine_double;
    Combine<double, float> combine_narrow;
    Combine<float, double> combine_wide;
    Combine<float, float> combine_float;
    Multiply<double, double, double> multiply_double;
    Multiply<double, float, float> multiply_float;
    Multiply<float, double, double> condition_double;
    Multiply<float, double, float> condition_mixed;
    Multiply<float, float, float> condition_float;
    void (*weigh)(double, const float*, const ShortFloat* const*, const float*, int, float*, int);
    void (*shorten)(double, const float*, double, const float*, ShortFloat*, int);
    float (*longest)(const float* const*, int, int);
    void (*clip)(float, float* const*, int, int);
};

/// The kernels for the running processor (processor_level()).
const RowKernels& row_kernels();

/// One row's part of sum_q conj(a_q).b_q, columns inside counted twice.
inline double row_dot(const double* a, const double* b, int sites) {
    return row_kernels().dot_double(a, b, sites);
}
inline double row_dot(const double* a, const float* b, int sites) {
    return row_kernels().dot_mixed(a, b, sites);
}
inline double row_dot(const float* a, const float* b, int sites) {
    return row_kernels().dot_float(a, b, sites);
}
inline double row_dot(const double* a, const ShortFloat* b, int sites) {
    return row_kernels().dot_short(a, b, sites);
}

/// to <- a from + keep to, n numbers; what is not kept is not looked at.
inline void combine_row(double a, const double* from, double keep, double* to, int n) {
    row_kernels().combine_double(a, from, keep, to, n);
}
inline void combine_row(double a, const double* from, double keep, float* to, int n) {
    row_kernels().combine_narrow(a, from, keep, to, n);
}
inline void combine_row(double a, const float* from, double keep, double* to, int n) {
    row_kernels().combine_wide(a, from, keep, to, n);
}
inline void combine_row(double a, const float* from, double keep, float* to, int n) {
    row_kernels().combine_float(a, from, keep, to, n);
}

/// f <- m u + norm f for a row of waves of one or three components; u and f may be the same.
inline void multiply_row(const MatrixRow<double>& m, int waves, int components,
                         const double* const* u, double norm, double* const* f) {
    row_kernels().multiply_double(m, waves, components, u, norm, f);
}
inline void multiply_row(const MatrixRow<double>& m, int waves, int components,
                         const float* const* u, double norm, float* const* f) {
    row_kernels().multiply_float(m, waves, components, u, norm, f);
}
inline void multiply_row(const MatrixRow<float>& m, int waves, int components,
                         const double* const* u, double norm, double* const* f) {
    row_kernels().condition_double(m, waves, components, u, norm, f);
}
inline void multiply_row(const MatrixRow<float>& m, int waves, int components,
                         const double* const* u, double norm, float* const* f) {
    row_kernels().condition_mixed(m, waves, components, u, norm, f);
}
inline void multiply_row(const MatrixRow<float>& m, int waves, int components,
                         const float* const* u, double norm, float* const* f) {
    row_kernels().condition_float(m, waves, components, u, norm, f);
}

/// to <- a first + sum_j weight[j] from[j], n numbers of each of `count` rows.
inline void weigh_rows(double a, const float* first, const ShortFloat* const* from,
                       const float* weight, int count, float* to, int n) {
    row_kernels().weigh(a, first, from, weight, count, to, n);
}
/// to <- a x + b y, rounded to the nearest.
inline void shorten_row(double a, const float* x, double b, const float* y, ShortFloat* to, int n) {
    row_kernels().shorten(a, x, b, y, to, n);
}
/// The greatest squared length of a row of vectors, given by components.
inline float longest_squared(const float* const* v, int components, int n) {
    return row_kernels().longest(v, components, n);
}
/// Shortens those that are longer than bound.
inline void clip_row(float bound, float* const* v, int components, int n) {
    row_kernels().clip(bound, v, components, n);
}

} // namespace asperity
