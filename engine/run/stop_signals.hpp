// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Signals that ask the program to stop: INT, TERM, HUP, USR1, USR2, XCPU.
//
// They are caught from the first line of main on, so that none is lost or kills while MPI starts or
// a surface is made. A run looks at them between steps and iterations, writes a checkpoint and ends
// with exit code 75. A second INT ends it at once. Those that were ignored when the program started
// (nohup, a shell's background jobs) stay ignored. PIPE and XFSZ are ignored as long: what cannot
// be written is an error of the write.
#pragma once

namespace asperity::stop_signals {

/// In main, before anything else. Signals that the parent process had blocked are delivered now.
void catch_all();
/// For commands that do not look at them: everything as it was before, XFSZ excepted; a signal that
/// has come in the meantime is delivered.
void release();
/// Whether one has come.
bool caught();

} // namespace asperity::stop_signals
