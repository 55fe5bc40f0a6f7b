// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Seams that absorb (docs/explanation/seams.md): the operator is that of its definition; it takes
// energy and no momentum, and nothing of a motion as a whole or of a state at rest; what is sent
// into the block does not come back; the books close.
#include "support/cases.hpp"
#include "support/echo.hpp"
#include "support/elastic_operator.hpp"
#include "support/nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

using namespace asperity;

namespace {

constexpr double dt = 10.0;

BlockOptions absorbing(int sites, int thickness, int layers, double span = 50.0) {
    BlockOptions options = test::paper_block(sites, thickness, layers);
    options.absorption_span = span;
    return options;
}

Block made(const BlockOptions& options) {
    return Block(options, Communicator(), test::serial_grid(options));
}

/// Calls visit(level, x, y, z, {v, v, v}) for all nodes that move.
template <class Visit>
void each_node(Block& block, const Visit& visit) {
    test::each_node(block, [&](const Block::Level& level, int x, int y, int z) {
        visit(level, x, y, z, test::components(block.fields(level).v.view(), x, y, z));
    });
}

void stir(Block& block) {
    unsigned seed = 3;
    each_node(block, [&](const Block::Level&, int, int, int, const auto& v) {
        const test::Vector random = test::random_vector(3, ++seed);
        for (std::size_t c = 0; c < 3; ++c)
            *v[c] = 1e-3 * random[c];
    });
}

struct Moving {
    double kinetic = 0.0, mass = 0.0;
    std::array<double, 3> momentum{};
};
Moving moving(Block& block) {
    Moving sum;
    each_node(block, [&](const Block::Level& level, int, int, int z, const auto& v) {
        sum.mass += level.mass(z);
        for (std::size_t c = 0; c < 3; ++c) {
            sum.kinetic += 0.5 * level.mass(z) * *v[c] * *v[c];
            sum.momentum[c] += level.mass(z) * *v[c];
        }
    });
    return sum;
}

/// The definition, cell by cell: corners and their weights at the nodes that move.
using Node = std::tuple<int, int, int, int>; // level, z, y, x
using Weights = std::vector<std::pair<Node, double>>;

Weights nodes_of_corner(const Block& block, int l, int x, int y, int z) {
    const Block::Level& level = block.levels()[static_cast<std::size_t>(l)];
    const int n = level.shape.sites;
    if (z < level.shape.cells) return {{{l, z, (y + n) % n, (x + n) % n}, 1.0}};
    Weights weights; // bilinear
    for (int j : {y / 2, (y + 1) / 2})
        for (int i : {x / 2, (x + 1) / 2})
            for (const auto& [node, w] : nodes_of_corner(block, l + 1, i, j, 0))
                weights.push_back({node, 0.25 * w});
    return weights;
}

std::map<Node, std::array<double, 3>> changes_by_definition(Block& block) {
    std::map<Node, std::array<double, 3>> velocity, change;
    std::map<Node, double> mass;
    each_node(block, [&](const Block::Level& level, int x, int y, int z, const auto& v) {
        velocity[{level.shape.level, z, y, x}] = {*v[0], *v[1], *v[2]};
        mass[{level.shape.level, z, y, x}] = level.mass(z);
    });
    for (const Block::Level& level : block.levels())
        for (int z = level.absorbs_from; z < level.shape.cells; ++z)
            for (int y = 0; y < level.tile.ny; ++y)
                for (int x = 0; x < level.tile.nx; ++x) {
                    std::array<Weights, 8> corner;
                    std::array<std::array<double, 3>, 8> v{};
                    std::array<double, 3> mean{};
                    for (int p = 0; p < 8; ++p) {
                        const auto i = static_cast<std::size_t>(p);
                        corner[i] = nodes_of_corner(block, level.shape.level, x + (p & 1),
                                                    y + (p >> 1 & 1), z + (p >> 2));
                        for (std::size_t c = 0; c < 3; ++c) {
                            for (const auto& [node, w] : corner[i])
                                v[i][c] += w * velocity[node][c];
                            mean[c] += v[i][c] / 8.0;
                        }
                    }
                    for (std::size_t i = 0; i < 8; ++i)
                        for (std::size_t c = 0; c < 3; ++c)
                            for (const auto& [node, w] : corner[i])
                                change[node][c] += w * level.node_mass / 8.0 *
                                                   level.fraction[static_cast<std::size_t>(z)] *
                                                   (mean[c] - v[i][c]) / mass[node];
                }
    return change;
}

} // namespace

