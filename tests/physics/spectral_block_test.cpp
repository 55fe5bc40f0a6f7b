// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The spectral block's stiffness against the elimination straight from the cell energy
// (support/spectral_lattice.hpp), and its laws: positive, exact at long and uniform waves, a force
// that is the gradient of its energy. That it is the lattice, states show (zero_load_test).
#include "engine/waves/preconditioner.hpp"
#include "engine/waves/spectral_block.hpp"
#include "support/cases.hpp"
#include "support/nodes.hpp"
#include "support/spectral_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

using namespace asperity;

namespace {

using std::numbers::pi;

SurfaceMatrix stiffness(const BlockOptions& o, int nx, int ny) {
    return o.stiffness(wave_phase(nx, o.sites), wave_phase(ny, o.sites));
}

/// Frictionless normal stiffness over E* q/2.
double ratio(const BlockOptions& o, int nx, int ny) {
    const double q = 2.0 * pi * std::hypot(nx, ny) / (o.sites * o.spacing);
    const double normal = 1.0 / (inverse(stiffness(o, nx, ny)).zz * o.spacing * o.spacing);
    return normal / (0.5 * o.contact_modulus() * q);
}

} // namespace

TEST(SurfaceMatrix, IsTheElimination) {
    for (int sites : {15, 16, 40})
        for (int thickness : {1, 2, 7, 40, 300}) {
            BlockOptions o = test::paper_block(sites, thickness, 0);
            for (int nx = 0; nx <= sites / 2; ++nx)
                for (int ny = 0; ny <= nx; ++ny) {
                    if (nx + ny == 0) continue;
                    const double dq = 2.0 * pi / (sites * o.spacing);
                    const double reference = test::surface_stiffness_ratio(
                        nx * dq, ny * dq, thickness, o.spacing, o.lame(), o.shear_modulus());
                    EXPECT_NEAR(ratio(o, nx, ny), reference, 1e-10 * reference) << nx << ", " << ny;
                }
        }
}

TEST(SurfaceMatrix, UniformModesAreExact) {
    for (int thickness : {1, 8, 512}) {
        const BlockOptions o = test::paper_block(16, thickness, 0);
        const SurfaceMatrix s = stiffness(o, 0, 0);
        const double area = o.spacing * o.spacing, depth = thickness * o.spacing;
        EXPECT_NEAR(s.zz / area, (o.lame() + 2 * o.shear_modulus()) / depth, 1e-15 / depth);
        EXPECT_NEAR(s.xx / area, o.shear_modulus() / depth, 1e-15 / depth);
        EXPECT_EQ(s.xz, 0.0);
    }
}

TEST(SurfaceMatrix, IsPositiveAndStopsWhereNothingIsLeft) {
    const BlockOptions thick = test::paper_block(512, 512, 0),
                       thicker = test::paper_block(512, 100000, 0);
    for (int nx : {1, 2, 3, 17, 64, 200, 255, 256})
        for (int ny : {0, 1, 2, 60, 128, 255, 256}) {
            if (ny > nx) continue;
            const SurfaceMatrix s = stiffness(thick, nx, ny), t = stiffness(thicker, nx, ny);
            EXPECT_GT(s.xx, 0.0);
            EXPECT_GT(s.xx * s.yy - s.xy * s.xy, 0.0);
            EXPECT_GT(inverse(s).zz * (s.xx * s.yy - s.xy * s.xy), 0.0);
            // Clamped at 512 a or far away: exp(-4 pi n) apart for the wave with n periods.
            const double apart = 1e-11 + 1e3 * std::exp(-4.0 * pi * std::hypot(nx, ny));
            EXPECT_NEAR(s.zz, t.zz, apart * t.zz) << nx << ", " << ny;
            EXPECT_NEAR(s.xz, t.xz, apart * t.zz) << nx << ", " << ny;
        }
}

TEST(SpectralBlock, AHeldTopPullsWithItsSpring) {
    const BlockOptions o = test::paper_block(10, 6, 0);
    SpectralBlock block(o, Communicator());
    block.set_uniform(0.0);
    block.constrain(Constraint::top(0.2));
    const double spring = (o.lame() + 2 * o.shear_modulus()) * 100 * o.spacing / 6;
    EXPECT_NEAR(block.top_force(), -0.2 * spring, 1e-12 * spring);
    EXPECT_NEAR(block.energies()[Term::elastic], 0.5 * 0.04 * spring, 1e-12 * spring);
    block.constrain({});
    EXPECT_EQ(block.energies()[Term::elastic], 0.0);
    EXPECT_EQ(block.top_force(), 0.0);
    // Under a load the free top plane stretches the same spring.
    const double load = 3.0;
    block.constrain(Constraint::load(load));
    EXPECT_NEAR(block.top_force(), load, 1e-12);
    EXPECT_NEAR(block.top(), -load / spring, 1e-12);
    EXPECT_NEAR(block.energies()[Term::elastic], 0.5 * load * load / spring, 1e-12);
}

