// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A run in time: approach and pull-off at the velocity of the drive.
#pragma once

#include "engine/run/run.hpp"

namespace asperity {

/// As run(), which checks the scene.
int run_in_time(const Scene& scene, const RunOptions& options, const Communicator& communicator);

} // namespace asperity
