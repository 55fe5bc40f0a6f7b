// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/dynamics/thermostat.hpp"

#include "engine/units.hpp"

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {

/// Three independent normal numbers of one node and step.
std::array<double, 3> normals(std::uint64_t seed, long long step, int level, int x, int y, int z) {
    using Generator = r123::Philox4x32;
    const auto u = static_cast<std::uint64_t>(step);
    const Generator::ctr_type counter = {
        {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
         static_cast<std::uint32_t>(z) | static_cast<std::uint32_t>(level) << 24,
         static_cast<std::uint32_t>(u)}};
    const Generator::key_type key = {{static_cast<std::uint32_t>(seed ^ (u >> 32) * 0x9E3779B9u),
                                      static_cast<std::uint32_t>(seed >> 32)}};
    const auto bits = Generator()(counter, key);
    const auto uniform = [](std::uint32_t b) { return (static_cast<double>(b) + 0.5) * 0x1p-32; };
    const double r1 = std::sqrt(-2.0 * std::log(uniform(bits[0])));
    const double r2 = std::sqrt(-2.0 * std::log(uniform(bits[2])));
    const double a1 = 2.0 * std::numbers::pi * uniform(bits[1]);
    const double a2 = 2.0 * std::numbers::pi * uniform(bits[3]);
    return {r1 * std::cos(a1), r1 * std::sin(a1), r2 * std::cos(a2)};
}

} // namespace

ExactSum Thermostat::kick(Block& block, double dt, double damping_from, long long step) const {
    ExactSum heat;
    const int thickness = block.options().thickness;
#pragma omp parallel
    {
        ExactSum mine;
        for (auto& level : block.levels()) {
            const auto v = level.v.view(), u = level.u.view();
            const bool counted = block.counts(level);
            const int from = level.first_plane_from(damping_from, thickness);
#pragma omp for schedule(static)
            for (int row = from * level.tile.ny; row < level.plan.cells * level.tile.ny; ++row) {
                const int z = row / level.tile.ny, y = row % level.tile.ny;
                const double m = level.mass(z);
                const double sigma =
                    std::sqrt(2.0 * damping_ * units::boltzmann * temperature_ * dt / m) /
                    (1.0 + 0.5 * damping_ * dt);
                for (int x = 0; x < level.tile.nx; ++x) {
                    const auto xi = normals(seed_, step, level.plan.level, level.tile.x0 + x,
                                            level.tile.y0 + y, z);
                    const auto push = [&](const VolumeView<double>& speed,
                                          const VolumeView<double>& place, double number) {
                        const double add = sigma * number, before = speed(x, y, z);
                        speed(x, y, z) = before + add;
                        place(x, y, z) += dt * add;
                        return add * (before + 0.5 * add);
                    };
                    const double given =
                        push(v.x, u.x, xi[0]) + push(v.y, u.y, xi[1]) + push(v.z, u.z, xi[2]);
                    if (counted) mine.add(m * given);
                }
            }
        }
#pragma omp critical(asperity_thermostat)
        heat.merge(mine);
    }
    return heat;
}

} // namespace asperity
