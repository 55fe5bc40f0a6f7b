// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run is rehearsed to take is what it takes; steps and costs follow the scene.
#include "engine/run/memory_meter.hpp"
#include "engine/run/plan.hpp"
#include "engine/run/rehearsal.hpp"
#include "engine/run/run_session.hpp"
#include "engine/run/time_path.hpp"
#include "support/cases.hpp"
#include "support/message.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace asperity;
using Part = Rehearsal::Part;

namespace {

Case case_with(const std::vector<std::string>& overrides, int ranks = 1) {
    return read_case_text("[surface]\nsites = 32\nrms = 1.0\n", "test.toml", overrides, ranks);
}

} // namespace

TEST(Rehearsal, MemoryIsWhatALargerRunAllocates) {
    // In time with a state, on a plain lattice and on levels; at rest; along a path; all
    // of them larger than the pieces that are rehearsed.
    const std::vector<std::string> in_time = {
        "surface.sites=192",  "surface.rms=0.3",     "block.thickness=12", "block.model=lattice",
        "drive.velocity=800", "drive.timestep=20",   "drive.ramp=0",       "drive.tolerance=2.5e-2",
        "output.series=100",  "drive.path=approach", "output.checkpoint=0"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> keys = in_time;
        keys.insert(keys.end(), more.begin(), more.end());
        return keys;
    };
    for (const auto& keys :
         {in_time,
          with({"block.model=multiscale", "block.layers_per_level=8", "block.thickness=192"}),
          with({"surface.sites=320", "drive.path=zero-load"}),
          with({"surface.sites=256", "drive.path=zero-load", "interface.kind=wall"}),
          with({"surface.sites=256", "drive.mode=quasistatic", "drive.max_steps=3"})}) {
        const Case c = case_with(keys);
        const double rehearsed = Rehearsal(c, Rehearsal::Kind::memory).most_bytes(0);
        const io::Scratch scratch;
        // To the byte, by the rehearsal's counter; tests/python/test_result.py asks the system.
        MemoryMeter meter;
        test::run_scene(c, scratch / "out");
        const double most = meter.take_peak();
        EXPECT_NEAR(most / rehearsed, 1.0, 0.1) << keys.back();
    }
}

TEST(MemoryMeter, CountsOneInsideAnother) {
    MemoryMeter outer;
    auto kept = std::make_unique<std::vector<double>>(1000);
    {
        MemoryMeter inner;
        std::vector<double> gone(5000);
        EXPECT_NEAR(inner.held(), 4e4, 100.0);
        gone = {};
        gone.shrink_to_fit();
        EXPECT_NEAR(inner.take_peak(), 4e4, 100.0);
        EXPECT_NEAR(inner.take_peak(), 0.0, 100.0);
    }
    EXPECT_NEAR(outer.held(), 8e3, 200.0);
    EXPECT_NEAR(outer.take_peak(), 4.8e4, 200.0);
    EXPECT_EQ(kept->size(), 1000u);
}

TEST(Rehearsal, ContinuesWhatGrowsWithSitesAndNodes) {
    // The same from the same pieces, four times as large.
    const auto of = [](const char* sites, const char* rolloff, const char* cutoff) {
        return case_with({sites, rolloff, cutoff, "drive.path=zero-load"});
    };
    const Case once = of("surface.sites=512", "surface.rolloff=3", "surface.cutoff=256"),
               twice = of("surface.sites=1024", "surface.rolloff=6", "surface.cutoff=512");
    const Rehearsal small(once, Rehearsal::Kind::memory), large(twice, Rehearsal::Kind::memory);
    EXPECT_NEAR(large.most_bytes(0) / small.most_bytes(0), 4.0, 0.1);
    // Twice the layers of a lattice are twice its nodes.
    const auto lattice = [](const char* layers) {
        return case_with({"surface.sites=256", "block.model=lattice", layers});
    };
    const Case thin = lattice("block.thickness=100"), thick = lattice("block.thickness=200");
    EXPECT_NEAR(Rehearsal(thick, Rehearsal::Kind::memory).bytes(Part::block, 0) /
                    Rehearsal(thin, Rehearsal::Kind::memory).bytes(Part::block, 0),
                2.0, 0.05);
}

TEST(Rehearsal, RanksShareTheBlockAndHaveTheSurfaceEach) {
    const Case one = case_with({"surface.sites=96"}), four = case_with({"surface.sites=96"}, 4);
    const Rehearsal alone(one, Rehearsal::Kind::memory), shared(four, Rehearsal::Kind::memory);
    // Of an allocation malloc counts 16 bytes more where what is left of a piece is too small to be
    // one itself.
    EXPECT_NEAR(shared.bytes(Part::surface, 3), alone.bytes(Part::surface, 0), 256.0);
    EXPECT_LT(shared.bytes(Part::block, 3), 0.5 * alone.bytes(Part::block, 0)) << "halos";
    EXPECT_GT(shared.bytes(Part::block, 3), 0.25 * alone.bytes(Part::block, 0));
    EXPECT_LT(shared.bytes(Part::state, 1), 0.5 * alone.bytes(Part::state, 0));
    EXPECT_EQ(shared.bytes(Part::maps, 1), 0.0) << "the root collects them";
}

