// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity cost`: what accuracy costs in time for a scene.
//
//     asperity cost scenes/cost/small.toml --knobs timestep,layers
//
// Runs the reference, the scene as it is, every value of every knob (cost_knobs.hpp), and then
// combinations: of each knob the cheapest value whose own error is within the target's share. Each
// is a process of its own with one thread (sweep_points.hpp), in a directory of its own; those that
// are there are not run again, so the same command goes on where it stopped.
#pragma once

#include "engine/commands/cost_judge.hpp"
#include "engine/commands/cost_knobs.hpp"
#include "engine/commands/sweep_points.hpp"
#include "io/progress.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

struct CostOptions {
    std::string scene; ///< file
    std::vector<std::string> overrides;
    std::vector<std::string> knobs; ///< names; empty: all
    int jobs = 1;
    io::ProgressMode progress = io::ProgressMode::automatic;
    std::string out; ///< directory; empty: results/<scene>-cost
};

/// Errors for which the cheapest settings are named.
inline constexpr std::array<double, 3> cost_targets = {0.05, 0.01, 0.001};
inline constexpr std::array<Question, 2> questions = {Question::state, Question::path};

/// A setting that was run.
struct CostRow {
    std::string knob;  ///< name; "reference", "scene" or "combination" for those that are none
    std::string label; ///< its value
    Setting setting;   ///< in full
    Setting own;       ///< the part of it that is the knob's value
    double x = 0.0;
    bool judged = true; ///< its error is one of settings: not the reference, not another solid
    PointOutcome outcome;
    CostNumbers numbers{};
    CostNumbers own_error{};          ///< errors against the twin; NaN: none
    std::array<double, 2> error = {}; ///< against the reference, by question; NaN: not answered
    std::array<bool, 2> front = {};
    double seconds = std::numeric_limits<double>::quiet_NaN(); ///< of the processor
    double wall = std::numeric_limits<double>::quiet_NaN();
};

struct CostOrder {
    const Knob* knob;
    std::array<std::optional<double>, cost_quantities> measured;
};

struct CostTable {
    std::string name; ///< of the scene
    io::JsonValue scene;
    CostCase what;
    std::vector<CostRow> rows; ///< the first is the reference, the second the scene itself
    std::vector<CostOrder> orders;
    /// By question and target: the row.
    std::array<std::array<std::optional<std::size_t>, cost_targets.size()>, 2> cheapest;
};

/// Errors, fronts, orders and cheapest settings of the rows that are there.
void judge(CostTable& table);

/// Returns the exit code: 75 if stopped before the end, that of the reference if it failed.
int cost_command(const CostOptions& options);

} // namespace asperity
