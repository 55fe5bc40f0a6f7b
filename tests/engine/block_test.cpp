// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Laws of the block as a whole at small and finite strain, constrained planes included: one energy,
// of which the forces are the gradient (so that the response is symmetric and a linear block's
// energy half of force times displacement); uniform strains exact; nothing gained or lost between
// levels.
//
// Tolerances: a force is a sum of some hundred terms k u with k below 6 eV/Å^2 times 2^level, so
// rounding leaves about 1e-15 times the largest k u; what depends on sums over all nodes gets
// sqrt(nodes) more.
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"
#include "support/nodes.hpp"
#include "support/spectral_lattice.hpp"
#include "support/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

using namespace asperity;
using test::ElasticOperator;
using test::Vector;

namespace {

struct Shape {
    int sites, thickness, layers; ///< layers a level; 0: lattice
    bool finite = false;          ///< strain
    BlockOptions options() const {
        BlockOptions o = test::paper_block(sites, thickness, layers);
        o.finite_strain = finite;
        return o;
    }
};
/// One level; two; levels of unequal height; six levels down to 2 x 2 nodes; an odd coarse level; a
/// thickness of 4096.
const std::vector<Shape> shapes = {{8, 5, 0},         {8, 7, 2},        {16, 23, 3},
                                   {32, 62, 2},       {12, 27, 3},      {24, 40, 4},
                                   {8, 4096, 2},      {8, 5, 0, true},  {16, 23, 3, true},
                                   {32, 62, 2, true}, {12, 27, 3, true}};

void PrintTo(const Shape& s, std::ostream* out) {
    *out << s.sites << " sites, " << s.thickness << " layers, " << s.layers << " a level"
         << (s.finite ? ", finite strain" : "");
}

class BlockLaws : public testing::TestWithParam<Shape> {
protected:
    BlockOptions options = GetParam().options();
};

using Matrix = std::array<std::array<double, 3>, 3>;

std::array<double, 3> apply(const Matrix& m, const std::array<double, 3>& v) {
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            result[i] += m[i][j] * v[j];
    return result;
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k)
                result[i][j] += a[i][k] * b[k][j];
    return result;
}

/// About an axis of any length (Rodrigues).
Matrix rotation(const std::array<double, 3>& axis, double degrees) {
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    const double x = axis[0] / length, y = axis[1] / length, z = axis[2] / length;
    const double angle = degrees * std::numbers::pi / 180.0;
    const double c = std::cos(angle), s = std::sin(angle), d = 1.0 - c;
    return {{{c + d * x * x, d * x * y - s * z, d * x * z + s * y},
             {d * x * y + s * z, c + d * y * y, d * y * z - s * x},
             {d * x * z - s * y, d * y * z + s * x, c + d * z * z}}};
}

double length(const Vector& v) { return std::sqrt(test::dot(v, v)); }

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
                const auto r = apply(F, {double(x), double(y), double(z)});
                const double stretch = std::hypot(r[0], r[1], r[2]) - std::sqrt(double(square));
                sum += 0.25 * mu * stretch * stretch; // each direction is met twice
            }
    const double det = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
                       F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                       F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
    return sum + 0.5 * (o.lame() - mu) * (det - 1) * (det - 1);
}

/// The same of small strain: springs feel what F adds along them, the volume the trace.
double linear_energy_density(const BlockOptions& o, Matrix F) {
    double sum = 0.0, trace = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        trace += F[i][i] -= 1.0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            sum += 0.25 * o.shear_modulus() * (F[i][j] + F[j][i]) * (F[i][j] + F[j][i]);
    return sum + 0.5 * o.lame() * trace * trace;
}

/// Nominal traction on planes of constant z, dW/dF_iz, eV/Å^3.
double traction(const BlockOptions& o, Matrix F, std::size_t i) {
    const double at = F[i][2], h = 1e-3;
    const auto energy = [&](double d) {
        F[i][2] = at + d;
        return o.finite_strain ? energy_density(o, F) : linear_energy_density(o, F);
    };
    const auto slope = [&](double d) { return (energy(d) - energy(-d)) / (2 * d); };
    return (4.0 * slope(h) - slope(2 * h)) / 3.0;
}

} // namespace

