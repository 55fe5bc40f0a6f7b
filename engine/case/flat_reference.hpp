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
    double largest_tension = 0.0;    ///< largest tension, GPa
    double tension_separation = 0.0; ///< separation of the largest tension, Å
    double stiffness = 0.0;          ///< U'' / A at the minimum, eV/Å^4
};

/// Returns energy (eV) and normal force (eV/Å) of one block site at a uniform gap (Å) over a flat
/// wall or a flat substrate of atoms, averaged over the registries of the two lattices (for equal
/// spacings the hollow site alone). sites, substrate_sites: atoms across the box of block and
/// substrate; spacing: that of the block, Å.
PairSum flat_pair_sum(const InterfaceOptions& options, double spacing, int sites,
                      int substrate_sites, double gap);

/// Computes the reference for an interface and lattices; arguments as for flat_pair_sum(). For a
/// wall without attraction all members except the stiffness are zero. Throws std::invalid_argument
/// if solids with atoms do not bind.
FlatReference flat_reference(const InterfaceOptions& options, double spacing, int sites,
                             int substrate_sites);

} // namespace asperity
