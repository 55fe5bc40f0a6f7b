// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The stresses inside the block (engine/waves/subsurface.hpp): below a sphere and a punch in closed
// form, below a sphere that slides, balance of forces, and the search for the largest ones.
#include "engine/waves/subsurface.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

using namespace asperity;

namespace {

BlockOptions half_space(int sites, double poisson, bool free_edges) {
    BlockOptions o;
    o.sites = sites;
    o.spacing = 1.0;
    o.thickness = 1 << 30;
    o.continuum = true;
    o.young = 2.0;
    o.poisson = poisson;
    o.free_edges = free_edges;
    return o;
}

/// Returns a pressure of the distance from the site in the middle, averaged over parts of sites.
template <class Pressure>
std::vector<double> round_pressure(int sites, int parts, const Pressure& pressure) {
    std::vector<double> map;
    for (int y = 0; y < sites; ++y)
        for (int x = 0; x < sites; ++x) {
            double sum = 0.0;
            for (int j = 0; j < parts; ++j)
                for (int i = 0; i < parts; ++i)
                    sum += pressure(std::hypot(x - sites / 2 + (i + 0.5) / parts - 0.5,
                                               y - sites / 2 + (j + 0.5) / parts - 0.5));
            map.push_back(sum / (parts * parts));
        }
    return map;
}

double hertz(double r, double a) { return r < a ? std::sqrt(1.0 - r * r / (a * a)) : 0.0; }

std::size_t middle(const Subsurface& field) {
    const auto n = static_cast<std::size_t>(field.points());
    return n / 2 * n + n / 2;
}

/// A rough pressure with contact on a part of the sites.
std::vector<double> patches(int sites, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::vector<double> map;
    for (int i = 0; i < sites * sites; ++i)
        map.push_back(std::max(0.0, uniform(random)));
    return map;
}

double mean(const std::vector<Stress>& of, double Stress::*component) {
    double sum = 0.0;
    for (const Stress& s : of)
        sum += s.*component;
    return sum / static_cast<double>(of.size());
}

} // namespace

TEST(Subsurface, BelowASphereIsThatOfHertz) {
    const double a = 16.0;
    const Subsurface field(half_space(256, 0.3, true),
                           {round_pressure(256, 1, [=](double r) { return hertz(r, a); }), {}, {}});
    for (const auto& [z, zz, xx, shear] :
         {std::array{0.25, -0.9412, -0.3985, 0.2713}, std::array{0.48, -0.8127, -0.1927, 0.3100},
          std::array{1.0, -0.5, -0.0290, 0.2355}}) {
        const Stress s = field.at(z * a)[middle(field)];
        EXPECT_NEAR(s.zz, zz, 2e-3) << z;
        EXPECT_NEAR(s.xx, xx, 2e-3) << z;
        EXPECT_NEAR(s.yy, xx, 2e-3) << z;
        EXPECT_NEAR(0.5 * (s.xx - s.zz), shear, 2e-3) << z;
        EXPECT_NEAR(s.xz, 0.0, 1e-3);
    }
}

TEST(Subsurface, BelowAPunchIsThatOfSneddon) {
    const double a = 16.0;
    const Subsurface field(half_space(256, 0.3, true),
                           {round_pressure(256, 20,
                                           [=](double r) {
                                               return r < a ? 1.0 / std::sqrt(1.0 - r * r / (a * a))
                                                            : 0.0;
                                           }),
                            {},
                            {}});
    for (const auto& [z, zz, xx] :
         {std::array{0.25, -1.0519, -0.6976}, std::array{0.5, -1.1200, -0.4800},
          std::array{1.0, -1.0, -0.15}, std::array{2.0, -0.52, 0.0}}) {
        const Stress s = field.at(z * a)[middle(field)];
        EXPECT_NEAR(s.zz, zz, 0.01) << z;
        EXPECT_NEAR(s.xx, xx, 0.01) << z;
    }
}