TEST(PlanLevels, FillTheThicknessExactly) {
    for (int layers : {1, 2, 3, 4, 6, 8})
        for (int thickness = 1; thickness < 200; ++thickness)
            for (int sites : {8, 12, 32, 100, 512}) {
                BlockOptions options = test::paper_block(sites, thickness, layers);
                const auto plan = level_shapes(options);
                int sum = 0;
                for (std::size_t l = 0; l < plan.size(); ++l) {
                    ASSERT_EQ(plan[l].level, static_cast<int>(l));
                    ASSERT_EQ(plan[l].sites << l, sites);
                    const bool last = l + 1 == plan.size();
                    ASSERT_GE(plan[l].cells, plan.size() > 1 ? layers : 1);
                    ASSERT_LE(plan[l].cells, last ? thickness : layers + 1);
                    sum += plan[l].cells << l;
                }
                ASSERT_EQ(sum, thickness) << layers << " layers a level, " << sites << " sites";
                // It goes on coarsening while both box and thickness allow.
                ASSERT_TRUE(plan.back().sites % 2 || plan.back().cells < 3 * layers + 2);
                options.multiscale = false;
                ASSERT_EQ(level_shapes(options).size(), 1u);
            }
}

TEST(PlanLevels, TheSizesOfTheReference) {
    const auto cells = [](int sites, int thickness) {
        std::vector<int> all;
        for (const auto& p : level_shapes(test::paper_block(sites, thickness, 4)))
            all.push_back(p.cells);
        return all;
    };
    EXPECT_EQ(cells(64, 124), (std::vector<int>{4, 4, 4, 4, 4}));
    EXPECT_EQ(cells(512, 512), (std::vector<int>{4, 4, 5, 4, 4, 4, 4})); // 4 + 8 + 20 + 32 + ...
}

