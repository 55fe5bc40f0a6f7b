// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Laws that no table of values can check: a surface mirrored, turned by 90 degrees or shifted gives
// the same energies, along a path and relaxed; block and interface together have one energy, whose
// gradient the forces are; momentum changes by the forces alone. (Ripple of order dt^2, drift and
// time reversal: dynamics_test.cpp.)
//
// Symmetries are about a block site, (1/2, 1/2) a, which is a node of every level; a shift by whole
// cells of the coarsest level likewise. Two runs that mirror each other add the same numbers in
// another order: they differ by rounding, which a path in contact lets grow.
#include "support/cases.hpp"
#include "support/elastic_operator.hpp"
#include "support/levels_at_rest.hpp"

#include "engine/block/spectral_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

using namespace asperity;
using test::ElasticOperator;
using test::Vector;

namespace {

struct Symmetry {
    const char* name;
    /// Where the atom at (i, j) goes, up to multiples of N.
    std::function<std::array<int, 2>(int, int)> moved;
};

/// A shift by so many sites is one of a block whose coarsest cells divide it.
std::vector<Symmetry> symmetries(int shift) {
    return {
        {"mirrored in x",
         [](int i, int j) {
             return std::array{1 - i, j};
         }},
        {"mirrored in y",
         [](int i, int j) {
             return std::array{i, 1 - j};
         }},
        {"turned by 90 degrees",
         [](int i, int j) {
             return std::array{1 - j, i};
         }},
        {"x and y exchanged",
         [](int i, int j) {
             return std::array{j, i};
         }},
        {"shifted",
         [shift](int i, int j) {
             return std::array{i + shift, j + 3 * shift};
         }},
    };
}

Surface moved(const Surface& surface, const Symmetry& symmetry) {
    Surface s = surface;
    const int n = s.sites;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const auto [p, q] = symmetry.moved(i, j);
            s.height[static_cast<std::size_t>(periodic(q, n) * n + periodic(p, n))] =
                surface.height[static_cast<std::size_t>(j * n + i)];
        }
    return s;
}

struct Block16 {
    const char* name;
    int thickness, layers, coarsest; ///< layers a level (0: lattice); edge of the coarsest cells
    bool finite_strain;

    BlockOptions options() const {
        BlockOptions o = test::paper_block(16, thickness, layers);
        o.finite_strain = finite_strain;
        return o;
    }
};
constexpr std::array blocks = {Block16{"lattice", 6, 0, 1, false},
                               Block16{"multiscale", 14, 2, 4, false},
                               Block16{"lattice at finite strain", 6, 0, 1, true},
                               Block16{"multiscale at finite strain", 14, 2, 4, true}};

InterfaceOptions interface_with(InterfaceMethod method, bool tail) {
    InterfaceOptions o = test::paper_interface();
    o.method = method;
    o.tail = tail;
    return o;
}

/// Force and the three energies of some steps into contact.
std::vector<double> path(const Block16& block, const InterfaceOptions& interface,
                         const Surface& surface) {
    SimulationOptions options;
    options.block = block.options();
    options.interface = interface;
    options.drive.velocity = 1e-3;
    options.damping = 5e-4;
    Simulation s = test::simulation(options, surface);
    s.start(surface.statistics.highest + 3.3);
    std::vector<double> series;
    for (int n = 0; n < 160; ++n) {
        const StepRecord& now = s.step(true);
        series.insert(series.end(), {now.force, now.interface_energy, now.elastic_energy,
                                     now.kinetic_energy, static_cast<double>(now.in_contact)});
    }
    return series;
}

constexpr std::array methods = {std::pair{"lattice sweep", InterfaceMethod::lattice},
                                std::pair{"rows sweep", InterfaceMethod::rows}};

} // namespace