TEST(Rehearsal, WhatTheSceneDoesNotCallForTakesNothing) {
    const Case c = case_with({"output.fields=[]", "block.strain=finite"});
    const Rehearsal rehearsal(c, Rehearsal::Kind::memory);
    EXPECT_EQ(rehearsal.bytes(Part::maps, 0), 0.0);
    EXPECT_EQ(rehearsal.bytes(Part::state, 0), 0.0) << "no state at finite strain";
    EXPECT_GT(rehearsal.bytes(Part::snapshots, 0), 0.0);
    const Case rest = case_with({"drive.path=zero-load"});
    EXPECT_EQ(Rehearsal(rest, Rehearsal::Kind::memory).bytes(Part::snapshots, 0), 0.0);
}

TEST(Rehearsal, WhatDoesNotFitIsRefusedBeforeItIsMade) {
    const Case c = case_with({"surface.sites=32768", "block.thickness=32768", "block.model=lattice",
                              "surface.cutoff=16384"});
    RunOptions options;
    options.out = "no-such-directory";
    const std::string refused =
        test::message_of<io::SceneError>([&] { run(c, options, Communicator()); });
    EXPECT_TRUE(test::has(refused, "the run does not fit into memory")) << refused;
    EXPECT_TRUE(test::has(refused, "multiscale")) << refused;
    EXPECT_FALSE(std::filesystem::exists("no-such-directory"));
    // A plan makes neither the surface nor the block.
    const Plan plan = make_plan(c, 1);
    EXPECT_GT(plan.whole.bytes, 1e15);
    EXPECT_GT(plan.whole.seconds, 0.0);
    EXPECT_GT(plan.steps, 0);
}

TEST(Plan, StepsAndCostsFollowTheScene) {
    const Plan plan = make_plan(case_with({"block.thickness=32"}), 1);
    // Down and up 13.12 Å and more at 5 m/s in steps of 10 fs.
    const double least = 2.0 * 13.12 / 5e-5 / 10.0;
    EXPECT_GT(static_cast<double>(plan.steps), least);
    EXPECT_LT(static_cast<double>(plan.steps), 2.0 * least);
    EXPECT_GT(plan.block.seconds, 0.0);
    EXPECT_GT(plan.iterations, 10);
    EXPECT_TRUE(plan.state_ended);

    const Plan twice = make_plan(case_with({"block.thickness=32", "drive.velocity=2.5"}), 1);
    EXPECT_NEAR(static_cast<double>(twice.steps), 2.0 * static_cast<double>(plan.steps),
                0.1 * static_cast<double>(plan.steps));
    EXPECT_EQ(make_plan(case_with({"drive.max_steps=7"}), 1).steps, 7);
    const Plan timeless = make_plan(case_with({"drive.path=zero-load"}), 1);
    EXPECT_EQ(timeless.steps, 0);
    EXPECT_GT(timeless.iterations, 10);
    EXPECT_EQ(timeless.block.seconds, 0.0);
}

TEST(Plan, AllWorkIsSharedAmongTheThreads) {
    // Times are rehearsed anew for each plan: against a factor of a million they do not matter.
    constexpr int many = 1'000'000;
    const Case c = case_with({"block.thickness=32", "output.checkpoint=0"});
    const Plan one = make_plan(c, 1), shared = make_plan(c, many);
    const auto expect_shared = [&](const Cost& cost, const Cost& alone) {
        EXPECT_GT(alone.seconds, 0.0);
        EXPECT_LT(shared.threads * cost.seconds, 1e3 * alone.seconds);
        EXPECT_GT(shared.threads * cost.seconds, 1e-3 * alone.seconds);
    };
    expect_shared(shared.making, one.making);
    expect_shared(shared.block, one.block);
    expect_shared(shared.state, one.state);
}

TEST(Plan, ProgressGoesWithTheTimeOfTheRun) {
    // The top moves at one speed: of the whole path as much is done as of the steps.
    const io::Scratch scratch;
    RunOptions options;
    options.out = scratch / "run";
    options.progress = io::ProgressMode::off;
    const Case c = case_with(
        {"surface.sites=64", "block.thickness=32", "drive.velocity=50", "drive.timestep=10"});
    const RunSession session(c, options, Communicator());
    TimePath path(c, {}, Communicator());
    std::vector<double> told;
    while (path.step(100, {}) == 100) {
        const Simulation& s = path.simulation();
        told.push_back(session.way_done(s.drive().segment(), s.now().top, s.reference_height()));
    }
    ASSERT_GT(told.size(), 4u);
    const double all = static_cast<double>(path.now().step);
    double worst = 0.0;
    for (std::size_t i = 0; i < told.size(); ++i)
        worst = std::max(worst, std::abs(told[i] - 100.0 * static_cast<double>(i + 1) / all));
    EXPECT_LT(worst, 0.2);
    EXPECT_GT(told.back(), 0.8);
}
