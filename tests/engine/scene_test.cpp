// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The scene against its contract: names, defaults, contradictions.
#include "engine/case/case.hpp"
#include "engine/run/series.hpp"
#include "io/json.hpp"
#include "io/quantities.hpp"
#include "kernels/device/device.hpp"
#include "kernels/variant.hpp"
#include "support/message.hpp"
#include "support/scratch.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace asperity {
namespace {

std::vector<io::Problem> wrong(const std::string& text,
                               const std::vector<std::string>& overrides = {}) {
    try {
        read_case_text(text, "s.toml", overrides);
    } catch (const io::SceneError& error) {
        return error.problems();
    }
    return {};
}

io::Problem only(const std::string& text, const std::vector<std::string>& overrides = {}) {
    const auto problems = wrong(text, overrides);
    EXPECT_EQ(problems.size(), 1u) << text;
    for (std::size_t i = 1; i < problems.size(); ++i)
        ADD_FAILURE() << format(problems[i]);
    return problems.empty() ? io::Problem{} : problems.front();
}

TEST(Scene, EveryKeyIsDescribedAndTheDefaultsAreAScene) {
    Scene scene;
    const io::Schema schema = bind(scene);
    for (const io::Schema::Key& key : schema.keys())
        EXPECT_FALSE(key.doc.empty()) << key.path();
    EXPECT_TRUE(wrong("").empty());
}

TEST(Scene, QuantitiesInTheUnitsOfTheContract) {
    const Scene s = read_scene_text(R"(
[surface]
rms = "0.3 nm"
radius = "441 nm"
sites = 64
[block]
young = "77200 MPa"
[interface]
epsilon = "100 meV"
[drive]
velocity = "0.05 Å/ps"
timestep = "0.02 ps"
load = "1 kPa"
ramp = "20 ps"
[theory]
delta_gamma = "0.1 eV/Å^2"
[output]
checkpoint = "5 min"
trajectory = 1000
)",
                                    "dir/my.scene.toml");
    EXPECT_EQ(s.surface.rms, 3.0);
    EXPECT_TRUE(s.gives_rms());
    EXPECT_EQ(s.surface.radius, 4410.0);
    EXPECT_EQ(s.block.thickness, 64); // follows N
    EXPECT_EQ(s.block.young, 77.2);
    EXPECT_EQ(std::get<LennardJones>(s.interface.potentials).epsilon, 0.1);
    EXPECT_EQ(s.drive.velocity, 5.0);
    EXPECT_EQ(s.drive.timestep, 20.0);
    EXPECT_EQ(s.drive.load, 0.001);
    EXPECT_EQ(s.drive.ramp, 20.0);
    EXPECT_EQ(s.theory.delta_gamma, 100.0);
    EXPECT_EQ(s.output.checkpoint, 300.0);
    EXPECT_EQ(s.output.trajectory, 1000);
    EXPECT_EQ(s.name, "my.scene");
}

TEST(Scene, WrittenBackItIsTheSameScene) {
    const Scene s = read_scene_text("surface.sites = 96\nsurface.radius = \"100 nm\"\n"
                                    "drive.path = [\"relax\"]\nblock.model = \"lattice\"\n",
                                    "s.toml");
    const Scene t = read_scene_text(scene_toml(s), "t.toml");
    EXPECT_EQ(scene_toml(s, false), scene_toml(t, false));
    EXPECT_EQ(scene_json(s), scene_json(t));
    EXPECT_EQ(scene_json(t)["block"]["thickness"], 96);
    EXPECT_EQ(scene_json(t)["surface"]["radius"], 1000.0);
}

TEST(Scene, Contradictions) {
    io::Problem p = only("[interface]\ncutoff = 40.0\n[surface]\nsites = 16\n");
    EXPECT_EQ(p.where, "s.toml:2:10");
    EXPECT_EQ(p.what, "interface.cutoff = 40 Å is more than half the box");
    EXPECT_EQ(p.fix, "take a cutoff of 20.8 Å at most, or surface.sites = 31 at least");
    p = only("[surface]\nsites = 8\nrolloff = 1\n");
    EXPECT_EQ(p.where, "s.toml:2:9"); // the cutoff has its default, so the box is to blame
    p = only("", {"surface.sites=8"});
    EXPECT_EQ(p.where, "--set surface.sites=8");
    EXPECT_EQ(only("[interface]\ncutoff = 3.0\n").what,
              "interface.cutoff = 3 Å leaves no attraction");
    EXPECT_EQ(only("[surface]\nrolloff = 600\n").where, "s.toml:2:11");
    EXPECT_EQ(only("[surface]\nrolloff = 300\n").what, "surface.rolloff = 300 is beyond Nyquist");
    EXPECT_EQ(only("[surface]\nradius = \"50 nm\"\n").what,
              "surface.radius = 500 Å is less than half the diagonal of the box");
    EXPECT_EQ(only("[drive]\ntemperature = 300\ndamping = 0\n").where, "s.toml:2:15");
    EXPECT_EQ(only("[output]\nfields = [\"pull-off\"]\n[drive]\npath = [\"approach\"]\n").where,
              "s.toml:2:10");
    EXPECT_EQ(only("[output]\ntrajectory = 10\n[drive]\npath = [\"relax\"]\n").where,
              "s.toml:2:14"); // frames are taken over time
    only("[output]\ntrajectory = 10\n[drive]\nmode = \"quasistatic\"\n");
}

