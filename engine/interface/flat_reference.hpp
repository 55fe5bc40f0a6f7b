// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Flat on flat: what two flat solids with the interface of a scene would do to each other. Binding
// energies are divided by it.
#pragma once

#include "engine/interface/interface.hpp"

namespace asperity {

/// Flat block on flat substrate: what gamma_eff is divided by.
struct FlatReference {
    double work_of_adhesion = 0.0;   ///< -U / A at its minimum, meV/Å^2
    double separation = 0.0;         ///< there, Å
    double largest_tension = 0.0;    ///< GPa
    double tension_separation = 0.0; ///< where the tension is largest, Å
    double stiffness = 0.0;          ///< U'' / A at the minimum, eV/Å^4
};

/// Energy (eV) and normal force (eV/Å) of one block site at a uniform gap over a flat substrate of
/// spacing b, averaged over the registries that the two lattices take (one for equal spacings:
/// hollow sites); or over a wall.
PairSum flat_pair_sum(const InterfaceOptions& options, double spacing, int sites,
                      int substrate_sites, double gap);

/// Flat on flat with this potential, cutoff and lattices, or with this wall (all but the stiffness
/// are zero where it does not attract). Throws std::invalid_argument if they do
/// not bind.
FlatReference flat_reference(const InterfaceOptions& options, double spacing, int sites,
                             int substrate_sites);

} // namespace asperity
