// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Laws of the block at finite strain, constrained planes included; its motion; its relaxed contact.
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"
#include "support/levels_at_rest.hpp"
#include "support/rotation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <omp.h>

using namespace asperity;
using test::ElasticOperator;
using test::Matrix;
using test::Vector;

namespace {

struct Shape {
    int sites, thickness, layers; ///< layers a level; 0: lattice
};
const std::vector<Shape> shapes = {{8, 5, 0}, {16, 23, 3}, {32, 62, 2}, {12, 27, 3}};

void PrintTo(const Shape& s, std::ostream* out) {
    *out << s.sites << " sites, " << s.thickness << " layers, " << s.layers << " a level";
}

BlockOptions finite_block(int sites, int thickness, int layers) {
    BlockOptions options = test::paper_block(sites, thickness, layers);
    options.finite_strain = true;
    return options;
}

class FiniteBlock : public testing::TestWithParam<Shape> {
protected:
    BlockOptions options = finite_block(GetParam().sites, GetParam().thickness, GetParam().layers);
};

/// Energy density of a uniform deformation, straight from the definition: springs as long as F
/// makes them, along 3 edges and 6 face diagonals, and the volume. eV/Å^3.
double energy_density(const BlockOptions& o, const Matrix& F) {
    const double mu = o.shear_modulus();
    double sum = 0.0;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                const int square = x * x + y * y + z * z;
                if (square != 1 && square != 2) continue;
                const auto r = test::apply(F, {double(x), double(y), double(z)});
                const double stretch = std::hypot(r[0], r[1], r[2]) - std::sqrt(double(square));
                sum += 0.25 * mu * stretch * stretch; // each direction is met twice
            }
    const double det = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
                       F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                       F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
    return sum + 0.5 * (o.lame() - mu) * (det - 1) * (det - 1);
}

/// Nominal traction on planes of constant z, dW/dF_iz, eV/Å^3.
double traction(const BlockOptions& o, Matrix F, std::size_t i) {
    const double at = F[i][2], h = 1e-3;
    const auto slope = [&](double d) {
        F[i][2] = at + d;
        const double up = energy_density(o, F);
        F[i][2] = at - d;
        return (up - energy_density(o, F)) / (2 * d);
    };
    return (4.0 * slope(h) - slope(2 * h)) / 3.0;
}

} // namespace

TEST_P(FiniteBlock, PatchTest) {
    // Uniform deformations, large, turned and both: no force inside or where levels meet, and the
    // nominal traction on each node of the free surface. A rotation alone: no force at all.
    Block block(options, Communicator(), test::serial_grid(options));
    std::vector<VectorField<double>> force;
    for (const auto& level : block.levels())
        force.emplace_back(level.tile, level.shape.cells);
    const double a = options.spacing;
    const Matrix stretch = {{{1.05, 0.02, 0.1}, {0.0, 0.97, -0.05}, {0.03, 0.0, 0.9}}};
    const Matrix turn = test::rotation({1.0, 2.0, -0.5}, 25.0);
    for (const Matrix& F : {stretch, turn, test::product(turn, stretch)}) {
        double largest = 0.0; // k u
        for (const auto& level : block.levels()) {
            const auto to = block.fields(level).u.view();
            const int scale = 1 << level.shape.level;
            const bool last = &level == &block.levels().back();
            for (int z = 0; z < level.shape.cells + (last ? 1 : 0); ++z)
                for (int y = -halo_width; y < level.tile.ny + halo_width; ++y)
                    for (int x = -halo_width; x < level.tile.nx + halo_width; ++x) {
                        const std::array<double, 3> at = {a * scale * x, a * scale * y,
                                                          a * (level.depth + scale * z)};
                        const auto moved = test::apply(F, at);
                        to.x(x, y, z) = moved[0] - at[0];
                        to.y(x, y, z) = moved[1] - at[1];
                        to.z(x, y, z) = moved[2] - at[2];
                        for (std::size_t i = 0; i < 3; ++i)
                            largest = std::max(largest, 6.0 * scale * std::abs(moved[i]));
                    }
        }
        block.interpolate();
        block.forces(force);
        const double rounding = 4e-15 * largest;
        std::array<double, 3> pull{};
        for (std::size_t i = 0; i < 3; ++i)
            pull[i] = a * a * traction(options, F, i);
        for (std::size_t l = 0; l < force.size(); ++l)
            for (int z = 0; z < block.levels()[l].shape.cells; ++z)
                for (int y = 0; y < block.levels()[l].tile.ny; ++y)
                    for (int x = 0; x < block.levels()[l].tile.nx; ++x) {
                        const double on = l == 0 && z == 0 ? 1.0 : 0.0;
                        const auto f = std::as_const(force[l]).view();
                        // The traction is a numerical derivative, good to 1e-11.
                        ASSERT_NEAR(f.x(x, y, z), on * pull[0], rounding + on * 1e-10) << l << z;
                        ASSERT_NEAR(f.y(x, y, z), on * pull[1], rounding + on * 1e-10) << l << z;
                        ASSERT_NEAR(f.z(x, y, z), on * pull[2], rounding + on * 1e-10) << l << z;
                    }
    }
}

