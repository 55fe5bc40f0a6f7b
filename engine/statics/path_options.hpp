// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The options of a quasi-static path (quasistatic.hpp).
#pragma once

#include "engine/case/case.hpp"
#include "engine/interface/interface.hpp"
#include "engine/options/scales.hpp"
#include "engine/waves/constraint.hpp"

#include <cmath>
#include <functional>
#include <optional>

namespace asperity {

/// Options of a quasi-static path.
struct PathOptions {
    Constraint::Of along = Constraint::Of::top; ///< or mean_height
    double step = 0.25;                         ///< largest step of the prescribed coordinate, Å
    double tolerance = 0.0;                     ///< tolerance at small forces, eV/Å
    Scales scales;
    double load = 0.0;     ///< force at which the approach ends, eV/Å
    double velocity = 0.0; ///< velocity of the drive if the block is viscoelastic, Å/fs
    /// Binding energy of flat surfaces of the area of the box, eV; empty if they do not attract.
    std::optional<double> binding_energy = {};
    bool over_wall = false; ///< the substrate is a wall
    /// Force under which the whole surface yields, eV/Å; infinite: it does not yield.
    double yield_force = HUGE_VAL;
    /// Called during relaxations with the iteration and the residual, eV/Å. Returns true to stop.
    std::function<bool(long long, double)> report;

    /// Returns true if the solids attract each other.
    bool attracts() const { return binding_energy.has_value(); }
    /// Returns true if only one state exists at each position, so that nothing is dissipated at
    /// instabilities: the energy of an elastic block over a purely repulsive wall is convex, with
    /// the plastic work of a step as well.
    bool reversible() const { return over_wall && !attracts() && !(velocity > 0.0); }
};

/// Returns the options of the path of a case. report: PathOptions::report.
PathOptions path_options(const Case& c, const Interface& interface,
                         std::function<bool(long long, double)> report = {});

} // namespace asperity