TEST(Subsurface, BelowASlidingSphereYieldsAtTheSurface) {
    const int sites = 128;
    const double a = 16.0;
    const auto pressure = round_pressure(sites, 4, [=](double r) { return hertz(r, a); });
    const BlockOptions block = half_space(sites, 0.3, true);
    double at_surface = 0.0;
    for (const auto& [friction, expected] :
         {std::array{0.0, 0.620}, std::array{0.1, 0.62}, std::array{0.2, 0.64},
          std::array{0.3, 0.66}, std::array{0.5, 0.93}}) {
        const Subsurface field(block, with_friction(pressure, friction));
        double largest = 0.0;
        for (double z = 0.0; z < a; z += 2.0)
            for (const Stress& s : field.at(z)) {
                largest = std::max(largest, von_mises(s));
                if (z == 0.0) at_surface = std::max(at_surface, von_mises(s));
            }
        EXPECT_NEAR(largest, expected, 0.02 * expected) << friction;
        EXPECT_EQ(largest == at_surface, friction == 0.5) << friction;
    }
    // Behind the edge of the contact, where the pressure and with it the sites are coarse, the
    // closed form (Hamilton 1983) has f pi (4 + nu)/8 + (1 - 2 nu)/3 along and 3 pi f nu/8 - (1 - 2
    // nu)/3 across, 0.957 of von Mises, to which finer sites lead slowly.
    const double x = 0.5 * std::numbers::pi * 4.3 / 8.0 + 0.4 / 3.0;
    const double y = 0.5 * std::numbers::pi * 0.9 / 8.0 - 0.4 / 3.0;
    const double closed = von_mises({x, y});
    EXPECT_NEAR(closed, 0.9567, 1e-4);
    EXPECT_LT(at_surface, closed);
    EXPECT_GT(at_surface, 0.97 * closed);
}

TEST(Subsurface, BalancesTheTractionsAtEveryDepth) {
    BlockOptions block = half_space(32, 0.3, false);
    block.layers = {{{10.0, 0.2}, 3.0}, {{0.5, 0.45}, 2.0}};
    SurfaceTractions tractions = with_friction(patches(32, 3), 0.3);
    tractions.shear_y = patches(32, 4);
    double p = 0.0, x = 0.0, y = 0.0;
    for (std::size_t i = 0; i < tractions.pressure.size(); ++i) {
        p += tractions.pressure[i] / 1024;
        x += tractions.shear_x[i] / 1024;
        y += tractions.shear_y[i] / 1024;
    }
    const Subsurface field(block, tractions);
    for (const double z : {0.0, 0.5, 3.0, 4.0, 20.0, 1e4}) {
        const auto s = field.at(z);
        EXPECT_NEAR(mean(s, &Stress::zz), -p, 1e-12);
        EXPECT_NEAR(mean(s, &Stress::xz), -x, 1e-12);
        EXPECT_NEAR(mean(s, &Stress::yz), -y, 1e-12);
    }
    // The tractions themselves at the surface, zero without contact; at depth only their means.
    const auto surface = field.at(0.0), deep = field.at(1e4);
    for (std::size_t i = 0; i < surface.size(); ++i) {
        EXPECT_NEAR(surface[i].zz, -tractions.pressure[i], 1e-12);
        EXPECT_NEAR(deep[i].zz, -p, 1e-12);
        EXPECT_NEAR(deep[i].yz, -y, 1e-12);
    }
}

TEST(Subsurface, TurnsWithTheTractions) {
    const int n = 16;
    BlockOptions block = half_space(n, 0.3, false);
    block.layers = {{{10.0, 0.2}, 3.0}};
    const SurfaceTractions one{patches(n, 1), patches(n, 2), patches(n, 3)};
    SurfaceTractions turned = one; // (x, y) -> (-y, x)
    const auto at = [](int x, int y) { return static_cast<std::size_t>(y * n + x); };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const std::size_t to = at(n - 1 - y, x);
            turned.pressure[to] = one.pressure[at(x, y)];
            turned.shear_x[to] = -one.shear_y[at(x, y)];
            turned.shear_y[to] = one.shear_x[at(x, y)];
        }
    const auto a = Subsurface(block, one).at(1.7), b = Subsurface(block, turned).at(1.7);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const Stress s = a[at(x, y)], t = b[at(n - 1 - y, x)];
            EXPECT_NEAR(t.yy, s.xx, 1e-12);
            EXPECT_NEAR(t.xx, s.yy, 1e-12);
            EXPECT_NEAR(t.zz, s.zz, 1e-12);
            EXPECT_NEAR(t.xy, -s.xy, 1e-12);
            EXPECT_NEAR(t.yz, s.xz, 1e-12);
            EXPECT_NEAR(t.xz, -s.yz, 1e-12);
        }
}

