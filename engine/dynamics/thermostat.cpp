// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/thermostat.hpp"

#include "engine/units.hpp"

namespace asperity {

using namespace ASPERITY_VARIANT;

ThermalNoise Thermostat::noise(double dt, long long step) const {
    return {seed_, step, 2.0 * damping_ * units::boltzmann * temperature_ * dt,
            1.0 + 0.5 * damping_ * dt, dt};
}

ExactSum Thermostat::kick(Block& block, double dt, double damping_from, long long step) const {
    ExactSum heat;
    const int thickness = block.options().thickness;
    const ThermalNoise noise = this->noise(dt, step);
#pragma omp parallel
    {
        ExactSum mine;
        for (const Block::Level& level : block.levels()) {
            const Block::Fields fields = block.fields(level);
            const auto v = fields.v.view(), u = fields.u.view();
            const bool counted = block.counts(level);
            const int from = level.first_plane_from(damping_from, thickness);
#pragma omp for schedule(static)
            for (int row = from * level.tile.ny; row < level.shape.cells * level.tile.ny; ++row) {
                const int z = row / level.tile.ny, y = row % level.tile.ny;
                for (int x = 0; x < level.tile.nx; ++x) {
                    const auto xi =
                        normals(noise, level.shape.level, level.tile.x0 + x, level.tile.y0 + y, z);
                    Triple<double> speed = {v.x(x, y, z), v.y(x, y, z), v.z(x, y, z)};
                    Triple<double> place = {u.x(x, y, z), u.y(x, y, z), u.z(x, y, z)};
                    const double given = add_noise(noise, level.mass(z), xi, speed, place);
                    v.x(x, y, z) = speed.x, v.y(x, y, z) = speed.y, v.z(x, y, z) = speed.z;
                    u.x(x, y, z) = place.x, u.y(x, y, z) = place.y, u.z(x, y, z) = place.z;
                    if (counted) mine.add(given);
                }
                mine.carry();
            }
        }
#pragma omp critical(asperity_thermostat)
        heat.merge(mine);
    }
    return heat;
}

} // namespace asperity
