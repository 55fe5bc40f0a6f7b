// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The block's side of the interface, and the sums of a pass over it.
//
// Block site (x, y) of the tile stands at ((x0+x+1/2) a + ux, (y0+y+1/2) a + uy, z_ref + uz).
// Units: Å, eV, eV/Å.
#pragma once

#include "kernels/exact_sum.hpp"
#include "kernels/views.hpp"

#include <cstdint>

namespace asperity {

/// The block's side of the interface: one tile of its lowest layer.
struct InterfaceSites {
    VectorPlane<const double> displacement; ///< u, Å
    VectorPlane<double> force;              ///< out: force on each site, eV/Å (overwritten)
    double spacing = 2.6;                   ///< a, Å
    double reference_height = 0.0;          ///< z of an undisplaced site, Å
    int x0 = 0;                             ///< the tile's first site, counted over the box
    int y0 = 0;
    /// out, if given and observed: squared distance to the nearest atom in reach (no_pair if there
    /// is none), Å^2
    PlaneView<double> nearest_r2{};
    /// out, if given and observed: 1 if a site is closer than contact_distance to some atom, or
    /// than contact_gap to the wall
    PlaneView<std::uint8_t> in_contact{};
};

/// Squared distance reported if no atom is in reach.
inline constexpr double no_pair = 1e300;

/// Sums of one pass over the sites. Sums are order-independent.
struct InterfaceSums {
    ExactSum force_z;            ///< total normal force of the substrate on the sites, eV/Å
    ExactSum energy;             ///< U_LJ, eV (only if asked for)
    std::int64_t in_contact = 0; ///< sites closer than contact_distance to some atom (if asked for)
    std::int64_t repulsive = 0;  ///< sites whose net normal force is repulsive (if asked for)
    double closest_r2 = no_pair; ///< smallest squared pair distance met (if asked for), Å^2

    void merge(const InterfaceSums& other) {
        force_z.merge(other.force_z);
        energy.merge(other.energy);
        in_contact += other.in_contact;
        repulsive += other.repulsive;
        closest_r2 = other.closest_r2 < closest_r2 ? other.closest_r2 : closest_r2;
    }
    void carry() { force_z.carry(), energy.carry(); }
};

} // namespace asperity
