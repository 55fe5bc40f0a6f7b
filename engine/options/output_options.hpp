// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of what a run writes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

/// Points at which the stresses below a map are written.
enum class StressPoints { none, section, volume };

/// Stresses below the surface (output.stress).
struct StressOptions {
    StressPoints points = StressPoints::none;
    std::optional<double> depth; ///< largest depth, Å; empty: three times that of the largest
    int depths = 48;             ///< number of depths
    double friction = 0.0;       ///< coefficient of a friction in phase with the pressure
};

/// Output of a run and its periods.
struct OutputOptions {
    std::optional<long long> trajectory; ///< steps between frames; empty: none
    bool velocities = false;             ///< write velocities in the frames too
    long long series = 100;              ///< steps between rows of the series
    double checkpoint = 600.0;           ///< wall time between checkpoints, s; 0: no checkpoints
    StressOptions stress{};              ///< stresses below each map of a state
};

/// Times at which maps are written (output.fields).
struct MapTimes {
    bool relaxed = false;           ///< maps of relaxed states
    bool pull_off = false;          ///< map at the largest attraction of the pull-off
    bool segments = false;          ///< maps at the end of each segment
    std::optional<long long> every; ///< period, steps or points; empty: none
    /// Delay after the end of the approach, ps, and name of the map, in ascending order.
    std::vector<std::pair<double, std::string>> after_approach;
};

} // namespace asperity
