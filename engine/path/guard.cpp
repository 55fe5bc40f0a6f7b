// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/guard.hpp"

#include "decomposition/global_largest.hpp"
#include "engine/units.hpp"
#include "io/terminal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace asperity {

std::optional<std::string> violation(const StepRecord& now, double lowest_height,
                                     const std::string& place) {
    if (!std::isfinite(now.force) || !std::isfinite(now.mean_height) ||
        !std::isfinite(now.top_force))
        return fmt::format("the motion diverged at {}: the force is {}", place, now.force);
    const double residual = now.observed ? now.residual : 0.0;
    if (!(std::abs(residual) <= largest_energy_error))
        return fmt::format("the energy balance is off by {} % at {}",
                           io::number(100.0 * residual, 1), place);
    if (now.observed && -now[Term::time_step] > now.largest_stored())
        return fmt::format(
            "the time step is too long for the motion at {}: {:.3g} eV of the energy "
            "are of waves that it does not resolve",
            place, -now[Term::time_step]);
    if (now.mean_height < lowest_height)
        return fmt::format("the block has passed through the substrate at {}: its lowest layer is "
                           "at {:.4g} Å",
                           place, now.mean_height);
    return std::nullopt;
}

std::string fastest_site(const Simulation& simulation) {
    const auto& level = simulation.block().levels().front();
    const auto v = level.v.view()[0];
    const LargestSite fastest =
        global_largest(simulation.communicator(), level.tile, [&](int x, int y) {
            return std::sqrt(v.x(x, y) * v.x(x, y) + v.y(x, y) * v.y(x, y) + v.z(x, y) * v.z(x, y));
        });
    return fmt::format("site ({}, {}) moves at {:.3g} m/s", fastest.x, fastest.y,
                       fastest.value / units::metre_per_second);
}

std::optional<std::string> violation(const StepRecord& now, const Case& c, const Surface& surface) {
    double lowest = surface.statistics.lowest - reach_of(c.simulation.interface);
    // A wall gives way: the mean gap is no less than that of flat surfaces under the same force.
    if (const auto& wall = c.simulation.interface.wall) {
        const auto depth = [&](const auto& law) { return law.depth_under(now.force / c.sites()); };
        lowest -= 2.0 * std::visit(depth, *wall);
    }
    if (surface.holes > 0) lowest = -HUGE_VAL; // the surface hangs into holes
    return violation(now, lowest,
                     fmt::format("{} {}", c.effects.dynamic ? "step" : "point", now.step));
}

} // namespace asperity