TEST(Symmetry, APathIsThatOfTheMovedSurface) {
    const Surface surface = test::reference_surface("c1_N16_T16_rms0.5");
    for (const Block16& block : blocks)
        for (const auto& [method_name, method] : methods) {
            const InterfaceOptions interface = interface_with(method, true);
            const auto one = path(block, interface, surface);
            double scale = 0.0;
            for (double v : one)
                scale = std::max(scale, std::abs(v));
            for (const Symmetry& symmetry : symmetries(block.coarsest)) {
                const auto other = path(block, interface, moved(surface, symmetry));
                double off = 0.0;
                for (std::size_t i = 0; i < one.size(); ++i)
                    off = std::max(off, std::abs(one[i] - other[i]));
                EXPECT_LT(off, 1e-11 * scale)
                    << block.name << ", " << method_name << ", " << symmetry.name;
                EXPECT_GT(one[one.size() - 3], 1.0) << "nothing is bent";
            }
        }
}

TEST(Symmetry, AShiftByLessThanACoarseCellIsNone) {
    // What the test above rests on: a coarse block does know where its nodes are.
    const Surface surface = test::reference_surface("c1_N16_T16_rms0.5");
    const InterfaceOptions interface = interface_with(InterfaceMethod::lattice, false);
    const auto one = path(blocks[1], interface, surface);
    const auto other = path(blocks[1], interface, moved(surface, symmetries(1)[4]));
    EXPECT_GT(std::abs(one.back() - other.back()) +
                  std::abs(one[one.size() - 3] - other[one.size() - 3]),
              1e-6);
}

TEST(Symmetry, ARelaxedStateIsThatOfTheMovedSurface) {
    // Residual forces of 1e-6 eV/Å leave some 1e-12 of the energy.
    const Surface surface = test::reference_surface("c2_N16_T8_rms1.5");
    const InterfaceOptions interface = interface_with(InterfaceMethod::automatic, false);
    for (const Block16& block : blocks) {
        const BlockOptions options = block.options();
        const auto one = test::relax_levels(options, interface, surface, 1e-6);
        ASSERT_TRUE(one.state.converged);
        for (const Symmetry& symmetry : symmetries(block.coarsest)) {
            const auto other =
                test::relax_levels(options, interface, moved(surface, symmetry), 1e-6);
            EXPECT_NEAR(other.binding_energy, one.binding_energy, 1e-9 * one.binding_energy)
                << block.name << ", " << symmetry.name;
            EXPECT_EQ(other.state.in_contact, one.state.in_contact);
        }
    }
    const BlockOptions options = test::paper_block(16, 8, 0);
    const auto one = test::relax_spectral(options, interface, surface, 1e-6);
    ASSERT_TRUE(one.state.converged);
    for (const Symmetry& symmetry : symmetries(1)) {
        const auto other = test::relax_spectral(options, interface, moved(surface, symmetry), 1e-6);
        EXPECT_NEAR(other.binding_energy, one.binding_energy, 1e-9 * one.binding_energy)
            << "spectral, " << symmetry.name;
        EXPECT_EQ(other.state.in_contact, one.state.in_contact);
    }
}

TEST(Symmetry, AFlatContactStaysFlat) {
    // Nothing distinguishes one site from another: all move alike, and none sideways. Waves grow
    // out of rounding only.
    for (const Block16& block : blocks)
        for (const auto& [method_name, method] : methods) {
            SimulationOptions options;
            options.block = block.options();
            options.interface = interface_with(method, true);
            options.drive.velocity = 1e-3;
            Simulation s = test::simulation(options, test::flat_surface(16));
            s.start(4.5);
            for (int n = 0; n < 200; ++n)
                s.step(false);
            double least = 1e300, most = -1e300, sideways = 0.0;
            const auto u = s.block().lowest_layer();
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) {
                    least = std::min(least, u.z(x, y)), most = std::max(most, u.z(x, y));
                    sideways = std::max({sideways, std::abs(u.x(x, y)), std::abs(u.y(x, y))});
                }
            EXPECT_GT(std::abs(most), 0.1) << "nothing moved";
            EXPECT_LT(most - least, 1e-10) << block.name << ", " << method_name;
            EXPECT_LT(sideways, 1e-10) << block.name << ", " << method_name;
        }
}

namespace {

/// A central difference over h along a direction of length one: of order h^2, and rounding 1e-16 U
/// / h.
constexpr double h = 1e-4;

} // namespace

