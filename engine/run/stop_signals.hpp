// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Signals that ask the program to stop: INT, TERM, HUP, USR1, USR2, XCPU.
//
// Signals are caught from the first line of main on, so that none is lost or kills the program
// while MPI starts or a surface is made. A run looks at them between steps and iterations, writes a
// checkpoint and ends with exit code 75. A second INT ends it at once. Signals that were ignored
// when the program started (nohup, a shell's background jobs) stay ignored. PIPE and XFSZ are
// ignored as well: a failed write is reported as an error of the write.
#pragma once

namespace asperity::stop_signals {

/// Catches the signals; main calls it first. Signals that the parent process had blocked are
/// delivered now.
void catch_all();
/// Restores the earlier handlers except that of XFSZ, for commands that do not check for signals,
/// and raises a signal that has arrived in the meantime.
void release();
/// Returns true if a signal has arrived.
bool caught();

} // namespace asperity::stop_signals