TEST(Scene, Paths) {
    EXPECT_TRUE(wrong("drive.path = [\"approach\"]").empty());
    EXPECT_TRUE(wrong("drive.path = [\"relax\"]").empty());
    EXPECT_TRUE(wrong("drive.path = [\"relax\", \"pull-off\"]").empty());
    EXPECT_TRUE(
        wrong("drive.path = [\"approach\", \"pull-off\", \"approach\", \"pull-off\"]").empty());
    EXPECT_EQ(only("drive.path = []").what, "drive.path is empty");
    only("drive.path = [\"pull-off\"]");
    only("drive.path = [\"approach\", \"approach\"]");
    only("drive.path = [\"approach\", \"relax\"]");
    only("drive.path = [\"approach\", \"pull-off\", \"pull-off\"]");
    EXPECT_EQ(only("drive.path = [\"aproach\"]").fix, "did you mean \"approach\"?");
    for (const char* member : {"load", "load 3 Å", "slide 3 Å", "slide z 3 Å", "slide x 0", "hold",
                               "hold -2 ps", "approach 3", "height 2 GPa", "load 3 MPa more", ""})
        only(fmt::format("drive.path = [\"approach\", \"{}\"]", member));
    const std::string quasistatic = "drive.mode = \"quasistatic\"\n";
    for (const char* load : {"load -3", "load 0", "load 3"})
        EXPECT_TRUE(wrong(fmt::format("drive.path = [\"{}\", \"pull-off\"]", load)).empty());
    for (const char* path : {"\"slide x 2\"", "\"approach\", \"load 1\", \"approach\"",
                             "\"approach\", \"pull-off\", \"slide y 1\""})
        only(fmt::format("{}drive.path = [{}]", quasistatic, path));
    only(quasistatic + "drive.path = [\"approach\", \"hold 3 ps\"]");
    const std::string wall = "interface.kind = \"wall\"\n";
    EXPECT_FALSE(wrong(wall + "drive.path = [\"approach\", \"slide x 2 Å\"]").empty());
    only(quasistatic + "drive.path = [\"approach\", \"slide x 2 Å until steady\"]");
    only(quasistatic + wall + "drive.path = [\"height 3\", \"slide x 2 Å under load\"]");
    const Case slides = read_case_text(
        quasistatic + wall +
            "drive.path = [\"load 3 MPa\", \"slide x -2 Å\", \"slide y 3 nm under load until "
            "steady\", \"slide y 1 until steady  under load\", \"slide x 1 until steady\"]",
        "s.toml");
    EXPECT_EQ(slides.path()[1].amount, -2.0);
    EXPECT_FALSE(slides.path()[1].under || slides.path()[1].until_steady);
    EXPECT_EQ(slides.path()[2].amount, 30.0);
    for (const std::size_t i : {2u, 3u}) {
        EXPECT_TRUE(slides.path()[i].until_steady);
        EXPECT_DOUBLE_EQ(slides.path()[i].under.value_or(0.0),
                         3.0 * units::megapascal * slides.area());
    }
    EXPECT_TRUE(slides.path()[4].until_steady && !slides.path()[4].under);
    for (const char* with : {"drive.path = [\"approach\", \"slide x 2 Å\"]",
                             "block.strain = \"finite\"", "surface.lattice_ratio = 1.618"})
        EXPECT_NE(only(fmt::format("numerics.device = \"emulated\"\n{}", with))
                      .what.find("numerics.device is not available with"),
                  std::string::npos)
            << with;
    const Case guided =
        read_case_text("drive.path = [\"approach\", \"load 1 GPa\", \"height 1.2 nm\", "
                       "\"slide y -5\", \"hold 20 ps\", \" pull-off \"]",
                       "s.toml");
    ASSERT_EQ(guided.path().size(), 6u);
    EXPECT_DOUBLE_EQ(guided.path()[1].amount, 1000.0 * units::megapascal * guided.area()) << "eV/Å";
    EXPECT_EQ(guided.path()[2].amount, 12.0);
    EXPECT_EQ(guided.path()[3].amount, -5.0);
    EXPECT_EQ(guided.path()[3].axis, 1);
    EXPECT_EQ(guided.path()[4].amount, 20000.0) << "fs";
    EXPECT_EQ(guided.path()[5].kind, Segment::pull_off);
    EXPECT_TRUE(guided.effects.sliding);
}

