// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What the terminal says at the beginning and at the end of a run.
#pragma once

#include "engine/equilibrium/findings.hpp"
#include "engine/scene/scene.hpp"
#include "engine/setup/setup.hpp"

#include <cstdio>
#include <string>

namespace asperity {

/// What is going to be simulated, in a few lines.
void print_opening(std::FILE* to, const Scene& scene, const Setup& setup, const Surface& surface,
                   const ProcessGrid& grid, int threads, std::size_t bytes,
                   const std::string& directory);

/// The numbers side by side, and how to read them. residual: of the energy balance (dynamic runs),
/// or NaN.
void print_summary(std::FILE* to, const Scene& scene, const Setup& setup, const Findings& findings,
                   double residual, const std::string& directory);

} // namespace asperity