TEST(Seams, TakeWhatTheirDefinitionSays) {
    // Two cells on level 0 (both absorb), three and five (the upper two); levels of 16 to 2 nodes.
    // After 50 fs a cell at a seam takes all, after 5 fs a fraction.
    for (const auto& [thickness, layers, span] :
         {std::tuple{14, 2, 50.0}, std::tuple{21, 3, 5.0}, std::tuple{50, 5, 50.0},
          std::tuple{50, 5, 5.0}, std::tuple{62, 2, 50.0}}) {
        Block block = made(absorbing(16, thickness, layers, span));
        stir(block);
        const auto expected = changes_by_definition(block);
        std::map<Node, std::array<double, 3>> before;
        each_node(block, [&](const Block::Level& level, int x, int y, int z, const auto& v) {
            before[{level.shape.level, z, y, x}] = {*v[0], *v[1], *v[2]};
        });
        const Moving then = moving(block);
        ExactSum taken;
        block.absorb(0, taken);
        double off = 0.0, most = 0.0;
        each_node(block, [&](const Block::Level& level, int x, int y, int z, const auto& v) {
            const Node node{level.shape.level, z, y, x};
            const auto at = expected.find(node);
            for (std::size_t c = 0; c < 3; ++c) {
                const double change = at == expected.end() ? 0.0 : at->second[c];
                off = std::max(off, std::abs(*v[c] - before[node][c] - change));
                most = std::max(most, std::abs(change));
            }
        });
        EXPECT_GT(most, 1e-4) << thickness;
        EXPECT_LT(off, 1e-15) << thickness << ", " << layers;
        const Moving now = moving(block);
        EXPECT_GT(taken.value(), 0.0);
        EXPECT_NEAR(taken.value(), then.kinetic - now.kinetic, 1e-12 * then.kinetic);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(now.momentum[c], then.momentum[c], 1e-17 * now.mass);
    }
}

TEST(Seams, LeaveAMotionAsAWholeAlone) {
    Block block = made(absorbing(16, 50, 5));
    block.set_uniform(0.0, 0.3); // not a binary fraction
    each_node(block,
              [](const Block::Level&, int, int, int, const auto& v) { *v[0] = 0.1, *v[1] = -0.7; });
    const auto before = test::fingerprint(block);
    ExactSum taken;
    block.absorb(0, taken);
    EXPECT_EQ(test::fingerprint(block), before);
    EXPECT_EQ(taken.value(), 0.0);
}

TEST(Seams, NeverGiveEnergy) {
    // Every kind of motion at once, at steps near the limit: one absorption a step there, one every
    // so many steps below. What is left only falls.
    for (const auto& [step, span] : {std::pair{55.0, 55.0}, std::pair{11.0, 55.0}}) {
        Block block = made(absorbing(8, 21, 3, span));
        block.set_uniform(0.0, 0.0);
        stir(block);
        const StepParameters parameters{step, 0.0, 0.0, 0.0, true};
        const long long every = std::llround(span / step);
        double first = 0.0, last = 0.0;
        constexpr int stretch = 500;
        std::vector<double> mean;
        for (int n = 0; n < 6 * stretch; ++n) {
            ExactSum elastic, taken;
            KickSums sums;
            if (n % every == 0) block.absorb(n / every, taken);
            block.interpolate();
            block.add_elastic_energy(elastic);
            block.advance(parameters, sums);
            block.exchange();
            if (n % stretch == 0) mean.push_back(0.0);
            mean.back() += (elastic.value() + sums.kinetic.value()) / stretch;
        }
        first = mean.front(), last = mean.back();
        EXPECT_GT(first, 0.0);
        EXPECT_LT(last, first);
        for (std::size_t i = 1; i < mean.size(); ++i)
            EXPECT_LT(mean[i], 1.001 * mean[i - 1]) << step << " fs";
    }
}

