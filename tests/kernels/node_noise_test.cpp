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

TEST(ThermalNoise, EnergiesAreThoseBeforeAndAfterFrictionAndNoise) {
    const double gamma = 0.004, dt = 5.0, m = 300.0;
    const double medium = 4e-4; // Å/fs
    const ThermalNoise noise{7, 11, 0.02, 1.0 + 0.5 * gamma * dt, dt, medium};
    const Triple<double> xi = {0.3, -1.2, 0.8}, force = {0.5, -0.02, 0.1}; // eV/Å
    const Triple<double> old = {1e-3, 2e-3, -1e-3};
    // The step's kick: m (v - old) = dt (F - gamma m ((v + old)/2 - V)).
    const auto kicked = [&](double v, double f, double of_medium) {
        return ((1.0 - 0.5 * gamma * dt) * v + dt * f / m + gamma * dt * of_medium) /
               (1.0 + 0.5 * gamma * dt);
    };
    Triple<double> v = {kicked(old.x, force.x, 0.0), kicked(old.y, force.y, 0.0),
                        kicked(old.z, force.z, medium)};
    Triple<double> u = {0.1, 0.2, 0.3};
    const Triple<double> v0 = v, u0 = u;
    const auto dot = [](const Triple<double>& a, const Triple<double>& b) {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    };
    const NoiseEnergies given = add_noise(noise, m, xi, old, v, u);
    // Half a kick of the force alone before friction and noise, and half a kick after them.
    const auto half_kick = [&](const Triple<double>& a, double sign) {
        const double by = sign * 0.5 * dt / m;
        return Triple<double>{a.x + by * force.x, a.y + by * force.y, a.z + by * force.z};
    };
    const Triple<double> p = half_kick(old, 1.0), after = half_kick(v, -1.0);
    const auto mean = [](const Triple<double>& a, const Triple<double>& b) {
        return Triple<double>{0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)};
    };
    const Triple<double> w = mean(old, v0);
    const double kinetic = 0.25 * m * (dot(p, p) + dot(after, after));
    EXPECT_NEAR(given.kinetic, kinetic - 0.5 * m * dot(w, w), 1e-15);
    const Triple<double> slip = {w.x, w.y, w.z - medium}; // friction without noise: kick.hpp
    const double friction = -gamma * dt * m * dot(w, slip);
    EXPECT_NEAR(given.heat, 0.5 * m * (dot(after, after) - dot(p, p)) - friction, 1e-15);
    EXPECT_GT(std::abs(given.heat), 1e-3) << "the case must tell";
    const double sigma = std::sqrt(noise.strength / m) / noise.drag;
    EXPECT_NEAR(v.x, v0.x + sigma * 0.3, 1e-15);
    EXPECT_NEAR(u.y, u0.y + dt * sigma * -1.2, 1e-15);
}
