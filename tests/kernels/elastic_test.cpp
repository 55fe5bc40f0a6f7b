// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The SIMD cells of small and finite strain against their definition, spring by spring. Gradients,
// uniform strains and rotations: engine/block_test.
#include "decomposition/field.hpp"
#include "kernels/elastic_level.hpp"
#include "support/elastic_reference.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <utility>
#include <vector>

using namespace asperity;

namespace {

constexpr double s = 2.6, mu = 0.17, lame = 0.89; // Å, eV/Å^3: near the paper's

/// A stack of n * m nodes and cells + 1 planes, with forces of all planes, the last one apart.
struct Stack {
    Tile tile;
    int cells;
    VectorField<double> u, force, transferred, upper;
    LevelCell cell{s, {mu * s, (lame - mu) * s / 16.0}};
    CellStrain strain;

    Stack(int n, int m, int layers, CellStrain of)
        : tile{0, 0, n, m, n}, cells(layers), u(tile, layers + 1), force(tile, layers),
          transferred(tile, 1), upper(tile, 1), strain(of) {}

    using Place = std::array<double, 3>;
    /// Random displacements of up to `amplitude` that fit the periodic box.
    void shake(double amplitude, unsigned seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
        for (auto* f : {&u.x, &u.y, &u.z})
            for (int z = 0; z <= cells; ++z)
                for (int y = 0; y < tile.ny; ++y)
                    for (int x = 0; x < tile.nx; ++x)
                        f->view()(x, y, z) = uniform(random);
        for (auto* f : {&u.x, &u.y, &u.z}) { // and the halo
            const auto v = f->view();
            for (int z = 0; z <= cells; ++z)
                for (int y = -2; y < tile.ny + 2; ++y)
                    for (int x = -2; x < tile.nx + 2; ++x)
                        v(x, y, z) = v(periodic(x, tile.nx), periodic(y, tile.ny), z);
        }
    }
    /// Band by band; of the upper plane also the frame around the tile.
    void evaluate(int band = 8) {
        const ElasticLevel of = level();
        for (int y = 0; y < tile.ny; y += band)
            elastic_kernels(strain).forces(of, y, std::min(tile.ny, y + band), force.view());
    }
    ElasticLevel level() {
        ElasticLevel level;
        level.cells = cells;
        level.u = u.view();
        level.transferred = transferred.plane(0);
        level.upper_force = upper.plane(0);
        level.lower = make_stencil(cell.elasticity, Face::lower);
        level.inner = make_stencil(cell.elasticity, Face::inner);
        level.upper = make_stencil(cell.elasticity, Face::upper);
        level.cell = cell;
        return level;
    }
    Place force_at(int x, int y, int z) const {
        if (z == cells)
            return {upper.x.view()(x, y, 0), upper.y.view()(x, y, 0), upper.z.view()(x, y, 0)};
        return {force.x.view()(x, y, z), force.y.view()(x, y, z), force.z.view()(x, y, z)};
    }
    double energy() const {
        ExactSum sum;
        elastic_kernels(strain).energy(u.view(), cell, 0, tile.ny, sum);
        return sum.value();
    }
    /// Forces of the definition, their halo folded back onto the owners, and the energy.
    double reference(VectorField<double>& out) const {
        out = VectorField<double>(tile, cells + 1);
        const double energy = strain == CellStrain::finite
                                  ? test::finite_reference(u.view(), cell, out.view())
                                  : test::elastic_reference(u.view(), cell, out.view());
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
};

class LevelCells : public testing::TestWithParam<std::tuple<CellStrain, std::pair<int, int>>> {};

} // namespace

TEST_P(LevelCells, EqualTheDefinitionCellByCell) {
    const auto [strain, size] = GetParam();
    const auto [n, m] = size;
    for (double kappa :
         {(lame - mu) * s / 16.0, 0.0}) // with dilatation, and the plain bond crystal
        for (int layers : {1, 2, 4}) {
            Stack stack(n, m, layers, strain);
            stack.cell.elasticity.kappa = kappa;
            stack.shake(0.4, 7u + static_cast<unsigned>(n));
            stack.transferred.x.view()(1, 2, 0) = 0.3;
            VectorField<double> expected;
            const double energy = stack.reference(expected);
            expected.x.view()(1, 2, 0) += 0.3;
            stack.evaluate();
            EXPECT_NEAR(stack.energy(), energy, 1e-13 * energy);
            // A force sums some 18 springs of k |r| each, below 2 eV/Å, and as many pressures.
            const double rounding = 1e-14;
            for (int z = 0; z <= layers; ++z)
                for (int y = 0; y < m; ++y)
                    for (int x = 0; x < n; ++x) {
                        const auto f = stack.force_at(x, y, z);
                        const auto e =
                            std::array{expected.x.view()(x, y, z), expected.y.view()(x, y, z),
                                       expected.z.view()(x, y, z)};
                        for (std::size_t i = 0; i < 3; ++i)
                            ASSERT_NEAR(f[i], e[i], rounding) << x << y << z;
                    }
        }
}

TEST_P(LevelCells, GiveTheSameBitsInBandsOfAnyHeight) {
    const auto [strain, size] = GetParam();
    const auto [n, m] = size;
    Stack whole(n, m, 3, strain), cut(n, m, 3, strain);
    whole.shake(0.4, 5);
    cut.shake(0.4, 5);
    whole.evaluate(m);
    for (int band : {1, 2, 3, 8}) {
        cut.evaluate(band);
        for (int z = 0; z <= 3; ++z)
            for (int y = z == 3 ? -1 : 0; y < (z == 3 ? m + 1 : m); ++y) // the upper plane's frame
                for (int x = z == 3 ? -1 : 0; x < (z == 3 ? n + 1 : n); ++x)
                    ASSERT_EQ(cut.force_at(x, y, z), whole.force_at(x, y, z)) << x << y << z;
    }
    // The frame is what the nodes inside are, seen through the periodic border.
    for (int x = -1; x <= n; ++x)
        EXPECT_EQ(whole.force_at(x, m, 3), whole.force_at(periodic(x, n), 0, 3));
}

/// Levels in the caches and beyond them, damped, observed or not, have loops of their own.
TEST(ElasticPass, KicksByTheForcesInAllItsLoops) {
    constexpr int layers = 3, band = 8;
    for (const auto& [n, m] : {std::pair{5, 7}, {8, 8}, {17, 3}, {72, 17}, {250, 251}}) {
        Stack stack(n, m, layers, CellStrain::small);
        stack.shake(0.4, 3);
        stack.transferred.y.view()(2, 1, 0) = 0.3;
        stack.evaluate();
        std::vector<Stack::Place> upper;
        for (int y = -1; y <= m; ++y)
            for (int x = -1; x <= n; ++x)
                upper.push_back(stack.force_at(x, y, layers));
        for (int loop = 0; loop < 4; ++loop) {
            Kick kick;
            kick.kick = 1.0; // of nodes at rest: their velocities are the forces, bit for bit
            kick.damped = loop & 1;
            kick.observed = loop & 2;
            VectorField<double> v(stack.tile, layers);
            ElasticLevel level = stack.level();
            level.v = v.view();
            KickSums sums;
            for (int y = 0; y < m; y += band)
                elastic_kernels().advance(level, {kick, kick, kick, layers}, 0.0,
                                          {y, std::min(m, y + band), 0, m}, {}, sums);
            for (int z = 0; z < layers; ++z)
                for (int y = 0; y < m; ++y)
                    for (int x = 0; x < n; ++x)
                        ASSERT_EQ((Stack::Place{v.x.view()(x, y, z), v.y.view()(x, y, z),
                                                v.z.view()(x, y, z)}),
                                  stack.force_at(x, y, z))
                            << n << ' ' << loop << ": " << x << ' ' << y << ' ' << z;
            auto expected = upper.begin();
            for (int y = -1; y <= m; ++y)
                for (int x = -1; x <= n; ++x)
                    ASSERT_EQ(stack.force_at(x, y, layers), *expected++);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, LevelCells,
                         testing::Combine(testing::Values(CellStrain::small, CellStrain::finite),
                                          testing::Values(std::pair{8, 8}, std::pair{5, 7},
                                                          std::pair{17, 3}, std::pair{32, 4},
                                                          std::pair{24, 17})));
