// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stresses of one wave inside a layered solid (kernels/subsurface_stress.hpp): against closed
// forms of a half-space, against a solution of the layers by matching exponentials, and laws.
#include "kernels/subsurface_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>

using namespace asperity;

namespace {

SolidLayer layer(double young, double poisson, double thickness) {
    return {young / (2.0 * (1.0 + poisson)), poisson, thickness};
}
constexpr double deep = 1e9; // thickness of a half-space

WaveStress at(std::initializer_list<SolidLayer> layers, double q, double depth) {
    return subsurface_stress(std::vector(layers), q, std::array{depth}).front();
}

/// Returns the stress at x by a pressure p cos(q x) and a traction t cos(q x) along x.
Stress of_wave(const WaveStress& s, double p, double t, double phase) {
    const double c = std::cos(phase), i = -std::sin(phase); // the real part of i exp(i q x)
    Stress at;
    at.xx = p * s.pressure.xx * c + t * s.shear.xx * i;
    at.zz = p * s.pressure.zz * c + t * s.shear.zz * i;
    at.xz = p * s.pressure.xz * i + t * s.shear.xz * c;
    at.yy = s.poisson * (at.xx + at.zz);
    return at;
}

TEST(SubsurfaceStress, IsThatOfAHalfSpace) {
    const std::array<double, 6> expected[4] = {// s_zz, s_xx, largest shear, von Mises
                                               {0.25, -0.9735, -0.5841, 0.1947, 0.4591},
                                               {0.5, -0.9098, -0.3033, 0.3033, 0.5786},
                                               {1.0, -0.7358, 0.0, 0.3679, 0.6540},
                                               {2.0, -0.4060, 0.1353, 0.2707, 0.4719}};
    for (const auto& [z, zz, xx, shear, mises, _] : expected)
        for (const double q : {0.01, 1.0, 7.0}) {
            const WaveStress s = at({layer(3.0, 0.3, deep)}, q, z / q);
            const double e = std::exp(-z);
            EXPECT_NEAR(s.pressure.zz, zz, 6e-5);
            EXPECT_NEAR(s.pressure.xx, xx, 6e-5);
            EXPECT_NEAR(s.pressure.zz, -(1.0 + z) * e, 1e-12);
            EXPECT_NEAR(s.pressure.xx, -(1.0 - z) * e, 1e-12);
            EXPECT_NEAR(s.pressure.xz, z * e, 1e-12); // times i: -Z e sin
            EXPECT_NEAR(s.shear.xz, -(1.0 - z) * e, 1e-12);
            EXPECT_NEAR(s.shear.xx, (2.0 - z) * e, 1e-12);
            EXPECT_NEAR(s.shear.zz, z * e, 1e-12);
            EXPECT_NEAR(s.across.yz, -e, 1e-12);
            EXPECT_NEAR(s.across.xy, e, 1e-12);
            double largest = 0.0, largest_mises = 0.0;
            for (int i = 0; i < 4000; ++i) {
                const Stress local = of_wave(s, 1.0, 0.0, i * 2.0 * std::numbers::pi / 4000);
                largest = std::max(largest, std::hypot(0.5 * (local.xx - local.zz), local.xz));
                largest_mises = std::max(largest_mises, von_mises(local));
            }
            EXPECT_NEAR(largest, z * e, 1e-12);
            EXPECT_NEAR(largest, shear, 6e-5);
            EXPECT_NEAR(largest_mises, mises, 6e-5);
        }
}

TEST(SubsurfaceStress, OfFrictionInPhaseHasTheSameShearEverywhere) {
    for (const double f : {0.1, 0.3679, 0.8})
        for (const double z : {0.0, 0.4, 1.0, 3.0})
            for (const double phase : {0.0, 0.7, 2.0, 4.4}) {
                const Stress s = of_wave(at({layer(1.0, 0.3, deep)}, 1.0, z), 1.0, f, phase);
                EXPECT_NEAR(std::hypot(0.5 * (s.xx - s.zz), s.xz),
                            std::exp(-z) * std::sqrt(z * z + f * f * (1.0 - z) * (1.0 - z)), 1e-12);
            }
}

TEST(SubsurfaceStress, IsThatOfACoatedHalfSpace) {
    struct Row {
        double ratio, qt, zz, xz, coat, below, surface;
    };
    for (const Row& r : {Row{10.0, 0.3, -0.9136, -0.3407, 1.2019, -0.2322, -3.5216},
                         Row{10.0, 1.0, -0.4096, -0.2524, 2.5311, 0.0951, -3.2347},
                         Row{10.0, 3.0, -0.0485, -0.0406, 0.5130, 0.0326, -1.1472},
                         Row{0.1, 1.0, -0.8379, -0.2997, -0.3470, -0.2384, -0.5019}}) {
        const auto stack = {layer(r.ratio, 0.3, 2.0), layer(1.0, 0.3, deep)};
        const double q = r.qt / 2.0, other_side = std::nextafter(2.0, 3.0);
        const WaveStress coat = at(stack, q, 2.0), below = at(stack, q, other_side);
        EXPECT_NEAR(coat.pressure.zz, r.zz, 6e-5);
        EXPECT_NEAR(-coat.pressure.xz, r.xz, 6e-5);
        EXPECT_NEAR(coat.pressure.xx, r.coat, 6e-5);
        EXPECT_NEAR(below.pressure.xx, r.below, 6e-5);
        EXPECT_NEAR(at(stack, q, 0.0).pressure.xx, r.surface, 6e-5);
        EXPECT_NEAR(below.pressure.zz, coat.pressure.zz, 1e-11);
        EXPECT_NEAR(below.pressure.xz, coat.pressure.xz, 1e-11);
    }
}

TEST(SubsurfaceStress, ObeysEquilibriumInEveryLayer) {
    // d s_xz/dx + d s_zz/dz = 0 and d s_xx/dx + d s_xz/dz = 0, with central differences.
    const auto stack = {layer(10.0, 0.2, 1.0), layer(0.5, 0.49, 0.7), layer(2.0, 0.3, 4.0)};
    for (const double q : {0.05, 0.8, 5.0})
        for (const double z : {0.3, 0.9, 1.2, 2.5, 5.0}) {
            const double h = 1e-4;
            const WaveStress s = at(stack, q, z), up = at(stack, q, z + h),
                             down = at(stack, q, z - h);
            const double scale = q * (std::abs(s.pressure.zz) + std::abs(s.pressure.xx));
            EXPECT_NEAR((up.pressure.zz - down.pressure.zz) / (2.0 * h), q * s.pressure.xz,
                        1e-6 * scale);
            EXPECT_NEAR((up.pressure.xz - down.pressure.xz) / (2.0 * h), -q * s.pressure.xx,
                        1e-6 * scale);
            const double shear = q * (std::abs(s.shear.xz) + std::abs(s.shear.xx));
            EXPECT_NEAR((up.shear.zz - down.shear.zz) / (2.0 * h), -q * s.shear.xz, 1e-6 * shear);
            EXPECT_NEAR((up.shear.xz - down.shear.xz) / (2.0 * h), q * s.shear.xx, 1e-6 * shear);
            EXPECT_NEAR((up.across.yz - down.across.yz) / (2.0 * h), q * s.across.xy,
                        1e-6 * q * (std::abs(s.across.yz) + std::abs(s.across.xy)));
        }
}

TEST(SubsurfaceStress, OfEqualLayersIsThatOfOneSolid) {
    const auto parts = {layer(2.0, 0.35, 0.01), layer(2.0, 0.35, 1.5), layer(2.0, 0.35, 8.49)};
    for (const double q : {1e-3, 0.1, 1.0, 10.0, 100.0})
        for (const double z : {0.0, 0.004, 0.01, 1.0, 1.51, 7.0, 9.99}) {
            const WaveStress one = at({layer(2.0, 0.35, 10.0)}, q, z), cut = at(parts, q, z);
            EXPECT_NEAR(cut.pressure.zz, one.pressure.zz, 1e-11);
            EXPECT_NEAR(cut.pressure.xx, one.pressure.xx, 1e-11);
            EXPECT_NEAR(cut.pressure.xz, one.pressure.xz, 1e-11);
            EXPECT_NEAR(cut.shear.xz, one.shear.xz, 1e-11);
            EXPECT_NEAR(cut.shear.xx, one.shear.xx, 1e-9 + 1e-11 * std::abs(one.shear.xx));
            EXPECT_NEAR(cut.shear.zz, one.shear.zz, 1e-11);
            EXPECT_NEAR(cut.across.yz, one.across.yz, 1e-11);
            EXPECT_NEAR(cut.across.xy, one.across.xy, 1e-9);
        }
}

TEST(SubsurfaceStress, DecaysWithDepthForShortWaves) {
    const auto stack = {layer(10.0, 0.3, 1.0), layer(1.0, 0.4, deep)};
    EXPECT_EQ(at(stack, 1e3, 2.0).pressure.zz, 0.0);
    double last = 1.0;
    for (const double z : {0.1, 0.5, 0.99, 1.01, 1.5, 3.0}) { // to 1e-12 without rounding
        const double now = std::abs(at(stack, 10.0, z).pressure.zz);
        EXPECT_LT(now, last);
        EXPECT_GT(now, 0.0);
        last = now;
    }
}

TEST(SubsurfaceStress, AtTheSurfaceIsTheTraction) {
    const WaveStress s = at({layer(10.0, 0.3, 1.0), layer(1.0, 0.4, 3.0)}, 0.7, 0.0);
    EXPECT_DOUBLE_EQ(s.pressure.zz, -1.0);
    EXPECT_DOUBLE_EQ(s.pressure.xz, 0.0);
    EXPECT_DOUBLE_EQ(s.shear.xz, -1.0);
    EXPECT_DOUBLE_EQ(s.shear.zz, 0.0);
    EXPECT_DOUBLE_EQ(s.across.yz, -1.0);
}

TEST(SubsurfaceStress, UniformIsThatOfItsSides) {
    const auto one = {layer(2.0, 0.3, deep)};
    EXPECT_DOUBLE_EQ(uniform_lateral_stress(one, 1.0, false), -0.3 / 0.7);
    EXPECT_NEAR(uniform_lateral_stress(one, 1.0, true), -0.5 * (1.0 + 2.0 * 0.3), 1e-14);
    // With layers the mean over directions of the limit of long waves.
    const auto stack = {layer(10.0, 0.2, 2.0), layer(1.0, 0.4, deep)};
    for (const double z : {1.0, 5.0}) {
        const WaveStress s = at(stack, 1e-6, z);
        EXPECT_NEAR(uniform_lateral_stress(stack, z, true),
                    0.5 * (s.pressure.xx + s.poisson * (s.pressure.xx + s.pressure.zz)), 1e-4);
    }
}

TEST(SubsurfaceStress, PrincipalStressesAreTheRoots) {
    const Stress s{1.0, -2.0, 0.5, 0.3, -0.7, 1.1};
    const auto [a, b, c] = principal_stresses(s);
    EXPECT_GT(a, b);
    EXPECT_GT(b, c);
    EXPECT_NEAR(a + b + c, s.xx + s.yy + s.zz, 1e-14);
    EXPECT_NEAR(a * a + b * b + c * c,
                s.xx * s.xx + s.yy * s.yy + s.zz * s.zz +
                    2.0 * (s.xy * s.xy + s.xz * s.xz + s.yz * s.yz),
                1e-13);
    for (const double root : {a, b, c}) {
        const double x = s.xx - root, y = s.yy - root, z = s.zz - root;
        EXPECT_NEAR(x * (y * z - s.yz * s.yz) - s.xy * (s.xy * z - s.yz * s.xz) +
                        s.xz * (s.xy * s.yz - y * s.xz),
                    0.0, 1e-13);
    }
    EXPECT_DOUBLE_EQ(von_mises({1.0, 1.0, 1.0}), 0.0);
    EXPECT_DOUBLE_EQ(von_mises({-2.0}), 2.0);
}

} // namespace
