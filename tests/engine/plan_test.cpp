// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a plan says of a run follows the scene, and is what runs take: their time here, their memory
// in tests/python/test_result.py.
#include "engine/interface/interface.hpp"
#include "engine/path/expected_path.hpp"
#include "engine/plan/plan.hpp"
#include "engine/script/stepped_path.hpp"
#include "io/hdf5_file.hpp"
#include "io/terminal.hpp"
#include "support/cases.hpp"
#include "support/message.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <utility>

using namespace asperity;

namespace {

Case planned(const std::vector<std::string>& overrides, int ranks = 1) {
    return read_case_text("[surface]\nsites = 32\nrms = 1.0\n", "test.toml", overrides, ranks);
}
double bytes_of(const Plan& plan) {
    return std::accumulate(plan.bytes_of_rank.begin(), plan.bytes_of_rank.end(), 0.0);
}

} // namespace

TEST(Plan, MemoryGrowsWithTheSitesAndTheNodes) {
    const auto bytes = [](const std::vector<std::string>& keys) {
        return bytes_of(make_plan(planned(keys), 0));
    };
    const std::string rest = "drive.path=relax";
    EXPECT_NEAR(bytes({"surface.sites=1024", rest}) / bytes({"surface.sites=512", rest}), 4.0, 0.1);
    // Against a piece that is the case itself.
    EXPECT_NEAR(bytes({"surface.sites=512", rest}) / bytes({"surface.sites=256", rest}), 4.0, 0.2);
    const std::vector<std::string> lattice = {"surface.sites=64", "block.model=lattice"};
    const auto block = [&](const char* layers) {
        std::vector<std::string> keys = lattice;
        keys.emplace_back(layers);
        return make_plan(planned(keys), 0).bytes[Piece::block];
    };
    EXPECT_NEAR(block("block.thickness=200") / block("block.thickness=100"), 2.0, 0.05);
}

TEST(Plan, RanksShareTheSurfaceTheBlockAndTheMaps) {
    const Plan alone = make_plan(planned({"surface.sites=96"}), 0),
               shared = make_plan(planned({"surface.sites=96"}, 4), 0);
    EXPECT_NEAR(shared.bytes[Piece::surface] / alone.bytes[Piece::surface], 1.0, 1e-9);
    EXPECT_EQ(alone.bytes[Piece::surface], 8.0 * 96 * 96);
    EXPECT_NEAR(shared.bytes[Piece::maps] / alone.bytes[Piece::maps], 1.0, 0.1);
    for (const Piece::Part part : {Piece::block, Piece::rest}) {
        EXPECT_GT(shared.bytes[part], alone.bytes[part]) << "halos; waves that ranks exchange";
        EXPECT_LT(shared.bytes[part], 1.2 * alone.bytes[part]);
    }
}

TEST(Plan, ARankAndTheFilesAreThere) {
    const Case c = planned({"surface.sites=96", "output.trajectory=10"}, 4);
    const Plan plan = make_plan(c, 1);
    const auto json = plan_json(c, 1, plan);
    EXPECT_EQ(json["sites_of_rank"], (nlohmann::ordered_json{48, 48}));
    const double rank = json["bytes"]["rank"], all = json["bytes"]["altogether"];
    EXPECT_GE(rank, 0.249 * all);
    EXPECT_LT(rank, 0.5 * all);
    EXPECT_EQ(json["bytes"]["state"], 49.0 * 96 * 96);
    EXPECT_EQ(json["bytes"]["frame"], 12.0 * 96 * 96);
    EXPECT_EQ(make_plan(planned({"surface.sites=96"}), 0).frame_bytes, 0.0);
}

/// The bytes of a state are those of its maps in run.h5.
TEST(Plan, AStateTakesWhatIsWritten) {
    const std::vector<std::string> rest = {"drive.path=relax"},
                                   wall = {"interface.kind=wall", "drive.mode=quasistatic"};
    std::vector<std::string> path = wall;
    path.insert(path.end(), {"drive.control=mean-height", "drive.path=[\"approach\"]",
                             "output.fields=[\"segments\"]"});
    using Keys = std::vector<std::string>;
    const std::vector<std::pair<Keys, Keys>> scenes = {
        {rest, {}},
        {rest, wall},
        {path, {"interface.hardness=5"}},
        {path, {"interface.hardness=rings 5 0.5 20 Å", "interface.adhesion=stripes 10 50 20 Å"}}};
    for (const auto& [first, more] : scenes) {
        Keys keys = {"block.thickness=16"};
        keys.insert(keys.end(), first.begin(), first.end());
        keys.insert(keys.end(), more.begin(), more.end());
        const Case c = planned(keys);
        const io::Scratch scratch;
        test::run_scene(c, scratch / "out");
        const io::Hdf5File file(scratch / "out/run.h5", io::Hdf5File::Mode::read);
        const std::string state = "/fields/" + file.members("/fields").front() + "/";
        double bytes = 0.0;
        for (const std::string& name : file.members(state))
            if (file.shape(state + name).size() == 2)
                bytes += (name == "contact" ? 1.0 : 8.0) * 32 * 32;
        EXPECT_EQ(make_plan(c, 0).state_bytes, bytes) << keys.back();
    }
}

