// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Effects are switched by the keys of the scene; one that is off makes no call.
#include "engine/setup/case.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

using namespace asperity;

namespace {

using Keys = std::vector<std::string>;

Case case_with(const Keys& keys) {
    return read_case_text("[surface]\nsites = 16\nrms = 1.0\n", "test.toml", keys);
}

} // namespace

TEST(Effects, EachIsSwitchedByItsKey) {
    const Keys plain = {"drive.damping=1e-6", "block.model=lattice", "output.fields=[]",
                        "output.checkpoint=none", "block.thickness=16"};
    const Keys rest = {"drive.path=relax"}, relaxing = {"drive.mode=quasistatic"};
    struct Row {
        Effect Effects::*effect;
        const Keys& with;
        const char *on, *off;
    };
    for (const Row& row :
         {Row{&Effects::inertia, plain, "", "drive.path=relax"},
          {&Effects::lateral, rest, "", "interface.frictionless=true"},
          {&Effects::damping, plain, "", "drive.damping=0"},
          {&Effects::temperature, plain, "drive.temperature=100", ""},
          {&Effects::finite_strain, plain, "block.strain=finite", ""},
          {&Effects::coarse_levels, plain, "block.model=multiscale", ""},
          {&Effects::skipping, rest, "", "interface.kind=wall"},
          {&Effects::sliding, plain, "drive.path=[\"approach\", \"slide x 1 Å\"]", ""},
          {&Effects::tail, plain, "interface.tail=true", ""},
          {&Effects::curvature, plain, "surface.radius=200", ""},
          {&Effects::branches, relaxing, "block.prony=[[2.0, \"1 ns\"]]", ""},
          {&Effects::relaxation, plain, "", "block.strain=finite"},
          {&Effects::observation, plain, "", "drive.path=relax"},
          {&Effects::maps, plain, "output.fields=[\"pull-off\"]", ""},
          {&Effects::maps, plain, "output.fields=[\"after-approach:3\"]", ""},
          {&Effects::trajectory, plain, "output.trajectory=10", ""},
          {&Effects::checkpoints, plain, "output.checkpoint=1", ""}}) {
        for (const bool on : {true, false}) {
            Keys keys = row.with;
            if (const char* key = on ? row.on : row.off; *key) keys.emplace_back(key);
            const Effect effect = case_with(keys).effects.*row.effect;
            EXPECT_EQ(effect.on, on) << row.on << row.off;
            EXPECT_FALSE(effect.why.empty()) << row.on << row.off;
        }
    }
}

TEST(Effects, OffMakesNoCall) {
    // Two runs of 20 steps in contact: the phases of their steps, their files and their sums.
    const auto run_with = [](Keys keys) {
        keys.insert(keys.end(), {"block.thickness=32", "drive.max_steps=20", "output.series=1",
                                 "drive.velocity=400", "drive.ramp=0"});
        return test::Written(case_with(keys).scene);
    };
    const test::Written off = run_with({"drive.damping=0", "block.model=lattice",
                                        "output.fields=[]", "output.checkpoint=none"}),
                        on = run_with({"drive.damping=0.2", "drive.temperature=100",
                                       "output.fields=[\"every:5\"]", "output.trajectory=5"});
    for (const char* phase : {"thermostat", "interpolate", "checkpoint"}) {
        EXPECT_FALSE(off.holds(std::string("run.phases.") + phase)) << phase;
        EXPECT_TRUE(on.holds(std::string("run.phases.") + phase)) << phase;
    }
    for (const char* group : {"/fields", "/particles"}) {
        EXPECT_FALSE(off.file->exists(group)) << group;
        EXPECT_TRUE(on.file->exists(group)) << group;
    }
    EXPECT_EQ(off("energy.damped"), 0.0);
    EXPECT_NE(on("energy.damped"), 0.0); // net of the noise: of either sign
}
