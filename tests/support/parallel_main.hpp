// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// main() of the tests that run on several ranks. All ranks run all tests; the program fails if any
// rank saw a failure, and the ranks but the first print nothing else.
#pragma once

#include "decomposition/communicator.hpp"

namespace asperity::test {

/// The ranks of this run; one if the test was started without mpirun.
const Communicator& world();

} // namespace asperity::test
