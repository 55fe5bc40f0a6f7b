// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The noise's own elementary functions against the C library's, and the moments of its numbers.
#include "kernels/node_noise.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

using namespace asperity;
using namespace asperity::ASPERITY_VARIANT;

namespace {

/// 32-bit numbers all over their range, with both ends and the borders of quarters.
template <class Visit>
void each_number(const Visit& visit) {
    for (std::uint32_t edge : {0u, 0x20000000u, 0x40000000u, 0x80000000u, 0xe0000000u})
        for (std::uint32_t k = 0; k < 1000; ++k)
            visit(edge + k), visit(edge - k);
    for (std::uint32_t k = 0, b = 1; k < 200000; ++k, b = b * 1664525u + 1013904223u)
        visit(b);
}

} // namespace

TEST(ThermalNoise, LogarithmIsThatOfTheCLibrary) {
    each_number([](std::uint32_t b) {
        const double x = (b + 0.5) * 0x1p-32, expected = std::log(x);
        ASSERT_NEAR(logarithm(x), expected,
                    2.0 * std::numeric_limits<double>::epsilon() * std::abs(expected))
            << b;
    });
}

TEST(ThermalNoise, CosineAndSineAreThoseOfTheCLibrary) {
    each_number([](std::uint32_t b) {
        const long double angle = 2.0L * std::numbers::pi_v<long double> * (b + 0.5L) * 0x1p-32L;
        const auto [c, s] = cosine_and_sine(b);
        ASSERT_NEAR(c, static_cast<double>(std::cos(angle)), 4e-16) << b;
        ASSERT_NEAR(s, static_cast<double>(std::sin(angle)), 4e-16) << b;
    });
}

TEST(ThermalNoise, NumbersAreNormalAndIndependent) {
    constexpr int n = 60; // nodes an edge
    const ThermalNoise noise{7, 11, 1.0, 1.0, 1.0};
    ThermalNoise later = noise;
    ++later.step;
    // Averages over nodes of xi, xi^2, xi^4 of each component; of products of components, of
    // neighbours and of two steps.
    std::array<double, 3> mean{}, square{}, fourth{};
    double xy = 0.0, yz = 0.0, neighbours = 0.0, steps = 0.0;
    for (int z = 0; z < n; ++z)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const auto xi = normals(noise, 3, x, y, z);
                const std::array component = {xi.x, xi.y, xi.z};
                for (std::size_t i = 0; i < 3; ++i) {
                    const double q = component[i] * component[i];
                    mean[i] += component[i], square[i] += q, fourth[i] += q * q;
                }
                xy += xi.x * xi.y, yz += xi.y * xi.z;
                neighbours += xi.x * normals(noise, 3, x + 1, y, z).x;
                steps += xi.z * normals(later, 3, x, y, z).z;
            }
    const double count = n * n * n, sigma = 1.0 / std::sqrt(count);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(mean[i] / count, 0.0, 4.0 * sigma);
        EXPECT_NEAR(square[i] / count, 1.0, 4.0 * std::sqrt(2.0) * sigma);
        EXPECT_NEAR(fourth[i] / count, 3.0, 4.0 * std::sqrt(96.0) * sigma);
    }
    for (double product : {xy, yz, neighbours, steps})
        EXPECT_NEAR(product / count, 0.0, 4.0 * sigma);
}

TEST(ThermalNoise, HeatIsTheEnergyGivenToVelocityAndDisplacement) {
    const double gamma = 0.004, dt = 5.0, m = 300.0;
    const ThermalNoise noise{7, 11, 0.02, 1.0 + 0.5 * gamma * dt, dt};
    const Triple<double> xi = {0.3, -1.2, 0.8}, force = {0.5, -0.02, 0.1}; // eV/Å
    const Triple<double> old = {1e-3, 2e-3, -1e-3};
    // The step's kick: m (v - old) = dt (F - gamma m (v + old)/2).
    const auto kicked = [&](double v, double f) {
        return ((1.0 - 0.5 * gamma * dt) * v + dt * f / m) / (1.0 + 0.5 * gamma * dt);
    };
    Triple<double> v = {kicked(old.x, force.x), kicked(old.y, force.y), kicked(old.z, force.z)};
    Triple<double> u = {0.1, 0.2, 0.3};
    const Triple<double> v0 = v, u0 = u;
    const auto dot = [](const Triple<double>& a, const Triple<double>& b) {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    };
    const double before = 0.5 * m * dot(v, v);
    const double heat = add_noise(noise, m, xi, old, v, u);
    const Triple<double> moved = {u.x - u0.x, u.y - u0.y, u.z - u0.z};
    EXPECT_NEAR(heat, 0.5 * m * dot(v, v) - before - 0.5 * dot(force, moved), 1e-15);
    const double sigma = std::sqrt(noise.strength / m) / noise.drag;
    EXPECT_NEAR(v.x, v0.x + sigma * 0.3, 1e-15);
    EXPECT_NEAR(u.y, u0.y + dt * sigma * -1.2, 1e-15);
}
