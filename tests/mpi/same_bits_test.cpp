// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The same bits on any number of ranks and threads: positions, velocities, energies, and the state
// that a relaxation finds. The run on one rank, in the same process, is the reference; so a wrong
// tile, a stale halo or a sum that depends on its order shows at its first bit.
//
// Two stacks on 32 x 32 sites, and their kin: warm, at finite strain, a plain lattice, over atoms
// anywhere. Shallow: 4 +
// 4 + 5 cells; three ranks cut its lowest level alone (10
// + 11 + 11 rows, odd offsets) and hold the other two whole. Deep: five levels down to 2 x 2 nodes;
// two and four ranks cut four of them and hold the last one whole.
#include "decomposition/halo_exchange.hpp"
#include "decomposition/plane_bands.hpp"
#include "support/cases.hpp"
#include "support/threads.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>

using namespace asperity;

namespace {

using test::from_root, test::Trace, test::world;

struct Body {
    const char* name;
    int thickness, layers;
    double temperature;
    bool finite = false; ///< strain
    bool atoms = false;  ///< a substrate of atoms anywhere
    bool types = false;  ///< of two types
    bool slides = false; ///< in contact
    bool spring = false; ///< holds the top plane
};
constexpr Body stacks[] = {{"shallow", 32, 3, 0.0},
                           {"deep", 62, 2, 0.0},
                           {"warm", 32, 3, 300.0},
                           {"lattice", 6, 0, 0.0},
                           {"finite", 32, 3, 0.0, true},
                           {"finite lattice", 6, 0, 0.0, true},
                           {"atoms", 32, 3, 0.0, false, true},
                           {"types", 32, 3, 0.0, false, true, true},
                           {"sliding", 32, 3, 0.0, false, false, false, true},
                           {"sliding over atoms", 32, 3, 0.0, false, true, false, true},
                           {"spring", 32, 3, 0.0, false, false, false, false, true}};
void PrintTo(const Body& s, std::ostream* out) { *out << s.name; }

Surface surface_of(const Body& stack, const char* name) {
    Surface surface = test::reference_surface(name);
    if (stack.atoms) surface = test::disordered(surface);
    if (stack.types)
        for (std::size_t i = 0; i < surface.atoms.size(); ++i)
            surface.atoms.type.push_back(i % 3 == 0);
    return surface;
}

InterfaceOptions interface_of(const Body& stack) {
    InterfaceOptions options = test::paper_interface();
    options.slides = stack.slides;
    if (stack.types) options.by_type = {options.potential, Morse{0.05, 1.7, 3.4, 10.0}};
    return options;
}

BlockOptions block_of(const Body& stack) {
    BlockOptions options = test::paper_block(32, stack.thickness, stack.layers);
    options.finite_strain = stack.finite;
    return options;
}

SimulationOptions options_of(const Body& stack) {
    SimulationOptions options;
    options.block = block_of(stack);
    options.interface = interface_of(stack);
    options.drive.velocity = 1e-3; // 100 m/s: into contact within 300 steps
    options.drive.ramp = 500.0;
    options.damping = 1e-3;
    options.damping_from = 0.3;
    options.temperature = stack.temperature;
    options.seed = 7;
    if (stack.spring) options.block.top_spring.stiffness = 20.0;
    // Over more than a spacing: the substrate's tables are made anew.
    if (stack.slides) {
        options.drive.ramp = 100.0;
        options.drive.path = {{Segment::approach}, {Segment::slide, -1.6, 0}};
    }
    return options;
}

Trace run(const Body& stack, const Communicator& ranks) {
    const SimulationOptions options = options_of(stack);
    const Surface surface = surface_of(stack, "c3_N32_T32_rms1.5");
    test::Driven s(options, surface, ranks, test::grid_for(options.block, ranks));
    s.start(7.0);
    Trace trace;
    trace.follow(s, stack.slides ? 500 : 300);
    EXPECT_EQ(s.interface().place()[0] < -1.3, stack.slides);
    trace.conclude(s);
    return trace;
}

/// The state below a block that has been pushed about.
Trace relaxation(const Body& stack, const Communicator& ranks) {
    const SimulationOptions options = options_of(stack);
    const Surface surface = surface_of(stack, "c4_N32_T16_rms3");
    Block block(options.block, ranks, test::grid_for(options.block, ranks));
    const auto& level = block.levels().front();
    const auto u = block.fields(level).u.plane(0);
    for (int y = 0; y < level.tile.ny; ++y)
        for (int x = 0; x < level.tile.nx; ++x)
            u.z(x, y) = 0.1 * std::sin(x + level.tile.x0 + 2.0 * (y + level.tile.y0));
    const LayerAtRest rest = test::bring_to_rest(block, surface, 8.0, options, 1e-3);
    Trace trace;
    const ZeroLoad& z = rest.numbers.value();
    for (double value : {z.binding_energy, z.pairwise, z.mean_height, z.residual,
                         static_cast<double>(z.iterations), z.repulsive_fraction})
        trace.records = test::mix(trace.records, value);
    trace.in_contact = std::llround(1024.0 * z.contact_fraction);
    // Every rank has its tile of the layer.
    const auto layer = std::as_const(rest.layer).view()[0];
    std::uint64_t hash = 1;
    for (const PlaneView<const double>& component : {layer.x, layer.y, layer.z})
        for (const double value : gather_plane(ranks, block.grid(), 0, component))
            hash = test::mix(hash, value);
    std::array<std::uint64_t, 1> whole = {hash}; // the root has all
    ranks.broadcast(std::as_writable_bytes(std::span(whole)));
    trace.state = whole[0];
    return trace;
}

void expect_same(const Trace& mine, const Trace& expected) {
    EXPECT_EQ(mine.state, expected.state) << "displacements and velocities";
    EXPECT_EQ(mine.in_contact, expected.in_contact);
    EXPECT_EQ(mine.records, expected.records);
}

class SameBits : public testing::TestWithParam<Body> {};

} // namespace

