// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity sweep`: one scene, several values of one or more of its keys, one table.
//
//     asperity sweep scenes/paper/fig2.toml --theory-only --set surface.rms=0.1:10:0.1
//
// --set key=v1,v2,... or key=start:stop:step (stop included) is an axis of the grid; --set with a
// single value overrides that key at every point. Every point is a scene of its own, read and
// checked like any other, all of them before the first is computed. The axis of numbers
// with the most values is the x axis of the plots; the others give one curve a value.
//
// This release computes the theory only (--theory-only), on one rank, points one after the other:
// about 15 ms each.
#pragma once

#include "engine/scene.hpp"

#include <string>
#include <vector>

namespace asperity {

/// One swept key and its values as they would stand behind --set.
struct SweepAxis {
    std::string key;
    std::vector<std::string> values;
};

/// The axes among the assignments "key=..."; those of a single value are left in `fixed`. Throws
/// io::SceneError.
std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& assignments,
                                  std::vector<std::string>& fixed);

/// Every combination, the last axis fastest, each as a list of "key=value".
std::vector<std::vector<std::string>> sweep_grid(const std::vector<SweepAxis>& axes);

struct SweepOptions {
    std::string scene;                    ///< file
    std::vector<std::string> assignments; ///< of --set
    bool theory_only = false;
    std::string out; ///< directory; empty: results/<scene>-sweep
};

/// Writes sweep.json, sweep.csv and plots, and prints a table. On one rank. Returns the exit code.
int sweep_command(const SweepOptions& options);

} // namespace asperity
