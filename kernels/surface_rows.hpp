// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Vector operations of a relaxation on a part of a surface: rows of sites and blocks of waves
// (decomposition/waves.hpp), compiled for each processor level (variant.hpp).
//
// A block of waves consists of a few columns q_x of each component, [component][q_y][column], with
// each wave a pair (real, imaginary). Arithmetic is in the wider of the two argument types, inner
// products are in double, products with matrices are in the type of the waves. The order of a sum
// depends on the level alone, not on the number of threads.
#pragma once

namespace asperity {

/// Number of columns of a block: one cache line of a row in single precision.
inline constexpr int block_columns = 8;

/// Entries of a symmetric 3 x 3 matrix that acts on (u_x, u_y, i u_z). The table of a block is
/// [|q_y|][entry][column], with one component [|q_y|][column]; xy and yz change sign with q_y.
namespace matrix_entry {
enum { xx, yy, zz, xy, xz, yz, count };
}

/// A row of sites that the heavy-ball method moves (engine/statics/heavy_ball.hpp), by components.
struct HeavyBallRow {
    const float* target[3]; ///< targets of the sites, Å
    double* u[3];           ///< displacements, Å; updated
    float* momentum[3];     ///< last moves of the sites, Å; updated
    float* step_size; ///< fractions of the distance to the targets that the sites move; updated
};
/// Constants of the heavy-ball method.
struct HeavyBallRule {
    float momentum_decay; ///< factor of the last move in the next one
    float step_cut;       ///< factor of the step size if the target lies behind the last move
    float step_growth;    ///< factor of the step size otherwise
    float step_size_max;  ///< largest step size
    float move_max;       ///< largest move of a site, Å
};

/// A row of symmetric 3 x 3 matrices, one for each site, by entries (matrix_entry). With one
/// component only zz is read.
struct SiteMatrices {
    const float* entry[matrix_entry::count];
};

/// Kernels for one processor level; the functions below document them.
struct RowKernels {
    template <class A, class B>
    using Dot = double (*)(const A*, const B*, int rows, const double* weights);
    template <class From, class To>
    using Combine = void (*)(double, const From*, double, To*, int);
    template <class T>
    using Multiply = void (*)(const T*, int sites, int components, const T*, double, const T*, T*);

    Dot<double, double> dot_double;
    Dot<double, float> dot_mixed;
    Dot<float, float> dot_float;
    Combine<double, double> combine_double;
    Combine<double, float> combine_narrow;
    Combine<float, double> combine_wide;
    Combine<float, float> combine_float;
    Multiply<double> multiply_double;
    Multiply<float> multiply_float;
    void (*multiply_sites)(const SiteMatrices&, float* const*, int, int);
    float (*longest_squared)(const float* const*, int, int);
    void (*spring_force)(double, double, const double*, const double*, float*, int);
    float (*heavy_ball)(const HeavyBallRow&, const HeavyBallRule&, int, int);
};

/// Returns the kernels for the running processor (processor_level()).
const RowKernels& row_kernels();

/// Returns a block's part of sum_q conj(a_q).b_q. rows: number of rows of block_columns waves;
/// weights: multiplicities of the columns.
inline double block_dot(const double* a, const double* b, int rows, const double* weights) {
    return row_kernels().dot_double(a, b, rows, weights);
}
inline double block_dot(const double* a, const float* b, int rows, const double* weights) {
    return row_kernels().dot_mixed(a, b, rows, weights);
}
inline double block_dot(const float* a, const float* b, int rows, const double* weights) {
    return row_kernels().dot_float(a, b, rows, weights);
}

/// Sets to <- a from + b to for n numbers; b = 0 does not read `to`.
inline void combine_row(double a, const double* from, double b, double* to, int n) {
    row_kernels().combine_double(a, from, b, to, n);
}
inline void combine_row(double a, const double* from, double b, float* to, int n) {
    row_kernels().combine_narrow(a, from, b, to, n);
}
inline void combine_row(double a, const float* from, double b, double* to, int n) {
    row_kernels().combine_wide(a, from, b, to, n);
}
inline void combine_row(double a, const float* from, double b, float* to, int n) {
    row_kernels().combine_float(a, from, b, to, n);
}

/// Sets f <- m u + norm g for a block of one or three components. m: table of the block; sites: N;
/// f may be u or g; norm = 0 does not read g.
inline void multiply_block(const double* m, int sites, int components, const double* u, double norm,
                           const double* g, double* f) {
    row_kernels().multiply_double(m, sites, components, u, norm, g, f);
}
inline void multiply_block(const float* m, int sites, int components, const float* u, double norm,
                           const float* g, float* f) {
    row_kernels().multiply_float(m, sites, components, u, norm, g, f);
}

/// Multiplies a row of n vectors, given by components, by the matrices of their sites: v <- m v.
inline void multiply_sites(const SiteMatrices& m, float* const* v, int components, int n) {
    row_kernels().multiply_sites(m, v, components, n);
}

/// Returns the largest squared length of a row of n vectors, given by components.
inline float longest_squared(const float* const* v, int components, int n) {
    return row_kernels().longest_squared(v, components, n);
}
/// Sets to <- norm (k u + f) for n numbers: the sum of f and the force of a spring k between each
/// site at 0 and u.
inline void spring_force_row(double k, double norm, const double* u, const double* f, float* to,
                             int n) {
    row_kernels().spring_force(k, norm, u, f, to, n);
}
/// Moves the sites of a row by the heavy-ball method. Returns the largest squared distance from a
/// target, Å^2.
inline float heavy_ball_row(const HeavyBallRow& row, const HeavyBallRule& rule, int components,
                            int n) {
    return row_kernels().heavy_ball(row, rule, components, n);
}

} // namespace asperity
