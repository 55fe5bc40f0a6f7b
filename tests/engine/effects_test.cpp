// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Effects are switched by the keys of the scene, which they name; one that is off makes no call.
#include "engine/case/case.hpp"
#include "kernels/variant.hpp"
#include "support/atoms.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

using namespace asperity;

namespace {

using Keys = std::vector<std::string>;

Case case_with(const Keys& keys) {
    std::string text = "[surface]\nsites = 16\nrms = 1.0\n";
    if (std::find(keys.begin(), keys.end(), "surface.kind=atoms") != keys.end())
        text = "[surface]\nsites = 16\n";
    return read_case_text(text, "test.toml", keys);
}

/// Writes a flat map of 16 x 16 points. Returns its path.
std::string flat_map(const std::string& file) {
    std::ofstream out(file);
    for (int y = 0; y < 16; ++y)
        out << "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n";
    return file;
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

TEST(Effects, WhatAKeySwitchesNamesIt) {
    // Every effect is switched by a key of this list, and then says so.
    const io::Scratch scratch;
    io::AtomsFile layer{{"Au"}, {}, 41.6, 41.6, {}, {}, {}};
    for (int i = 0; i < 256; ++i) {
        layer.type.push_back(0);
        layer.x.push_back(2.6 * (i % 16));
        layer.y.push_back(2.6 * (i / 16));
        layer.z.push_back(0.0);
    }
    const std::string atoms = write_atoms(scratch / "atoms.h5", layer);
    const std::string counter = "surface.counter=" + flat_map(scratch / "counter.txt");
    const Keys plain = {"drive.damping=1e-6", "block.model=lattice", "output.fields=[]",
                        "output.checkpoint=none", "block.thickness=16"};
    const Keys rest = {"drive.path=relax"}, relaxing = {"drive.mode=quasistatic"},
               wall = {"drive.mode=quasistatic", "interface.kind=wall"};
    struct Row {
        const Keys& with;
        const char* key;
    };
    std::set<std::string> switched;
    for (const Row& row : {Row{plain, "drive.path=relax"},
                           {plain, "drive.damping=0"},
                           {plain, "drive.temperature=100"},
                           {plain, "block.strain=finite"},
                           {plain, "block.model=multiscale"},
                           {plain, "drive.path=[\"approach\", \"slide x 1 Å\"]"},
                           {plain, "interface.tail=true"},
                           {plain, "surface.radius=200"},
                           {plain, "output.fields=[\"pull-off\"]"},
                           {plain, "output.fields=[\"after-approach:3\"]"},
                           {plain, "output.trajectory=10"},
                           {plain, "output.checkpoint=1"},
                           {plain, "numerics.device=emulated"},
                           {rest, "interface.frictionless=true"},
                           {rest, "interface.kind=wall"},
                           {relaxing, "block.prony=[[2.0, \"1 ns\"]]"},
                           {relaxing, "block.layers=[[\"1 nm\", \"10 GPa\", 0.3]]"},
                           {relaxing, "block.surface_stress=0.1"},
                           {relaxing, "drive.stiffness=0.2"},
                           {wall, "interface.adhesion=stripes 1 9 20"},
                           {wall, "interface.hardness=1"},
                           {wall, counter.c_str()},
                           {wall, "surface.boundary=free"}}) {
        const std::string text = row.key;
        if (text.starts_with("numerics.device") && !fuses(processor_level())) {
            switched.insert("device"); // refused: no fused multiply-add here
            continue;
        }
        Keys keys = row.with;
        keys.emplace_back(row.key);
        const std::string key = text.substr(0, text.find('='));
        const auto without = case_with(row.with).effects.list(),
                   with = case_with(keys).effects.list();
        for (std::size_t i = 0; i < with.size(); ++i) {
            const auto& [name, effect] = with[i];
            EXPECT_FALSE(effect.why.empty()) << name;
            if (effect.on == without[i].second.on) continue;
            switched.insert(name);
            EXPECT_NE(effect.why.find(key), std::string::npos)
                << text << " switches " << name << ", and it says: " << effect.why;
        }
    }
    for (const auto& [name, effect] : case_with({}).effects.list())
        EXPECT_TRUE(switched.contains(name) || std::string(name) == "theory") << name;
    const Effect theory = case_with({"surface.kind=atoms", "surface.file=" + atoms}).effects.theory;
    EXPECT_FALSE(theory.on);
    EXPECT_NE(theory.why.find("surface.kind"), std::string::npos);
}

TEST(Effects, OffMakesNoCall) {
    const io::Scratch scratch;
    const std::string counter = "surface.counter=" + flat_map(scratch / "counter.txt");
    // Short runs, each with and without the effect's key. An effect that is off leaves no trace.
    const Keys moving = {"block.thickness=8",  "block.model=lattice", "drive.max_steps=20",
                         "output.series=1",    "output.fields=[]",    "output.checkpoint=none",
                         "drive.velocity=400", "drive.ramp=0"},
               still = {"block.thickness=16", "drive.mode=quasistatic",
                        "drive.path=[\"height 3.2\"]", "interface.kind=wall", "output.fields=[]"},
               state = {"block.thickness=16", "drive.path=relax"},
               state_of_wall = {"block.thickness=16", "drive.path=relax", "interface.kind=wall"},
               sphere = {"surface.kind=flat",    "surface.radius=100",  "interface.kind=wall",
                         "interface.adhesion=5", "interface.range=0.3", "drive.path=relax"};
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
        {&Effects::site_maps,
         {"block.thickness=16", "drive.path=relax", "interface.kind=wall"},
         "interface.adhesion=stripes 1 9 20",
         "",
         "/fields/relaxed/adhesion"},
        {&Effects::counter, state_of_wall, counter.c_str(), "", "surface.counter.file_digest"},
        {&Effects::spring, still, "drive.stiffness=0.2", "", "/series/spring_energy"},
        {&Effects::free_edges, sphere, "surface.boundary=free", "", "instrument.edge_distance"},
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
