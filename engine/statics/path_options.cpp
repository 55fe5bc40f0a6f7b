// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/path_options.hpp"

#include "engine/units.hpp"

#include <algorithm>
#include <utility>

namespace asperity {

PathOptions path_options(const Case& c, const Interface& interface,
                         std::function<bool(long long, double)> report) {
    PathOptions o;
    o.along = c.simulation.drive.control == Control::top ? Constraint::Of::top
                                                         : Constraint::Of::mean_height;
    o.step = c.simulation.drive.displacement_step;
    o.tolerance = c.tolerance;
    o.scales = c.scales;
    o.load = c.simulation.drive.load_force;
    if (c.effects.branches) o.velocity = c.simulation.drive.velocity;
    o.over_wall = interface.wall() != nullptr;
    if (c.simulation.interface.hardness)
        o.yield_force = c.simulation.interface.mean_hardness() * c.area();
    o.report = std::move(report);
    const double flat = c.flat.work_of_adhesion / units::milli_per_unit;
    if (flat > 0.0) o.binding_energy = flat * c.area();
    return o;
}

} // namespace asperity
