// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// From what a run computed to result.json: each number is named here, where it is collected, and
// described in io/quantities.hpp.
#pragma once

#include "engine/equilibrium/path_results.hpp"
#include "engine/setup/case.hpp"
#include "io/result.hpp"

#include <string>

namespace asperity {

/// A result with the scene's name, keys and their units.
io::Result scene_result(const Scene& scene);
/// The same with the statistics of the surface.
io::Result surface_result(const Case& c, const Surface& surface);
/// What dynamic runs and without it have in common: the scene, its surface, its effects, the
/// results, theory, ranks and threads.
io::Result run_result(const Case& c, const Surface& surface, const PathResults& results);

/// Energies of the last observed step or point.
void add_energies(const StepRecord& now, io::Result& result);
void add_phases(const Phases& phases, io::Result& result);

} // namespace asperity
