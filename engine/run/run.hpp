// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// `asperity run`: from a case to a result directory.
#pragma once

#include "engine/case/case.hpp"
#include "io/terminal.hpp"

#include <optional>
#include <string>

namespace asperity {

/// Options of `asperity run`.
struct RunOptions {
    std::string out;                  ///< --out; empty: results/<scene>
    std::string resume;               ///< --resume: "", "auto", or a checkpoint file
    bool restart = false;             ///< --restart: discards an unfinished run in the directory
    std::optional<double> wall_limit; ///< --wall-limit, s
    io::ProgressMode progress = io::ProgressMode::automatic;
    bool quiet = false; ///< print the summary alone
    bool json = false;  ///< print result.json on one line and nothing else

    bool resuming() const { return !resume.empty(); }
};

/// Runs the case on all ranks of the communicator, whose number must be that of the case, and
/// prints the summary on rank 0. Returns the exit code. Collective. Throws io::Error.
int run(const Case& c, const RunOptions& options, const Communicator& communicator);

} // namespace asperity
