// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A row of a surface at a time: what a relaxation does with its vectors, at the sites and as waves
// (decomposition/waves.hpp), compiled for each processor level (variant.hpp).
//
// Waves are pairs (real, imaginary), sites / 2 + 1 of them in a row. Arithmetic is in the wider of
// the two types that meet, inner products always in double, products with matrices in the type of
// the waves. Orders of sums belong to the level: the
// same on any number of threads, others on another level.
#pragma once

namespace asperity {

/// The part of a table of 3 x 3 matrices for one row of waves, each acting on (u_x, u_y, i u_z).
template <class T>
struct MatrixRow {
    enum Entry { xx, yy, zz, xy, xz, yz, entries };
    const T* at[entries]; ///< [wave]; of one component only zz is read
    T sign;               ///< of q_y: on xy and yz
};

/// A row of sites on their way downhill (engine/equilibrium/heavy_ball.hpp), by components.
struct BallRow {
    const float* target[3]; ///< where each would go, Å
    double* u[3];           ///< where it is
    float* momentum[3];     ///< how far it went last
    float* step_size;       ///< fraction of the distance to the target that it goes
};
/// How the momentum and the step size are kept.
struct BallRule {
    float keep;       ///< of the momentum
    float cut, raise; ///< of the step size: where the target lies back, and elsewhere
    float most;       ///< of the step size
    float bound;      ///< of a move, Å
};

/// The rows' arithmetic for one processor level.
struct RowKernels {
    template <class A, class B>
    using Dot = double (*)(const A*, const B*, int sites);
    template <class From, class To>
    using Combine = void (*)(double, const From*, double, To*, int);
    template <class M, class T>
    using Multiply = void (*)(const MatrixRow<M>&, int, int, const T* const*, double, T* const*);

    Dot<double, double> dot_double;
    Dot<double, float> dot_mixed;
    Dot<float, float> dot_float;
    Combine<double, double> combine_double;
    Combine<double, float> combine_narrow;
    Combine<float, double> combine_wide;
    Combine<float, float> combine_float;
    Multiply<double, double> multiply_double;
    Multiply<double, float> multiply_float;
    Multiply<float, float> condition_float;
    float (*longest)(const float* const*, int, int);
    void (*tie)(double, double, const double*, const double*, float*, int);
    float (*ball)(const BallRow&, const BallRule&, int, int);
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

/// to <- a from + keep to, n numbers; with keep = 0, to is not read.
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
                         const float* const* u, double norm, float* const* f) {
    row_kernels().condition_float(m, waves, components, u, norm, f);
}

/// The greatest squared length of a row of vectors, given by components.
inline float longest_squared(const float* const* v, int components, int n) {
    return row_kernels().longest(v, components, n);
}
/// to <- norm (k u + f), n numbers.
inline void tie_row(double k, double norm, const double* u, const double* f, float* to, int n) {
    row_kernels().tie(k, norm, u, f, to, n);
}
/// Moves the sites. Returns the greatest squared distance from a target.
inline float move_row(const BallRow& row, const BallRule& rule, int components, int n) {
    return row_kernels().ball(row, rule, components, n);
}

} // namespace asperity
