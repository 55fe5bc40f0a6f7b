// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#pragma once

namespace asperity {

/// Carries out the command line of main() and returns the exit code. Installs the signal handlers
/// and starts MPI; may be called once per process.
int program(int argc, char** argv);

} // namespace asperity
