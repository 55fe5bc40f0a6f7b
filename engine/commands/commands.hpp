// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The commands except `run`. Each returns the exit code and throws io::SceneError with all mistakes
// in the scene. Only rank 0 prints.
#pragma once

#include "engine/case/case.hpp"

#include <string>
#include <vector>

namespace asperity {

class Communicator;
struct Arguments;

/// Writes a commented scene to start from (`asperity init`). Throws io::SceneError if the file
/// exists.
int init_command(const Arguments& given, const Communicator& world);
/// Checks a scene (`asperity check`). --quiet: prints nothing without mistakes; --json: prints the
/// resolved scene, its [sweep], notes and limits as one line.
int check_command(const Case& c, const Arguments& given, const Communicator& world);
/// Plans a run on the ranks of the case (`asperity plan`). --json: prints plan_json() and the notes
/// as one line.
int plan_command(const Case& c, const Arguments& given, const Communicator& world);
/// Writes heights.h5 and result.json (`asperity surface`) to --out (empty:
/// results/<scene>-surface). --json: instead prints rms height (Å), rms slope from neighbours,
/// notes, and possible mistakes in the file of a map (doubts), as one line.
int surface_command(const Case& c, const Arguments& given, const Communicator& world);
/// Prints the keys as TOML (`asperity defaults`). markdown: as the page docs/reference/scene.md;
/// plain: without explanations; results: the page docs/reference/result.md instead.
int defaults_command(bool markdown, bool plain, bool results, const Communicator& world);
/// Prints kind, unit, default, choices and meaning of every key as JSON (`asperity defaults
/// --json`). results: prints unit and meaning of every value of result.json instead.
int schema_command(bool results, const Communicator& world);
/// Prints version, compiler and machine (`asperity info`). json: prints one line of JSON.
int info_command(bool json, const Communicator& world);

/// Input of `asperity theory-points SCENE`, on one rank: many variations of one scene in one call,
/// for programs. The Python package computes its theories with it, and sweeps check their points.
///
/// Each line of the input is a JSON array of overrides, ["surface.rms=1", "surface.seed=2"]. Each
/// line of the output is a JSON object for the point of the same line, either
///     {"name", "scene", "units", "delta_gamma", "theory": {...}, "flat", "notes": [...], "rough"}
/// with the keys and units of result.json, the separation (Å) and the largest tension (GPa) of flat
/// on flat, and renormalised_inputs(); or {"problems": [{"where", "what", "why", "fix"}]}.
struct TheoryPoints {
    std::string scene;                  ///< file
    std::vector<std::string> overrides; ///< overrides of every point
    std::string points;    ///< file of the points; "-": standard input; empty: the scene alone
    bool runnable = false; ///< report also the problems that would stop a run (examine())
    /// Output also theory.persson.critical_rms, and "profile": [{"name", "unit", "meaning",
    /// "values"}], the theory at all magnifications.
    bool profile = false;
};
/// Prints the theories of the points (`asperity theory-points`). Throws io::FileError if the input
/// cannot be read.
int theory_points_command(const TheoryPoints& what);
/// Computes the stresses below a state of a run (`asperity stress-below`), for programs. scene:
/// block and output.stress*; given.points: a file of JSON, {"file": run.h5, "state": name of a
/// group of /fields, "slid": true for the tractions of with_slopes()}; given.out: file of HDF5 to
/// which the group /stress/<state> is written. Prints the largest stresses of each layer as one
/// line of JSON.
int stress_below_command(const Case& c, const Arguments& given);
/// Locks a result directory and sends the lock's file descriptor through the Unix socket at
/// standard input (`asperity hold`). Throws io::SceneError if the standard input is no socket, and
/// io::FileError if the directory is in use.
int hold_command(const std::string& directory);

} // namespace asperity
