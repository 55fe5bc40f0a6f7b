// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Output of a run at its beginning and at its end.
#pragma once

#include "engine/case/case.hpp"
#include "engine/path/path_results.hpp"
#include "io/result.hpp"

#include <cstdio>
#include <string>

namespace asperity {

/// Prints the effects and sizes of the simulation in a few lines. threads: threads of a rank;
/// bytes: memory of the path on all ranks; directory: the result directory.
void print_opening(std::FILE* to, const Case& c, const Surface& surface, const ProcessGrid& grid,
                   int threads, std::size_t bytes, const std::string& directory);

/// Returns the state of a run for its line of progress: "approach, -12.3 MPa, contact 0.012, height
/// 3.11 Å". force: total normal force, eV/Å; in_contact: number of sites; mean_height: Å.
std::string progress_phase(const Case& c, const std::string& segment, double force,
                           long long in_contact, double mean_height);

/// Prints the main numbers of result.json side by side, with notes on their meaning. directory: the
/// result directory; "": prints the numbers alone.
void print_summary(std::FILE* to, const Case& c, const io::Result& result,
                   const PathResults& results, const std::string& directory);

} // namespace asperity
