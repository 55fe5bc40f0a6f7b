// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#pragma once

namespace asperity {

/// Carries out a command line, as main() gets it, and returns the exit code. Installs the handlers
/// of signals and starts MPI: once a process.
int program(int argc, char** argv);

} // namespace asperity
