// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The guard: conditions under which no path goes on, dynamic or quasi-static.
#pragma once

#include "engine/case/case.hpp"
#include "engine/dynamics/simulation.hpp"

#include <optional>
#include <string>

namespace asperity {

/// Largest relative error of the energy balance that counts as physics.
inline constexpr double largest_energy_error = 0.02;

/// Returns the error of a step or point, or nothing: a force or height that is not finite, an
/// energy balance with an error above largest_energy_error, or a lowest layer below this height
/// (Å), beyond the substrate. place: "step 1200".
std::optional<std::string> violation(const StepRecord& now, double lowest_height,
                                     const std::string& place);

/// Returns the error of a step or point of a case with this surface, or nothing.
std::optional<std::string> violation(const StepRecord& now, const Case& c, const Surface& surface);

/// Returns "site (3, 7) moves at 1e+05 m/s" for the site of the lowest layer with the largest
/// velocity, which may be infinite or not a number. Collective.
std::string fastest_site(const Simulation& simulation);
} // namespace asperity
