// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/thermostat.hpp"

#include "engine/units.hpp"
#include "kernels/node_noise.hpp"

#include <algorithm>

namespace asperity {

using namespace ASPERITY_VARIANT;

ThermalNoise Thermostat::noise(double dt, long long step) const {
    return {seed_, step, 2.0 * damping_ * units::boltzmann * temperature_ * dt,
            1.0 + 0.5 * damping_ * dt, dt};
}

void Thermostat::keep_velocities(const Block& block, double damping_from) {
    old_.resize(block.levels().size());
    for (std::size_t l = 0; l < old_.size(); ++l) {
        const Block::Level& level = block.levels()[l];
        const auto v = level.v.view();
        const int from = level.first_plane_from(damping_from, block.options().thickness);
        const auto nx = static_cast<std::size_t>(level.tile.nx);
        const int rows = std::max(0, level.shape.cells - from) * level.tile.ny;
        old_[l].resize(3 * nx * static_cast<std::size_t>(rows));
#pragma omp parallel for schedule(static)
        for (int row = 0; row < rows; ++row) {
            const int z = from + row / level.tile.ny, y = row % level.tile.ny;
            double* to = old_[l].data() + 3 * nx * static_cast<std::size_t>(row);
            for (const auto& of : {v.x, v.y, v.z})
                to = std::copy_n(&of(0, y, z), nx, to);
        }
    }
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
            const auto& old = old_[static_cast<std::size_t>(&level - block.levels().data())];
            const auto nx = static_cast<std::size_t>(level.tile.nx);
#pragma omp for schedule(static)
            for (int row = from * level.tile.ny; row < level.shape.cells * level.tile.ny; ++row) {
                const int z = row / level.tile.ny, y = row % level.tile.ny;
                const double* before =
                    old.data() + 3 * nx * static_cast<std::size_t>(row - from * level.tile.ny);
                for (int x = 0; x < level.tile.nx; ++x, ++before) {
                    const auto xi =
                        normals(noise, level.shape.level, level.tile.x0 + x, level.tile.y0 + y, z);
                    Triple<double> speed = {v.x(x, y, z), v.y(x, y, z), v.z(x, y, z)};
                    Triple<double> place = {u.x(x, y, z), u.y(x, y, z), u.z(x, y, z)};
                    const double given =
                        add_noise(noise, level.mass(z), xi, {before[0], before[nx], before[2 * nx]},
                                  speed, place);
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
