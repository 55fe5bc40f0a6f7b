// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// result.json: what a command found.
//
// ResultRecord mirrors the file key by key; what was not computed stays empty and is left out
// of the file. A run that fails writes its record too, with the reason. Which directory it goes to
// is result_directory.hpp's matter.
#pragma once

#include "io/json_value.hpp"
#include "io/output_file.hpp"

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

/// Writes result.json, whole or not at all. Throws FileError.
void write_result(const Directory& directory, const ResultRecord& record);

} // namespace asperity::io
