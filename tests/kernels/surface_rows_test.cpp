// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Rows of a surface: the compiler's wide loops against complex numbers written out, for lengths
// with and without a rest.
#include "kernels/surface_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

using namespace asperity;

namespace {

using Complex = std::complex<double>;

template <class T>
std::vector<T> numbers(int n, std::mt19937_64& random) {
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<T> v(static_cast<std::size_t>(n));
    for (T& x : v)
        x = static_cast<T>(any(random));
    return v;
}

template <class T>
Complex wave(const std::vector<T>& row, int i) {
    const auto at = static_cast<std::size_t>(2 * i);
    return {static_cast<double>(row[at]), static_cast<double>(row[at + 1])};
}

/// f = m u + norm f by the definition: m acts on (u_x, u_y, i u_z), and its third row is i f_z.
template <class M, class U, class F>
void expect_product(int sites, double norm, double tolerance) {
    std::mt19937_64 random(static_cast<unsigned>(sites));
    const int waves = sites / 2 + 1;
    std::vector<M> table[6];
    MatrixRow<M> m;
    for (int e = 0; e < 6; ++e) {
        table[e] = numbers<M>(waves, random);
        m.at[e] = table[e].data();
    }
    m.sign = M(-1);
    std::vector<U> u[3];
    std::vector<F> f[3];
    for (int c = 0; c < 3; ++c) {
        u[c] = numbers<U>(2 * waves, random);
        f[c] = numbers<F>(2 * waves, random);
    }
    const auto before = std::to_array({f[0], f[1], f[2]});
    const U* const from[3] = {u[0].data(), u[1].data(), u[2].data()};
    F* const to[3] = {f[0].data(), f[1].data(), f[2].data()};
    multiply_row(m, waves, 3, from, norm, to);
    const Complex i_unit(0.0, 1.0);
    for (int i = 0; i < waves; ++i) {
        const auto at = [&](int e) { return static_cast<double>(m.at[e][i]); };
        const double xy = -at(MatrixRow<M>::xy), yz = -at(MatrixRow<M>::yz);
        const double xz = at(MatrixRow<M>::xz);
        const Complex x = wave(u[0], i), y = wave(u[1], i), w = i_unit * wave(u[2], i);
        const Complex expected[3] = {at(MatrixRow<M>::xx) * x + xy * y + xz * w,
                                     xy * x + at(MatrixRow<M>::yy) * y + yz * w,
                                     (xz * x + yz * y + at(MatrixRow<M>::zz) * w) / i_unit};
        for (int c = 0; c < 3; ++c)
            EXPECT_LT(std::abs(wave(f[c], i) - expected[c] -
                               norm * wave(before[static_cast<std::size_t>(c)], i)),
                      tolerance)
                << sites << " sites, wave " << i << ", component " << c;
    }
}

} // namespace

TEST(SurfaceRows, MatricesActOnWaves) {
    for (int sites : {1, 2, 7, 16, 33, 128})
        for (double norm : {0.0, -0.25}) {
            expect_product<double, double, double>(sites, norm, 1e-14);
            expect_product<double, float, float>(sites, norm, 2e-6);
            expect_product<float, double, double>(sites, norm, 2e-6);
            expect_product<float, double, float>(sites, norm, 2e-6);
            expect_product<float, float, float>(sites, norm, 2e-6);
        }
}

TEST(SurfaceRows, InnerProductsCountInnerColumnsTwice) {
    for (int sites : {1, 2, 7, 16, 33, 128}) {
        std::mt19937_64 random(3);
        const int waves = sites / 2 + 1, length = 2 * waves;
        const auto a = numbers<double>(length, random);
        const auto b = numbers<float>(length, random);
        double expected = 0.0;
        for (int i = 0; i < waves; ++i) {
            const bool mirrored = i > 0 && 2 * i < sites;
            expected += (mirrored ? 2.0 : 1.0) * (wave(a, i) * std::conj(wave(b, i))).real();
        }
        EXPECT_NEAR(row_dot(a.data(), b.data(), sites), expected, 1e-13 * length) << sites;
    }
}

TEST(SurfaceRows, ShortNumbersAreTheNearest) {
    const int n = 1000;
    std::mt19937_64 random(8);
    const auto x = numbers<float>(n, random), y = numbers<float>(n, random);
    std::vector<ShortFloat> s(static_cast<std::size_t>(n));
    shorten_row(3.0, x.data(), -1.0, y.data(), s.data(), n);
    const float one = 1.0f;
    const ShortFloat* const row[1] = {s.data()};
    std::vector<float> back(static_cast<std::size_t>(n)), zero(back);
    weigh_rows(1.0, zero.data(), row, &one, 1, back.data(), n);
    for (std::size_t i = 0; i < back.size(); ++i) {
        const double exact = 3.0 * static_cast<double>(x[i]) - static_cast<double>(y[i]);
        EXPECT_NEAR(back[i], exact, std::abs(exact) / 256.0);
    }
}

TEST(SurfaceRows, WeighedRowsAddUp) {
    // Longer than a piece, and with a rest; six rows, of which four go together.
    const int n = 2100;
    std::mt19937_64 random(9);
    const auto first = numbers<float>(n, random), x = numbers<float>(n, random);
    std::vector<ShortFloat> a(static_cast<std::size_t>(n)), b(a);
    shorten_row(1.0, x.data(), 0.0, x.data(), a.data(), n);
    shorten_row(2.0, x.data(), 0.0, x.data(), b.data(), n); // exactly twice as much
    const ShortFloat* const rows[6] = {a.data(), b.data(), a.data(), b.data(), a.data(), b.data()};
    const float weight[6] = {1.0f, -2.0f, 4.0f, 1.0f, -5.0f, 1.0f}; // 4 of a is 2 of b
    std::vector<float> sum(static_cast<std::size_t>(n));
    weigh_rows(-1.0, first.data(), rows, weight, 6, sum.data(), n);
    for (std::size_t i = 0; i < sum.size(); ++i)
        ASSERT_NEAR(sum[i], -first[i], 1e-6) << i;
}

TEST(SurfaceRows, VectorsAreClippedToTheBoundAndKeepTheirDirection) {
    const int n = 37;
    std::mt19937_64 random(10);
    for (int components : {1, 3}) {
        std::vector<float> v[3], before[3];
        for (int c = 0; c < 3; ++c)
            before[c] = v[c] = numbers<float>(n, random);
        float* const rows[3] = {v[0].data(), v[1].data(), v[2].data()};
        clip_row(0.5f, rows, components, n);
        EXPECT_NEAR(longest_squared(rows, components, n), 0.25, 1e-6);
        for (std::size_t i = 0; i < v[0].size(); ++i) {
            double length2 = 0.0;
            for (int c = 0; c < components; ++c)
                length2 += std::pow(before[c][i], 2);
            const double kept = std::min(1.0, 0.5 / std::sqrt(length2));
            for (int c = 0; c < components; ++c)
                EXPECT_NEAR(v[c][i], kept * before[c][i], 1e-6);
        }
    }
}
