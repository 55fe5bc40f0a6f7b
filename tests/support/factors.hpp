// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A scene in other units is the same scene.
#pragma once

#include <cmath>

namespace asperity::test {

/// Factors of the units of a scene: what a number of each kind is multiplied by.
struct Factors {
    double length = 1.0, energy = 1.0;
    double time() const { return length / std::sqrt(energy); }
    double force() const { return energy / length; }
    double pressure() const { return energy / (length * length * length); }
    double surface() const { return energy / (length * length); }
};

} // namespace asperity::test
