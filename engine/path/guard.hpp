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

/// Returns the error message for a step or point that is not physical, or nothing. Conditions that
/// are not physical: a force or height that is not finite, an error of the energy balance above
/// largest_energy_error, a time step too long for the motion, and a mean height of the lowest layer
/// below lowest_height (Å), inside the substrate. place: position for the message, "step 1200".
std::optional<std::string> violation(const StepRecord& now, double lowest_height,
                                     const std::string& place);

/// Returns the error message for a step or point of a case that is not physical, or nothing; the
/// lowest height follows from the surface.
std::optional<std::string> violation(const StepRecord& now, const Case& c, const Surface& surface);

/// Returns "site (3, 7) moves at 1e+05 m/s" for the site of the lowest layer with the largest
/// velocity, which may be infinite or not a number. Collective.
std::string fastest_site(const Simulation& simulation);
} // namespace asperity
