// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Effects: decided from the scene, off means no call and no byte, and a run that strays from its
// plan is found out. The plan's memory is that of the objects it stands for.
#include "engine/run/plan.hpp"
#include "support/cases.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>

using namespace asperity;

namespace {

Scene scene_with(const std::vector<std::string>& overrides) {
    return read_scene_text("[surface]\nsites = 32\nrms = 1.0\n", "test.toml", overrides);
}

/// A contact of the scene's effects, some steps long.
Simulation follow(const Scene& scene, int steps) {
    const auto setup = make_setup(scene, 1);
    Simulation s(setup.simulation, scene_surface(scene), Communicator(),
                 test::serial_grid(setup.simulation.block));
    s.start(s.interface().start_height() - 10.0);
    for (int n = 0; n < steps; ++n)
        s.step(n % 10 == 0);
    return s;
}

} // namespace

TEST(Effects, ThePlainestSceneTouchesNothingElse) {
    const Scene scene = scene_with({"drive.damping=0", "block.model=lattice", "block.thickness=4"});
    const Effects effects(scene);
    for (Effect off : {Effect::damping, Effect::temperature, Effect::finite_strain,
                       Effect::coarse_levels, Effect::tail, Effect::curvature, Effect::trajectory})
        EXPECT_FALSE(effects.on(off)) << name(off);
    for (Effect on : {Effect::inertia, Effect::lateral, Effect::skipping, Effect::relaxation,
                      Effect::observation})
        EXPECT_TRUE(effects.on(on)) << name(on);
    const Simulation s = follow(scene, 20);
    EXPECT_EQ(s.work().steps, 20);
    EXPECT_EQ(s.work().nodes, 20ll * 32 * 32 * 4);
    EXPECT_EQ(s.work().observed, 2);
    EXPECT_EQ(s.work().damped, 0);
    EXPECT_EQ(s.phases()[Phase::thermostat].calls, 0);
    EXPECT_EQ(s.phases()[Phase::interpolate].calls, 0);
    EXPECT_EQ(s.block().coarse_bytes(), 0u);
    EXPECT_EQ(s.block().finite_nodes(), 0);
    EXPECT_EQ(s.block().finite_bytes(), 0u);
    EXPECT_EQ(s.interface().work().tails, 0);
    EXPECT_EQ(s.interface().tail_bytes(), 0u);
    EXPECT_EQ(s.interface().work().sites, 20ll * 32 * 32);
    EXPECT_EQ(scene_surface(scene).radius, 0.0);
}

TEST(Effects, WhatIsAskedForTakesPlace) {
    const Scene scene = scene_with(
        {"drive.damping=0.2", "drive.damping_from=0.4", "drive.temperature=100",
         "interface.tail=true", "surface.radius=200", "block.thickness=32", "block.strain=finite"});
    const Effects effects(scene);
    for (Effect on : {Effect::damping, Effect::temperature, Effect::finite_strain,
                      Effect::coarse_levels, Effect::tail, Effect::curvature})
        EXPECT_TRUE(effects.on(on)) << name(on);
    const Simulation s = follow(scene, 20);
    EXPECT_GT(s.work().damped, 0);
    EXPECT_LT(s.work().damped, s.work().nodes) << "not below damping_from";
    EXPECT_EQ(s.phases()[Phase::thermostat].calls, 20);
    EXPECT_EQ(s.phases()[Phase::interpolate].calls, 20);
    EXPECT_GT(s.block().coarse_bytes(), 0u);
    EXPECT_EQ(s.block().finite_nodes(), s.work().nodes);
    EXPECT_EQ(s.interface().work().tails, 20ll * 32 * 32);
    EXPECT_GT(s.interface().tail_bytes(), 0u);
    EXPECT_EQ(scene_surface(scene).radius, 200.0);
}

TEST(Effects, AStateAtRestHoldsNoMotion) {
    const auto setup = make_setup(scene_with({"drive.path=zero-load"}), 1);
    EXPECT_FALSE(setup.effects.on(Effect::inertia));
    EXPECT_FALSE(setup.effects.on(Effect::observation));
    const ProcessGrid grid = test::serial_grid(setup.simulation.block);
    const Block moving(setup.simulation.block, Communicator(), grid);
    const Block still(setup.simulation.block, Communicator(), grid, Motion::at_rest);
    EXPECT_GT(moving.motion_bytes(), 0u);
    EXPECT_EQ(still.motion_bytes(), 0u);
    EXPECT_EQ(still.bytes(), moving.bytes() - moving.motion_bytes());
    EXPECT_EQ(moving.copy_at_rest().motion_bytes(), 0u);
}

TEST(Effects, FarSitesAreCountedAndLeftOut) {
    const Scene scene = scene_with({});
    const auto setup = make_setup(scene, 1);
    Simulation s(setup.simulation, scene_surface(scene), Communicator(),
                 test::serial_grid(setup.simulation.block));
    s.start(s.interface().start_height() + 0.1);
    s.step(false);
    EXPECT_EQ(s.interface().work().in_reach, 0) << "out of reach";
    s.start(3.0);
    s.step(false);
    EXPECT_EQ(s.interface().work().in_reach, 32 * 32) << "all in reach";
}

