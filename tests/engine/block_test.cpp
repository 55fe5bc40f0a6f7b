// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Laws of the block as a whole, constrained planes included: one energy, of which the forces are
// the gradient; uniform strains exact; nothing gained or lost between levels.
//
// Tolerances: a force is a sum of some hundred terms k u with k below 6 eV/Å^2 times 2^level, so
// rounding leaves about 1e-15 times the largest k u; what depends on sums over all nodes gets
// sqrt(nodes) more.
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"

#include <gtest/gtest.h>

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
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
};
/// One level; two; levels of unequal height; six levels down to 2 x 2 nodes; an odd coarse level.
const std::vector<Shape> shapes = {{8, 5, 0},   {8, 7, 2},   {16, 23, 3},
                                   {32, 62, 2}, {12, 27, 3}, {24, 40, 4}};

void PrintTo(const Shape& s, std::ostream* out) {
    *out << s.sites << " sites, " << s.thickness << " layers, " << s.layers << " a level";
}

class BlockLaws : public testing::TestWithParam<Shape> {
protected:
    BlockOptions options =
        test::paper_block(GetParam().sites, GetParam().thickness, GetParam().layers);
};

double length(const Vector& v) { return std::sqrt(test::dot(v, v)); }

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
    std::vector<int> cells;
    for (const auto& p : level_shapes(test::paper_block(64, 124, 4)))
        cells.push_back(p.cells);
    EXPECT_EQ(cells, (std::vector<int>{4, 4, 4, 4, 4}));
    cells.clear();
    for (const auto& p : level_shapes(test::paper_block(512, 512, 4)))
        cells.push_back(p.cells);
    EXPECT_EQ(cells, (std::vector<int>{4, 4, 5, 4, 4, 4, 4})); // 4 + 8 + 20 + 32 + 64 + 128 + 256
}

TEST_P(BlockLaws, PatchTest) {
    // Every uniform displacement gradient, the nine one by one (so all strains and all rotations):
    // no force inside or where levels meet, and a^2 sigma e_z on each node of the free surface.
    Block block(options, Communicator(), test::serial_grid(options));
    std::vector<VectorField<double>> force;
    for (const auto& level : block.levels())
        force.emplace_back(level.tile, level.shape.cells);
    const double a = options.spacing, mu = options.shear_modulus(), lame = options.lame();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double gradient[3][3] = {};
            gradient[i][j] = 1e-2;
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
                            const double at[3] = {a * scale * x, a * scale * y,
                                                  a * (level.depth + scale * z)};
                            double u[3] = {0.3, -0.2, 0.1};
                            for (int p = 0; p < 3; ++p)
                                for (int q = 0; q < 3; ++q)
                                    u[p] += gradient[p][q] * at[q];
                            to.x(x, y, z) = u[0];
                            to.y(x, y, z) = u[1];
                            to.z(x, y, z) = u[2];
                            for (double c : u)
                                largest = std::max(largest, 6.0 * scale * std::abs(c));
                        }
            }
            block.interpolate();
            block.forces(force);
            double sigma[3] = {}; // sigma_xz, sigma_yz, sigma_zz
            const double trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
            for (int c = 0; c < 3; ++c)
                sigma[c] = mu * (gradient[c][2] + gradient[2][c]) + (c == 2 ? lame * trace : 0.0);
            const double rounding = 4e-15 * largest;
            for (std::size_t l = 0; l < force.size(); ++l)
                for (int z = 0; z < block.levels()[l].shape.cells; ++z)
                    for (int y = 0; y < block.levels()[l].tile.ny; ++y)
                        for (int x = 0; x < block.levels()[l].tile.nx; ++x) {
                            const double on = l == 0 && z == 0 ? a * a : 0.0;
                            const auto f = std::as_const(force[l]).view();
                            ASSERT_NEAR(f.x(x, y, z), on * sigma[0], rounding)
                                << i << j << " level " << l << " z " << z;
                            ASSERT_NEAR(f.y(x, y, z), on * sigma[1], rounding)
                                << i << j << " level " << l << " z " << z;
                            ASSERT_NEAR(f.z(x, y, z), on * sigma[2], rounding)
                                << i << j << " level " << l << " z " << z;
                        }
        }
}

