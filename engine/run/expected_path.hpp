// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What is led along a path, as far as it is known beforehand: for progress, and for `asperity
// plan`.
#pragma once

#include "engine/setup/case.hpp"

#include <vector>

namespace asperity {

struct ExpectedPath {
    /// Of each segment, Å: how far the top plane moves, or the block over the substrate.
    std::vector<double> ways;
    double deepest = 0.0; ///< below the start, Å
    double time = 0.0;    ///< of a dynamic path, fs
};
/// start: height of the lowest layer at the start, Å.
ExpectedPath expected_path(const Case& c, double start);

} // namespace asperity