TEST(Scene, Ranges) {
    for (const char* bad : {"surface.sites = 3",
                            "surface.rms = -1",
                            "surface.rms = \"-3 nm\"",
                            "surface.hurst = 1.5",
                            "surface.rolloff = 0.5",
                            "surface.spacing = 0",
                            "surface.radius = 0",
                            "surface.seed = -1",
                            "block.young = 0",
                            "block.young = 77e9", // in Pa
                            "block.young = 2e6",
                            "block.poisson = 0.5",
                            "block.poisson = -1",
                            "block.thickness = 0",
                            "block.layers_per_level = 1",
                            "block.atom_mass = -197",
                            "interface.epsilon = 0",
                            "drive.velocity = 0",
                            "drive.timestep = -1",
                            "drive.damping = -1",
                            "drive.damping_from = 1.5",
                            "drive.temperature = -1",
                            "drive.max_steps = -1",
                            "drive.ramp = -1",
                            "output.series = 0",
                            "output.checkpoint = -1",
                            "output.trajectory = 0",
                            "theory.beta = 0",
                            "theory.delta_gamma = 0"}) {
        const io::Problem p = only(bad);
        EXPECT_NE(p.what.find("is out of range"), std::string::npos) << bad;
        EXPECT_NE(p.why.find("allowed: "), std::string::npos) << bad;
    }
}

TEST(Scene, ABlockThatRelaxes) {
    const std::string still = "drive.mode = \"quasistatic\"\n";
    const Case c =
        read_case_text(still + "block.prony = [[9.0, \"1 ns\"], [2, 20e3]]\n"
                               "drive.path = [\"approach\", \"hold 2 ns\", \"pull-off\"]",
                       "s.toml");
    const auto& branches = c.simulation.block.branches;
    ASSERT_EQ(branches.size(), 2u);
    EXPECT_EQ(branches[0].ratio, 9.0);
    EXPECT_EQ(branches[0].time, 1e6) << "fs";
    EXPECT_EQ(branches[1].time, 2e7);
    EXPECT_NE(scene_toml(c.scene).find("prony = [[9.0, 1000.0], [2.0, 20000.0]]"),
              std::string::npos);
    EXPECT_EQ(read_case_text(still + "block.prony = []", "s.toml").simulation.block.branches.size(),
              0u);

    EXPECT_EQ(only(still + "block.prony = [[-9.0, \"1 ns\"]]").what,
              "block.prony = [[-9, \"1 ns\"]] in row 1, modulus over young, is out of range");
    EXPECT_EQ(only(still + "block.prony = [[9.0, \"1 ns\"], [1.0, 0]]").what,
              "block.prony = [[9, \"1 ns\"], [1, 0]] in row 2, relaxation time, is out of range");
    EXPECT_EQ(only(still + "block.prony = [[9.0, \"20 ns\"], [1.0, \"1 ns\"]]").what,
              "block.prony has 1000 ps after 20000 ps");
    only(still + "block.prony = [[9.0, \"1 nm\"]]");
    only(still + "block.prony = [9.0, \"1 ns\"]");
    only(still + "block.prony = [[9.0]]");
    only(still + "block.prony = 9.0");
    EXPECT_EQ(only("block.prony = [[9.0, \"1 ns\"]]").what,
              "block.prony = [...] on a dynamic path");
    const auto note = [&](const char* time) {
        for (const std::string& n :
             read_case_text(still + "block.prony = [[9.0, \"" + time + "\"]]", "s.toml").notes)
            if (n.starts_with("block.prony: ")) return n.substr(n.find(": this") + 2);
        return std::string();
    };
    EXPECT_EQ(note("1 h"), "this branch stays a spring");
    EXPECT_EQ(note("1e-9 ps"), "this branch is always relaxed");
    EXPECT_EQ(note("1 ns"), "");
}

