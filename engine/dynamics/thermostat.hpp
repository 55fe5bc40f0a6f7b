// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Langevin noise for scenes with a temperature.
//
// The noise balances the damping of the scene: after the kick the velocity of each damped node is
// increased by sigma xi with sigma^2 = 2 Gamma k_B T dt / m / (1 + Gamma dt/2)^2 (Bruenger, Brooks
// and Karplus 1984). The stationary moments of a spring mode of frequency w are those of
//
//   T / (1 - (w dt/2)^2)       displacements u(n), and velocities v(n-1/2) at half steps;
//   T                          velocities at whole steps before friction and noise have acted,
//                              p(n) = v(n-1/2) + dt F(n)/2m, and after it, p'(n) = v(n+1/2) -
//                              dt F(n)/2m. The record's kinetic energy is the mean of both
//                              (kernels/node_noise.hpp), the trajectory has p(n);
//   T / (1 + Gamma dt/2)       the mean of v(n-1/2) and v(n+1/2), which is not reported.
//
// The mean energies at a step are those of T / (1 - (w dt/2)^2) in the springs and of T in motion,
// whereas the noise brings k_B T. The leapfrog conserves U + K - dt^2 F^2/8m (exactly for springs),
// and the energy balance includes the last term (Term::time_step).
//
// xi is drawn from a counter-based generator keyed by seed, step and node (kernels/node_noise.hpp):
// bitwise identical on any number of ranks and threads, and on a device. A scene at T = 0 has no
// thermostat object.
#pragma once

#include "engine/block/block.hpp"
#include "kernels/thermal_noise.hpp"

#include <cstdint>
#include <vector>

namespace asperity {

/// Langevin noise of a scene with a temperature.
class Thermostat {
public:
    /// Sets the parameters. temperature: K; damping: Gamma, 1/fs.
    Thermostat(double temperature, double damping, std::uint64_t seed)
        : temperature_(temperature), damping_(damping), seed_(seed) {}

    /// Returns the noise of a step. medium: velocity of the damping medium along z, Å/fs.
    ThermalNoise noise(double dt, long long step, double medium) const;

    /// Copies v(n-1/2) before a step; the energy given by the noise depends on these velocities.
    /// damping_from: fraction of the thickness above which damping acts.
    void keep_velocities(const Block& block, double damping_from);
    /// Adds the noise to v(n+1/2) and u(n+1). Returns this rank's shares of the energy given to the
    /// nodes and of the kinetic energy at the whole step, eV.
    NoiseSums kick(Block& block, const ThermalNoise& noise, double damping_from) const;
    /// Replaces v, which holds the mean of v(n-1/2) and v(n+1/2) of the lowest layer, by p(n),
    /// Å/fs.
    void set_velocities_at_step(const Block& block, const ThermalNoise& noise, double damping_from,
                                const VectorPlane<double>& v) const;

private:
    double temperature_, damping_;
    std::uint64_t seed_;
    /// v(n-1/2): rows of x, y and z of the planes of each level.
    std::vector<std::vector<double>> old_;
};

} // namespace asperity