TEST_P(SameBits, OfARunOnAnyRanksAndThreads) {
    const Body& stack = GetParam();
    const Trace expected = from_root([&] {
        const test::Threads one(1);
        return run(stack, Communicator());
    });
    EXPECT_GT(expected.in_contact, 100) << "the scene must touch, or nothing is tested";
    {
        const test::Threads one(1);
        expect_same(run(stack, world()), expected);
    }
    // Two cores: no more than four workers at once, and those on one stack.
    if (world().size() > 2 || (world().size() == 2 && stack.name != stacks[0].name)) return;
    const test::Threads two(2);
    expect_same(run(stack, world()), expected);
}

TEST_P(SameBits, OfARelaxationOnAnyRanksAndThreads) {
    const Body& stack = GetParam();
    if (stack.temperature > 0.0 || stack.finite)
        return; // no other block than the shallow one; none
    const Trace expected = from_root([&] {
        const test::Threads one(1);
        return relaxation(stack, Communicator());
    });
    EXPECT_GT(expected.in_contact, 50);
    {
        const test::Threads one(1);
        expect_same(relaxation(stack, world()), expected);
    }
    if (world().size() > 1) return;
    const test::Threads two(2);
    expect_same(relaxation(stack, world()), expected);
}

INSTANTIATE_TEST_SUITE_P(Stacks, SameBits, testing::ValuesIn(stacks));

TEST(SameBits, TheStacksAreCutAsIntended) {
    const auto levels = [](const Body& s) { return level_shapes(options_of(s).block).size(); };
    ASSERT_EQ(levels(stacks[0]), 3u);
    ASSERT_EQ(levels(stacks[1]), 5u);
    if (world().size() == 3) {
        EXPECT_EQ(test::grid_for(options_of(stacks[0]).block, world()).cut_level(), 0);
    }
    if (world().size() == 2 || world().size() == 4) {
        EXPECT_EQ(test::grid_for(options_of(stacks[1]).block, world()).cut_level(), 3);
    }
}
