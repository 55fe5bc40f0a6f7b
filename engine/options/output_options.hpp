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

/// Contents of the output of a run, and their times.
struct OutputOptions {
    std::optional<long long> trajectory; ///< steps between frames; empty: none
    bool velocities = false;             ///< velocities in the frames too
    long long series = 100;              ///< steps between rows of the series
    double checkpoint = 600.0;           ///< s of wall time between checkpoints; 0: none
};

/// Times at which maps are written (output.fields).
struct MapTimes {
    bool relaxed = false, pull_off = false;
    bool segments = false;          ///< maps at the end of each segment of the path
    std::optional<long long> every; ///< steps, or points of a quasi-static path
    /// Delay after the end of the approach, ps, and name; in the order of the delays.
    std::vector<std::pair<double, std::string>> after_approach;
};

} // namespace asperity
