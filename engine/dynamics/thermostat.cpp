// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/thermostat.hpp"

#include "engine/units.hpp"
#include "kernels/node_noise.hpp"

#include <algorithm>

namespace asperity {

using namespace ASPERITY_VARIANT;

ThermalNoise Thermostat::noise(double dt, long long step, double medium) const {
    return {seed_,
            step,
            2.0 * damping_ * units::boltzmann * temperature_ * dt,
            1.0 + 0.5 * damping_ * dt,
            dt,
            medium};
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

NoiseSums Thermostat::kick(Block& block, const ThermalNoise& noise, double damping_from) const {
    NoiseSums sums;
    const int thickness = block.options().thickness;
#pragma omp parallel
    {
        NoiseSums mine;
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
                    const NoiseEnergies given =
                        add_noise(noise, level.mass(z), xi, {before[0], before[nx], before[2 * nx]},
                                  speed, place);
                    v.x(x, y, z) = speed.x, v.y(x, y, z) = speed.y, v.z(x, y, z) = speed.z;
                    u.x(x, y, z) = place.x, u.y(x, y, z) = place.y, u.z(x, y, z) = place.z;
                    if (!counted) continue;
                    mine.heat.add(given.heat);
                    mine.kinetic.add(given.kinetic);
                }
                mine.heat.carry();
                mine.kinetic.carry();
            }
        }
#pragma omp critical(asperity_thermostat)
        sums.heat.merge(mine.heat), sums.kinetic.merge(mine.kinetic);
    }
    return sums;
}

/// Computes p = w + g (w - V) from v = w + add/2, with w of push() (node_noise.hpp).
void Thermostat::set_velocities_at_step(const Block& block, const ThermalNoise& noise,
                                        double damping_from, const VectorPlane<double>& v) const {
    const Block::Level& level = block.levels().front();
    if (level.first_plane_from(damping_from, block.options().thickness) > 0) return;
    const double half = 0.5 * noise_speed(noise, level.mass(0)), g = noise.drag - 1.0;
    for (int y = 0; y < v.x.ny; ++y)
        for (int x = 0; x < v.x.nx; ++x) {
            const auto xi =
                normals(noise, level.shape.level, level.tile.x0 + x, level.tile.y0 + y, 0);
            const auto of_step = [&](double& mean, double add, double medium) {
                const double w = mean - half * add;
                mean = w + g * (w - medium);
            };
            of_step(v.x(x, y), xi.x, 0.0);
            of_step(v.y(x, y), xi.y, 0.0);
            of_step(v.z(x, y), xi.z, noise.medium_z);
        }
}

} // namespace asperity