TEST(Scene, ABlockOfLayers) {
    const std::string still =
        "drive.mode = \"quasistatic\"\nsurface.spacing = 2.0\nblock.thickness = 40\n";
    const Case c = read_case_text(still + "block.layers = [[\"2 nm\", \"10 GPa\", 0.3], [6.9, 5, "
                                          "0.2]]\nblock.surface_stress = \"30 mN/m\"",
                                  "s.toml");
    const BlockOptions& block = c.simulation.block;
    ASSERT_EQ(block.layers.size(), 2u);
    EXPECT_EQ(block.layers[0].thickness, 20.0);
    EXPECT_DOUBLE_EQ(block.layers[0].material.young * 160.21766208, 10.0);
    EXPECT_EQ(block.column()[1].cells, 3) << "6.9 Å, rounded";
    EXPECT_EQ(block.layers[1].material.poisson, 0.2);
    EXPECT_NEAR(block.surface_stress, 0.03 / 16.021766208, 1e-12) << "eV/Å^2";
    EXPECT_NE(scene_toml(c.scene).find("layers = [[20.0, 10.0, 0.3], [6.9, 5.0, 0.2]]"),
              std::string::npos);
    EXPECT_EQ(std::count_if(c.notes.begin(), c.notes.end(),
                            [](const std::string& n) { return n.starts_with("block.layers: "); }),
              1)
        << "of the layer that is rounded by more than 1 %";

    const std::string layer = "block.layers = [[\"2 nm\", \"10 GPa\", 0.3]]";
    EXPECT_EQ(only(layer).what, "block.layers = [...] on a dynamic path");
    EXPECT_EQ(only("block.surface_stress = 0.03").what,
              "block.surface_stress = 0.03 N/m on a dynamic path");
    EXPECT_EQ(only(still + "block.surface_stress = 0.03\nblock.prony = [[1, \"1 ns\"]]").what,
              "block.surface_stress = 0.03 N/m with block.prony");
    EXPECT_EQ(only(still + "block.layers = [[\"8 nm\", \"10 GPa\", 0.3]]").what,
              "block.layers are 40 lattice layers thick, 80 Å");
    EXPECT_EQ(only(still + "block.layers = [[0.9, \"10 GPa\", 0.3]]").what,
              "block.layers has a layer 1 of 0.9 Å");
    EXPECT_EQ(only(still + "block.layers = [[\"2 nm\", \"10 GPa\", 0.5]]").what,
              "block.layers = [[\"2 nm\", \"10 GPa\", 0.5]] in row 1, Poisson's ratio, is out of "
              "range");
    for (const char* value : {"[[\"2 nm\", \"10 GPa\"]]", "[[]]", "[\"2 nm\"]", "3", "\"2 nm\"",
                              "[[\"2 nm\", [\"10 GPa\"], 0.3]]"})
        EXPECT_TRUE(only(still + "block.layers = " + value)
                        .fix.starts_with("write, for example, [[\"2 nm\", \"10 GPa\", 0.3]]"))
            << value;
}

TEST(Scene, ABoxWithFreeEdges) {
    const std::string still = "drive.mode = \"quasistatic\"\ninterface.kind = \"wall\"\n"
                              "interface.range = 20\ninterface.adhesion = \"50 mJ/m^2\"\n"
                              "surface.sites = 64\nsurface.spacing = 10\nsurface.radius = "
                              "\"80 nm\"\nsurface.kind = \"flat\"\nblock.young = \"3 GPa\"\n",
                      free = "surface.boundary = \"free\"\n";
    const Case c = read_case_text(
        still + free + "drive.load = \"20 nN\"\ndrive.path = [\"approach\", \"load 30 nN\"]",
        "s.toml");
    EXPECT_TRUE(c.simulation.block.free_edges);
    EXPECT_EQ(c.simulation.block.grid(), 128);
    EXPECT_EQ(c.area(), 640.0 * 640.0);
    EXPECT_FALSE(c.effects.theory);
    EXPECT_NEAR(c.simulation.drive.load_force, 20.0 / 1.602176634, 1e-8) << "eV/Å";
    EXPECT_NEAR(c.path()[1].amount, 30.0 / 1.602176634, 1e-8);
    EXPECT_NEAR(c.scene.drive.load, 20e-9 / (64e-9 * 64e-9) / 1e6, 1e-7) << "MPa";
    // Written back it is a pressure; one that is set over it is not the force.
    EXPECT_EQ(read_scene_text(scene_toml(c.scene), "t.toml").drive.load, c.scene.drive.load);
    EXPECT_EQ(
        read_scene_text(still + "drive.load = \"20 nN\"", "s.toml", {"drive.load=3"}).drive.load,
        3.0);
    // Of a periodic box too.
    EXPECT_EQ(read_scene_text(still + "drive.load = \"20 nN\"", "s.toml").drive.load,
              c.scene.drive.load);

    EXPECT_EQ(only("surface.boundary = \"free\"").what,
              "surface.boundary = \"free\" on a dynamic path");
    EXPECT_EQ(only(free + "drive.mode = \"quasistatic\"").what,
              "surface.boundary = \"free\" without a wall");
    EXPECT_EQ(only(still + free + "drive.control = \"mean-height\"").what,
              "drive.control = \"mean-height\" with surface.boundary = \"free\"");
    EXPECT_TRUE(only("drive.load = \"20 nm\"").why.starts_with("a pressure is needed"));
    const Case coated = read_case_text(
        still + free +
            "block.layers = [[\"200 nm\", \"10 GPa\", 0.3]]\nblock.surface_stress = 0.03",
        "s.toml"); // a half-space, thicker than any layer
    EXPECT_TRUE(coated.effects.layers && coated.effects.surface_stress &&
                coated.effects.free_edges);
    const auto refused = [&](const std::string& keys) {
        const Case wide = read_case_text(still + free + keys, "s.toml");
        EXPECT_EQ(wide.refused.size(), 1u);
        return wide.refused.empty() ? io::Problem() : wide.refused[0];
    };
    // JKR's contact is as wide as the box at K a^3/R - sqrt(6 pi w K a^3).
    EXPECT_EQ(refused("drive.load = \"4 uN\"").what,
              "drive.load = 4000 nN needs a contact wider than the box");
    EXPECT_EQ(refused("drive.path = [\"approach\", \"load 4 uN\"]").what,
              "drive.path has \"load 4 uN\", which needs a contact wider than the box");
}

