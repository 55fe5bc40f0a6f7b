// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The natural scales of a scene (engine/case/scales.cpp finds them). Steps, thresholds and
// tolerances of relaxations and of quasi-static paths are fractions of these, so that scenes that
// differ only in the scale of length or energy are solved in the same way.
#pragma once

namespace asperity {

/// Natural scales of a scene.
struct Scales {
    double length = 0.0;    ///< length over which the interface's force on a site changes, Å
    double force = 0.0;     ///< smallest force on a site that decides the state, eV/Å
    double stiffness = 0.0; ///< stiffness of the interface per site at its energy minimum, eV/Å^2

    /// Returns the force that the stiffness gives for a displacement by `length`, eV/Å.
    double interface_force() const { return stiffness * length; }
};

} // namespace asperity
