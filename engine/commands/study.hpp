// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The commands that the Python package carries out (python/asperity): sweep, cost, report, export.
// They stand in the table of commands for --help; called, they become `python3 -m asperity`.
#pragma once

#include "engine/commands/command_line.hpp"

#include <optional>
#include <vector>

namespace asperity {

/// Their names and purposes, for the table.
const std::vector<Command>& study_commands();

/// If argv names one of them: replaces this process by Python with the package, which calls this
/// program back through $ASPERITY_PROGRAM. Returns only if argv names another command (nothing) or
/// Python or the package was not found (the exit code; the reason is printed). Before MPI is
/// initialised.
std::optional<int> hand_over_to_python(int argc, char** argv);

} // namespace asperity
