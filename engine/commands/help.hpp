// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The help of the program and of its commands, in 80 columns: usage, purpose, arguments, options,
// exit codes. Commands of the Python package print the same form
// (python/asperity/commands/command_line.py). packaging/generate.py makes man page and completions
// from the help.
#pragma once

#include "engine/commands/command_line.hpp"

#include <string>
#include <vector>

namespace asperity {

/// Returns the help of a command of the program.
std::string help_of(const Command& command);
/// Returns the help of the program: its commands, in their order.
std::string overview_of(const std::vector<Command>& commands);

} // namespace asperity