TEST(EffectBooks, BothKindsOfStrayingAreFound) {
    const Effects planned(scene_with({"drive.damping=0"}));
    EffectBooks books;
    for (Effect e : {Effect::inertia, Effect::lateral, Effect::coarse_levels})
        books[e].calls = 10;
    EXPECT_TRUE(books.differences(planned, false).empty());
    EXPECT_EQ(books.differences(planned, true).size(), 2u) << "no relaxation, no maps";
    books[Effect::relaxation].calls = 100;
    books[Effect::maps].calls = 1;
    EXPECT_TRUE(books.differences(planned, true).empty());
    books[Effect::temperature].bytes = 8; // unasked
    books[Effect::damping].calls = 1;     // unasked
    books[Effect::inertia].calls = 0;     // missing
    const auto list = books.differences(planned, true);
    ASSERT_EQ(list.size(), 3u);
    EXPECT_NE(list[0].find("inertia was called for"), std::string::npos);
    EXPECT_NE(list[1].find("damping was not called for (drive.damping = 0)"), std::string::npos);
    EXPECT_NE(list[2].find("temperature"), std::string::npos);
}

TEST(Plan, MemoryIsThatOfTheBlock) {
    for (const auto& [sites, thickness, layers] :
         {std::array{32, 32, 3}, {33, 20, 0}, {64, 64, 4}, {8, 1, 0}, {16, 500, 2}}) {
        const BlockOptions options = test::paper_block(sites, thickness, layers);
        const ProcessGrid grid = test::serial_grid(options);
        const Block block(options, Communicator(), grid);
        const Block::Memory planned = Block::memory_for(options, grid);
        EXPECT_EQ(planned.bytes, block.bytes());
        EXPECT_EQ(planned.motion, block.motion_bytes());
        EXPECT_EQ(planned.coarse, block.coarse_bytes());
    }
}

TEST(Plan, FiniteStrainHasItsLine) {
    const Scene scene = scene_with({"block.thickness=32", "block.strain=finite"});
    const int threads = omp_get_max_threads();
    const Plan plan = make_plan(scene, 1, threads);
    EXPECT_GT(plan.cost(Effect::finite_strain).seconds, 0.0);
    EXPECT_LT(plan.cost(Effect::finite_strain).seconds, plan.seconds);
    EXPECT_EQ(plan.cost(Effect::finite_strain).bytes,
              static_cast<double>(follow(scene, 1).block().finite_bytes()));
    // A path without time keeps its forces anyway, and needs no memory more.
    const Plan timeless =
        make_plan(scene_with({"drive.path=zero-load", "block.strain=finite"}), 1, threads);
    EXPECT_GT(timeless.cost(Effect::finite_strain).seconds, 0.0);
    EXPECT_EQ(timeless.cost(Effect::finite_strain).bytes, 0.0);
    const Plan linear = make_plan(scene_with({"block.thickness=32"}), 1, threads);
    EXPECT_EQ(linear.cost(Effect::finite_strain).seconds, 0.0);
    EXPECT_EQ(linear.cost(Effect::finite_strain).bytes, 0.0);
}

TEST(Plan, StepsAndCostsFollowTheScene) {
    const Scene scene = scene_with({"block.thickness=32"});
    const Plan plan = make_plan(scene, 1, 1);
    // Down and up 13.12 Å and more at 5 m/s in steps of 10 fs.
    const double least = 2.0 * 13.12 / 5e-5 / 10.0;
    EXPECT_GT(static_cast<double>(plan.steps), least);
    EXPECT_LT(static_cast<double>(plan.steps), 2.0 * least);
    EXPECT_GT(plan.seconds, 0.0);
    EXPECT_EQ(plan.cost(Effect::temperature).seconds, 0.0);
    EXPECT_EQ(plan.cost(Effect::temperature).bytes, 0.0);
    EXPECT_EQ(plan.cost(Effect::tail).bytes, 0.0);
    EXPECT_GT(plan.cost(Effect::coarse_levels).bytes, 0.0);

    const Plan twice = make_plan(scene_with({"block.thickness=32", "drive.velocity=2.5"}), 1, 1);
    EXPECT_NEAR(static_cast<double>(twice.steps), 2.0 * static_cast<double>(plan.steps),
                0.1 * static_cast<double>(plan.steps));
    EXPECT_EQ(make_plan(scene_with({"drive.max_steps=7"}), 1, 1).steps, 7);
    const Plan timeless =
        make_plan(scene_with({"drive.path=zero-load", "block.model=spectral"}), 1, 1);
    EXPECT_EQ(timeless.steps, 0);
    EXPECT_GT(timeless.iterations, 0);
    EXPECT_EQ(timeless.cost(Effect::inertia).bytes, 0.0);
    EXPECT_LT(timeless.bytes, plan.bytes);
}
