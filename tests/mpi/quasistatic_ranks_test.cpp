// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A quasi-static path of a block of levels is the same bits on any number of ranks, and one that is
// taken up from a checkpoint, on whatever number of ranks, ends in the same state. Judge: the
// uninterrupted path on one rank.
#include "engine/equilibrium/quasistatic.hpp"
#include "engine/run/checkpoint.hpp"
#include "support/cases.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <filesystem>
#include <memory>
#include <span>

using namespace asperity;

namespace {

const Communicator& world() { return test::world(); }
constexpr double tolerance = 1e-3;

/// A soft block on a rough map: it snaps in.
struct Contact {
    BlockOptions options = test::paper_block(16, 60, 2);
    Surface surface = test::reference_surface("c1_N16_T16_rms0.5");
    ProcessGrid grid;
    Interface interface;
    std::unique_ptr<Equilibrium> block;
    QuasistaticPath path;

    explicit Contact(const Communicator& ranks, Hold hold = Hold::top)
        : grid(test::grid_for(options, ranks)),
          interface(surface, grid.tile(0), options.spacing, test::paper_interface()),
          block(at_rest(Block(options, ranks, grid))), path(*block, interface, path_options(hold)) {
    }

    PathOptions path_options(Hold hold) const {
        PathOptions o;
        o.hold = hold;
        o.step = 0.5;
        o.tolerance = tolerance;
        o.reference_height = interface.start_height();
        return o;
    }
    /// Up to this many points, or the end of the approach. True at the end.
    bool approach(int points) {
        for (int i = 0; i < points; ++i)
            if (path.advance(Leg::approach) == QuasistaticPath::Outcome::landed) return true;
        return false;
    }
    std::uint64_t trace() {
        std::uint64_t hash = 1;
        const StepRecord& r = path.now();
        for (double value : {r.top, r.mean_height, r.force, r.top_force, r.interface_energy,
                             r.elastic_energy, r.work, r.damped, r.residual, r.closest,
                             static_cast<double>(r.in_contact), path.approach_work()})
            hash = test::mix(hash, value);
        for (const Jump& jump : path.dissipation().jumps)
            for (double value : {jump.energy, jump.top, jump.site_x, jump.site_y, jump.sites_moved})
                hash = test::mix(hash, value);
        return hash;
    }
};

struct Judge {
    std::uint64_t trace = 0;
    double top = 0.0, energy = 0.0, lost = 0.0;
};

/// The whole approach on one rank.
const Judge& judge() {
    static const Judge j = [] {
        Contact one{Communicator()};
        one.path.start();
        EXPECT_TRUE(one.approach(1000));
        EXPECT_GT(one.path.dissipation().total(), 0.1) << "it is meant to snap in";
        return Judge{one.trace(), one.path.now().top,
                     one.path.now().interface_energy + one.path.now().elastic_energy,
                     one.path.dissipation().total()};
    }();
    return j;
}

} // namespace

TEST(QuasistaticRanks, SameBits) {
    Contact all(world());
    all.path.start();
    ASSERT_TRUE(all.approach(1000));
    EXPECT_EQ(all.trace(), judge().trace);
}

TEST(QuasistaticRanks, SameBitsAtAHeldMeanHeight) {
    Contact all(world(), Hold::mean_height), one(Communicator(), Hold::mean_height);
    all.path.start();
    one.path.start();
    EXPECT_EQ(all.approach(20), one.approach(20));
    EXPECT_LT(one.path.now().force, -1.0);
    EXPECT_EQ(all.trace(), one.trace());
}

TEST(QuasistaticRanks, TakenUpFromACheckpointEndsTheSame) {
    const std::string file = "quasistatic_ranks" + std::to_string(world().size()) + ".h5";
    for (int points : {3, 25}) {
        Contact before(world());
        before.path.start();
        ASSERT_FALSE(before.approach(points));
        CollectScalars collect;
        before.path.visit(collect);
        write_checkpoint(file, world(), before.grid, before.block->state(), collect.values, "it");
        world().barrier();
        if (world().root()) {
            Contact after{Communicator()};
            const RunScalars scalars =
                read_checkpoint(file, Communicator(), after.grid, after.block->state(), "it");
            RestoreScalars restore{scalars};
            after.path.visit(restore);
            after.path.resume();
            EXPECT_EQ(after.path.now().step, points);
            ASSERT_TRUE(after.approach(1000));
            const double sites = 256.0, energy = after.path.now().interface_energy +
                                                 after.path.now().elastic_energy;
            EXPECT_NEAR(after.path.now().top, judge().top, 5e-3);
            EXPECT_NEAR(energy, judge().energy, 1e-2 * tolerance * sites);
            EXPECT_NEAR(after.path.dissipation().total(), judge().lost, tolerance * sites * 3.0);
            std::filesystem::remove(file);
        }
        world().barrier();
    }
}
