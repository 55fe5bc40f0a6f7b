// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Laws that no table of values can check: a surface mirrored, turned by 90 degrees or shifted gives
// the same energies along a path; spectral block and interface together have one energy, whose
// gradient the forces are (of the levels and the sweeps: engine/block_test, engine/interface_test,
// and together the ripple of order dt^2 in dynamics_test); momentum changes by the forces alone.
//
// Symmetries are about a block site, (1/2, 1/2) a, which is a node of every level; a shift by whole
// cells of the coarsest level likewise. Two runs that mirror each other add the same numbers in
// another order: they differ by rounding, which a path in contact lets grow.
#include "support/cases.hpp"
#include "support/nodes.hpp"

#include "engine/waves/spectral_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

using namespace asperity;

namespace {

struct Symmetry {
    const char* name;
    int turn[2][2], shift[2]; ///< the atom at (i, j) goes to turn (i, j) + shift, modulo N
};

/// A shift by so many sites is one of a block whose coarsest cells divide it.
std::vector<Symmetry> symmetries(int shift) {
    return {{"mirrored in x", {{-1, 0}, {0, 1}}, {1, 0}},
            {"mirrored in y", {{1, 0}, {0, -1}}, {0, 1}},
            {"turned by 90 degrees", {{0, -1}, {1, 0}}, {1, 0}},
            {"x and y exchanged", {{0, 1}, {1, 0}}, {0, 0}},
            {"shifted", {{1, 0}, {0, 1}}, {shift, 3 * shift}}};
}

Surface moved(const Surface& surface, const Symmetry& symmetry) {
    Surface s = surface;
    const int n = s.sites;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const auto& [name, turn, shift] = symmetry;
            const int p = turn[0][0] * i + turn[0][1] * j + shift[0];
            const int q = turn[1][0] * i + turn[1][1] * j + shift[1];
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
    test::Driven s = test::simulation(options, surface);
    s.start(surface.statistics.highest + 3.3);
    std::vector<double> series;
    for (int n = 0; n < 160; ++n) {
        const StepRecord& now = s.step(true);
        series.insert(series.end(), {now.force, now[Term::interface], now[Term::elastic],
                                     now[Term::kinetic], static_cast<double>(now.in_contact)});
    }
    return series;
}

double sum_of(const PlaneView<const double>& plane) {
    const std::vector<double> all = test::values_of(plane);
    return std::accumulate(all.begin(), all.end(), 0.0);
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
            for (const Symmetry& symmetry : symmetries(block.coarsest)) {
                const auto other = path(block, interface, moved(surface, symmetry));
                EXPECT_LT(test::largest_difference(one, other), 1e-11 * test::largest_of(one))
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
                            std::exchange(along.waves.uniform(block.components() - 1), 0.0f);
                        for (int y = 0; y < 16; ++y)
                            for (int x = 0; x < 16; ++x)
                                along.sites.back().plane(0)(x, y) -= mean;
                    }
                    auto g = block.new_waves<double>();
                    const auto energy = [&] {
                        return block.energies()[Term::elastic] +
                               interface
                                   .sweep(block.lowest_layer(), block.interface_force(),
                                          {.observe = true, .height = 3.7})
                                   .energy.value();
                    };
                    // A central difference: of order h^2, and rounding 1e-16 U / h.
                    const double step = 1e-4 / 16.0; // the direction has a length of about 28
                    energy();
                    block.gradient(g);
                    const double slope = dot(g, along.waves);
                    block.displace(step, along.waves, along.sites);
                    const double above = energy();
                    if (held) {
                        EXPECT_EQ(g.uniform(block.components() - 1), 0.0);
                        EXPECT_NEAR(block.mean_height(), -0.3, 1e-15);
                        EXPECT_NEAR(sum_of(block.lowest_layer().z) / 256.0, -0.3, 1e-11);
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
                test::Driven s =
                    test::simulation(options, test::reference_surface("c2_N16_T8_rms1.5"));
                s.start(6.0);
                double mass = 0.0;
                const auto momentum = [&] {
                    std::array<double, 3> sum{};
                    mass = 0.0;
                    test::each_node(s.block(), [&](const Block::Level& l, int x, int y, int z) {
                        mass += l.mass(z);
                        const auto v = test::components(l.v.view(), x, y, z);
                        for (std::size_t c = 0; c < 3; ++c)
                            sum[c] += l.mass(z) * *v[c];
                    });
                    return sum;
                };
                for (int n = 0; n < 150; ++n)
                    s.step(false);
                const auto before = momentum();
                s.step(false);
                const auto after = momentum();
                const auto from_below = s.block().levels().front().transferred.plane(0);
                const auto at_top = s.block().levels().back().upper_force.plane(0);
                const std::array force = {sum_of(from_below.x) - sum_of(at_top.x),
                                          sum_of(from_below.y) - sum_of(at_top.y),
                                          sum_of(from_below.z) - sum_of(at_top.z)};
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
