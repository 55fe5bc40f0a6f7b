// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A run without a path in time: straight to the relaxed state under zero load.
#pragma once

#include "engine/run/run.hpp"

namespace asperity {

/// As run(), which calls it for scenes with path = ["zero-load"].
int run_equilibrium(const Scene& scene, const RunOptions& options,
                    const Communicator& communicator);

} // namespace asperity
