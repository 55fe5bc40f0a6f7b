// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What no path goes on from, dynamic or quasi-static.
#pragma once

#include "engine/dynamics/simulation.hpp"

#include <functional>
#include <optional>
#include <string>

namespace asperity {

class Path;

/// Largest relative error of the energy balance that counts as physics.
inline constexpr double largest_energy_error = 0.02;

/// What is wrong at a step or point, or nothing: a force or height that is no number, an energy
/// balance off by more than largest_energy_error, or a lowest layer below this height (Å), beyond
/// the substrate. place: "step 1200".
std::optional<std::string> violation(const StepRecord& now, double lowest_height,
                                     const std::string& place);

/// Throws io::PhysicsError where that is so at path.now(). kept: says what is left to go on from.
/// Collective.
void guard(const Path& path, const std::function<std::string()>& kept = {});

/// "site (3, 7) moves at 1e+05 m/s": that of the lowest layer with the largest velocity, which may
/// be infinite or no number. Collective.
std::string fastest_site(const Simulation& simulation);
} // namespace asperity
