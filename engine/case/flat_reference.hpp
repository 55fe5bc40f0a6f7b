// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Flat on flat: the interaction of two flat solids with the interface of a scene. Binding energies
// are divided by its work of adhesion.
#pragma once

#include "engine/options/interface_options.hpp"

namespace asperity {

/// Flat block on flat substrate: the reference of gamma_eff.
struct FlatReference {
    double work_of_adhesion = 0.0;   ///< -U / A at its minimum, meV/Å^2
    double separation = 0.0;         ///< separation at the minimum, Å
    double largest_tension = 0.0;    ///< GPa
    double tension_separation = 0.0; ///< separation of the largest tension, Å
    double stiffness = 0.0;          ///< U'' / A at the minimum, eV/Å^4
};

/// Returns energy (eV) and normal force (eV/Å) of one block site at a uniform gap over a flat
/// substrate of spacing b, averaged over the registries of the two lattices (one for equal
/// spacings: hollow sites); or over a wall.
PairSum flat_pair_sum(const InterfaceOptions& options, double spacing, int sites,
                      int substrate_sites, double gap);

/// Returns the reference for this potential, cutoff and lattices, or for this wall (all but the
/// stiffness are zero for a wall without attraction). Throws std::invalid_argument if the two
/// solids do not bind.
FlatReference flat_reference(const InterfaceOptions& options, double spacing, int sites,
                             int substrate_sites);

} // namespace asperity