TEST(Seams, SendBackWhatTheNextLevelCannotCarryOrTakeIt) {
    // Vertical and at 45 degrees; eight spacings a wave and less. Reflecting seams return all.
    using enum test::Polarisation;
    BlockOptions reflecting = test::paper_block(8, 128, 4);
    BlockOptions taking = reflecting;
    taking.absorption_span = 50.0;
    for (const test::Packet& packet :
         {test::Packet{0, 5.0, 2.0, longitudinal}, test::Packet{0, 8.0, 1.5, longitudinal},
          test::Packet{0, 8.0, 1.5, horizontal_shear}, test::Packet{1, 8.0, 1.5, longitudinal}}) {
        if (packet.rise < 8.0) {
            EXPECT_GT(test::echo(reflecting, packet, 12.0, 20.0), 0.9);
        }
        EXPECT_LT(test::echo(taking, packet, 12.0, 20.0), 0.05)
            << packet.angle(8) << " degrees, " << packet.length(8) << " a";
    }
}

namespace {

SimulationOptions contact(double span, double step = dt) {
    SimulationOptions options;
    options.block = absorbing(8, 14, 2, span);
    options.interface = test::paper_interface();
    options.dt = step;
    return options;
}

} // namespace

TEST(Seams, WhatTheyTakeIsCounted) {
    // Released pressed into a rough wall: half of the energy that moves is absorbed, and no more is
    // missing than with seams that reflect. Driven too.
    for (const double velocity : {0.0, 1e-3}) {
        const auto worst = [&](double span) {
            SimulationOptions options = contact(span, 5.0);
            options.drive.velocity = velocity;
            Simulation s = test::simulation(options, test::reference_surface("n8_b_rms1.0"));
            s.start(4.5);
            double residual = 0.0;
            for (int n = 0; n < 1500; ++n)
                residual = std::max(residual, std::abs(s.step(true).residual));
            if (span > 0.0) {
                EXPECT_GT(s.balance().radiated, 0.3 * s.now().kinetic_energy);
                EXPECT_EQ(s.now().radiated, s.balance().radiated);
            } else {
                EXPECT_EQ(s.balance().radiated, 0.0);
            }
            EXPECT_EQ(s.balance().damped, 0.0);
            return residual;
        };
        EXPECT_LT(worst(50.0), 1.5 * worst(0.0)) << velocity;
    }
}

TEST(Seams, LeaveStatesAtRestWhereTheyAre) {
    // A contact that is damped until nothing moves ends in the same state.
    const auto rests_at = [](double span) {
        SimulationOptions options = contact(span);
        options.damping = 2e-3;
        options.drive.velocity = 0.0;
        Simulation s = test::simulation(options, test::reference_surface("n8_b_rms1.0"));
        s.start(4.5);
        for (int n = 0; n < 6000; ++n)
            s.step(n == 5999);
        EXPECT_LT(s.now().kinetic_energy, 1e-12);
        return std::array{s.now().mean_height, s.now().interface_energy, s.now().elastic_energy};
    };
    const auto with = rests_at(50.0), without = rests_at(0.0);
    for (std::size_t i = 0; i < with.size(); ++i)
        EXPECT_NEAR(with[i], without[i], 1e-6) << i;
}

TEST(Seams, ThatReflectHoldNothing) {
    const Block off = made(test::paper_block(16, 50, 5)), on = made(absorbing(16, 50, 5));
    EXPECT_EQ(off.absorption_bytes(), 0u);
    for (const Block::Level& level : off.levels())
        EXPECT_TRUE(level.fraction.empty() && level.constrained_v.empty() && !level.absorbs());
    EXPECT_EQ(on.bytes() - off.bytes(), on.absorption_bytes());
    EXPECT_FALSE(on.levels().back().absorbs()) << "under the rigid top";
}
