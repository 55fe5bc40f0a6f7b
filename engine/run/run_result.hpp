// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The result of a run: each number of result.json is named here, where it is collected, and
// described in io/quantities.hpp. Also the part of a scene that a checkpoint keeps.
#pragma once

#include "engine/path/path.hpp"
#include "io/result.hpp"

#include <optional>
#include <string>

namespace asperity {

/// Returns a result with the scene's name, keys and their units.
io::Result scene_result(const Scene& scene);
/// Returns scene_result() with the statistics of the surface.
io::Result surface_result(const Case& c, const Surface& surface);
/// Returns the common part of the results of dynamic and quasi-static runs: the scene, its surface,
/// its effects, the results, theory, ranks and threads.
io::Result run_result(const Case& c, const Surface& surface, const PathResults& results);

/// Returns the part of a case that may not change between a checkpoint and its resumption: keys,
/// and the map or the atoms of a file.
std::string physics_of(const Case& c, const Surface& surface);

/// Adds steps and energies of a path. failed: the step or point at which a guard ended the path.
void add_steps(const Path& path, const std::optional<StepRecord>& failed, io::Result& result);
void add_phases(const Phases& phases, io::Result& result);

} // namespace asperity
