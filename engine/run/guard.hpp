// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What no path goes on from, dynamic or quasi-static.
#pragma once

#include "engine/dynamics/simulation.hpp"
#include "engine/setup/case.hpp"
#include "io/error.hpp"

#include <optional>
#include <string>

namespace asperity {

/// Largest relative error of the energy balance that counts as physics.
inline constexpr double largest_energy_error = 0.02;

/// What is wrong at a step or point, or nothing: a force or height that is no number, an energy
/// balance off by more than largest_energy_error, or a lowest layer below this height (Å), beyond
/// the substrate. place: "step 1200".
std::optional<std::string> violation(const StepRecord& now, double lowest_height,
                                     const std::string& place);

/// "site (3, 7) moves at 1e+05 m/s": that of the lowest layer with the largest velocity, which may
/// be infinite or no number. Collective.
std::string fastest_site(const Simulation& simulation);
/// Of a time step at which something was wrong; where: its fastest_site(); kept: what is left to
/// go on from.
io::PhysicsError step_failed(const std::string& wrong, const std::string& where, const Case& c,
                             const std::string& kept);

/// At the end of an approach. Throws io::PhysicsError where it was to end under a pull (load, eV/Å,
/// negative) larger than the largest attraction that it met. slack: what a force may be wrong by,
/// eV/Å; area: Å^2.
void require_load_reached(double load, double attraction, double slack, double area);

} // namespace asperity