TEST(SpectralBlock, PreconditionerIsAnInverse) {
    // (S + k) (S + k)^-1 x = x, in the precision of the products.
    for (int sites : {11, 16})
        for (bool frictionless : {false, true}) {
            const SpectralBlock block(test::paper_block(sites, 9, 0), Communicator(), frictionless);
            const Preconditioner preconditioner(block, 1.5);
            std::mt19937_64 random(5);
            const auto x = test::random_displacement(block, random, 1.0);
            auto y = block.new_waves<float>(), back = block.new_waves<float>();
            for (int b = 0; b < y.blocks(); ++b)
                preconditioner.apply(b, x.waves.block(b), 0.0, y.block(b));
            combine(1.5, y, 0.0, back);
            for (int b = 0; b < y.blocks(); ++b)
                block.stiffen<float>(b, y.block(b), 1.0, back.block(b), back.block(b));
            combine(-1.0, x.waves, 1.0, back);
            EXPECT_LT(dot(back, back), 1e-12 * dot(x.waves, x.waves));
        }
}

TEST(SpectralBlock, SitesRespondToTheGradientThroughThePreconditioner) {
    // target - u = -(S + k)^-1 g, whatever is held, the gradient in double on its own way.
    constexpr double k = 0.4;
    for (bool frictionless : {false, true})
        for (const Constraint& constraint :
             {Constraint::load(3.0), Constraint::top(0.25), Constraint::mean_height(-0.1)}) {
            SpectralBlock block(test::paper_block(15, 9, 0), Communicator(), frictionless);
            std::mt19937_64 random(12);
            const auto displacement = test::random_displacement(block, random, 0.3);
            block.displace(1.0, displacement.waves, displacement.sites);
            block.constrain(constraint);
            block.apply_constraint();
            std::normal_distribution<double> normal(0.0, 0.1);
            const VectorPlane<double> force = block.interface_force();
            for (const PlaneView<double>& f : {force.x, force.y, force.z})
                for (int y = 0; y < f.ny; ++y)
                    for (int x = 0; x < f.nx; ++x)
                        f(x, y) = normal(random);
            const Preconditioner preconditioner(block, k);
            auto waves = block.new_waves<float>();
            auto target = block.new_field<float>();
            to_sites(block.respond(k, std::cref(preconditioner)), target);

            auto g = block.new_waves<double>();
            block.gradient(g);
            combine(1.0, g, 0.0, waves);
            for (int b = 0; b < g.blocks(); ++b)
                preconditioner.apply(b, waves.block(b), 0.0, waves.block(b));
            auto response = block.new_waves<double>();
            combine(1.0, waves, 0.0, response);
            auto expected = block.new_field<double>();
            to_sites(response, block.transform<double>(), expected);
            double largest = 0.0;
            for (int c = 0; c < block.components(); ++c) {
                const auto i = static_cast<std::size_t>(c);
                std::vector<double> way = test::values_of(expected[i].plane(0));
                const auto u = test::values_of(block.moving_layer(c));
                largest = std::max(largest, test::largest_of(way));
                std::transform(u.begin(), u.end(), way.begin(), way.begin(), std::minus());
                EXPECT_LT(test::largest_difference(test::values_of(target[i].plane(0)), way), 2e-6);
            }
            EXPECT_GT(largest, 0.1);
        }
}

TEST(SpectralBlock, WithoutFrictionAWaveIsTheHalfSpace) {
    // Normal forces alone: E* q/2 for long waves on a thick block, and what the whole matrix says
    // of a displacement whose lateral components are free.
    const BlockOptions o = test::paper_block(64, 512, 0);
    const SpectralBlock block(o, Communicator(), true), with_friction(o, Communicator());
    const double area = o.spacing * o.spacing;
    for (int n : {1, 2, 3}) {
        const double q = 2.0 * pi * n / (64 * o.spacing);
        const double long_wave = 0.5 * o.contact_modulus() * q * area;
        EXPECT_NEAR(block.acting_stiffness(n, 0).zz, long_wave, 2.5e-4 * n * n * long_wave) << n;
    }
    for (int nx : {1, 7, 32})
        for (int ny : {0, 5, 32})
            EXPECT_NEAR(block.acting_stiffness(nx, ny).zz,
                        1.0 / inverse(with_friction.acting_stiffness(nx, ny)).zz, 1e-14);
}
