// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The SIMD stencil against the definition of the cell energy, spring by spring.
#include "decomposition/field.hpp"
#include "kernels/elastic_level.hpp"
#include "support/elastic_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

using namespace asperity;

namespace {

/// A periodic stack of n * m nodes and cells + 1 planes with random displacements.
struct Stack {
    Tile tile;
    int cells;
    VectorField<double> u, force, none;
    CellElasticity elasticity{0.441, 0.117};

    Stack(int n, int m, int layers, unsigned seed)
        : tile{0, 0, n, m, n}, cells(layers), u(tile, layers + 1), force(tile, layers + 1),
          none(tile, 1) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> uniform(-1.0, 1.0);
        for (auto* f : {&u.x, &u.y, &u.z})
            for (int z = 0; z <= cells; ++z)
                for (int y = 0; y < m; ++y)
                    for (int x = 0; x < n; ++x)
                        f->view()(x, y, z) = uniform(random);
        wrap();
    }
    void wrap() {
        for (auto* f : {&u.x, &u.y, &u.z}) {
            const auto v = f->view();
            for (int z = 0; z <= cells; ++z)
                for (int y = -2; y < tile.ny + 2; ++y)
                    for (int x = -2; x < tile.nx + 2; ++x)
                        v(x, y, z) = v(periodic(x, tile.nx), periodic(y, tile.ny), z);
        }
    }
    /// Forces of the reference, its halo folded back onto the owners. Returns the energy.
    double reference(VectorField<double>& out) const {
        out = VectorField<double>(tile, cells + 1);
        const double energy = test::elastic_reference(u.view(), elasticity, out.view());
        for (auto* f : {&out.x, &out.y, &out.z}) {
            const auto v = f->view();
            for (int z = 0; z <= cells; ++z)
                for (int y = 0; y <= tile.ny; ++y)
                    for (int x = 0; x <= tile.nx; ++x)
                        if (x == tile.nx || y == tile.ny)
                            v(periodic(x, tile.nx), periodic(y, tile.ny), z) += v(x, y, z);
        }
        return energy;
    }
    void stencil() {
        ElasticLevel level;
        level.cells = cells;
        level.u = u.view();
        level.transferred = none.plane(0);
        level.upper_force = force.plane(cells);
        level.lower = make_stencil(elasticity, Face::lower);
        level.inner = make_stencil(elasticity, Face::inner);
        level.upper = make_stencil(elasticity, Face::upper);
        elastic_kernels().forces(level, 0, tile.ny, force.view());
    }
    double energy() const {
        ExactSum sum;
        elastic_kernels().energy(u.view(), {2.6, elasticity}, 0, tile.ny, sum);
        return sum.value();
    }
};

} // namespace

class ElasticStencil : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(ElasticStencil, EqualsTheCellsSpringBySpring) {
    const auto [n, m] = GetParam();
    for (int layers : {1, 2, 4}) {
        Stack stack(n, m, layers, 7u + static_cast<unsigned>(n));
        VectorField<double> expected;
        const double energy = stack.reference(expected);
        stack.stencil();
        EXPECT_NEAR(stack.energy(), energy, 1e-13 * energy);
        for (int z = 0; z <= layers; ++z)
            for (int y = 0; y < m; ++y)
                for (int x = 0; x < n; ++x) {
                    ASSERT_NEAR(stack.force.view().x(x, y, z), expected.view().x(x, y, z),
                                2e-14 * 20);
                    ASSERT_NEAR(stack.force.view().y(x, y, z), expected.view().y(x, y, z),
                                2e-14 * 20);
                    ASSERT_NEAR(stack.force.view().z(x, y, z), expected.view().z(x, y, z),
                                2e-14 * 20);
                }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ElasticStencil,
                         testing::Values(std::pair{8, 8}, std::pair{5, 7}, std::pair{17, 3},
                                         std::pair{32, 4}));

TEST(ElasticStencil, ForceIsMinusTheGradientOfTheEnergy) {
    Stack stack(6, 6, 3, 3);
    stack.stencil();
    const double step = 1e-4; // the energy is quadratic: central differences are exact to rounding
    for (const auto& [x, y, z] : {std::tuple{0, 0, 0}, {5, 2, 1}, {3, 5, 3}, {2, 2, 2}})
        for (auto component :
             {&VectorField<double>::x, &VectorField<double>::y, &VectorField<double>::z}) {
            double& u = (stack.u.*component).view()(x, y, z);
            const double at = u;
            u = at + step;
            stack.wrap();
            const double up = stack.energy();
            u = at - step;
            stack.wrap();
            const double down = stack.energy();
            u = at;
            stack.wrap();
            EXPECT_NEAR((stack.force.*component).view()(x, y, z), -(up - down) / (2 * step), 1e-9);
        }
}

TEST(ElasticStencil, RigidTranslationsAndInfinitesimalRotationsAreFree) {
    Stack stack(8, 8, 2, 1);
    // A rotation does not fit the periodic box: look at nodes whose stencil stays inside.
    for (int z = 0; z <= 2; ++z)
        for (int y = -2; y < 10; ++y)
            for (int x = -2; x < 10; ++x) {
                stack.u.view().x(x, y, z) = 0.3 + 0.01 * z - 0.02 * y;
                stack.u.view().y(x, y, z) = -0.1 + 0.02 * x - 0.03 * z;
                stack.u.view().z(x, y, z) = 0.7 - 0.01 * x + 0.03 * y;
            }
    stack.stencil();
    EXPECT_NEAR(stack.energy(), 0.0, 1e-25);
    for (int z = 0; z <= 2; ++z)
        EXPECT_NEAR(stack.force.view().z(3, 3, z), 0.0, 1e-14);
}

TEST(ElasticStencil, LongWavesAreIsotropicWithTheModuliAskedFor) {
    // Uniform strains: energy density against C11 = lambda + 2 mu, C12 = lambda, C44 = mu.
    const double s = 2.6, mu = 0.17, lambda = 0.89;
    const CellElasticity e{mu * s, (lambda - mu) * s / 16.0};
    const auto density = [&](double exx, double eyy, double gxy, double gxz) {
        Stack stack(8, 8, 1, 1);
        stack.elasticity = e;
        for (int z = 0; z <= 1; ++z)
            for (int y = -2; y < 10; ++y)
                for (int x = -2; x < 10; ++x) {
                    stack.u.view().x(x, y, z) = s * (exx * x + gxy * y + gxz * z);
                    stack.u.view().y(x, y, z) = s * eyy * y;
                    stack.u.view().z(x, y, z) = 0.0;
                }
        return stack.energy() / (64 * s * s * s);
    };
    EXPECT_NEAR(density(1e-2, 0, 0, 0), 0.5 * (lambda + 2 * mu) * 1e-4, 1e-16);
    EXPECT_NEAR(density(1e-2, 1e-2, 0, 0), (2 * lambda + 2 * mu) * 1e-4, 1e-16);
    EXPECT_NEAR(density(0, 0, 1e-2, 0), 0.5 * mu * 1e-4, 1e-16);
    EXPECT_NEAR(density(0, 0, 0, 1e-2), 0.5 * mu * 1e-4, 1e-16);
}
