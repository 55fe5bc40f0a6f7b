// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Effects are switched by the keys of the scene; one that is off makes no call.
#include "engine/case/case.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

using namespace asperity;

namespace {

using Keys = std::vector<std::string>;

Case case_with(const Keys& keys) {
    return read_case_text("[surface]\nsites = 16\nrms = 1.0\n", "test.toml", keys);
}

/// What an effect leaves in a result: a phase of its steps, a data set, or a number.
struct Trace {
    Effect Effects::*effect;
    Keys scene; ///< of both runs
    const char *on, *off;
    const char* leaves; ///< "run.phases.x" and the like in result.json, "/x" in run.h5
};

/// Returns whether the trace is there; a number that is zero is none.
bool leaves(const test::Written& run, const std::string& what) {
    if (what.front() == '/') return run.file->exists(what);
    const io::Json* const found = io::find(run.json, what);
    return found && !(found->is_number() && found->get<double>() == 0.0);
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
         {Row{&Effects::dynamic, plain, "", "drive.path=relax"},
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
          {&Effects::layers, relaxing, "block.layers=[[\"1 nm\", \"10 GPa\", 0.3]]", ""},
          {&Effects::surface_stress, relaxing, "block.surface_stress=0.1", ""},
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
    // Short runs, each with and without the effect's key. An effect that is off leaves no trace.
    const Keys moving = {"block.thickness=8",  "block.model=lattice", "drive.max_steps=20",
                         "output.series=1",    "output.fields=[]",    "output.checkpoint=none",
                         "drive.velocity=400", "drive.ramp=0"},
               still = {"block.thickness=16", "drive.mode=quasistatic",
                        "drive.path=[\"height 3.2\"]", "interface.kind=wall", "output.fields=[]"},
               state = {"block.thickness=16", "drive.path=relax"};
    const std::vector<Trace> traces = {
        {&Effects::dynamic,
         {"block.thickness=16", "drive.max_steps=20"},
         "",
         "drive.mode=quasistatic",
         "run.phases.exchange"},
        {&Effects::damping, moving, "drive.damping=0.2", "drive.damping=0", "energy.damped"},
        {&Effects::temperature, moving, "drive.temperature=100", "", "run.phases.thermostat"},
        {&Effects::coarse_levels,
         {"block.thickness=32", "drive.max_steps=20"},
         "",
         "block.model=lattice",
         "run.phases.interpolate"},
        {&Effects::sliding, moving, "drive.path=[\"approach\", \"slide x 1 Å\"]", "",
         "/series/slide_x"},
        {&Effects::branches, still, "block.prony=[[2.0, \"1 ns\"]]", "", "/series/branch_energy"},
        {&Effects::relaxation,
         {"block.thickness=8", "block.model=lattice", "drive.max_steps=20"},
         "drive.path=relax",
         "block.strain=finite",
         "binding_energy"},
        {&Effects::observation,
         {"block.thickness=16"},
         "drive.max_steps=5",
         "drive.path=relax",
         "run.phases.observe"},
        {&Effects::maps, moving, "output.fields=[\"every:5\"]", "", "/fields"},
        {&Effects::trajectory, moving, "output.trajectory=5", "", "/particles"},
        {&Effects::checkpoints, moving, "output.checkpoint=0.0001", "", "run.phases.checkpoint"},
    };
    for (const Trace& trace : traces)
        for (const bool on : {true, false}) {
            Keys keys = trace.scene;
            if (const char* key = on ? trace.on : trace.off; *key) keys.emplace_back(key);
            const Case c = case_with(keys);
            ASSERT_EQ((c.effects.*trace.effect).on, on) << trace.leaves;
            EXPECT_EQ(leaves(test::Written(c.scene), trace.leaves), on) << trace.leaves;
        }
}
