// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Files that a scene names: where they are looked for, and the branches of a viscoelastic block.
#pragma once

#include "engine/scene/scene.hpp"

#include <string>

namespace asperity {

/// Returns the file that a key names, beside the scene or in the working directory (in reverse
/// order if it was named on the command line); empty if there is none.
std::string find_beside_scene(const Scene& scene, const std::string& file, const std::string& key);
/// Returns the places in which find_beside_scene() looks, in words.
std::string places_looked_at(const Scene& scene, const std::string& file, const std::string& key);

/// Reads the file of block.prony, a TOML file with
///     [block]   young, prony, poisson    as in a scene; the last may be missing
///     [fit]     source, rms_error        of the fit; both may be missing
/// and fills in block.prony, and young and poisson if the scene does not set them. Adds mistakes to
/// problems.
void read_fit(Scene& scene, io::Problems& problems);

} // namespace asperity