TEST_P(BlockLaws, UniformModeHasTheStiffnessOfAColumn) {
    // Lowest layer lifted by w, top held: (lambda + 2 mu) / thickness per area.
    ElasticOperator k(options);
    const double height = options.thickness * options.spacing;
    const Vector u = k.tabulate([&](const Block::Level& level, int c, int z, int, int) {
        return c == 2 ? 1.0 - (level.depth + z * double(1 << level.shape.level)) / options.thickness
                      : 0.0;
    });
    k.set(u);
    const Vector f = k.force();
    const double area = std::pow(options.sites * options.spacing, 2);
    const double expected = (options.lame() + 2.0 * options.shear_modulus()) / height;
    EXPECT_NEAR(-test::dot(u, f) / area, expected, 1e-13 * expected);
    EXPECT_NEAR(2.0 * k.energy() / area, expected, 1e-13 * expected);
    EXPECT_NEAR(k.top_force()[2] / area, expected, 1e-12 * expected);
}

TEST_P(BlockLaws, ForceIsMinusTheGradientOfTheEnergy) {
    ElasticOperator k(options);
    // The energy is quadratic, so a central difference of any width is exact.
    for (unsigned seed : {1u, 2u, 3u}) {
        const Vector u = test::random_vector(k.size(), seed);
        Vector along = test::random_vector(k.size(), seed + 10);
        const double top = 0.3, top_along = seed == 3 ? 0.0 : 0.7;
        if (seed == 2) // only the planes next to the constrained ones move
            along = k.tabulate([&](const Block::Level& level, int c, int z, int y, int x) {
                const bool seam = (level.shape.level > 0 && z == 0) || z == level.shape.cells - 1;
                return seam ? std::sin(1.0 + c + 2.0 * x + 3.0 * y) : 0.0;
            });
        k.set(u, top);
        const Vector f = k.force();
        const double expected = -(test::dot(f, along) + k.top_force()[2] * top_along);
        const auto energy_at = [&](double s) {
            Vector moved = u;
            for (std::size_t i = 0; i < moved.size(); ++i)
                moved[i] += s * along[i];
            k.set(moved, top + s * top_along);
            return k.energy();
        };
        const double up = energy_at(1.0), down = energy_at(-1.0);
        EXPECT_NEAR(0.5 * (up - down), expected, 1e-13 * (up + down));
    }
}

TEST_P(BlockLaws, EnergyIsHalfOfForceTimesDisplacement) {
    ElasticOperator k(options);
    const Vector u = test::random_vector(k.size(), 4);
    k.set(u);
    const double energy = k.energy();
    EXPECT_GT(energy, 0.0);
    EXPECT_NEAR(-0.5 * test::dot(u, k.force()), energy, 1e-13 * energy);
}

TEST_P(BlockLaws, ResponseIsSymmetric) {
    ElasticOperator k(options);
    const Vector u = test::random_vector(k.size(), 5), v = test::random_vector(k.size(), 6);
    k.set(u);
    const Vector ku = k.force();
    k.set(v);
    const Vector kv = k.force();
    EXPECT_NEAR(test::dot(u, kv), test::dot(v, ku), 1e-14 * length(u) * length(kv));
}

TEST_P(BlockLaws, InternalForcesSumToZero) {
    ElasticOperator k(options);
    k.set(test::random_vector(k.size(), 7), 0.5);
    const Vector f = k.force();
    auto total = k.top_force();
    for (int c = 0; c < 3; ++c) {
        const Vector one = k.tabulate([&](const Block::Level&, int component, int, int, int) {
            return component == c ? 1.0 : 0.0;
        });
        EXPECT_NEAR(test::dot(f, one) + total[static_cast<std::size_t>(c)], 0.0,
                    1e-14 * length(f) * length(one));
    }
}