/// The plan's heights of a rank are those that the rank holds.
TEST(Plan, HeightsOfARankAreThoseHeld) {
    for (const std::vector<std::string>& keys : std::vector<std::vector<std::string>>{
             {"drive.path=relax"},
             {"drive.path=relax", "interface.kind=wall"},
             {"drive.mode=quasistatic", "drive.path=[\"approach\", \"slide x 2 Å\"]"}}) {
        std::vector<std::string> wide = keys;
        wide.insert(wide.end(), {"surface.sites=512", "block.thickness=16"});
        const Case c = planned(wide, 8);
        const Plan plan = make_plan(c, 0);
        const Surface surface = surface_of(c);
        double held = 0.0;
        for (int rank = 0; rank < 8; ++rank)
            held +=
                static_cast<double>(Interface(surface, c.grid(rank).tile(0),
                                              c.simulation.block.spacing, c.simulation.interface)
                                        .bytes());
        EXPECT_NEAR(plan.bytes[Piece::interface] / held, 1.0, 0.1) << keys.back();
        EXPECT_EQ(plan.bytes[Piece::surface], 8.0 * 512 * 512);
        EXPECT_EQ(plan.whole.size(), keys[0] != "drive.path=relax" ? 1u : 0u);
    }
}

/// The solver of points over a wall has more arrays than that of a state, wherever a path begins.
TEST(Plan, PathsOverAWallTakeTheirSolver) {
    const auto bytes = [](const char* path) {
        return bytes_of(
            make_plan(planned({"surface.sites=256", "interface.kind=wall", "drive.mode=quasistatic",
                               "output.fields=[]", std::string("drive.path=") + path}),
                      0));
    };
    const double approach = bytes("[\"approach\", \"pull-off\"]");
    EXPECT_GT(approach, 1.2 * bytes("[\"relax\"]"));
    EXPECT_NEAR(bytes("[\"relax\", \"pull-off\"]") / approach, 1.0, 0.02);
    EXPECT_NEAR(bytes("[\"load 100 MPa\", \"pull-off\"]") / approach, 1.0, 0.02);
}

TEST(Plan, NodesHoldSoManyRanks) {
    const Case c = planned({"surface.sites=96"}, 4);
    const Plan plan = make_plan(c, 0);
    const double largest = *std::max_element(plan.bytes_of_rank.begin(), plan.bytes_of_rank.end());
    const auto ranks_of = [&](double node) {
        return plan_json(c, 1, plan, node)["ranks_of_node"].get<int>();
    };
    EXPECT_EQ(ranks_of(0.99 * largest), 0);
    EXPECT_EQ(ranks_of(2.01 * largest), 2);
    EXPECT_EQ(ranks_of(100.0 * largest), 4);
    EXPECT_FALSE(plan_json(c, 1, plan).contains("ranks_of_node"));
    EXPECT_EQ(io::parse_memory("64GB"), 64e9);
    EXPECT_EQ(io::parse_memory("0.5 TiB"), 0x1p39);
    for (const char* none : {"", "64", "GB", "-1GB", "64 GBs", "64gb", "0GB"})
        EXPECT_FALSE(io::parse_memory(none)) << none;
}

TEST(Plan, WhatTheSceneDoesNotCallForTakesNothing) {
    const Plan finite =
        make_plan(planned({"output.fields=[]", "block.strain=finite", "block.thickness=8"}), 1);
    EXPECT_EQ(finite.bytes[Piece::maps], 0.0);
    EXPECT_EQ(finite.bytes[Piece::rest], 0.0) << "no state at finite strain";
    EXPECT_GT(finite.bytes[Piece::kept], 0.0);
    const Plan rest = make_plan(planned({"drive.path=relax"}), 1);
    EXPECT_EQ(rest.bytes[Piece::kept], 0.0);
    EXPECT_EQ(rest.steps, 0);
    EXPECT_EQ(rest.moving, 0.0);
    EXPECT_GT(rest.rest, 0.0);
}

