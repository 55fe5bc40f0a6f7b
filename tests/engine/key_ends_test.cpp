// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Every numeric key at the ends of its stated range, in a short run of each kind of scene: the
// answer is finite, or the key is refused by its name.
#include "engine/case/case.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "io/error.hpp"
#include "support/run_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace asperity {
namespace {

/// Returns the ends of the range of a key as values of a scene: the last numbers within it, and in
/// place of an end at infinity a number that no scene means.
std::vector<std::string> ends_of(const io::Schema::Key& key) {
    const bool whole = key.kind() == "integer";
    const double huge = whole ? 2e9 : 1e300;
    const auto& [low, high, low_open, high_open] = key.range;
    const double step = whole ? 1.0 : 0.0;
    const auto inwards = [&](double end, double towards) {
        return whole ? end + std::copysign(step, towards - end) : std::nextafter(end, towards);
    };
    std::vector<std::string> ends;
    for (const double end :
         {std::isfinite(low) ? (low_open ? inwards(low, HUGE_VAL) : low) : -huge,
          std::isfinite(high) ? (high_open ? inwards(high, -HUGE_VAL) : high) : huge})
        ends.push_back(whole ? fmt::format("{:.0f}", end) : fmt::format("{:.17g}", end));
    return ends;
}

/// Returns true if all numbers of a result are finite: others are written as null.
bool is_finite(const io::Json& value) {
    if (value.is_object() || value.is_array())
        return std::all_of(value.begin(), value.end(), is_finite);
    return !value.is_null();
}

const std::vector<std::pair<std::string, std::string>>& scenes() {
    const std::string solid = "[surface]\nsites = 16\nrms = 0.5\n[block]\nyoung = 10\n"
                              "poisson = 0.3\nthickness = 16\n",
                      small = solid + "[output]\nfields = []\n";
    const std::string wall = "[interface]\nkind = \"wall\"\nadhesion = 3\nrange = 3\n";
    const std::string still = "[drive]\nmode = \"quasistatic\"\nmax_steps = 12\n";
    static const std::vector<std::pair<std::string, std::string>> all = {
        {"state over a wall", small + wall + "[drive]\npath = [\"relax\"]\n"},
        {"state of a lattice over a wall", solid + "model = \"lattice\"\n[output]\nfields = []\n" +
                                               wall + "[drive]\npath = [\"relax\"]\n"},
        {"path over a wall", small + wall + "law = \"power\"\n" + still},
        {"path over atoms", small + still + "stiffness = 50\n"}};
    return all;
}

class KeyEnds : public testing::TestWithParam<std::size_t> {};

TEST_P(KeyEnds, AreFiniteOrRefused) {
    const auto& [name, text] = scenes()[GetParam()];
    Scene defaults;
    const io::Schema schema = bind(defaults);
    int run = 0, refused = 0;
    std::vector<std::string> keys; // with values
    for (const io::Schema::Key& key : schema.keys())
        // drive.max_steps makes the runs short.
        if ((key.kind() == "number" || key.kind() == "integer") && key.name != "max_steps")
            for (const std::string& end : ends_of(key))
                keys.push_back(key.path() + "=" + end);
    for (const char* poisson : {"-0.99999999999999989", "0.49999999999999994"}) {
        keys.push_back(fmt::format("block.layers=[[\"5 Å\", \"10 GPa\", {}]]", poisson));
        keys.push_back(fmt::format("block.layers=[[\"5 Å\", \"2 GPa\", {}]]", poisson));
    }
    for (const std::string& key : keys) {
        const std::string path = key.substr(0, key.find('='));
        const io::Scratch scratch;
        try {
            const Case c = read_case_text(text, "ends.toml", {key});
            examine(c);
            require_memory(c, Communicator());
            const io::Json result = test::run_scene(c, scratch / "run");
            EXPECT_TRUE(is_finite(result)) << name << ": " << key << "\n" << result.dump(1);
            ++run;
        } catch (const io::Error& error) {
            EXPECT_NE(std::string(error.what()).find(path), std::string::npos)
                << name << ": " << key << "\n"
                << error.what();
            ++refused;
        }
    }
    EXPECT_GT(run, 5) << name;
    EXPECT_GT(refused, 5) << name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, KeyEnds, testing::Range(std::size_t{0}, scenes().size()),
                         [](const auto& number) {
                             std::string name = scenes()[number.param].first;
                             std::replace(name.begin(), name.end(), ' ', '_');
                             return name;
                         });

} // namespace
} // namespace asperity