TEST(Subsurface, OfAWaveInAnyDirectionIsThatOfOneAlongX) {
    const int n = 32;
    const BlockOptions block = half_space(n, 0.3, false);
    const double unit = 2.0 * std::numbers::pi / n;
    for (const auto& [kx, ky] : {std::pair{3, 0}, {0, 3}, {3, 4}, {-5, 2}, {7, 7}, {1, -6}}) {
        std::vector<double> pressure;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                pressure.push_back(2.0 + std::cos(unit * (kx * x + ky * y)));
        const Subsurface field(block, with_friction(pressure, 0.0));
        const double z = 2.0, q = unit * std::hypot(kx, ky), c = unit * kx / q, s = unit * ky / q;
        const auto stress = field.at(z);
        for (int i : {0, 5, 77, 300}) {
            const double phase = unit * (kx * (i % n) + ky * (i / n)), e = std::exp(-q * z);
            const Stress& local = stress[static_cast<std::size_t>(i)];
            const double along = -(1.0 - q * z) * e * std::cos(phase),
                         zz = -(1.0 + q * z) * e * std::cos(phase);
            const double held = -2.0 * 0.3 / 0.7;
            EXPECT_NEAR(local.zz, zz - 2.0, 1e-12);
            EXPECT_NEAR(c * c * local.xx + s * s * local.yy + 2.0 * c * s * local.xy, along + held,
                        1e-12);
            EXPECT_NEAR(s * s * local.xx + c * c * local.yy - 2.0 * c * s * local.xy,
                        0.3 * (along + zz) + held, 1e-12);
            EXPECT_NEAR(c * local.xz + s * local.yz, -q * z * e * std::sin(phase), 1e-12);
            EXPECT_NEAR(s * local.xz - c * local.yz, 0.0, 1e-12);
        }
    }
}

TEST(Subsurface, SurfaceStressBearsAPartOfThePressure) {
    const int n = 16;
    BlockOptions block = half_space(n, 0.3, false);
    block.surface_stress = 0.7;
    const double q = 2.0 * std::numbers::pi * 3 / n;
    std::vector<double> pressure;
    for (int i = 0; i < n * n; ++i)
        pressure.push_back(1.0 + std::cos(q * (i % n)));
    const double s = 0.5 * block.contact_modulus() * q, share = s / (s + 0.7 * q * q);
    EXPECT_NEAR(Subsurface(block, {pressure, {}, {}}).at(0.0).front().zz, -1.0 - share, 1e-12);
}

TEST(Subsurface, OfASlideHasTheSlopesOfTheWall) {
    const int n = 32;
    const BlockOptions block = half_space(n, 0.3, false);
    const double q = 2.0 * std::numbers::pi / n;
    std::vector<double> pressure, height;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            pressure.push_back(1.0 + std::cos(q * (3 * x + y)));
            height.push_back(0.1 * std::sin(q * (3 * x + y)));
        }
    const SurfaceTractions found = with_slopes(block, pressure, height);
    double friction = 0.0;
    for (std::size_t i = 0; i < pressure.size(); ++i) {
        const double slope = 0.1 * q * std::cos(q * static_cast<double>(3 * (i % n) + i / n));
        EXPECT_NEAR(found.shear_x[i], -pressure[i] * 3.0 * slope, 1e-14);
        EXPECT_NEAR(found.shear_y[i], -pressure[i] * slope, 1e-14);
        friction += found.shear_x[i] / (n * n);
    }
    EXPECT_NEAR(friction, -0.5 * 0.3 * q, 1e-14);
}

