// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity theory SCENE --points FILE`: many variations of one scene in one call, for programs.
// Sweeps use it to check their points and to compute the theory beside them.
//
// Each line of the input is a JSON array of overrides, ["surface.rms=1", "surface.seed=2"]. Each
// line of the output is a JSON object for the point of the same line, either
//     {"name", "scene", "delta_gamma", "theory": {...}, "notes": [...]}
// with the keys and units of result.json, or {"problems": [{"where", "what", "why", "fix"}]}.
#pragma once

#include <string>
#include <vector>

namespace asperity {

struct TheoryPoints {
    std::string scene;                  ///< file
    std::vector<std::string> overrides; ///< of every point
    std::string points;                 ///< file of the points; "-": standard input
    bool runnable = false; ///< also report what a run of the point would refuse (examine())
};

/// On one rank. Returns the exit code. Throws io::SceneError, io::FileError for the input.
int theory_points_command(const TheoryPoints& what);

} // namespace asperity