TEST_P(BlockLaws, MassIsThatOfTheAtoms) {
    // Thickness planes of full atoms move, the lowest a whole one instead of half: with half a
    // cell's mass on the top plane that makes (thickness + 1/2) N^2 atoms, however the levels are
    // cut.
    const Block block(options, Communicator(), test::serial_grid(options));
    double mass = 0.0;
    for (const auto& level : block.levels())
        for (int z = 0; z < level.shape.cells; ++z)
            mass += level.mass(z) * level.shape.sites * level.shape.sites;
    const auto& last = block.levels().back();
    mass += 0.5 * last.node_mass * last.shape.sites * last.shape.sites;
    const double atoms = (options.thickness + 0.5) * options.sites * options.sites;
    EXPECT_NEAR(mass, atoms * options.atom_mass, 1e-14 * mass);
}

TEST_P(BlockLaws, NoModeIsFasterThanTheBulk) {
    // The step's stability limit is taken from the bulk lattice; seams and surface must not exceed
    // it.
    ElasticOperator k(options);
    const Vector mass =
        k.tabulate([](const Block::Level& level, int, int z, int, int) { return level.mass(z); });
    Vector u = test::random_vector(k.size(), 8);
    double w2 = 0.0;
    for (int iteration = 0; iteration < 300; ++iteration) {
        k.set(u);
        const Vector f = k.force();
        double uu = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i)
            uu += u[i] * mass[i] * u[i];
        w2 = -test::dot(u, f) / uu; // Rayleigh quotient: never above the largest
        for (std::size_t i = 0; i < u.size(); ++i)
            u[i] = -f[i] / mass[i];
        const double norm = length(u);
        for (double& x : u)
            x /= norm;
    }
    EXPECT_LE(std::sqrt(w2), options.highest_frequency(0.0) * (1.0 + 1e-12));
    EXPECT_GE(std::sqrt(w2), 0.8 * options.highest_frequency(0.0)) << "the bound should be near";
}

TEST(BlockStep, IsTheForcesThenAKickThenADrift) {
    // In place, band behind band, on any number of threads: as if all forces had been kept first.
    // Levels large enough for several threads, a row more than whole bands, fewer bands than
    // threads.
    const StepParameters plan{7.0, 0.0, 0.0, 0.0, false};
    for (const Shape& shape : {Shape{64, 60, 4}, Shape{44, 9, 0}, Shape{41, 7, 0}}) {
        const BlockOptions options = test::paper_block(shape.sites, shape.thickness, shape.layers);
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
        const int usual = omp_get_max_threads();
        for (int threads : {1, 2, 3, 7}) {
            omp_set_num_threads(threads);
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
        omp_set_num_threads(usual);
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, BlockLaws, testing::ValuesIn(shapes));

namespace {

/// The largest eigenvalue of the bulk's dynamical matrix for a wave of phase q from atom to atom,
/// from the energy of a cell: springs between corners and the dilatation
/// (docs/explanation/model.md).
double largest_eigenvalue(const BlockOptions& o, const std::array<double, 3>& q) {
    using Complex = std::complex<double>;
    const double s = o.spacing, mu = o.shear_modulus(), lame = o.lame();
    double d[3][3] = {};
    const auto corner = [](int i) { return std::array{i & 1, i >> 1 & 1, i >> 2 & 1}; };
    const auto wave = [&](int i) {
        const auto at = corner(i);
        return std::polar(1.0, q[0] * at[0] + q[1] * at[1] + q[2] * at[2]);
    };
    std::array<Complex, 3> dilatation{};
    for (int i = 0; i < 8; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            dilatation[c] += (corner(i)[c] ? 1.0 : -1.0) * wave(i) / (4.0 * s);
        for (int j = 0; j < i; ++j) {
            std::array<double, 3> e{};
            double length2 = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                e[c] = corner(i)[c] - corner(j)[c];
                length2 += e[c] * e[c];
            }
            if (length2 > 2.0) continue; // no springs along the cell's diagonals
            const double stiffness = mu * s / (length2 < 1.5 ? 4.0 : 2.0);
            const double stretch = std::norm(wave(i) - wave(j));
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < 3; ++b)
                    d[a][b] += stiffness * stretch * e[a] * e[b] / length2;
        }
    }
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            d[a][b] +=
                (lame - mu) * s * s * s * std::real(std::conj(dilatation[a]) * dilatation[b]);
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
