// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Plain loops: what they need of wide registers the compiler finds, once it is allowed to.
#include "kernels/surface_rows.hpp"

#include "kernels/variant.hpp"

#include <cmath>
#include <type_traits>

namespace asperity::ASPERITY_VARIANT {

namespace {

inline double wide(double v) { return v; }
inline double wide(float v) { return static_cast<double>(v); }

template <class A, class B>
double dot(const A* a, const B* b, int sites) {
    const auto term = [&](int i) { return wide(a[i]) * wide(b[i]); };
    const int length = 2 * (sites / 2 + 1);
    // Partial sums, so many and added in this order whatever the width of registers and the
    // compiler: left to the compiler, the order would be its own.
    constexpr int lanes = 16;
    double part[lanes] = {};
    int i = 0;
    for (; i + lanes <= length; i += lanes)
#pragma omp simd
        for (int k = 0; k < lanes; ++k)
            part[k] += wide(a[i + k]) * wide(b[i + k]);
    for (int k = 0; i + k < length; ++k)
        part[k] += wide(a[i + k]) * wide(b[i + k]);
    for (int half = lanes / 2; half > 0; half /= 2)
        for (int k = 0; k < half; ++k)
            part[k] += part[k + half];
    double once = term(0) + term(1); // columns that have no mirror image
    if (sites % 2 == 0) once += term(length - 2) + term(length - 1);
    return 2.0 * part[0] - once;
}

template <class From, class To>
void combine(double a, const From* from, double keep, To* to, int n) {
    using T = std::common_type_t<From, To>;
    const T factor = static_cast<T>(a), kept = static_cast<T>(keep);
    if (keep == 0.0) {
#pragma omp simd
        for (int i = 0; i < n; ++i)
            to[i] = static_cast<To>(factor * static_cast<T>(from[i]));
        return;
    }
#pragma omp simd
    for (int i = 0; i < n; ++i)
        to[i] = static_cast<To>(factor * static_cast<T>(from[i]) + kept * static_cast<T>(to[i]));
}

template <bool keep, class M, class T>
void multiply_three(const MatrixRow<M>& m, int waves, const T* const* u, double norm_,
                    T* const* f) {
    using E = typename MatrixRow<M>::Entry;
    const M *xx = m.at[E::xx], *yy = m.at[E::yy], *zz = m.at[E::zz];
    const M *xy = m.at[E::xy], *xz = m.at[E::xz], *yz = m.at[E::yz];
    const T *ux = u[0], *uy = u[1], *uz = u[2];
    T *fx = f[0], *fy = f[1], *fz = f[2];
    const T sign = static_cast<T>(m.sign), norm = static_cast<T>(norm_);
#pragma omp simd
    for (int i = 0; i < waves; ++i) {
        const T cross = sign * static_cast<T>(xy[i]), across = sign * static_cast<T>(yz[i]);
        const T along = static_cast<T>(xz[i]), a = static_cast<T>(xx[i]);
        const T b = static_cast<T>(yy[i]), c = static_cast<T>(zz[i]);
        const T x0 = ux[2 * i], x1 = ux[2 * i + 1];
        const T y0 = uy[2 * i], y1 = uy[2 * i + 1];
        const T z0 = uz[2 * i], z1 = uz[2 * i + 1];
        // w = i u_z = (-z1, z0); the third row, of i f_z, likewise.
        T gx0 = a * x0 + cross * y0 - along * z1, gx1 = a * x1 + cross * y1 + along * z0;
        T gy0 = cross * x0 + b * y0 - across * z1, gy1 = cross * x1 + b * y1 + across * z0;
        T gz0 = c * z0 + along * x1 + across * y1, gz1 = c * z1 - along * x0 - across * y0;
        if constexpr (keep) {
            gx0 += norm * fx[2 * i];
            gx1 += norm * fx[2 * i + 1];
            gy0 += norm * fy[2 * i];
            gy1 += norm * fy[2 * i + 1];
            gz0 += norm * fz[2 * i];
            gz1 += norm * fz[2 * i + 1];
        }
        fx[2 * i] = gx0;
        fx[2 * i + 1] = gx1;
        fy[2 * i] = gy0;
        fy[2 * i + 1] = gy1;
        fz[2 * i] = gz0;
        fz[2 * i + 1] = gz1;
    }
}

template <class M, class T>
void multiply(const MatrixRow<M>& m, int waves, int components, const T* const* u, double norm,
              T* const* f) {
    if (components == 3) {
        if (norm == 0.0)
            multiply_three<false>(m, waves, u, norm, f);
        else
            multiply_three<true>(m, waves, u, norm, f);
        return;
    }
    const M* zz = m.at[MatrixRow<M>::zz];
    const T* from = u[0];
    T* to = f[0];
    for (int i = 0; i < 2 * waves; ++i) {
        const double kept = norm == 0.0 ? 0.0 : norm * static_cast<double>(to[i]);
        to[i] =
            static_cast<T>(static_cast<double>(zz[i / 2]) * static_cast<double>(from[i]) + kept);
    }
}

float longest(const float* const* v, int components, int n) {
    float most = 0.0f;
    if (components == 1) {
        const float* z = v[0];
#pragma omp simd reduction(max : most)
        for (int i = 0; i < n; ++i)
            most = z[i] * z[i] > most ? z[i] * z[i] : most;
        return most;
    }
    const float *x = v[0], *y = v[1], *z = v[2];
#pragma omp simd reduction(max : most)
    for (int i = 0; i < n; ++i) {
        const float length2 = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
        most = length2 > most ? length2 : most;
    }
    return most;
}

void tie(double k, double norm, const double* u, const double* f, float* to, int n) {
#pragma omp simd
    for (int i = 0; i < n; ++i)
        to[i] = static_cast<float>(norm * (k * u[i] + f[i]));
}

template <int components>
float move(const BallRow& row, const BallRule& rule_, int n) {
    // Copies and selections of values: loops over pointers and branches within a row's structure
    // the compiler would not make wide.
    constexpr int z = components - 1, x = 0, y = components / 2;
    const float *tx = row.target[x], *ty = row.target[y], *tz = row.target[z];
    float *mx = row.momentum[x], *my = row.momentum[y], *mz = row.momentum[z];
    double *ux = row.u[x], *uy = row.u[y], *uz = row.u[z];
    float* const step_sizes = row.step_size;
    const BallRule rule = rule_;
    const float bound2 = rule.bound * rule.bound;
    float most = 0.0f;
#pragma omp simd reduction(max : most)
    for (int i = 0; i < n; ++i) {
        const float wz = static_cast<float>(static_cast<double>(tz[i]) - uz[i]);
        float along = wz * mz[i], away2 = wz * wz;
        float wx = 0.0f, wy = 0.0f;
        if constexpr (components == 3) {
            wx = static_cast<float>(static_cast<double>(tx[i]) - ux[i]);
            wy = static_cast<float>(static_cast<double>(ty[i]) - uy[i]);
            along = wx * mx[i] + wy * my[i] + along;
            away2 = wx * wx + wy * wy + away2;
        }
        const bool back = along < 0.0f;
        const float raised = rule.raise * step_sizes[i], cut = rule.cut * step_sizes[i];
        const float forth = raised < rule.most ? raised : rule.most;
        const float step_size = back ? cut : forth, keep = back ? 0.0f : rule.keep;
        step_sizes[i] = step_size;
        most = away2 > most ? away2 : most;
        float vz = step_size * wz + keep * mz[i], speed2 = vz * vz;
        float vx = 0.0f, vy = 0.0f;
        if constexpr (components == 3) {
            vx = step_size * wx + keep * mx[i];
            vy = step_size * wy + keep * my[i];
            speed2 = vx * vx + vy * vy + speed2;
        }
        const float shorter = rule.bound / std::sqrt(speed2);
        const float q = speed2 > bound2 ? shorter : 1.0f;
        mz[i] = vz = q * vz;
        uz[i] += static_cast<double>(vz);
        if constexpr (components == 3) {
            mx[i] = vx = q * vx;
            my[i] = vy = q * vy;
            ux[i] += static_cast<double>(vx);
            uy[i] += static_cast<double>(vy);
        }
    }
    return most;
}

float ball(const BallRow& row, const BallRule& rule, int components, int n) {
    return components == 1 ? move<1>(row, rule, n) : move<3>(row, rule, n);
}

} // namespace

extern const RowKernels row_kernels;
const RowKernels row_kernels = {dot<double, double>,
                                dot<double, float>,
                                dot<float, float>,
                                combine<double, double>,
                                combine<double, float>,
                                combine<float, double>,
                                combine<float, float>,
                                multiply<double, double>,
                                multiply<double, float>,
                                multiply<float, float>,
                                longest,
                                tie,
                                ball};

} // namespace asperity::ASPERITY_VARIANT
