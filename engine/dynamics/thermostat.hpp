// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Langevin noise for scenes with a temperature.
//
// The damping of the scene gets its fluctuating partner: after the kick each damped node's velocity
// receives sigma xi with sigma^2 = 2 Gamma k_B T dt / m / (1 + Gamma dt/2)^2 (Bruenger, Brooks and
// Karplus 1984). The stationary moments of a spring mode of frequency w are those of the
// temperature
//
//   T / (1 - (w dt/2)^2)       displacements, and velocities at half steps;
//   T / (1 + Gamma dt/2)^2     the record's kinetic energy: velocities at whole steps, without the
//                              noise of the present step, half of which belongs to them.
//
// xi is drawn from a counter-based generator keyed by seed, step and node
// (kernels/node_noise.hpp): bitwise identical on any number of ranks and threads, and on a
// device. A scene at T = 0 has no thermostat object at all.
#pragma once

#include "engine/block/block.hpp"
#include "kernels/thermal_noise.hpp"

#include <cstdint>
#include <vector>

namespace asperity {

/// Langevin noise of a scene with a temperature.
class Thermostat {
public:
    /// Sets the parameters. temperature: K; damping: 1/fs.
    Thermostat(double temperature, double damping, std::uint64_t seed)
        : temperature_(temperature), damping_(damping), seed_(seed) {}

    /// Returns the noise of a step.
    ThermalNoise noise(double dt, long long step) const;

    /// Copies v(n-1/2) before a step, because the energy given by the noise depends on it.
    void keep_velocities(const Block& block, double damping_from);
    /// Adds the noise of this step to v(n+1/2) and u(n+1). Returns this rank's share of the energy
    /// given to the nodes, eV.
    ExactSum kick(Block& block, double dt, double damping_from, long long step) const;

private:
    double temperature_, damping_;
    std::uint64_t seed_;
    /// v(n-1/2): rows of x, y and z of the planes of each level
    std::vector<std::vector<double>> old_;
};

} // namespace asperity
