// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How fast this process is at a scene: the rates of the real kernels, measured for some 0.3 s on a
// smaller piece of it, with the same layers, the same interface and a cut-out of the same surface.
#pragma once

#include "engine/scene/surface.hpp"
#include "engine/setup/setup.hpp"

#include <string>
#include <vector>

namespace asperity {

/// Seconds of this process with all its threads.
struct Rates {
    double node = 0.0;        ///< a node's step: forces, kick, drift, damping
    double finite = 0.0;      ///< what finite strain adds to a node's forces
    double noise = 0.0;       ///< of a node and step
    double far = 0.0;         ///< a site out of reach
    double near = 0.0;        ///< a site in contact
    double tail = 0.0;        ///< what the tail adds to either
    double absorption = 0.0;  ///< of seams, of a site and step
    double hanging = 0.0;     ///< interpolation, of a site and step
    double rest = 0.0;        ///< halos, sums, mean height: of a site and step
    double observation = 0.0; ///< of a node and observed step
    double iteration = 0.0;   ///< of a relaxation: of a site
    double making = 0.0;      ///< tables and block, of a site
    std::string origin;       ///< where they come from, in words
};

/// What the scene does not ask for is not measured: 0.
Rates measure_rates(const Scene& scene, const Setup& setup, const Surface& surface);

/// Of all levels together.
double nodes_of(const std::vector<LevelShape>& levels);

} // namespace asperity
