// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Files that a scene names: their search, and the file of the branches of a viscoelastic block.
#pragma once

#include "engine/scene/scene.hpp"

#include <string>

namespace asperity {

/// Finds the file that a key names in the folder of the scene or in the working directory (searched
/// first if the key was set on the command line). Returns its path; empty if it does not exist.
std::string find_beside_scene(const Scene& scene, const std::string& file, const std::string& key);
/// Returns the folders that find_beside_scene() searches, as text for messages.
std::string places_looked_at(const Scene& scene, const std::string& file, const std::string& key);

/// Reads the file of block.prony, a TOML file with
///     [block]   young, prony, poisson    as in a scene; the last may be missing
///     [fit]     source, rms_error        of the fit; both may be missing
/// and fills in block.prony, and young and poisson if the scene does not set them. Adds mistakes to
/// problems.
void read_fit(Scene& scene, io::Problems& problems);

} // namespace asperity
