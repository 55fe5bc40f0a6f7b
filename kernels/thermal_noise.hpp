// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Parameters of the Langevin noise of a step; node_noise.hpp has its effect on a node.
#pragma once

#include "kernels/exact_sum.hpp"

#include <cstdint>

namespace asperity {

/// Langevin noise of a step.
struct ThermalNoise {
    std::uint64_t seed = 0;
    long long step = 0;
    double strength = 0.0; ///< 2 Gamma k_B T dt, eV; 0: no noise
    double drag = 1.0;     ///< 1 + Gamma dt/2
    double dt = 0.0;       ///< fs
    double medium_z = 0.0; ///< velocity of the damping medium along z, Å/fs
};

/// Changes that the noise of a step makes in the sums of that step, eV.
struct NoiseSums {
    ExactSum heat;    ///< energy given to the nodes
    ExactSum kinetic; ///< change of the kinetic energy at the whole step
};

} // namespace asperity