TEST(Scene, OneComplaintAKey) { // out of range, and therefore not also a contradiction
    EXPECT_EQ(wrong("[interface]\ncutoff = -1\n").size(), 1u);
    const auto problems =
        wrong("[surface]\nrms = -1\nsites = 8\nrolloff = 1\n[drive]\npath = []\nspeed = 3\n");
    ASSERT_EQ(problems.size(), 4u);
    EXPECT_EQ(problems[0].where, "s.toml:2:7");
}

TEST(Scene, NotYet) {
    const auto refused = [](const std::string& text) {
        const Case c = read_case_text(text, "s.toml");
        for (const io::Problem& p : c.refused) {
            EXPECT_NE(p.what.find("is not available yet"), std::string::npos) << p.what;
            EXPECT_FALSE(p.fix.empty()) << p.what;
        }
        return c.refused.size();
    };
    EXPECT_EQ(refused(""), 0u);
    EXPECT_EQ(refused("output.trajectory = 100"), 0u);
    EXPECT_EQ(refused("block.strain = \"finite\""), 0u);
    EXPECT_EQ(refused("numerics.precision = \"mixed\""), 0u);
    EXPECT_EQ(refused("drive.mode = \"quasistatic\"\ndrive.path = [\"relax\", \"pull-off\", "
                      "\"approach\"]"),
              0u);
    EXPECT_EQ(refused("drive.path = [\"relax\", \"pull-off\"]"), 1u);
}

namespace {

/// Returns values of a key as TOML, other than its default.
std::vector<std::string> other_values(const io::Schema::Key& key) {
    const io::Json now = key.load();
    const std::string kind = key.kind();
    std::vector<std::string> others;
    if (kind == "boolean") return {now.get<bool>() ? "false" : "true"};
    for (const std::string& word : key.choices)
        if (kind == "choice" && now != word) others.push_back("\"" + word + "\"");
    if (kind == "text") return {"\"other.txt\""};
    if (kind == "list") return {"[\"Au 0.1 3.28\"]"};
    if (kind == "rows")
        return {key.name == "prony" ? "[[1.0, \"1 ns\"]]" : "[[\"2 nm\", \"10 GPa\", 0.3]]"};
    for (const double value : {7.0, 0.75, 0.375})
        if ((kind == "number" || kind == "integer") && key.range.contains(value) && now != value)
            return {kind == "integer" ? fmt::format("{:.0f}", value) : fmt::format("{}", value)};
    EXPECT_FALSE(others.empty()) << key.path();
    return others;
}

} // namespace

/// A key that has no effect is refused with the key that would make it act, unless it belongs to
/// another kind of path: each need of each key is not met in one of these scenes.
TEST(Scene, AKeyWithoutEffectIsRefused) {
    const std::string wall = "interface.kind = \"wall\"\n", rest = "drive.path = [\"relax\"]\n",
                      still = "drive.mode = \"quasistatic\"\n",
                      pair = still + wall + "surface.counter = \"no.npy\"\n";
    const std::string scenes[] = {"",
                                  wall,
                                  pair,
                                  pair + "surface.counter_young = 70\n",
                                  "surface.kind = \"flat\"\n",
                                  "surface.kind = \"file\"\nsurface.file = \"no.npy\"\n",
                                  "surface.kind = \"atoms\"\nsurface.file = \"no.h5\"\n",
                                  "surface.kind = \"atoms\"\nsurface.file = \"no.h5\"\n" + still,
                                  rest,
                                  still,
                                  still + wall,
                                  still + wall + "interface.law = \"smeared\"\n",
                                  still + wall + "interface.law = \"table\"\n",
                                  still + wall + "interface.law = \"8-2\"\n",
                                  still + wall + "surface.boundary = \"free\"\n",
                                  still + wall + "output.fields = []\n",
                                  still + "drive.control = \"mean-height\"\n",
                                  still + "block.prony = [[1.0, \"1 ns\"]]\n",
                                  "block.model = \"lattice\"\n",
                                  "drive.damping = 0\n",
                                  "drive.temperature = 300\n",
                                  "interface.potential = \"morse\"\n"};
    using Unmet = std::set<std::pair<std::string, std::string>>;
    Unmet all, seen;
    Scene defaults;
    const auto name = [](const io::Schema::Need& need) { return need.otherwise + need.why; };
    const io::Schema of_defaults = bind(defaults);
    for (const io::Schema::Key& key : of_defaults.keys())
        for (const io::Schema::Need& need : key.needs)
            all.emplace(key.path(), name(need));
    for (const std::string& text : scenes) {
        Scene scene = read_scene_text(text, "s.toml");
        const io::Schema schema = bind(scene);
        for (const io::Schema::Key& key : schema.keys()) {
            const std::string path = key.path();
            if (key.needs.empty() || scene.positions.is_set(path)) continue;
            for (const std::string& value : other_values(key)) {
                const std::string with = text + path + " = " + value;
                Scene set = read_scene_text(with, "s.toml");
                const io::Schema of_set = bind(set);
                const io::Schema::Need* const need = of_set.find(path)->unmet_need();
                if (!need) continue;
                seen.emplace(path, name(*need));
                io::Problems problems;
                refuse_unmet_needs(set, problems);
                const auto& list = problems.list();
                const auto refused = std::find_if(list.begin(), list.end(), [&](const auto& p) {
                    return p.what.starts_with(path + " ");
                });
                const std::vector<std::string> notes = notes_on_idle_keys(set);
                const bool noted = std::any_of(notes.begin(), notes.end(), [&](const auto& note) {
                    return note.starts_with(path + " has no effect");
                });
                const bool of_path = need->why.empty() && need->instead.empty();
                EXPECT_NE(refused != list.end(), noted) << with;
                EXPECT_EQ(noted, of_path) << with;
                if (refused == list.end()) continue;
                EXPECT_FALSE(refused->why.empty() || refused->fix.empty()) << with;
                for (const std::string& deciding : need->deciding)
                    EXPECT_NE(of_set.find(deciding), nullptr) << deciding;
            }
        }
    }
    for (const auto& [path, need] : all)
        EXPECT_TRUE(seen.contains({path, need})) << path << ": " << need;
}

