// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The natural scales of a scene (engine/setup/scales.cpp finds them). Steps, thresholds and
// tolerances of relaxations and of quasi-static paths are fractions of these, so that scenes which
// differ in the unit of length or of energy alone are solved in the same way.
#pragma once

namespace asperity {

struct Scales {
    double length = 0.0;    ///< over which the interface's force on a site changes, Å
    double force = 0.0;     ///< the smallest on a site that decides the state, eV/Å
    double stiffness = 0.0; ///< of the interface at its minimum, for a site, eV/Å^2

    /// A force of the interface on a site that is displaced by the length, eV/Å.
    double interface_force() const { return stiffness * length; }
};

} // namespace asperity
