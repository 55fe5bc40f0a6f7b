// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The end of the program, with and without an error.
//
// Under mpirun every rank runs the same command; rank 0 alone prints. An error in a scene is met
// by all ranks alike, or by rank 0 for all of them: they agree on the code and end in order. Any
// other error ends them all at once (abort), because the others may be waiting for this one.
#pragma once

#include <functional>

namespace asperity {

class Communicator;
class ParallelSession;

/// Does the work and returns the exit code, the same on every rank: its own, or that of the error
/// it threw, which is printed.
int exit_code_of(const Communicator& world, const std::function<int()>& work);

/// Where a launcher has started several processes and MPI connects none (session.unconnected()):
/// each would take itself for the whole run. In the first of them throws io::SceneError, elsewhere
/// waits for the launcher to end it, and returns the same code.
int refuse_unconnected(const ParallelSession& session);

} // namespace asperity
