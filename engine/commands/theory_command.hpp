// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity theory`: the analytic theory of a scene without simulating it, with its profile over
// magnification and where adhesion ends.
#pragma once

#include "engine/scene/scene.hpp"

#include <string>

namespace asperity {

/// Writes result.json and theory.h5 into `out` (empty: results/<scene>-theory) and prints a table;
/// json: prints what result.json would hold as one line and writes nothing.
/// On one rank. Returns the exit code. Throws io::SceneError.
int theory_command(const Scene& scene, const std::string& out, bool json);

} // namespace asperity