/// A key of the file is noted if --set has switched it off, and one of --set is refused.
TEST(Scene, AKeyThatIsSwitchedOffIsNoted) {
    const std::string rough = "[surface]\nkind = \"self-affine\"\nhurst = 0.7\nsites = 16\n";
    const auto notes = read_case_text(rough, "s.toml", {"surface.kind=flat"}).notes;
    EXPECT_EQ(std::count_if(notes.begin(), notes.end(),
                            [](const auto& n) { return n.starts_with("surface.hurst has no"); }),
              1);
    const auto problem = [](const std::string& text, const std::vector<std::string>& sets) {
        try {
            read_case_text(text, "s.toml", sets);
        } catch (const io::SceneError& error) {
            return error.problems().front();
        }
        return io::Problem();
    };
    EXPECT_EQ(problem(rough, {"surface.file=map.h5"}).fix,
              "take surface.kind = \"file\" (a map), or \"atoms\", or leave surface.file out");
    EXPECT_EQ(problem(rough, {"surface.kind=flat", "surface.rms=2"}).what,
              "surface.rms = 2 Å has no effect");
    EXPECT_EQ(problem("[surface]\nkind = \"flat\"\nhurst = 0.7\n", {}).why,
              "surface.kind is not \"self-affine\"");
}

TEST(Scene, Notes) {
    const auto said = [](const std::string& text, const std::string& what) {
        for (const std::string& note : read_case_text(text, "s.toml").notes)
            if (note.find(what) != std::string::npos) return true;
        return false;
    };
    EXPECT_TRUE(said("drive.displacement_step = 0.1", "drive.displacement_step has no effect"));
    EXPECT_TRUE(said("surface.file = \"heights.h5\"", "surface.file has no effect"));
    const std::string mixed = "numerics.precision = \"mixed\"\n";
    EXPECT_FALSE(said(mixed, "numerics.precision"));
    for (const char* with : {"surface.lattice_ratio = 1.618",
                             "interface.kind = \"wall\"\ndrive.mode = \"quasistatic\"",
                             "numerics.device = \"emulated\""}) {
        if (std::string_view(with).starts_with("numerics.device") && !fuses(processor_level()))
            continue; // refused for another reason
        EXPECT_TRUE(said(mixed + with, "numerics.precision has no effect: pairs are in double"))
            << with;
    }
    const std::string still = "drive.mode = \"quasistatic\"\n";
    EXPECT_TRUE(said(still + "drive.velocity = 2", "drive.velocity has no effect"));
    EXPECT_TRUE(said(still + "drive.temperature = 300", "drive.temperature has no effect"));
    EXPECT_TRUE(said(still + "drive.velocity = 2\ndrive.timestep = 20\nblock.model = \"lattice\"",
                     "block.model, drive.velocity and drive.timestep have no effect"));
    EXPECT_FALSE(said(still + "drive.displacement_step = 0.1", "has no effect"));
    EXPECT_TRUE(said("surface.sites = 500", "halved 2 times"));
    EXPECT_FALSE(said("", "halved"));
    EXPECT_TRUE(said("block.thickness = 64", "thinner"));
    // E (1 - ν) / ((1 + ν) (1 - 2ν)) = 197.08 GPa
    EXPECT_TRUE(said("drive.load = 19708", "strains the block by 10 %"));
    EXPECT_TRUE(said("drive.path = [\"approach\", \"load -19.708 GPa\", \"pull-off\"]", "by 10 %"));
    EXPECT_FALSE(said("drive.load = 19708\nblock.strain = \"finite\"", "strains"));
    EXPECT_FALSE(said("drive.load = 1000", "strains"));
    // Stiff, soft and frictionless.
    const std::string steep =
        "surface.sites = 16\nsurface.rms = 4\nsurface.rolloff = 1\nblock.thickness = 16\n"
        "drive.path = [\"relax\"]\nblock.young = ";
    EXPECT_FALSE(said(steep + "100", "several states"));
    EXPECT_TRUE(said(steep + "8", "several states"));
    EXPECT_FALSE(said(steep + "8\ninterface.frictionless = true", "several states"));
    for (const auto& [fine, wrong, note] : std::vector<std::array<const char*, 3>>{
             {"drive.velocity = 50", "drive.velocity = 51", "above 50 m/s"},
             {"drive.timestep = 40", "drive.timestep = 41", "the longest that is usable"},
             {"surface.rms = 4", "surface.rms = 20", "the rms slope is"},
             {"surface.rms = 133", "surface.rms = 134", "a tenth of the box"}}) {
        EXPECT_FALSE(said(fine, note)) << fine;
        EXPECT_TRUE(said(wrong, note)) << wrong;
    }
    EXPECT_FALSE(said(still + "drive.timestep = 60", "usable")) << "no time passes";
}

