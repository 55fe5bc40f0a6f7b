// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The plan's memory is that of the objects it stands for; steps and costs follow the scene.
#include "engine/run/plan.hpp"
#include "support/cases.hpp"

#include <gtest/gtest.h>
#include <omp.h>

using namespace asperity;

namespace {

Case case_with(const std::vector<std::string>& overrides) {
    return read_case_text("[surface]\nsites = 32\nrms = 1.0\n", "test.toml", overrides);
}

} // namespace

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
    const Case c = case_with({"block.thickness=32", "block.strain=finite"});
    const int threads = omp_get_max_threads();
    Rates rates;
    rates.node = 3e-9;
    rates.finite = 2e-9;
    rates.iteration = 5e-9;
    const Plan plan = make_plan(c, threads, rates);
    EXPECT_GT(plan.steps, 0);
    EXPECT_EQ(plan.iterations, 0); // no state is relaxed
    const double seconds =         // of each node, at each step
        static_cast<double>(plan.steps) * nodes_of(c.levels) * rates.finite;
    EXPECT_NEAR(plan.cost(Effect::finite_strain).seconds, seconds, 1e-12 * seconds);
    const BlockOptions& options = c.simulation.block;
    Block block(options, Communicator(), test::serial_grid(options));
    KickSums sums;
    block.advance({10.0}, sums);
    EXPECT_EQ(plan.cost(Effect::finite_strain).bytes, static_cast<double>(block.finite_bytes()));
    const Plan linear = make_plan(case_with({"block.thickness=32"}), threads, rates);
    EXPECT_EQ(linear.cost(Effect::finite_strain).seconds, 0.0);
    EXPECT_EQ(linear.cost(Effect::finite_strain).bytes, 0.0);
}

TEST(Plan, StepsAndCostsFollowTheScene) {
    const Case c = case_with({"block.thickness=32"});
    const Plan plan = make_plan(c, 1);
    // Down and up 13.12 Å and more at 5 m/s in steps of 10 fs.
    const double least = 2.0 * 13.12 / 5e-5 / 10.0;
    EXPECT_GT(static_cast<double>(plan.steps), least);
    EXPECT_LT(static_cast<double>(plan.steps), 2.0 * least);
    EXPECT_GT(plan.seconds, 0.0);
    EXPECT_EQ(plan.cost(Effect::temperature).seconds, 0.0);
    EXPECT_EQ(plan.cost(Effect::temperature).bytes, 0.0);
    EXPECT_EQ(plan.cost(Effect::tail).bytes, 0.0);
    EXPECT_GT(plan.cost(Effect::coarse_levels).bytes, 0.0);

    const Plan twice = make_plan(case_with({"block.thickness=32", "drive.velocity=2.5"}), 1);
    EXPECT_NEAR(static_cast<double>(twice.steps), 2.0 * static_cast<double>(plan.steps),
                0.1 * static_cast<double>(plan.steps));
    EXPECT_EQ(make_plan(case_with({"drive.max_steps=7"}), 1).steps, 7);
    const Plan timeless = make_plan(case_with({"drive.path=zero-load"}), 1);
    EXPECT_EQ(timeless.steps, 0);
    EXPECT_GT(timeless.iterations, 0);
    EXPECT_EQ(timeless.cost(Effect::inertia).bytes, 0.0);
    EXPECT_LT(timeless.bytes, plan.bytes);
}

TEST(Plan, AllWorkIsSharedAmongTheThreads) {
    // Rates are measured anew for each plan: against a factor of a million they do not matter.
    constexpr int many = 1'000'000;
    const Case c = case_with({"block.thickness=32", "output.checkpoint=0"});
    const Plan one = make_plan(c, 1), shared = make_plan(c, many);
    const auto expect_shared = [&](const EffectCost& cost, const EffectCost& alone) {
        EXPECT_GT(alone.seconds, 0.0);
        EXPECT_LT(shared.threads * cost.seconds, 1e3 * alone.seconds);
        EXPECT_GT(shared.threads * cost.seconds, 1e-3 * alone.seconds);
    };
    expect_shared(shared.interface, one.interface);
    for (const Effect effect : {Effect::inertia, Effect::relaxation, Effect::observation})
        expect_shared(shared.cost(effect), one.cost(effect));
}
