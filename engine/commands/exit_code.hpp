// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The end of the program, with and without an error.
//
// Every rank of mpirun runs the same command; rank 0 alone prints. All ranks meet an error in a
// scene alike, or rank 0 meets it for all of them: they agree on the code and end in order. Any
// other error ends them all at once (abort), because the others may be waiting for this one.
#pragma once

#include <functional>

namespace asperity {

class Communicator;
class ParallelSession;

/// Calls work() and returns the exit code, the same on every rank: the result of work(), or the
/// code of the error that it threw, which is printed. json: the error is printed as one line
/// {"error": {"code", "problems": [{"where", "what", "why", "fix"}], "text"}}, for programs.
int exit_code_of(const Communicator& world, bool json, const std::function<int()>& work);

/// Ends a process of a launcher that has started several processes of which MPI connects none
/// (session.unconnected()): each would take itself for the whole run. The first process throws
/// io::SceneError; the others wait for the launcher to end them, and return the same code.
int refuse_unconnected(const ParallelSession& session);

} // namespace asperity