TEST(Scene, MapsAreFoundBesideTheScene) {
    const io::Scratch scratch;
    std::filesystem::create_directory(scratch / "maps");
    scratch.write("maps/m.txt", "0\n");
    const std::string file =
        scratch.write("s.toml", "surface.kind = \"file\"\nsurface.file = \"maps/m.txt\"\n");
    Case c = read_case(file);
    Scene s = c.scene;
    EXPECT_EQ(c.file, scratch / "maps/m.txt");
    EXPECT_EQ(scene_json(s)["surface"]["file"], "maps/m.txt"); // as it was given
    EXPECT_FALSE(s.gives_rms());
    // Read back, the map stays as high as it is.
    EXPECT_FALSE(scene_json(s)["surface"].contains("rms"));
    c = read_case(file, {"surface.file=maps/m.txt:/x", "surface.rms=2"});
    s = c.scene;
    EXPECT_EQ(c.file, scratch / "maps/m.txt:/x");
    EXPECT_TRUE(scene_json(s)["surface"].contains("rms"));

    io::Problem p = only("surface.kind = \"file\"\nsurface.file = \"none.h5\"\n");
    EXPECT_EQ(p.where, "s.toml:2:16");
    EXPECT_EQ(p.what, "surface.file = \"none.h5\": there is no such file");
    p = only("surface.kind = \"file\"\n");
    EXPECT_EQ(p.where, "s.toml:1:16");
    EXPECT_EQ(p.what, "surface.kind = \"file\" needs surface.file");
}

TEST(Scene, ScenesThatComeWithAsperity) {
    const std::string scenes = std::string(ASPERITY_SOURCE_DIR) + "/scenes/";
    const Scene first = read_scene(scenes + "first-contact.toml");
    EXPECT_EQ(first.surface.sites, 128);
    EXPECT_EQ(first.surface.rms, 1.5);
    EXPECT_EQ(first.block.model, BlockModel::multiscale);
    Scene flat = read_scene(scenes + "paper/flat-3A.toml");
    EXPECT_EQ(flat.drive.timestep, 40.0);
    EXPECT_EQ(flat.numerics.precision, Precision::mixed);
    flat.drive.timestep = Scene{}.drive.timestep; // the rest is the defaults, spelt out
    flat.numerics.precision = Scene{}.numerics.precision;
    flat.block.model = Scene{}.block.model;
    EXPECT_EQ(scene_toml(flat, false), scene_toml(Scene{}, false));
}

TEST(Scene, ADeviceThatIsNotThereIsRefusedAndAutoSaysWhatItTook) {
    if (!fuses(processor_level())) return; // refused for another reason
    if (cuda_device_count() >= 8) return;  // more have no number
    const std::string beyond = "numerics.device=" + std::to_string(cuda_device_count());
    const std::string refused = test::message_of<io::SceneError>(
        [&] { read_case_text("", "s.toml", {beyond}).require_runnable(); });
    for (const char* part : {"numerics.device", "not there", "auto"})
        EXPECT_TRUE(test::has(refused, part)) << part << " not in: " << refused;
    for (const char* path : {"drive.path=relax", "drive.path=[\"approach\"]"}) {
        const Case c = read_case_text("", "s.toml", {"numerics.device=auto", path});
        EXPECT_EQ(c.effects.device.on, bool(c.simulation.device))
            << path << ": " << c.effects.device.why;
        if (cuda_device_count() == 0) {
            EXPECT_FALSE(c.effects.device) << path;
        }
    }
}

