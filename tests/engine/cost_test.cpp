// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a setting is worth, on made-up runs: errors, fronts, orders, and which knobs a scene has.
#include "engine/commands/cost.hpp"
#include "engine/commands/cost_output.hpp"
#include "io/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace asperity {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

TEST(CostErrors, CompareEnergiesOverTheirOwnFlat) {
    io::JsonValue result;
    result["delta_gamma"] = 50.0;
    result["binding_energy"] = 30.0;
    result["contact_fraction"] = 0.5;
    const CostNumbers a = cost_numbers(result);
    result["delta_gamma"] = 100.0;
    result["binding_energy"] = 60.0;
    result["contact_fraction"] = 0.49;
    const CostNumbers b = cost_numbers(result);
    const CostNumbers e = cost_errors(b, a);
    EXPECT_DOUBLE_EQ(e[0], 0.0);
    EXPECT_NEAR(e[1], -0.02, 1e-15);
    EXPECT_TRUE(std::isnan(e[2]));
    EXPECT_NEAR(largest_error(b, a, Question::state), 0.02, 1e-15);
}

TEST(CostErrors, ThatWhichWasNotFollowedAnswersNothing) {
    const CostNumbers reference = {0.5, 0.9, 0.5, 0.5, 100.0};
    const CostNumbers state_only = {0.51, 0.9, nothing, nothing, nothing};
    EXPECT_NEAR(largest_error(state_only, reference, Question::state), 0.02, 1e-12);
    EXPECT_TRUE(std::isnan(largest_error(state_only, reference, Question::path)));
    EXPECT_TRUE(std::isnan(largest_error(state_only, state_only, Question::path)));
    // What the reference itself lacks is not asked for.
    const CostNumbers approach_only = {0.5, 0.9, 0.5, nothing, nothing};
    EXPECT_NEAR(largest_error({0.5, 0.9, 0.45, nothing, nothing}, approach_only, Question::path),
                0.1, 1e-12);
}

TEST(ParetoFront, HoldsWhatNothingBeatsInBoth) {
    const std::vector<double> seconds = {1, 2, 3, 4, 2, 5, 1};
    const std::vector<double> errors = {0.5, 0.2, 0.2, 0.1, 0.3, nothing, 0.5};
    EXPECT_EQ(pareto_front(seconds, errors),
              (std::vector<bool>{true, true, false, true, false, false, true}));
    EXPECT_EQ(cheapest_within(seconds, errors, 0.25), 1u);
    EXPECT_EQ(cheapest_within(seconds, errors, 0.6), 0u);
    EXPECT_EQ(cheapest_within(seconds, errors, 0.01), std::nullopt);
}

TEST(Order, IsThatOfThePowerLaw) {
    const std::vector<double> x = {6, 5, 4, 3, 2, 1};
    for (const double p : {2.0, 1.0, -4.0, -2.0, 0.5}) {
        std::vector<double> exact, against_half;
        for (const double v : x) {
            exact.push_back(-3e-3 * std::pow(v, p));
            // What is measured if the run compared with still has the error of x = 1/2.
            against_half.push_back(3e-3 * (std::pow(v, p) - std::pow(0.5, p)));
        }
        EXPECT_NEAR(order_of(x, exact, std::nullopt).value(), p, 0.011) << p;
        EXPECT_NEAR(order_of(x, against_half, 0.5).value(), p, 0.011) << p;
    }
}

TEST(Order, IsNotMadeUpWhereThereIsNone) {
    const std::vector<double> x = {3, 2, 1};
    EXPECT_FALSE(order_of(x, std::vector<double>{1e-9, 1e-8, 1e-9}, std::nullopt));
    EXPECT_FALSE(order_of(x, std::vector<double>{1e-2, nothing, 0.0}, std::nullopt));
    EXPECT_FALSE(order_of({}, {}, std::nullopt));
}

/// Names of a scene's knobs.
std::string knobs(const std::string& text) {
    std::string names;
    for (const Knob& knob : cost_case(read_scene_text(text, "s.toml")).knobs)
        names += knob.name + " ";
    return names;
}

TEST(Knobs, AreThoseThatTheSceneHas) {
    const std::string small = "surface.sites = 16\n";
    EXPECT_EQ(knobs(small), "cutoff tail layers thickness precision timestep velocity damping "
                            "tolerance step model ");
    EXPECT_EQ(knobs(small + "drive.path = [\"zero-load\"]\nblock.model = \"spectral\""),
              "cutoff tail thickness precision tolerance model ");
    EXPECT_EQ(knobs(small + "drive.damping = 0").find("damping"), std::string::npos);
    for (const char* bad : {"drive.temperature = 300", "drive.max_steps = 10",
                            "surface.sites = 32\nnumerics.accuracy = 0.01"})
        EXPECT_THROW(knobs(std::string(bad)), io::SceneError) << bad;
}

/// Three runs of a knob with errors of the square, under a reference.
TEST(CostTables, JudgeWhatWasRun) {
    CostTable table;
    table.name = "made up";
    Knob knob{"timestep", "time step", {},  KnobValue{"1", {"drive.timestep=1"}, 1.0},
              false,      2.0,         "2", "timestep"};
    const auto run = [&](const std::string& name, double x, double error, double seconds) {
        CostRow row;
        row.knob = name;
        row.label = std::to_string(static_cast<int>(x));
        row.own = row.setting = {"drive.timestep=" + row.label};
        row.x = x;
        row.judged = name != "reference";
        row.outcome.state = PointState::finished;
        row.numbers = {1.0 + error, 1.0, nothing, nothing, nothing};
        row.seconds = seconds;
        table.rows.push_back(row);
    };
    run("reference", 0, 0.0, 9.0);
    run("scene", 2, 4e-3, 4.0);
    for (const double x : {4.0, 3.0, 2.0, 1.0})
        run("timestep", x, 1.1e-3 * x * x, 8.0 / x);
    table.what.knobs.push_back(knob);
    judge(table);
    EXPECT_NEAR(table.rows[2].error[0], 0.0176, 1e-12);
    EXPECT_TRUE(table.rows[5].front[0]);
    EXPECT_EQ(table.cheapest[0][0], 2u); // 5 %
    EXPECT_EQ(table.cheapest[0][1], 3u); // 1 %
    ASSERT_EQ(table.orders.size(), 1u);
    EXPECT_NEAR(table.orders[0].measured[0].value(), 2.0, 0.02);
    const io::JsonValue json = cost_json(table);
    EXPECT_EQ(json.find("settings")->items().size(), 6u);
    const auto& cheapest = json.find("cheapest.state")->items();
    ASSERT_EQ(cheapest.size(), 2u); // nothing keeps 0.1 %
    EXPECT_EQ(cheapest[1].find("set")->text(), "--set drive.timestep=3");
    const std::string csv = cost_csv(table);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
}

} // namespace
} // namespace asperity
