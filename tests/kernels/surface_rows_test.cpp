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

/// f = m u + norm g by the definition: m acts on (u_x, u_y, i u_z), and its third row is i f_z.
template <class T>
void expect_product(int sites, int components, double norm, bool in_place, double tolerance) {
    using namespace matrix_entry;
    std::mt19937_64 random(static_cast<unsigned>(sites));
    const int entries = components == 1 ? 1 : count, waves = components * sites * block_columns;
    const auto m = numbers<T>((sites / 2 + 1) * entries * block_columns, random);
    const auto u = numbers<T>(2 * waves, random), before = numbers<T>(2 * waves, random);
    auto f = in_place ? before : numbers<T>(2 * waves, random);
    multiply_block(m.data(), sites, components, u.data(), norm, in_place ? f.data() : before.data(),
                   f.data());
    const Complex i_unit(0.0, 1.0);
    for (int y = 0; y < sites; ++y)
        for (int column = 0; column < block_columns; ++column) {
            const int sign = 2 * y > sites ? -1 : 1;
            const auto at = [&](int e) {
                const int row = std::min(y, sites - y) * entries + (components == 1 ? 0 : e);
                return static_cast<double>(
                    m[static_cast<std::size_t>(row * block_columns + column)]);
            };
            const auto index = [&](int c) { return (c * sites + y) * block_columns + column; };
            std::vector<Complex> expected;
            if (components == 1)
                expected = {at(zz) * wave(u, index(0))};
            else {
                const Complex x = wave(u, index(0)), v = wave(u, index(1));
                const Complex w = i_unit * wave(u, index(2));
                const double cross = sign * at(xy), across = sign * at(yz);
                expected = {at(xx) * x + cross * v + at(xz) * w,
                            cross * x + at(yy) * v + across * w,
                            (at(xz) * x + across * v + at(zz) * w) / i_unit};
            }
            for (int c = 0; c < components; ++c)
                EXPECT_LT(std::abs(wave(f, index(c)) - expected[static_cast<std::size_t>(c)] -
                                   norm * wave(before, index(c))),
                          tolerance)
                    << sites << " sites, wave " << column << ' ' << y << ", component " << c;
        }
}

} // namespace

TEST(SurfaceRows, MatricesActOnSites) {
    using namespace matrix_entry;
    std::mt19937_64 random(3);
    for (const int components : {1, 3})
        for (const int n : {1, 15, 64}) {
            std::array<std::vector<float>, count> m;
            SiteMatrices matrices{};
            for (int e = 0; e < count; ++e) {
                m[e] = numbers<float>(n, random);
                matrices.entry[e] = components == 3 || e == zz ? m[e].data() : nullptr;
            }
            std::array<std::vector<float>, 3> v, before;
            for (std::vector<float>& row : before)
                row = numbers<float>(n, random);
            v = before;
            float* rows[3] = {v[0].data(), v[1].data(), v[2].data()};
            multiply_sites(matrices, rows, components, n);
            const int of[3][3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
            for (int c = 0; c < components; ++c)
                for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
                    double expected = components == 1 ? m[zz][i] * before[0][i] : 0.0;
                    for (int k = 0; components == 3 && k < 3; ++k)
                        expected += static_cast<double>(m[of[c][k]][i]) * before[k][i];
                    EXPECT_NEAR(v[c][i], expected, 1e-6) << components << ' ' << n;
                }
        }
}

TEST(SurfaceRows, MatricesActOnWaves) {
    for (int sites : {1, 2, 7, 16, 33})
        for (int components : {1, 3})
            for (double norm : {0.0, -0.25}) {
                for (bool in_place : {false, true}) {
                    expect_product<double>(sites, components, norm, in_place, 1e-14);
                    expect_product<float>(sites, components, norm, in_place, 2e-6);
                }
            }
}

TEST(SurfaceRows, InnerProductsWeighColumns) {
    const int rows = 21;
    std::mt19937_64 random(3);
    const auto a = numbers<double>(2 * rows * block_columns, random);
    const auto b = numbers<float>(2 * rows * block_columns, random);
    const auto weights = numbers<double>(block_columns, random);
    double expected = 0.0;
    for (int i = 0; i < rows * block_columns; ++i)
        expected += weights[static_cast<std::size_t>(i % block_columns)] *
                    (wave(a, i) * std::conj(wave(b, i))).real();
    EXPECT_NEAR(block_dot(a.data(), b.data(), rows, weights.data()), expected, 1e-12);
}

TEST(SurfaceRows, TiesAreSpringsAndForces) {
    const int n = 37;
    std::mt19937_64 random(8);
    const auto u = numbers<double>(n, random), f = numbers<double>(n, random);
    std::vector<float> to(static_cast<std::size_t>(n));
    spring_force_row(0.7, 0.25, u.data(), f.data(), to.data(), n);
    for (std::size_t i = 0; i < to.size(); ++i)
        EXPECT_NEAR(to[i], 0.25 * (0.7 * u[i] + f[i]), 1e-7);
}

/// Sites that know their targets, moved by the kernel, against one site written out.
TEST(SurfaceRows, EverySiteKeepsItsOwnMomentumAndGain) {
    const HeavyBallRule rule{.momentum_decay = 0.7f,
                             .step_cut = 0.5f,
                             .step_growth = 1.25f,
                             .step_size_max = 2.0f,
                             .move_max = 0.5f};
    const int n = 67; // with a rest
    std::mt19937_64 random(10);
    for (int components : {1, 3}) {
        std::vector<float> target[3], momentum[3], step_size(n);
        std::vector<double> u[3];
        HeavyBallRow row{};
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
        const float longest = heavy_ball_row(row, rule, components, n);

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