TEST(Scene, OldNamesAreRefusedWithTheNewOnes) {
    for (const auto& [old, now] : std::vector<std::pair<std::string, std::string>>{
             {"drive.hold = \"top\"", "control"},
             {"drive.step = 0.1", "displacement_step"},
             {"surface.cutoff = 64", "q_max"},
             {"interface.morse_r0 = 3.7", "interface.morse_r_min"},
             {"drive.path = [\"zero-load\"]", "\"relax\""},
             {"output.fields = [\"zero-load\"]", "\"relaxed\""},
             {"output.fields = [\"pull-off\", \"after-zero-load:20\"]", "\"after-approach:N\""},
             {"drive.max_steps = 0", "\"none\""},
             {"output.checkpoint = 0", "\"none\""}})
        EXPECT_NE(only(old).fix.find(now), std::string::npos) << old << ": " << only(old).fix;
}

TEST(Scene, NoneIsTheWordForOff) {
    const Scene s = read_scene_text(
        "drive.max_steps = \"none\"\noutput.checkpoint = \"none\"\noutput.trajectory = \"none\"",
        "s.toml");
    EXPECT_EQ(s.drive.max_steps, 0);
    EXPECT_EQ(s.output.checkpoint, 0.0);
    for (const auto& [section, key] : {std::pair{"drive", "max_steps"}, {"output", "checkpoint"}})
        EXPECT_EQ(scene_json(s)[section][key], "none");
    EXPECT_EQ(scene_toml(read_scene_text(scene_toml(s), "t.toml")), scene_toml(s));
}

TEST(Scene, CountsAreGivenAsLengthsToo) {
    const auto read = [](const std::vector<std::string>& keys) {
        return read_scene_text("", "s.toml", keys);
    };
    const Scene s =
        read({"surface.sites=33 nm", "surface.spacing=2.5", "block.thickness=\"120 Å\""});
    EXPECT_EQ(s.surface.sites, 132);
    EXPECT_EQ(s.block.thickness, 48);
    EXPECT_EQ(read({"surface.sites=33 nm"}).block.thickness, 127) << "as wide as the box";
    EXPECT_EQ(read({"surface.sites=33 nm", "surface.sites=64"}).surface.sites, 64);
    EXPECT_EQ(read({"surface.sites=64", "surface.sites=33 nm"}).surface.sites, 127);
    for (const char* bad : {"3 Å", "1 mm", "33 GPa", "-33 nm", "nan nm", "wide"}) {
        const std::string key = std::string("surface.sites=") + bad;
        EXPECT_NE(only("", {key}).what.find("surface.sites"), std::string::npos) << bad;
    }
}

TEST(Scene, TheCutoffFollowsTheLengthOfThePotential) {
    const auto cutoff = [](const std::vector<std::string>& keys) {
        return cutoff_of(read_case_text("", "s.toml", keys).simulation.interface.potential);
    };
    EXPECT_EQ(cutoff({}), 13.12);
    EXPECT_EQ(cutoff({"interface.r0=2.63"}), 4 * 2.63);
    EXPECT_EQ(cutoff({"interface.r0=2.63", "interface.cutoff=10"}), 10.0);
    EXPECT_EQ(cutoff({"interface.r0=2.63", "interface.cutoff=4 r0"}), 4 * 2.63);
    EXPECT_EQ(cutoff({"interface.potential=morse", "interface.morse_r_min=3.5"}),
              4 * (3.5 - std::log(2.0) / 1.63));
}

TEST(Scene, WithoutQMaxTheSpectrumEndsAtNyquist) {
    const auto heights = [](const std::vector<std::string>& keys) {
        return surface_of(read_case_text("surface.sites = 64", "s.toml", keys)).height;
    };
    EXPECT_EQ(heights({}), heights({"surface.q_max=32"}));
    EXPECT_EQ(heights({}), heights({"surface.q_max=512"}));
    EXPECT_NE(heights({}), heights({"surface.q_max=16"}));
}

TEST(Scene, DefaultsAreThoseOfTheContract) {
    const std::string file =
        io::contents(std::string(ASPERITY_SOURCE_DIR) + "/tests/engine/defaults.toml");
    EXPECT_EQ(file.substr(file.find("\n\n") + 2), scene_toml(Scene{}, false));
}

TEST(Scene, ReferencePagesAreUpToDate) {
    const std::string pages = std::string(ASPERITY_SOURCE_DIR) + "/docs/reference/";
    EXPECT_EQ(io::contents(pages + "result.md"), io::result_markdown(series_quantities()))
        << "./asperity defaults --results > docs/reference/result.md";
    EXPECT_EQ(io::contents(pages + "scene.md"), scene_markdown())
        << "./asperity defaults --markdown > docs/reference/scene.md";
}

} // namespace
} // namespace asperity
