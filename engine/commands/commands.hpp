// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the commands other than `run` do. Each returns the exit code and throws io::SceneError with
// all that is wrong with the scene; rank 0 alone prints.
#pragma once

#include "engine/setup/case.hpp"

#include <string>
#include <vector>

namespace asperity {

class Communicator;

/// `asperity init`: a commented scene to start from. Throws where the file is there.
int init_command(const std::string& file, const Communicator& world);
/// `asperity check`. json: the scene as it would be used, its [sweep], notes and limits, as one
/// line.
int check_command(const Case& c, bool json, const Communicator& world);
/// `asperity plan`, for the ranks of the case.
int plan_command(const Case& c, const Communicator& world);
/// `asperity surface`: heights.h5 and result.json in `out` (empty: results/<scene>-surface). json:
/// rms height (Å), rms slope of neighbours, notes, and those on the file of a map (doubts), as one
/// line.
int surface_command(const Case& c, const std::string& out, bool json, const Communicator& world);
/// `asperity defaults`: as TOML, with or without explanations, or as the page
/// docs/reference/scene.md.
int defaults_command(bool markdown, bool plain, bool results, const Communicator& world);
/// `asperity defaults --json`: of every key its kind, unit, default, choices and meaning; results:
/// instead of every value of result.json its unit and meaning.
int schema_command(bool results, const Communicator& world);
/// `asperity info`
int info_command(const Communicator& world);

/// `asperity theory-points SCENE`, on one rank: many variations of one scene in one call, for
/// programs. The Python package computes its theories with it, and sweeps check their points.
///
/// Each line of the input is a JSON array of overrides, ["surface.rms=1", "surface.seed=2"]. Each
/// line of the output is a JSON object for the point of the same line, either
///     {"name", "scene", "units", "delta_gamma", "theory": {...}, "flat", "notes": [...], "rough"}
/// with the keys and units of result.json, the separation (Å) and the largest tension (GPa) of flat
/// on flat, and renormalised_inputs(); or {"problems": [{"where", "what", "why", "fix"}]}.
struct TheoryPoints {
    std::string scene;                  ///< file
    std::vector<std::string> overrides; ///< of every point
    std::string points;    ///< file of the points; "-": standard input; empty: the scene alone
    bool runnable = false; ///< also report what a run of the point would refuse (examine())
    bool profile = false;  ///< theory.persson.critical_rms, and "profile": [{"name", "unit",
                           ///< "meaning", "values"}], everything at every magnification
};
/// Throws io::FileError for the input.
int theory_points_command(const TheoryPoints& what);

} // namespace asperity
