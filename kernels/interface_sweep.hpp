// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Lennard-Jones forces between the block's lowest layer and the rigid substrate: the contract.
//
// Three sweeps give the same answer:
//   reference  every site against every substrate atom in reach by an explicit loop over pairs, scalar,
//              obvious: the judge of the other two;
//   lattice    both sides are the same lattice, so the neighbours of a site are known offsets: SIMD
//              over sites, sums in registers over the offsets in a fixed order;
//   cell list  any substrate (incommensurate): atoms sorted into square cells, SIMD over atoms of a cell.
//
// Block site (x, y) of the tile stands at ((x0 + x + 1/2) a + ux, (y0 + y + 1/2) a + uy, z_ref + uz).
// Units: Å, eV, eV/Å.
#pragma once

#include "kernels/exact_sum.hpp"
#include "kernels/lennard_jones.hpp"
#include "kernels/views.hpp"

#include <cstdint>

namespace asperity {

/// The block's side of the interface: one tile of its lowest layer.
struct InterfaceSites {
    VectorPlane<const double> displacement; ///< u, Å
    VectorPlane<double> force;              ///< out: force on each site, eV/Å (overwritten, owned sites)
    double spacing = 2.6;                   ///< a, Å
    double reference_height = 0.0;          ///< z of an undisplaced site, Å
};

/// What one pass over the sites adds up. Sums are order-independent.
struct InterfaceSums {
    ExactSum force_z;           ///< total normal force of the substrate on the sites, eV/Å
    ExactSum energy;            ///< U_LJ, eV (only if asked for)
    std::int64_t in_contact = 0;///< sites closer than contact_distance to some atom (only if asked for)
    std::int64_t pushed = 0;    ///< sites whose net normal force is repulsive (only if asked for)
    std::int64_t in_reach = 0;  ///< sites of the blocks of sites that were not skipped
    double closest_r2 = 1e300;  ///< smallest squared pair distance met (only if asked for), Å^2

    void merge(const InterfaceSums& other) {
        force_z.merge(other.force_z);
        energy.merge(other.energy);
        in_contact += other.in_contact;
        pushed += other.pushed;
        in_reach += other.in_reach;
        closest_r2 = other.closest_r2 < closest_r2 ? other.closest_r2 : closest_r2;
    }
};

} // namespace asperity
