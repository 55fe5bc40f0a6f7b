// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// result.json: what a command found.
//
// ResultRecord mirrors the file key by key; what was not computed stays empty and is left out
// of the file. A run that fails writes its record too, with the reason. The file appears whole or
// not at all (written beside its place, then renamed), and a directory that already holds a result
// is never written over without being asked.
#pragma once

#include "io/json_value.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity::io {

using Quantity = std::optional<double>;

struct ResultRecord {
    std::string name; ///< of the scene
    JsonValue scene;  ///< everything that was used, defaults filled in

    struct Surface {
        Quantity rms, rms_slope, min, max; ///< Å, -, Å, Å
        std::string origin;                ///< whose map it is; empty: not told
    } surface;

    Quantity delta_gamma;    ///< flat reference, meV/Å^2, same cutoff and sites
    Quantity binding_energy; ///< meV/Å^2, relaxed zero-load state
    struct Work {
        Quantity approach, pull_off, pairwise; ///< meV/Å^2
    } work_of_adhesion;
    Quantity contact_fraction, pushed_fraction; ///< at zero load
    Quantity pull_off_force;                    ///< eV/Å, positive
    struct Jkr {
        Quantity in, out; ///< meV/Å^2, of a curved surface
    } jkr;
    struct Theory {
        Quantity gamma_eff, contact_fraction, gamma_full_contact; ///< meV/Å^2, -, meV/Å^2
    } theory;
    struct Energy {
        Quantity residual;                                  ///< relative
        Quantity work, kinetic, elastic, interface, damped; ///< eV
    } energy;

    struct Phase {
        std::string name;
        double seconds = 0.0;
        long long calls = 0;
    };
    struct Run {
        Quantity wall_seconds;
        std::optional<long long> steps, iterations;
        std::optional<int> ranks, threads;
        std::vector<Phase> phases;
        std::string
            stopped; ///< "max_steps", "wall_limit", "signal"; empty: the path's end was reached
        // version, git, compiler, flags and machine are filled in from build_info.
    } run;

    /// Why the command failed; empty: it did not.
    struct Failure {
        int exit_code = 0;
        std::string reason;
    } failure;

    /// Whatever else is worth keeping; dots lead deeper ("run.levels"). Never a name listed above.
    std::vector<std::pair<std::string, JsonValue>> extra;
};

/// The record in the layout of the file.
JsonValue result_json(const ResultRecord& record);

/// Writes directory/result.json, whole or not at all. Throws FileError.
void write_result(const std::string& directory, const ResultRecord& record);

/// Writes text to path, whole or not at all (temporary file beside it, then renamed). Throws
/// FileError.
void write_whole(const std::string& path, const std::string& text);

/// Which directory a command writes to.
struct ResultPlace {
    std::string directory;
    std::string note; ///< says so where the name is not the one expected; else empty
};
/// asked: the --out of the command line, or empty for results/<name>, then results/<name>-2, -3,
/// ... A directory asked for that already holds result.json is refused (SceneError) unless
/// resuming. Looks, but makes nothing.
ResultPlace choose_result_directory(const std::string& asked, const std::string& name,
                                    bool resuming);
/// Makes the directory (and its parents). Throws FileError.
void make_directory(const std::string& directory);

} // namespace asperity::io
