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
template <class M, class T>
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
    std::vector<T> u[3], f[3];
    for (int c = 0; c < 3; ++c) {
        u[c] = numbers<T>(2 * waves, random);
        f[c] = numbers<T>(2 * waves, random);
    }
    const auto before = std::to_array({f[0], f[1], f[2]});
    const T* const from[3] = {u[0].data(), u[1].data(), u[2].data()};
    T* const to[3] = {f[0].data(), f[1].data(), f[2].data()};
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
            expect_product<double, double>(sites, norm, 1e-14);
            expect_product<double, float>(sites, norm, 2e-6);
            expect_product<float, float>(sites, norm, 2e-6);
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

TEST(SurfaceRows, TiesAreSpringsAndForces) {
    const int n = 37;
    std::mt19937_64 random(8);
    const auto u = numbers<double>(n, random), f = numbers<double>(n, random);
    std::vector<float> to(static_cast<std::size_t>(n));
    tie_row(0.7, 0.25, u.data(), f.data(), to.data(), n);
    for (std::size_t i = 0; i < to.size(); ++i)
        EXPECT_NEAR(to[i], 0.25 * (0.7 * u[i] + f[i]), 1e-7);
}

/// Sites that know their targets, moved by the kernel, against one site written out.
TEST(SurfaceRows, EverySiteKeepsItsOwnMomentumAndGain) {
    const BallRule rule{.keep = 0.7f, .cut = 0.5f, .raise = 1.25f, .most = 2.0f, .bound = 0.5f};
    const int n = 67; // with a rest
    std::mt19937_64 random(10);
    for (int components : {1, 3}) {
        std::vector<float> target[3], momentum[3], step_size(n);
        std::vector<double> u[3];
        BallRow row{};
        for (int c = 0; c < components; ++c) {
            target[c] = numbers<float>(n, random);
            momentum[c] = numbers<float>(n, random);
            u[c] = numbers<double>(n, random);
            row.target[c] = target[c].data();
            row.momentum[c] = momentum[c].data();
            row.u[c] = u[c].data();
        }
        std::uniform_real_distribution<float> any(0.1f, 2.0f);
        for (float& g : step_size)
            g = any(random);
        row.step_size = step_size.data();
        const auto m_before = std::to_array({momentum[0], momentum[1], momentum[2]});
        const auto u_before = std::to_array({u[0], u[1], u[2]});
        const auto step_size_before = step_size;
        const float longest = move_row(row, rule, components, n);

        double longest_way2 = 0.0;
        int backwards = 0, capped = 0, clipped = 0;
        for (std::size_t i = 0; i < step_size.size(); ++i) {
            double along = 0.0, way2 = 0.0, move2 = 0.0, move[3] = {};
            for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
                const double way = target[c][i] - u_before[c][i];
                along += way * m_before[c][i];
                way2 += way * way;
            }
            const bool back = along < 0.0;
            const double g =
                back ? 0.5 * step_size_before[i] : std::min(1.25 * step_size_before[i], 2.0);
            backwards += back;
            capped += !back && 1.25 * step_size_before[i] > 2.0;
            EXPECT_NEAR(step_size[i], g, 1e-6);
            for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
                move[c] = g * (target[c][i] - u_before[c][i]) + (back ? 0.0 : 0.7 * m_before[c][i]);
                move2 += move[c] * move[c];
            }
            const double kept = std::min(1.0, 0.5 / std::sqrt(move2));
            clipped += kept < 1.0;
            for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
                EXPECT_NEAR(momentum[c][i], kept * move[c], 1e-6);
                EXPECT_NEAR(u[c][i] - u_before[c][i], kept * move[c], 1e-6);
            }
            longest_way2 = std::max(longest_way2, way2);
        }
        EXPECT_NEAR(longest, longest_way2, 1e-5);
        EXPECT_GT(backwards, 0);
        EXPECT_GT(capped, 0);
        EXPECT_GT(clipped, 0);
        EXPECT_LT(clipped, n);
    }
}
