// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The table of a sweep: a line for every point, the theory's numbers and, where points were
// simulated, what is in their result.json; and the means over the seeds.
#pragma once

#include "engine/commands/sweep_grid.hpp"
#include "engine/commands/sweep_points.hpp"
#include "engine/run/theory_case.hpp"
#include "io/json_value.hpp"

#include <functional>
#include <string>
#include <vector>

namespace asperity {

struct SweepPoint {
    SweepPoint() = default;
    SweepPoint(const Scene& scene, const std::vector<SweepAxis>& axes, TheoryCase what,
               TheoryNumbers numbers);

    std::vector<io::JsonValue> values; ///< of the swept keys, numbers in the units of the scene
    TheoryCase what;
    TheoryNumbers numbers;
    std::string name;     ///< of its directory; empty: theory only
    PointOutcome outcome; ///< of the simulation
};

struct SweepTable {
    std::string name;    ///< of the scene
    io::JsonValue scene; ///< the scene that the points vary
    std::vector<SweepAxis> axes;
    std::vector<SweepPoint> points;
    std::vector<SweepPoint> theory; ///< of a sweep of simulations: the theory's curves, more finely
    std::vector<std::string> notes;
    bool simulated = false;
    double seconds = 0.0;
};

/// A column of numbers; NaN where a point has none.
struct SweepColumn {
    std::string name;
    std::string unit;
    std::function<double(const SweepPoint&)> value;
};
/// Those for which some point has a number.
std::vector<SweepColumn> sweep_columns(const SweepTable& table);
/// A number of the point's result.json ("work_of_adhesion.approach"), or NaN.
double result_number(const SweepPoint& point, const char* path);
/// "done", "failed", "waiting"; of a theory-only sweep the status of the theory.
std::string status_of(const SweepPoint& point, bool simulated);

/// Points that differ in their seeds only.
struct SweepGroup {
    std::vector<io::JsonValue> values; ///< of the axes that are no seeds
    std::vector<const SweepPoint*> points;
};
std::vector<SweepGroup> sweep_groups(const std::vector<SweepAxis>& axes,
                                     const std::vector<SweepPoint>& points);

/// Over the points that have a number.
struct Spread {
    int count = 0;
    double mean;      ///< NaN without any
    double deviation; ///< standard deviation of the single point (n - 1); NaN below two
};
Spread spread_of(const SweepGroup& group, const std::function<double(const SweepPoint&)>& value);

/// As it stands in tables and names: "3", "multiscale".
std::string shown(const io::JsonValue& value);

} // namespace asperity