TEST(Plan, WhatDoesNotFitIsRefusedBeforeItIsMade) {
    const Case c = planned({"surface.sites=32768", "block.thickness=32768", "block.model=lattice",
                            "surface.q_max=16384"});
    const std::string refused =
        test::message_of<io::SceneError>([&] { require_memory(c, Communicator()); });
    EXPECT_TRUE(test::has(refused, "the run does not fit into memory")) << refused;
    EXPECT_TRUE(test::has(refused, "multiscale")) << refused;
    // A plan makes neither the surface nor the block.
    const Plan plan = make_plan(c, 1);
    EXPECT_GT(bytes_of(plan), 1e15);
    EXPECT_GT(plan.moving, 0.0);
    EXPECT_GT(plan.steps, 0);
}

TEST(Plan, StepsFollowThePathAndAllWorkIsSharedAmongTheThreads) {
    const std::string thin = "block.thickness=32";
    const Plan plan = make_plan(planned({thin}), 1);
    // Down and up 13.12 Å and more at 5 m/s in steps of 10 fs.
    const double least = 2.0 * 13.12 / 5e-5 / 10.0, steps = static_cast<double>(plan.steps);
    EXPECT_GT(steps, least);
    EXPECT_LT(steps, 2.0 * least);
    const Plan slow = make_plan(planned({thin, "drive.velocity=2.5"}), 1);
    EXPECT_NEAR(static_cast<double>(slow.steps), 2.0 * steps, 0.1 * steps);
    EXPECT_EQ(make_plan(planned({thin, "drive.max_steps=7"}), 1).steps, 7);
    // Times are measured anew for each plan: against a factor of a million they do not matter.
    constexpr int many = 1'000'000;
    const Plan shared = make_plan(planned({thin}), many);
    for (double Plan::*time : {&Plan::making, &Plan::moving, &Plan::rest})
        EXPECT_NEAR(std::log10(plan.*time / shared.*time), 6.0, 2.0);
}

TEST(Plan, PathsAndStatesTakeTheTimeThatItSays) {
    // Twice as wide as a piece. In processor time, which other programs hardly change.
    omp_set_num_threads(1);
    const std::string path = "drive.mode=quasistatic";
    for (const auto& keys : std::vector<std::vector<std::string>>{
             {path, "surface.sites=48", "surface.rms=1.5"},
             {path, "drive.control=mean-height", "interface.kind=wall"},
             {"drive.path=relax", "surface.sites=256", "surface.rms=3"}}) {
        const Case c = planned(keys);
        const Plan plan = make_plan(c, 1);
        const io::Scratch scratch;
        const std::clock_t begin = std::clock();
        test::run_scene(c, scratch / "out");
        const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        EXPECT_LT(plan.rest, 3.0 * took) << keys.back();
        EXPECT_GT(plan.rest, took / 3.0) << keys.back();
    }
}

/// The drive stretches a soft spring before the solids part, however little they move; and a path
/// of which the plan made a piece only takes as much more time as it has more points.
TEST(Plan, ASoftSpringIsAWay) {
    const std::vector<std::string> wall = {"surface.sites=16",       "interface.kind=wall",
                                           "interface.adhesion=3",   "interface.range=3",
                                           "drive.mode=quasistatic", "block.young=10",
                                           "block.thickness=16"};
    const auto with = [&](const std::string& stiffness) {
        std::vector<std::string> keys = wall;
        keys.push_back("drive.stiffness=" + stiffness);
        return planned(keys);
    };
    const Case c = with("2e-3");
    const BlockOptions& block = c.simulation.block;
    const double of_block =
                     block.modulus_of_compression() * c.area() / (block.thickness * block.spacing),
                 stretch =
                     c.smooth_pull_off() * (1.0 / block.top_spring.stiffness + 1.0 / of_block);
    EXPECT_NEAR(c.smooth_pull_off(), 1e-3 * 3.0 / 3.0 * c.area(), 0.02 * c.area() * 1e-3);
    EXPECT_NEAR(expected_path(c, 10.0).ways.back(), 0.5 * stretch, 1e-9 * stretch);
    const Case soft = with("1e-4");
    const Plan plan = make_plan(soft, 1);
    if (!plan.ended) {
        EXPECT_GT(plan.rest, 4.0); // a piece has 1.5 s
    }
    EXPECT_TRUE(soft.refused.empty());
    const Case softer = with("1e-6");
    ASSERT_EQ(softer.refused.size(), 1u);
    EXPECT_NE(softer.refused[0].what.find("drive.stiffness"), std::string::npos);
}
