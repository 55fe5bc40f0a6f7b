// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The exit code of the program, with and without an error.
//
// Every rank of mpirun runs the same command; only rank 0 prints. An error in a scene occurs on all
// ranks, or on rank 0 for all of them: all ranks agree on the code and end regularly. Any other
// error aborts all ranks at once, because other ranks may be waiting for the failed one.
#pragma once

#include <functional>

namespace asperity {

class Communicator;
class ParallelSession;

/// Calls work() and returns the exit code, the same on every rank: the result of work(), or the
/// code of its exception, which is printed. json: prints an error as one line {"error": {"code",
/// "problems": [{"where", "what", "why", "fix"}], "text"}}.
int exit_code_of(const Communicator& world, bool json, const std::function<int()>& work);

/// Refuses to run if a launcher has started several processes that MPI does not connect
/// (session.unconnected()), because each would do the whole run. The first process throws
/// io::SceneError; the others wait until the launcher ends them, and otherwise return the same
/// code.
int refuse_unconnected(const ParallelSession& session);

} // namespace asperity
