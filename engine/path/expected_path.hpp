// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The course of a path as estimated from the scene, for progress and for `asperity plan`.
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
/// Estimates distances and times of the case's path. start: height of the lowest layer at the
/// start, Å.
ExpectedPath expected_path(const Case& c, double start);

} // namespace asperity