TEST_P(FiniteBlock, ForceIsMinusTheGradientOfTheEnergy) {
    ElasticOperator block(options);
    for (unsigned seed : {1u, 2u}) {
        Vector u = test::random_vector(block.size(), seed);
        for (double& x : u)
            x *= 0.3;
        const Vector along = test::random_vector(block.size(), seed + 10);
        const double top = 0.3, top_along = 0.7;
        const auto energy_at = [&](double s) {
            Vector moved = u;
            for (std::size_t i = 0; i < moved.size(); ++i)
                moved[i] += s * along[i];
            block.set(moved, top + s * top_along);
            return block.energy();
        };
        const auto slope = [&](double d) { return (energy_at(d) - energy_at(-d)) / (2 * d); };
        const double h = 2e-3;
        const double gradient = (4.0 * slope(h) - slope(2 * h)) / 3.0;
        const double energy = energy_at(0.0);
        const double expected =
            -(test::dot(block.force(), along) + block.top_force()[2] * top_along);
        EXPECT_NEAR(gradient, expected, 1e-10 * energy);
    }
}

TEST_P(FiniteBlock, InternalForcesSumToZero) {
    ElasticOperator block(options);
    Vector u = test::random_vector(block.size(), 7);
    for (double& x : u)
        x *= 0.3;
    block.set(u, 0.5);
    const Vector f = block.force();
    auto total = block.top_force();
    for (int c = 0; c < 3; ++c) {
        const Vector one = block.tabulate([&](const Block::Level&, int component, int, int, int) {
            return component == c ? 1.0 : 0.0;
        });
        EXPECT_NEAR(test::dot(f, one) + total[static_cast<std::size_t>(c)], 0.0,
                    1e-14 * std::sqrt(test::dot(f, f) * test::dot(one, one)));
    }
}

TEST_P(FiniteBlock, CostsMemoryOnlyWhereItIsAskedFor) {
    const auto bytes_after_a_step = [this](bool finite) {
        BlockOptions o = options;
        o.finite_strain = finite;
        Block block(o, Communicator(), test::serial_grid(o));
        block.set_uniform(0.0, 0.0);
        const std::size_t before = block.bytes();
        KickSums sums;
        block.advance({10.0}, sums);
        return block.bytes() - before;
    };
    EXPECT_EQ(bytes_after_a_step(false), 0u);
    // Two planes of a band of at most a dozen rows with their padding, three components, a thread.
    const auto most = static_cast<std::size_t>(omp_get_max_threads()) * 2 * 3 * sizeof(double) *
                      12 * static_cast<std::size_t>(options.sites + 40);
    EXPECT_GT(bytes_after_a_step(true), 0u);
    EXPECT_LT(bytes_after_a_step(true), most);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FiniteBlock, testing::ValuesIn(shapes));

TEST(FiniteMotion, EnergyErrorFallsAsTheSquareOfTheStep) {
    // Released pressed into a rough wall, nothing driven, nothing damped, 4 ps.
    const auto ripple = [](double dt) {
        SimulationOptions options;
        options.block = finite_block(8, 7, 2);
        options.interface = test::paper_interface();
        options.drive.velocity = 0.0;
        options.dt = dt;
        Simulation simulation(options, test::reference_surface("n8_b_rms1.0"), Communicator(),
                              test::serial_grid(options.block));
        simulation.start(4.5);
        double least = 1e300, most = -1e300;
        for (int n = 0; n * dt < 4000.0; ++n) {
            const StepRecord& now = simulation.step(true);
            const double energy = now.interface_energy + now.elastic_energy + now.kinetic_energy;
            least = std::min(least, energy), most = std::max(most, energy);
        }
        return most - least;
    };
    const double coarse = ripple(8.0), middle = ripple(4.0), fine = ripple(2.0);
    EXPECT_NEAR(coarse / middle, 4.0, 0.15);
    EXPECT_NEAR(middle / fine, 4.0, 0.05);
}

namespace {

struct Relaxation {
    RelaxedState state;
    double top = 0.0;
};
Relaxation relaxed(bool finite, double load) {
    BlockOptions options = test::paper_block(8, 6, 2);
    options.finite_strain = finite;
    test::LevelsAtRest rest(options);
    const Interface interface(test::reference_surface("n8_b_rms1.0"), rest.block.grid().tile(0),
                              options.spacing, test::paper_interface());
    const RelaxedState state = rest.relax(interface, 4.0, Constraint::load(load), 1e-8);
    return {state, rest.block.top()};
}

} // namespace

TEST(FiniteRelaxation, ReleasesTheWorkOfTheLoad) {
    // d(U + F z_top)/dF = z_top (Castigliano): forces of every node are those of the energy, linear
    // or not.
    const auto enthalpy = [](double load) {
        const auto r = relaxed(true, load);
        return r.state.interface_energy + r.state.elastic_energy + load * r.top;
    };
    const double h = 0.05;
    const auto free = relaxed(true, 0.0);
    ASSERT_TRUE(free.state.converged);
    EXPECT_NEAR((enthalpy(h) - enthalpy(-h)) / (2 * h), free.top, 1e-5);
    // It is another state than that of small strain, and not far from it.
    const auto linear = relaxed(false, 0.0);
    const double energy = free.state.interface_energy + free.state.elastic_energy;
    const double other = linear.state.interface_energy + linear.state.elastic_energy;
    EXPECT_GT(std::abs(energy - other), 1e-5 * std::abs(other));
    EXPECT_LT(std::abs(energy - other), 0.05 * std::abs(other));
}
