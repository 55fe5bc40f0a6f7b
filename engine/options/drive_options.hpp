// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Options of the drive.
#pragma once

#include "engine/options/segment.hpp"

#include <optional>
#include <vector>

namespace asperity {

/// Quantity that a quasi-static path prescribes.
enum class Control { top, mean_height };

/// Options of the drive, in the units of the engine.
struct DriveOptions {
    double velocity = 5e-5;  ///< Å/fs
    double ramp = 0.0;       ///< time over which a velocity changes, fs
    double load_force = 0.0; ///< total normal force at which an approach ends, eV/Å
    double area = 1.0;       ///< area of the interface, Å^2
    /// Time over which the force that ends a segment is averaged, fs, for a warm block, whose force
    /// fluctuates; 0: no average.
    double average_over = 0.0;
    Control control = Control::top; ///< quantity that a quasi-static path prescribes
    /// Largest step between points of a quasi-static path, Å.
    double displacement_step = 0.25;
    /// Number of steps or points after which the run stops; empty: no limit.
    std::optional<long long> max_steps;
    /// Segments of the path.
    std::vector<Segment> path = {{Segment::approach, 0.0, 0, "approach"},
                                 {Segment::pull_off, 0.0, 0, "pull-off"}};
};

} // namespace asperity