TEST(Subsurface, SearchFindsTheLargestOfHertzWithAnErrorThatCoversIt) {
    const BlockOptions block = half_space(64, 0.3, true);
    for (const double a : {4.0, 6.0, 8.0}) {
        const StressSearch found = search_stresses(
            block, {round_pressure(64, 1, [=](double r) { return hertz(r, a); }), {}, {}});
        ASSERT_EQ(found.layers.size(), 1u);
        const LargestStress &mises = found.layers[0].largest[0],
                            &tresca = found.layers[0].largest[1];
        EXPECT_EQ(mises.reason, "");
        EXPECT_NEAR(tresca.value, 0.6200, tresca.error()) << a;
        EXPECT_NEAR(mises.value, 0.6200, mises.error()) << a;
        EXPECT_GT(mises.images, 0.0);
        EXPECT_NEAR(mises.depth, 0.48 * a, 0.06 * a);
        EXPECT_NEAR(mises.x, 32.5, 1.0);
        EXPECT_LT(mises.error(), 0.4 / a);
    }
}

TEST(Subsurface, SearchLooksAtBothSidesOfABoundary) {
    // One wave on a stiff coating: its tension is largest at its inner side.
    BlockOptions block = half_space(64, 0.3, false);
    const double q = 2.0 * std::numbers::pi / 64;
    block.layers = {{{20.0, 0.3}, 1.0 / q}};
    std::vector<double> pressure;
    for (int i = 0; i < 64 * 64; ++i)
        pressure.push_back(std::cos(q * (i % 64)));
    const StressSearch found = search_stresses(block, {pressure, {}, {}});
    ASSERT_EQ(found.layers.size(), 2u);
    // The tension of the coating at its surface, under the trough, is larger.
    EXPECT_LT(found.layers[0].largest[2].value, 3.2347);
    EXPECT_GT(found.layers[0].largest[2].value, 2.5311);
    EXPECT_EQ(found.layers[0].largest[2].depth, 0.5);
    EXPECT_NE(found.layers[0].largest[2].reason, "");
    EXPECT_LT(found.layers[1].largest[2].value, 1.0);
    EXPECT_GT(found.layers[1].largest[0].depth, 1.0 / q);
    const Subsurface field(block, {pressure, {}, {}});
    double inner = -1e9;
    for (const Stress& s : field.at(1.0 / q))
        inner = std::max(inner, principal_stresses(s)[0]);
    EXPECT_NEAR(inner, 2.5311, 1e-2);
}

TEST(Subsurface, BetweenTheSitesIsTheSumOfTheirWaves) {
    const int n = 12;
    BlockOptions block = half_space(n, 0.3, false);
    block.layers = {{{10.0, 0.2}, 1.0}};
    const double unit = 2.0 * std::numbers::pi / n;
    for (const auto& [kx, ky] :
         {std::pair{0, 0}, {1, 0}, {0, 2}, {-3, 4}, {6, 0}, {0, 6}, {6, 2}}) {
        const auto at = [&](double x, double y) { return std::cos(unit * (kx * x + ky * y)); };
        SurfaceTractions coarse, finer;
        for (int y = 0; y < 2 * n; ++y)
            for (int x = 0; x < 2 * n; ++x) {
                // The shortest wave stands for both signs.
                const double px = 0.5 * x - 0.25, py = 0.5 * y - 0.25;
                const double wave =
                    2 * kx == n || 2 * ky == n
                        ? 0.5 * (at(px, py) + at(2 * kx == n ? -px : px, 2 * kx == n ? py : -py))
                        : at(px, py);
                finer.pressure.push_back(wave);
                if (x % 2 == 0 && y % 2 == 0) coarse.pressure.push_back(at(x / 2, y / 2));
            }
        const Subsurface interpolated(block, coarse, 2);
        BlockOptions twice = block;
        twice.sites = 2 * n;
        twice.spacing = 0.5;
        const auto a = interpolated.at(0.8), b = Subsurface(twice, finer).at(0.8);
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_NEAR(a[i].zz, b[i].zz, 1e-12) << kx << " " << ky;
            EXPECT_NEAR(a[i].xz, b[i].xz, 1e-12) << kx << " " << ky;
            EXPECT_NEAR(a[i].xy, b[i].xy, 1e-12) << kx << " " << ky;
        }
    }
}
