// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Memory is counted before it is taken: the counts are those of the objects, and what does not fit
// is refused before anything is allocated.
#include "engine/setup/memory.hpp"

#include "engine/equilibrium/zero_load.hpp"
#include "engine/run/plan.hpp"
#include "engine/run/run.hpp"
#include "io/error.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include <malloc.h>

namespace asperity {
namespace {

Scene scene_with(const std::vector<std::string>& overrides) {
    return read_scene_text("[surface]\nsites = 96\nrms = 1.0\n[block]\nthickness = 24\n",
                           "test.toml", overrides);
}

TEST(Memory, IsThatOfTheObjects) {
    for (const std::vector<std::string>& what : std::vector<std::vector<std::string>>{
             {},
             {"block.model=lattice"},
             {"block.seams=absorb"},
             {"interface.tail=true"},
             {"numerics.precision=mixed"},
             {"surface.lattice_ratio=1.618"},
             {"surface.lattice_ratio=2.3", "numerics.precision=mixed"}}) {
        const Scene scene = scene_with(what);
        const std::string name = what.empty() ? "plain" : what.front();
        const auto setup = make_setup(scene, 1);
        const ProcessGrid grid = make_grid(scene, setup, 1, 0);
        const MemoryNeed need = memory_of_rank(scene, setup, 1, 0, 1);
        const Surface surface = scene_surface(scene);
        EXPECT_EQ(need.surface, static_cast<double>(surface.height.size() * sizeof(double)));
        const Simulation s(setup.simulation, surface, Communicator(), grid);
        EXPECT_EQ(need.interface, static_cast<double>(s.interface().bytes())) << name;
        EXPECT_EQ(need.block + need.motion,
                  static_cast<double>(s.block().bytes() - s.block().absorption_bytes()))
            << name;
    }
    for (const std::vector<std::string>& what : std::vector<std::vector<std::string>>{
             {"drive.path=zero-load"}, {"drive.path=zero-load", "interface.frictionless=true"}}) {
        const Scene scene = scene_with(what);
        const auto setup = make_setup(scene, 1);
        const MemoryNeed need = memory_of_rank(scene, setup, 1, 0, 1);
        const SpectralBlock block(setup.simulation.block, Communicator(),
                                  scene.interface.frictionless);
        // The inverse of S(q) is made with the first relaxation.
        const auto made = static_cast<double>(block.bytes());
        EXPECT_GE(need.block, made) << what.back();
        EXPECT_LE(need.block, 1.5 * made) << what.back();
        EXPECT_EQ(need.motion, 0.0);
    }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // have allocators of their own

namespace {

double in_use() {
    const struct mallinfo2 info = ::mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

/// The most that is allocated at once while work() is done, beyond what was before.
double most_allocated(const std::function<void()>& work) {
    const double before = in_use();
    std::atomic<bool> done = false;
    double most = 0.0;
    std::thread watch([&] {
        while (!done) {
            most = std::max(most, in_use() - before);
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    });
    work();
    done = true;
    watch.join();
    return most;
}

} // namespace

TEST(Memory, IsWhatARunAllocates) {
    // Fields of 2 MB each, beside which files and plans are small. In time with a state, which is
    // relaxed beside the guard's snapshot; and at rest.
    const std::vector<std::string> in_time = {
        "surface.sites=64",   "surface.rms=0.3",     "block.thickness=48", "block.model=lattice",
        "drive.velocity=800", "drive.timestep=20",   "drive.ramp=0",       "drive.tolerance=1e-2",
        "output.series=100",  "drive.path=approach", "output.fields=[]",   "output.checkpoint=0"};
    std::vector<std::string> at_rest = in_time;
    for (const char* key : {"surface.sites=256", "drive.path=zero-load"})
        at_rest.emplace_back(key);
    std::vector<std::string> coarser = in_time;
    for (const char* key :
         {"block.model=multiscale", "block.layers_per_level=16", "block.thickness=112"})
        coarser.emplace_back(key);
    for (const auto& keys : {in_time, at_rest, coarser}) {
        const Scene scene = scene_with(keys);
        const MemoryNeed need = memory_of_rank(scene, make_setup(scene, 1), 1, 0, 1);
        const io::Scratch scratch;
        const double most = most_allocated([&] { test::run_scene(scene, scratch / "out"); });
        EXPECT_NEAR(most / need.most(), 1.0, 0.08) << keys.back();
    }
}

#endif

TEST(Memory, RanksShareTheBlockAndHaveTheSurfaceEach) {
    const Scene scene = scene_with({});
    const auto setup = make_setup(scene, 4);
    const MemoryNeed one = memory_of(scene, setup, 1, 1), four = memory_of(scene, setup, 4, 1);
    EXPECT_EQ(four.surface, 4.0 * one.surface);
    EXPECT_EQ(four.making, 4.0 * one.making);
    EXPECT_LT(four.block, 2.0 * one.block) << "halos";
}

TEST(Memory, WhatDoesNotFitIsRefusedBeforeItIsMade) {
    const Scene scene = scene_with({"surface.sites=32768", "block.thickness=32768",
                                    "block.model=lattice", "surface.cutoff=16384"});
    try {
        RunOptions options;
        options.out = "no-such-directory";
        run(scene, options, Communicator());
        ADD_FAILURE() << "it ran";
    } catch (const io::SceneError& error) {
        const io::Problem& p = error.problems().front();
        EXPECT_NE(p.what.find("the run does not fit into memory"), std::string::npos) << p.what;
        EXPECT_NE(p.fix.find("multiscale"), std::string::npos) << p.fix;
    }
    EXPECT_FALSE(std::filesystem::exists("no-such-directory"));
    // A plan makes neither the surface nor the block.
    const Plan plan = make_plan(scene, 1, 1);
    EXPECT_GT(plan.bytes, 1e15);
    EXPECT_GT(plan.seconds, 0.0);
    EXPECT_GT(plan.steps, 0);
}

TEST(Memory, PlansOfLargeScenesGoOnFromThoseOfSmallOnes) {
    // Below and above the size up to which the surface itself is made.
    const auto of = [](const char* sites, const char* rolloff, const char* cutoff) {
        return make_plan(scene_with({sites, rolloff, cutoff, "drive.path=zero-load"}), 1, 1);
    };
    const Plan small = of("surface.sites=512", "surface.rolloff=3", "surface.cutoff=256");
    const Plan large = of("surface.sites=1024", "surface.rolloff=6", "surface.cutoff=512");
    EXPECT_NEAR(large.bytes / small.bytes, 4.0, 0.1);
    EXPECT_EQ(large.iterations, small.iterations);
}

} // namespace
} // namespace asperity