TEST(Gradient, BlockAndInterfaceHaveOneEnergy) {
    // Random states in the attraction and in the wall. Every sweep, with and without its tail, over
    // every block; energy and forces as a step and a relaxation take them. Along a random
    // direction, and along a lift of the lowest layer, which the tail feels most; a short cutoff
    // leaves it much.
    const Surface surface = test::reference_surface("c1_N16_T16_rms0.5");
    for (const Block16& block : blocks)
        for (auto method :
             {InterfaceMethod::reference, InterfaceMethod::lattice, InterfaceMethod::rows})
            for (bool tail : {false, true})
                for (double height : {3.4, 4.6})
                    for (bool lift : {false, true}) {
                        ElasticOperator k(block.options());
                        InterfaceOptions options = interface_with(method, tail);
                        test::lennard_jones(options).cutoff = 2.5 * test::lennard_jones(options).r0;
                        const Interface interface(surface, k.block().grid().tile(0), 2.6, options);
                        Vector u = test::random_vector(k.size(), 21);
                        for (double& x : u)
                            x *= 0.15;
                        Vector along = test::random_vector(k.size(), 22);
                        if (lift)
                            along =
                                k.tabulate([](const Block::Level& level, int c, int z, int, int) {
                                    return level.shape.level == 0 && z == 0 && c == 2 ? 1.0 : 0.0;
                                });
                        const double norm = std::sqrt(test::dot(along, along));
                        for (double& x : along)
                            x /= norm;
                        const auto energy = [&](double s) {
                            Vector at = u;
                            for (std::size_t i = 0; i < u.size(); ++i)
                                at[i] += s * along[i];
                            k.set(at);
                            return k.energy() +
                                   interface
                                       .sweep(k.block().lowest_layer(), k.block().interface_force(),
                                              height, {.observe = true})
                                       .energy.value();
                        };
                        const double slope = (energy(h) - energy(-h)) / (2.0 * h);
                        energy(
                            0.0); // leaves the interface's forces where the block takes them from
                        const double power = test::dot(k.force(), along);
                        EXPECT_GT(std::abs(power), 0.01);
                        EXPECT_NEAR(power, -slope, 2e-6 * (1.0 + std::abs(power)))
                            << block.name << " method " << static_cast<int>(method) << " tail "
                            << tail << " height " << height << " lift " << lift;
                    }
}

TEST(Gradient, TheSpectralBlockAndInterfaceHaveOneEnergy) {
    // A held mean height is left out: along anything but the uniform wave, which stays where it is.
    const Surface surface = test::reference_surface("c1_N16_T16_rms0.5");
    for (auto method : {InterfaceMethod::lattice, InterfaceMethod::rows})
        for (bool tail : {false, true})
            for (const Constraint& constraint :
                 {Constraint{}, Constraint::top(0.2), Constraint::mean_height(-0.3)})
                for (bool frictionless : {false, true}) {
                    SCOPED_TRACE("method " + std::to_string(static_cast<int>(method)) + " tail " +
                                 std::to_string(tail) + " held " +
                                 std::to_string(static_cast<int>(constraint.of)) +
                                 " frictionless " + std::to_string(frictionless));
                    SpectralBlock block(test::paper_block(16, 8, 0), Communicator(), frictionless);
                    const Interface interface(surface, block.tile(), 2.6,
                                              interface_with(method, tail));
                    std::mt19937_64 random(5);
                    const auto start = test::random_displacement(block, random, 0.1);
                    auto along = test::random_displacement(block, random, 1.0);
                    block.displace(1.0, start.waves, start.sites);
                    block.constrain(constraint);
                    const bool held = constraint.of == Constraint::Of::mean_height;
                    if (held) {
                        block.apply_constraint();
                        const float mean =
                            std::exchange(along.waves.row(block.components() - 1, 0)[0], 0.0f);
                        for (int y = 0; y < 16; ++y)
                            for (int x = 0; x < 16; ++x)
                                along.sites.back().plane(0)(x, y) -= mean;
                    }
                    auto g = block.new_waves<double>();
                    const auto energy = [&] {
                        return block.elastic_energy() +
                               interface
                                   .sweep(block.lowest_layer(), block.interface_force(), 3.7,
                                          {.observe = true})
                                   .energy.value();
                    };
                    const double step = h / 16.0; // the direction has a length of about 28
                    energy();
                    block.gradient(g);
                    const double slope = dot(g, along.waves);
                    block.displace(step, along.waves, along.sites);
                    const double above = energy();
                    if (held) {
                        EXPECT_EQ(g.row(block.components() - 1, 0)[0], 0.0);
                        EXPECT_NEAR(block.mean_height(), -0.3, 1e-15);
                        double sum = 0.0;
                        const auto z = block.lowest_layer().z;
                        for (int y = 0; y < 16; ++y)
                            for (int x = 0; x < 16; ++x)
                                sum += z(x, y);
                        EXPECT_NEAR(sum / 256.0, -0.3, 1e-11);
                    }
                    block.displace(-2.0 * step, along.waves, along.sites);
                    const double below = energy();
                    EXPECT_GT(std::abs(slope), 0.01);
                    EXPECT_NEAR(slope, (above - below) / (2.0 * step),
                                2e-6 * (10.0 + std::abs(slope)));
                }
}

