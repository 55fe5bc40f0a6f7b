// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The expected course of a path, as far as it is known beforehand, for progress and for `asperity
// plan`.
#pragma once

#include "engine/case/case.hpp"

#include <vector>

namespace asperity {

/// Expected distances and times of a path.
struct ExpectedPath {
    /// Distance that the top plane moves, or the block over the substrate, in each segment, Å.
    std::vector<double> ways;
    double deepest = 0.0; ///< largest depth below the start, Å
    double time = 0.0;    ///< duration of a dynamic path, fs
};
/// Returns the expected path. start: height of the lowest layer at the start, Å.
ExpectedPath expected_path(const Case& c, double start);

} // namespace asperity
