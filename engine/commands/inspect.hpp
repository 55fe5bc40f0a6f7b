// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The commands that simulate nothing: check, plan, surface, defaults, info.
// Each has a function. Each returns the exit code; rank 0 alone prints.
#pragma once

#include "engine/scene/scene.hpp"

#include <string>

namespace asperity {

class Communicator;

/// `asperity init`: a commented scene to start from. Throws io::SceneError where the file is there.
int init_command(const std::string& file, const Communicator& world);
/// `asperity check`. Throws io::SceneError with all that is wrong, like those below. json: the
/// scene as it would be used, its [sweep], notes and limits, as one line.
int check_command(const Scene& scene, bool json, const Communicator& world);
/// `asperity plan`; ranks: to plan for, 0: as many as there are.
int plan_command(const Scene& scene, int ranks, const Communicator& world);
/// `asperity surface`: heights.h5 and result.json in `out` (empty: results/<scene>-surface).
int surface_command(const Scene& scene, const std::string& out, const Communicator& world);
/// `asperity defaults`: as TOML, with or without explanations, or as the page docs/scene.md.
int defaults_command(bool markdown, bool plain, bool results, const Communicator& world);
/// `asperity defaults --json`: of every key its kind, unit, default, choices and meaning; results:
/// instead of every value of result.json its unit and meaning.
int schema_command(bool results, const Communicator& world);
/// `asperity info`
int info_command(const Communicator& world);

} // namespace asperity
