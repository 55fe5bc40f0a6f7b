// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The ranks that run the tests (support/main.cpp).
#pragma once

#include "decomposition/communicator.hpp"

namespace asperity::test {

/// The ranks of this run; one if the test was started without mpirun.
const Communicator& world();

} // namespace asperity::test
