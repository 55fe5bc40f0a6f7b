// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// From what a run computed to result.json: each number is named here, where it is collected, and
// described in io/quantities.hpp. And what a checkpoint keeps of its scene.
#pragma once

#include "engine/path/path.hpp"
#include "io/result.hpp"

#include <optional>
#include <string>

namespace asperity {

/// A result with the scene's name, keys and their units.
io::Result scene_result(const Scene& scene);
/// The same with the statistics of the surface.
io::Result surface_result(const Case& c, const Surface& surface);
/// What dynamic runs and without it have in common: the scene, its surface, its effects, the
/// results, theory, ranks and threads.
io::Result run_result(const Case& c, const Surface& surface, const PathResults& results);

/// What may not change between a checkpoint and its resumption: keys, and the map or the atoms of a
/// file.
std::string physics_of(const Case& c, const Surface& surface);

/// Steps and energies of a path; failed: the step or point that a guard ended it at.
void add_steps(const Path& path, const std::optional<StepRecord>& failed, io::Result& result);
void add_phases(const Phases& phases, io::Result& result);

} // namespace asperity