TEST_P(BlockLaws, PatchTest) {
    // Uniform deformations. Small strain: every displacement gradient, the nine one by one (so all
    // strains and all rotations); finite: large ones, turned and both, and a rotation alone. No
    // force inside or where levels meet, and the nominal traction on each node of the free surface.
    Block block(options, Communicator(), test::serial_grid(options));
    std::vector<VectorField<double>> force;
    for (const auto& level : block.levels())
        force.emplace_back(level.tile, level.shape.cells);
    const double a = options.spacing;
    const Matrix stretch = {{{1.05, 0.02, 0.1}, {0.0, 0.97, -0.05}, {0.03, 0.0, 0.9}}};
    const Matrix turn = rotation({1.0, 2.0, -0.5}, 25.0);
    std::vector<Matrix> gradients = {stretch, turn, product(turn, stretch)};
    if (!options.finite_strain) {
        gradients.assign(9, rotation({0.0, 0.0, 1.0}, 0.0));
        for (std::size_t k = 0; k < 9; ++k)
            gradients[k][k / 3][k % 3] += 1e-2;
    }
    for (const Matrix& F : gradients) {
        double largest = 0.0; // k u
        for (const auto& level : block.levels()) {
            const auto to = block.fields(level).u.view();
            const int scale = 1 << level.shape.level;
            // Moving planes with their halos: an affine field does not fit the periodic box, so
            // nothing is exchanged. The last plane of all is the clamped top.
            const bool last = &level == &block.levels().back();
            for (int z = 0; z < level.shape.cells + (last ? 1 : 0); ++z)
                for (int y = -halo_width; y < level.tile.ny + halo_width; ++y)
                    for (int x = -halo_width; x < level.tile.nx + halo_width; ++x) {
                        const std::array<double, 3> at = {a * scale * x, a * scale * y,
                                                          a * (level.depth + scale * z)};
                        const auto moved = apply(F, at);
                        to.x(x, y, z) = moved[0] - at[0] + 0.3;
                        to.y(x, y, z) = moved[1] - at[1] - 0.2;
                        to.z(x, y, z) = moved[2] - at[2] + 0.1;
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
                        const auto f = test::components(force[l].view(), x, y, z);
                        // The traction is a numerical derivative, good to 1e-11.
                        for (std::size_t i = 0; i < 3; ++i)
                            ASSERT_NEAR(*f[i], on * pull[i], rounding + on * 1e-10) << l << z;
                    }
    }
}

TEST_P(BlockLaws, ForceIsMinusTheGradientOfTheEnergy) {
    ElasticOperator k(options);
    // Small strain: the energy is quadratic, so a central difference of any width is exact. Finite:
    // of two widths, what is left is of fourth order.
    const bool finite = options.finite_strain;
    const double h = finite ? 2e-3 : 1.0;
    for (unsigned seed : {1u, 2u, 3u}) {
        Vector u = test::random_vector(k.size(), seed);
        if (finite)
            for (double& x : u)
                x *= 0.3;
        Vector along = test::random_vector(k.size(), seed + 10);
        const double top = 0.3, top_along = seed == 3 ? 0.0 : 0.7;
        if (seed == 2) // only the planes next to the constrained ones move
            along = k.tabulate([&](const Block::Level& level, int c, int z, int y, int x) {
                const bool seam = (level.shape.level > 0 && z == 0) || z == level.shape.cells - 1;
                return seam ? std::sin(1.0 + c + 2.0 * x + 3.0 * y) : 0.0;
            });
        double highest = 0.0;
        const auto energy_at = [&](double s) {
            Vector moved = u;
            for (std::size_t i = 0; i < moved.size(); ++i)
                moved[i] += s * along[i];
            k.set(moved, top + s * top_along);
            highest = std::max(highest, k.energy());
            return k.energy();
        };
        const auto slope = [&](double d) { return (energy_at(d) - energy_at(-d)) / (2 * d); };
        const double gradient = finite ? (4.0 * slope(h) - slope(2 * h)) / 3.0 : slope(h);
        energy_at(0.0);
        const double expected = -(test::dot(k.force(), along) + k.top_force()[2] * top_along);
        EXPECT_NEAR(gradient, expected, (finite ? 1e-10 : 2e-13) * highest);
    }
}

TEST_P(BlockLaws, MassIsThatOfTheAtoms) {
    // Thickness planes of full atoms move, the lowest a whole one instead of half: with half a
    // cell's mass on the top plane that makes (thickness + 1/2) N^2 atoms, however the levels are
    // cut.
    const Block block(options, Communicator(), test::serial_grid(options));
    double mass = 0.0;
    test::each_node(block, [&](const Block::Level& l, int, int, int z) { mass += l.mass(z); });
    const auto& last = block.levels().back();
    mass += 0.5 * last.node_mass * last.shape.sites * last.shape.sites;
    const double atoms = (options.thickness + 0.5) * options.sites * options.sites;
    EXPECT_NEAR(mass, atoms * options.atom_mass, 1e-14 * mass);
}

TEST_P(BlockLaws, EnergyIsPositiveAndNoModeIsFasterThanTheBulk) {
    // The step's stability limit is taken from the bulk lattice; seams and surface must not exceed
    // it, at any of Poisson's ratios. At finite strain: of displacements of up to 1e-6 Å.
    const double small = options.finite_strain ? 1e-6 : 1.0;
    const double paper = options.poisson;
    for (double poisson : {-0.9, -0.5, 0.0, 0.25, paper, 0.49, 0.4999}) {
        options.poisson = poisson;
        ElasticOperator k(options);
        const Vector mass = k.tabulate(
            [](const Block::Level& level, int, int z, int, int) { return level.mass(z); });
        Vector u = test::random_vector(k.size(), 8);
        for (double& x : u)
            x *= small;
        double w2 = 0.0, least = 1e300; // Rayleigh quotients: never above the largest
        for (int iteration = 0; iteration < (poisson == paper ? 300 : 60); ++iteration) {
            k.set(u);
            const Vector f = k.force();
            double uu = 0.0;
            for (std::size_t i = 0; i < u.size(); ++i)
                uu += u[i] * mass[i] * u[i];
            w2 = -test::dot(u, f) / uu;
            least = std::min(least, w2);
            const double norm = length(f);
            for (std::size_t i = 0; i < u.size(); ++i)
                u[i] = -small * f[i] / mass[i] * mass[0] / norm;
        }
        EXPECT_GT(least, 0.0) << poisson;
        EXPECT_LE(std::sqrt(w2),
                  options.highest_frequency(0.0) * (1.0 + 1e-12 * std::pow(small, -1.0)))
            << poisson;
        if (poisson == paper) {
            EXPECT_GE(std::sqrt(w2), 0.8 * options.highest_frequency(0.0)) << "should be near";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, BlockLaws, testing::ValuesIn(shapes));

TEST(BlockStep, IsTheForcesThenAKickThenADrift) {
    // In place, band behind band, on any number of threads: as if all forces had been kept first.
    // Levels large enough for several threads, a row more than whole bands, fewer bands than
    // threads.
    const StepParameters plan{7.0, 0.0, 0.0, 0.0, false};
    for (const Shape& shape : {Shape{64, 60, 4}, Shape{44, 9, 0}, Shape{41, 7, 0}}) {
        const BlockOptions options = shape.options();
        Block start(options, Communicator(), test::serial_grid(options));
        std::mt19937_64 random(5);
        std::uniform_real_distribution<double> uniform(-0.1, 0.1);
        const auto fill = [&](VectorField<double>& field, int planes) {
            for (auto* f : {&field.x, &field.y, &field.z})
                for (int z = 0; z < planes; ++z)
                    for (int y = 0; y < f->view().ny; ++y)
                        for (int x = 0; x < f->view().nx; ++x)
                            f->view()(x, y, z) = uniform(random);
        };
        std::vector<VectorField<double>> force, speed;
        for (const auto& level : start.levels()) {
            fill(start.fields(level).u, level.shape.cells);
            force.emplace_back(level.tile, level.shape.cells);
            fill(speed.emplace_back(level.tile, level.shape.cells), level.shape.cells);
        }
        start.set_top(0.05);
        start.exchange();
        start.interpolate();
        start.forces(force);
        for (int threads : {1, 2, 3, 7}) {
            const test::Threads own(threads);
            Block block(options, Communicator(), test::serial_grid(options));
            for (std::size_t l = 0; l < speed.size(); ++l) {
                const Block::Fields fields = block.fields(block.levels()[l]);
                fields.u.copy_from(start.levels()[l].u);
                fields.v.copy_from(speed[l]);
            }
            KickSums sums;
            block.advance(plan, sums);
            for (std::size_t l = 0; l < speed.size(); ++l)
                for (auto c :
                     {&VectorField<double>::x, &VectorField<double>::y, &VectorField<double>::z}) {
                    const auto& before = start.levels()[l];
                    const auto& after = block.levels()[l];
                    const auto f = (force[l].*c).view(), v = (speed[l].*c).view();
                    for (int z = 0; z < before.shape.cells; ++z)
                        for (int y = 0; y < before.tile.ny; ++y)
                            for (int x = 0; x < before.tile.nx; ++x) {
                                const double w = v(x, y, z) + plan.dt / before.mass(z) * f(x, y, z);
                                const double u = (before.u.*c).view()(x, y, z) + plan.dt * w;
                                ASSERT_NEAR((after.v.*c).view()(x, y, z), w, 1e-16)
                                    << threads << " threads, level " << l << ", " << x << ' ' << y
                                    << ' ' << z;
                                ASSERT_NEAR((after.u.*c).view()(x, y, z), u, 1e-15)
                                    << threads << " threads, level " << l << ", " << x << ' ' << y
                                    << ' ' << z;
                            }
                }
        }
    }
}

namespace {

/// The largest eigenvalue of the bulk's dynamical matrix for a wave of phase q from atom to atom,
/// from the energy of a cell.
double largest_eigenvalue(const BlockOptions& o, const std::array<double, 3>& q) {
    const test::CellStiffness cell = test::cell_stiffness(o.spacing, o.lame(), o.shear_modulus());
    double d[3][3] = {};
    const auto phase = [&](std::size_t p) {
        return q[0] * double(p & 1u) + q[1] * double(p >> 1 & 1u) + q[2] * double(p >> 2 & 1u);
    };
    for (std::size_t i = 0; i < 24; ++i)
        for (std::size_t j = 0; j < 24; ++j)
            d[i % 3][j % 3] += cell[i][j] * std::cos(phase(j / 3) - phase(i / 3));
    // Jacobi's rotations.
    for (int round = 0; round < 12; ++round)
        for (const auto& [i, j] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
            if (d[i][j] == 0.0) continue;
            const double angle = 0.5 * std::atan2(2.0 * d[i][j], d[j][j] - d[i][i]);
            const double c = std::cos(angle), n = std::sin(angle);
            for (int k = 0; k < 3; ++k) {
                const double x = d[k][i], y = d[k][j];
                d[k][i] = c * x - n * y, d[k][j] = n * x + c * y;
            }
            for (int k = 0; k < 3; ++k) {
                const double x = d[i][k], y = d[j][k];
                d[i][k] = c * x - n * y, d[j][k] = n * x + c * y;
            }
        }
    return std::max({d[0][0], d[1][1], d[2][2]});
}

} // namespace

TEST(BlockFrequency, NoWaveOfTheZoneIsHigherAndOneIsAsHigh) {
    const double pi = std::numbers::pi;
    for (const double poisson : {-0.99, -0.7, -0.5, -0.2, 0.0, 0.1, 0.11, 0.12, 0.125, 0.13, 0.2,
                                 0.25, 0.3, 0.42, 0.49, 0.4999}) {
        BlockOptions o = test::paper_block(8, 8, 0);
        o.poisson = poisson;
        const double bound = std::pow(o.highest_frequency(0.0), 2) * o.atom_mass;
        double highest = 0.0;
        std::array<double, 3> at{};
        const auto look = [&](const std::array<double, 3>& q) {
            const double here = largest_eigenvalue(o, q);
            if (here > highest) highest = here, at = q;
        };
        constexpr int mesh = 30;
        for (int i = 0; i <= mesh; ++i)
            for (int j = 0; j <= i; ++j)
                for (int k = 0; k <= j; ++k)
                    look({pi * i / mesh, pi * j / mesh, pi * k / mesh});
        for (double step = pi / mesh; step > 1e-6; step *= 0.5) { // and around the best of them
            const std::array<double, 3> best = at;
            for (int i = -1; i <= 1; ++i)
                for (int j = -1; j <= 1; ++j)
                    for (int k = -1; k <= 1; ++k)
                        look({best[0] + i * step, best[1] + j * step, best[2] + k * step});
        }
        EXPECT_LE(highest, bound * (1.0 + 1e-13)) << poisson;
        EXPECT_GE(highest, bound * (1.0 - 1e-10)) << poisson;
    }
}

TEST(BlockFrequency, HighestOfTheBulk) {
    // 0.02503096 / fs at (pi/a)(1,0,0): the largest eigenvalue of the independent code's dynamical
    // matrix over the Brillouin zone, whose 24-point mesh holds that point.
    EXPECT_NEAR(test::paper_block(512, 512, 4).highest_frequency(0.0), 0.02503095958873518, 1e-7);
    const BlockOptions o = test::paper_block(8, 8, 0);
    EXPECT_NEAR(std::pow(o.highest_frequency(2.2), 2) - std::pow(o.highest_frequency(0.0), 2),
                2.2 / o.atom_mass, 1e-12);
}

TEST(BlockModuli, OfThePaper) {
    // docs/explanation/model.md, in GPa.
    const BlockOptions o = test::paper_block(8, 8, 0);
    const double gpa = 160.21766208;
    EXPECT_NEAR(o.lame() * gpa, 142.711, 5e-4);
    EXPECT_NEAR(o.shear_modulus() * gpa, 27.1831, 5e-5);
    EXPECT_NEAR(o.contact_modulus() * gpa, 93.7348, 5e-5);
    EXPECT_NEAR(o.elasticity(0).k, 0.4411253, 1e-7);
    EXPECT_NEAR(o.elasticity(3).k, 8 * o.elasticity(0).k, 1e-15);
}
