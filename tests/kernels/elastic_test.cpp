// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The SIMD cells of small and finite strain against their definition, spring by spring, and the
// laws that single out finite strain: invariance under rotation, closed forms of uniform
// deformations, small strain as its limit. Gradients and uniform strains of both:
// engine/block_test.
#include "decomposition/field.hpp"
#include "kernels/elastic_level.hpp"
#include "support/elastic_reference.hpp"
#include "support/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

using namespace asperity;
using test::Matrix;

namespace {

constexpr double s = 2.6, mu = 0.17, lame = 0.89; // Å, eV/Å^3: near the paper's

/// A stack of n * m nodes and cells + 1 planes, with forces of all planes, the last one apart.
struct Stack {
    Tile tile;
    int cells;
    VectorField<double> u, force, transferred, upper;
    LevelCell cell{s, {mu * s, (lame - mu) * s / 16.0}};
    CellStrain strain;

    Stack(int n, int m, int layers, CellStrain of = CellStrain::finite)
        : tile{0, 0, n, m, n}, cells(layers), u(tile, layers + 1), force(tile, layers),
          transferred(tile, 1), upper(tile, 1), strain(of) {}

    using Place = std::array<double, 3>;
    /// u(node) on every node, those of the halo too.
    void fill(const std::function<Place(int, int, int)>& displacement) {
        for (int z = 0; z <= cells; ++z)
            for (int y = -2; y < tile.ny + 2; ++y)
                for (int x = -2; x < tile.nx + 2; ++x) {
                    const Place at = displacement(x, y, z);
                    u.x.view()(x, y, z) = at[0];
                    u.y.view()(x, y, z) = at[1];
                    u.z.view()(x, y, z) = at[2];
                }
    }
    /// Random displacements of up to `amplitude` that fit the periodic box.
    void shake(double amplitude, unsigned seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
        for (auto* f : {&u.x, &u.y, &u.z})
            for (int z = 0; z <= cells; ++z)
                for (int y = 0; y < tile.ny; ++y)
                    for (int x = 0; x < tile.nx; ++x)
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
    /// Band by band; of the upper plane also the frame around the tile.
    void evaluate(int band = 8) {
        ElasticLevel level;
        level.cells = cells;
        level.u = u.view();
        level.transferred = transferred.plane(0);
        level.upper_force = upper.plane(0);
        level.lower = make_stencil(cell.elasticity, Face::lower);
        level.inner = make_stencil(cell.elasticity, Face::inner);
        level.upper = make_stencil(cell.elasticity, Face::upper);
        level.cell = cell;
        for (int y = 0; y < tile.ny; y += band)
            elastic_kernels(strain).forces(level, y, std::min(tile.ny, y + band), force.view());
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
                                  : test::elastic_reference(u.view(), cell.elasticity, out.view());
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
    double density() const { return energy() / (tile.nx * tile.ny * cells * s * s * s); }
};

/// Every node of the stack at F X.
void deform(Stack& stack, const Matrix& F) {
    stack.fill([&](int x, int y, int z) {
        const std::array<double, 3> at = {s * x, s * y, s * z};
        std::array<double, 3> u = test::apply(F, at);
        for (std::size_t i = 0; i < 3; ++i)
            u[i] -= at[i];
        return u;
    });
}

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
                        ASSERT_NEAR(f[0], expected.view().x(x, y, z), rounding) << x << y << z;
                        ASSERT_NEAR(f[1], expected.view().y(x, y, z), rounding) << x << y << z;
                        ASSERT_NEAR(f[2], expected.view().z(x, y, z), rounding) << x << y << z;
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

INSTANTIATE_TEST_SUITE_P(Sizes, LevelCells,
                         testing::Combine(testing::Values(CellStrain::small, CellStrain::finite),
                                          testing::Values(std::pair{8, 8}, std::pair{5, 7},
                                                          std::pair{17, 3}, std::pair{32, 4},
                                                          std::pair{24, 17})));

TEST(FiniteStrain, IsInvariantUnderRotation) {
    // A deformed stack and the same stack turned as a whole about a slanted axis: same energy,
    // forces turned along. The displacements, random everywhere, do not fit the box and need not.
    const auto wobble = [](int x, int y, int z) {
        const double phase = 1.3 * x + 71.7 * y + 0.7 * z;
        return std::array{0.3 * std::sin(phase), 0.3 * std::sin(1.7 * phase),
                          0.3 * std::sin(2.3 * phase)};
    };
    Stack straight(8, 8, 3);
    straight.fill(wobble);
    straight.evaluate();
    const double energy = straight.energy();
    for (double degrees : {10.0, 90.0, 180.0}) {
        const Matrix Q = test::rotation({1.0, -2.0, 0.5}, degrees);
        Stack turned(8, 8, 3);
        turned.fill([&](int x, int y, int z) {
            const std::array<double, 3> at = {s * x, s * y, s * z};
            auto u = wobble(x, y, z);
            for (std::size_t i = 0; i < 3; ++i)
                u[i] += at[i];
            u = test::apply(Q, u);
            for (std::size_t i = 0; i < 3; ++i)
                u[i] -= at[i];
            return u;
        });
        turned.evaluate();
        EXPECT_NEAR(turned.energy(), energy, 1e-13 * energy) << degrees;
        // Displacements of up to 45 Å are rounded to 7e-15 Å; stiffnesses are some 10 eV/Å^2.
        const double rounding = 7e-14;
        double largest = 0.0;
        for (int z = 0; z <= 3; ++z)
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x) {
                    const auto expected = test::apply(Q, straight.force_at(x, y, z));
                    const auto f = turned.force_at(x, y, z);
                    for (std::size_t i = 0; i < 3; ++i) {
                        ASSERT_NEAR(f[i], expected[i], rounding) << degrees;
                        largest = std::max(largest, std::abs(f[i]));
                    }
                }
        EXPECT_GT(largest, 0.1);
    }
}

TEST(FiniteStrain, UniformDeformationsHaveTheirClosedForms) {
    const double k = mu; // spring constant over s: k s^2 / s^3
    const auto square = [](double x) { return x * x; };
    Stack stack(8, 8, 2);
    for (double stretch : {0.8, 0.95, 1.0, 1.1, 1.5}) {
        // Along z: one edge in three, four face diagonals of six.
        deform(stack, {{{1, 0, 0}, {0, 1, 0}, {0, 0, stretch}}});
        const double diagonal = std::sqrt(0.5 * (1 + stretch * stretch)) - 1;
        double expected = 0.5 * k * square(stretch - 1) + k * 4 * square(diagonal) +
                          0.5 * (lame - mu) * square(stretch - 1);
        EXPECT_NEAR(stack.density(), expected, 1e-14) << stretch;
        // On all sides.
        deform(stack, {{{stretch, 0, 0}, {0, stretch, 0}, {0, 0, stretch}}});
        expected = (1.5 + 6) * k * square(stretch - 1) +
                   0.5 * (lame - mu) * square(stretch * stretch * stretch - 1);
        EXPECT_NEAR(stack.density(), expected, 1e-14) << stretch;
    }
    for (double shear : {-0.7, 0.01, 0.3, 1.0}) {
        // Planes of constant z slide along x: the volume stays.
        deform(stack, {{{1, 0, shear}, {0, 1, 0}, {0, 0, 1}}});
        const double edge = std::sqrt(1 + shear * shear) - 1;
        const double xz_long = std::sqrt(0.5 * (square(1 + shear) + 1)) - 1;
        const double xz_short = std::sqrt(0.5 * (square(1 - shear) + 1)) - 1;
        const double yz = std::sqrt(0.5 * (shear * shear + 2)) - 1;
        const double expected =
            0.5 * k * square(edge) + k * (square(xz_long) + square(xz_short) + 2 * square(yz));
        EXPECT_NEAR(stack.density(), expected, 1e-14) << shear;
    }
}

TEST(FiniteStrain, ApproachesSmallStrainAsTheSquareOfTheAmplitude) {
    Stack stack(8, 8, 3);
    const auto difference = [&](double amplitude) {
        stack.shake(amplitude, 11);
        const auto forces = [&](CellStrain strain) {
            stack.strain = strain;
            stack.evaluate();
            std::vector<double> all;
            for (int z = 0; z <= stack.cells; ++z)
                for (int y = 0; y < 8; ++y)
                    for (int x = 0; x < 8; ++x)
                        for (double f : stack.force_at(x, y, z))
                            all.push_back(f);
            return all;
        };
        const auto finite = forces(CellStrain::finite), small = forces(CellStrain::small);
        double sum = 0.0;
        for (std::size_t i = 0; i < finite.size(); ++i)
            sum += std::pow(finite[i] - small[i], 2);
        return std::sqrt(sum);
    };
    const double coarse = difference(4e-3), middle = difference(2e-3), fine = difference(1e-3);
    EXPECT_GT(fine, 1e-7) << "there is a difference";
    EXPECT_NEAR(coarse / middle, 4.0, 0.01); // the next order is that of amplitude / s
    EXPECT_NEAR(middle / fine, 4.0, 0.005);
}
