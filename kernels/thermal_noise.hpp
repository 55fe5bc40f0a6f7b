// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Parameters of the Langevin noise of a step; node_noise.hpp has its effect on a node.
#pragma once

#include <cstdint>

namespace asperity {

/// Langevin noise of a step.
struct ThermalNoise {
    std::uint64_t seed = 0;
    long long step = 0;
    double strength = 0.0; ///< 2 Gamma k_B T dt, eV; 0: no noise
    double drag = 1.0;     ///< 1 + Gamma dt/2
    double dt = 0.0;       ///< fs
};

} // namespace asperity
