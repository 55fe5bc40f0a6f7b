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
/// Returns the segment that ends under the largest force. Requires a segment.
const SegmentResults& most_pressed(const PathResults& results);
/// Returns scene_result() with the statistics of the surface.
io::Result surface_result(const Case& c, const Surface& surface);
/// Returns surface_result() with the effects, the results of the path, theory, ranks and threads.
io::Result run_result(const Case& c, const Surface& surface, const PathResults& results);

/// Returns as text the part of a case that may not change between a checkpoint and its resumption:
/// keys, and digests of the map or the atoms of a file.
std::string physics_of(const Case& c, const Surface& surface);

/// Adds the number of steps and the energies of a path: of its last step or point, or of `failed`,
/// at which a guard ended the path.
void add_steps(const Path& path, const std::optional<StepRecord>& failed, io::Result& result);
/// Adds the wall time and number of calls of each phase.
void add_phases(const Phases& phases, io::Result& result);

} // namespace asperity
