// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity sweep`: one scene (or several), several values of one or more of its keys, one table.
//
//     asperity sweep scenes/paper/small/fig2-equilibrium.toml
//     asperity sweep scenes/paper/fig2.toml --theory-only --set surface.rms=0.1:10:0.1
//
// What is swept stands in the scene's [sweep] or behind --set (sweep_grid.hpp). Every point is a
// scene of its own, read and checked like any other, all of them before the first is computed. A
// point is simulated by a process of its own (sweep_points.hpp), in a directory of its own inside
// that of the sweep; the same command goes on where it stopped, and adds points to those that are
// there. --theory-only computes the theory alone, about 15 ms a point.
//
// Several scenes share one pool of processes and one set of plots: dynamics beside equilibrium.
#pragma once

#include "io/progress.hpp"

#include <optional>
#include <string>
#include <vector>

namespace asperity {

struct SweepOptions {
    std::vector<std::string> scenes;      ///< files
    std::vector<std::string> assignments; ///< of --set
    bool theory_only = false;
    int jobs = 1;                      ///< points side by side
    std::vector<std::string> launcher; ///< words before the program
    std::optional<double> wall_limit;  ///< s
    io::ProgressMode progress = io::ProgressMode::automatic;
    std::string out; ///< directory; empty: results/<scene>-sweep
};

/// Runs what is missing, writes the tables and plots, and prints the table. On one rank. Returns
/// the exit code: 75 if stopped before the end, else that of the first point that failed.
int sweep_command(const SweepOptions& options);

} // namespace asperity
