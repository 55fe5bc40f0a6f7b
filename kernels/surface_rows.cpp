// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Plain loops: what they need of wide registers the compiler finds, once it is allowed to.
#include "kernels/surface_rows.hpp"

#include "kernels/variant.hpp"

#include <cmath>
#include <cstddef>
#include <type_traits>

namespace asperity::ASPERITY_VARIANT {

namespace {

inline double wide(double v) { return v; }
inline double wide(float v) { return static_cast<double>(v); }

template <class A, class B>
double dot(const A* a, const B* b, int rows, const double* weights) {
    // A partial sum for each number of a row, added in this order for any width of registers and
    // the compiler: left to the compiler, the order would be its own.
    constexpr int lanes = 2 * block_columns;
    double part[lanes] = {};
    for (int y = 0; y < rows; ++y, a += lanes, b += lanes)
#pragma omp simd
        for (int k = 0; k < lanes; ++k)
            part[k] += wide(a[k]) * wide(b[k]);
    for (int k = 0; k < lanes; ++k)
        part[k] *= weights[k / 2];
    for (int half = lanes / 2; half > 0; half /= 2)
        for (int k = 0; k < half; ++k)
            part[k] += part[k + half];
    return part[0];
}

template <class From, class To>
void combine(double a, const From* from, double b, To* to, int n) {
    using T = std::common_type_t<From, To>;
    const T from_factor = static_cast<T>(a), to_factor = static_cast<T>(b);
    if (b == 0.0) {
#pragma omp simd
        for (int i = 0; i < n; ++i)
            to[i] = static_cast<To>(from_factor * static_cast<T>(from[i]));
        return;
    }
#pragma omp simd
    for (int i = 0; i < n; ++i)
        to[i] = static_cast<To>(from_factor * static_cast<T>(from[i]) +
                                to_factor * static_cast<T>(to[i]));
}

template <bool accumulate, class T>
void multiply_three(const T* m, int sites, const T* u, double norm_, const T* g, T* f) {
    using namespace matrix_entry;
    constexpr int n = block_columns;
    const std::ptrdiff_t component = static_cast<std::ptrdiff_t>(sites) * 2 * n;
    const T norm = static_cast<T>(norm_);
    for (int row = 0; row < sites; ++row, u += 2 * n, g += accumulate ? 2 * n : 0, f += 2 * n) {
        const int mirrored = row < sites - row ? row : sites - row;
        const T* const e = m + static_cast<std::ptrdiff_t>(mirrored) * count * n;
        const T sign = 2 * row > sites ? T(-1) : T(1);
        const T *ux = u, *uy = ux + component, *uz = uy + component;
        T *fx = f, *fy = fx + component, *fz = fy + component;
        const T *gx = g, *gy = nullptr, *gz = nullptr;
        if constexpr (accumulate) {
            gy = gx + component;
            gz = gy + component;
        }
#pragma omp simd
        for (int i = 0; i < n; ++i) {
            const T cross = sign * e[xy * n + i];
            const T across = sign * e[yz * n + i];
            const T along = e[xz * n + i], a = e[xx * n + i];
            const T b = e[yy * n + i], c = e[zz * n + i];
            const T x0 = ux[2 * i], x1 = ux[2 * i + 1];
            const T y0 = uy[2 * i], y1 = uy[2 * i + 1];
            const T z0 = uz[2 * i], z1 = uz[2 * i + 1];
            // w = i u_z = (-z1, z0); the third row, of i f_z, likewise.
            T fx0 = a * x0 + cross * y0 - along * z1, fx1 = a * x1 + cross * y1 + along * z0;
            T fy0 = cross * x0 + b * y0 - across * z1, fy1 = cross * x1 + b * y1 + across * z0;
            T fz0 = c * z0 + along * x1 + across * y1, fz1 = c * z1 - along * x0 - across * y0;
            if constexpr (accumulate) {
                fx0 += norm * gx[2 * i];
                fx1 += norm * gx[2 * i + 1];
                fy0 += norm * gy[2 * i];
                fy1 += norm * gy[2 * i + 1];
                fz0 += norm * gz[2 * i];
                fz1 += norm * gz[2 * i + 1];
            }
            fx[2 * i] = fx0;
            fx[2 * i + 1] = fx1;
            fy[2 * i] = fy0;
            fy[2 * i + 1] = fy1;
            fz[2 * i] = fz0;
            fz[2 * i + 1] = fz1;
        }
    }
}

template <class T>
void multiply(const T* m, int sites, int components, const T* u, double norm_, const T* g, T* f) {
    if (components == 3) {
        if (norm_ == 0.0)
            multiply_three<false>(m, sites, u, norm_, g, f);
        else
            multiply_three<true>(m, sites, u, norm_, g, f);
        return;
    }
    constexpr int n = block_columns;
    const T norm = static_cast<T>(norm_);
    for (int row = 0; row < sites; ++row) {
        const T* const e = m + (row < sites - row ? row : sites - row) * n;
        for (int k = 0; k < 2 * n; ++k) {
            const int i = row * 2 * n + k;
            const T kept = norm == T(0) ? T(0) : norm * g[i];
            f[i] = e[k / 2] * u[i] + kept;
        }
    }
}

void multiply_sites(const SiteMatrices& m, float* const* v, int components, int n) {
    using namespace matrix_entry;
    const float* mzz = m.entry[zz];
    if (components == 1) {
        float* z = v[0];
#pragma omp simd
        for (int i = 0; i < n; ++i)
            z[i] *= mzz[i];
        return;
    }
    const float *mxx = m.entry[xx], *myy = m.entry[yy];
    const float *mxy = m.entry[xy], *mxz = m.entry[xz], *myz = m.entry[yz];
    float *x = v[0], *y = v[1], *z = v[2];
#pragma omp simd
    for (int i = 0; i < n; ++i) {
        const float a = x[i], b = y[i], c = z[i];
        x[i] = mxx[i] * a + mxy[i] * b + mxz[i] * c;
        y[i] = mxy[i] * a + myy[i] * b + myz[i] * c;
        z[i] = mxz[i] * a + myz[i] * b + mzz[i] * c;
    }
}

float longest_squared(const float* const* v, int components, int n) {
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

void spring_force(double k, double norm, const double* u, const double* f, float* to, int n) {
#pragma omp simd
    for (int i = 0; i < n; ++i)
        to[i] = static_cast<float>(norm * (k * u[i] + f[i]));
}

template <int components>
float move(const HeavyBallRow& row, const HeavyBallRule& rule_, int n) {
    // Copies and selections of values: loops over pointers and branches within a row's structure
    // the compiler would not make wide.
    constexpr int z = components - 1, x = 0, y = components / 2;
    const float *tx = row.target[x], *ty = row.target[y], *tz = row.target[z];
    float *mx = row.momentum[x], *my = row.momentum[y], *mz = row.momentum[z];
    double *ux = row.u[x], *uy = row.u[y], *uz = row.u[z];
    float* const step_sizes = row.step_size;
    const HeavyBallRule rule = rule_;
    const float bound2 = rule.move_max * rule.move_max;
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
        const float raised = rule.step_growth * step_sizes[i], cut = rule.step_cut * step_sizes[i];
        const float forth = raised < rule.step_size_max ? raised : rule.step_size_max;
        const float step_size = back ? cut : forth, decay = back ? 0.0f : rule.momentum_decay;
        step_sizes[i] = step_size;
        most = away2 > most ? away2 : most;
        float vz = step_size * wz + decay * mz[i], speed2 = vz * vz;
        float vx = 0.0f, vy = 0.0f;
        if constexpr (components == 3) {
            vx = step_size * wx + decay * mx[i];
            vy = step_size * wy + decay * my[i];
            speed2 = vx * vx + vy * vy + speed2;
        }
        const float shorter = rule.move_max / std::sqrt(speed2);
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

float heavy_ball(const HeavyBallRow& row, const HeavyBallRule& rule, int components, int n) {
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
                                multiply<double>,
                                multiply<float>,
                                multiply_sites,
                                longest_squared,
                                spring_force,
                                heavy_ball};

} // namespace asperity::ASPERITY_VARIANT