TEST(Momentum, ChangesByTheForcesAlone) {
    // Over one step, in all three directions: substrate, rigid top plane and, where there is
    // damping, the medium. The drag is that of the mean velocity against the medium's.
    for (const Block16& block : blocks)
        for (double damping : {0.0, 2e-3})
            for (bool tail : {false, true}) {
                SimulationOptions options;
                options.block = block.options();
                options.interface = interface_with(InterfaceMethod::automatic, tail);
                options.drive.velocity = 5e-4;
                options.damping = damping;
                Simulation s =
                    test::simulation(options, test::reference_surface("c2_N16_T8_rms1.5"));
                s.start(6.0);
                const auto momentum = [&] {
                    std::array<double, 3> sum{};
                    for (const auto& level : s.block().levels())
                        for (int z = 0; z < level.shape.cells; ++z)
                            for (int y = 0; y < level.tile.ny; ++y)
                                for (int x = 0; x < level.tile.nx; ++x) {
                                    const auto v = level.v.view();
                                    sum[0] += level.mass(z) * v.x(x, y, z);
                                    sum[1] += level.mass(z) * v.y(x, y, z);
                                    sum[2] += level.mass(z) * v.z(x, y, z);
                                }
                    return sum;
                };
                double mass = 0.0;
                for (const auto& level : s.block().levels())
                    for (int z = 0; z < level.shape.cells; ++z)
                        mass += level.mass(z) * level.shape.sites * level.shape.sites;
                for (int n = 0; n < 150; ++n)
                    s.step(false);
                const auto before = momentum();
                s.step(false);
                const auto after = momentum();
                const auto from_below = s.block().levels().front().transferred.plane(0);
                const auto at_top = s.block().levels().back().upper_force.plane(0);
                std::array<double, 3> force{};
                for (int y = 0; y < from_below.x.ny; ++y)
                    for (int x = 0; x < from_below.x.nx; ++x) {
                        force[0] += from_below.x(x, y);
                        force[1] += from_below.y(x, y);
                        force[2] += from_below.z(x, y);
                    }
                for (int y = 0; y < at_top.x.ny; ++y)
                    for (int x = 0; x < at_top.x.nx; ++x) {
                        force[0] -= at_top.x(x, y);
                        force[1] -= at_top.y(x, y);
                        force[2] -= at_top.z(x, y);
                    }
                EXPECT_NEAR(force[2], s.now().force - s.now().top_force,
                            1e-10 * (1.0 + std::abs(force[2])));
                for (std::size_t c = 0; c < 3; ++c) {
                    const double medium = c == 2 ? -options.drive.velocity * mass : 0.0;
                    const double drag = damping * (0.5 * (before[c] + after[c]) - medium);
                    const double given = options.dt * (force[c] - drag);
                    EXPECT_NEAR(after[c] - before[c], given, 1e-10 * std::abs(before[2]))
                        << block.name << " direction " << c << " damping " << damping;
                }
                EXPECT_GT(std::abs(options.dt * force[2]), 1.0);
            }
}
