// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The sites of the interface, and the sums of a sweep.
//
// Block site (x, y) of the tile stands at ((x0+x+1/2) a + ux, (y0+y+1/2) a + uy, z_ref + uz).
// Units: Å, eV, eV/Å.
#pragma once

#include "kernels/exact_sum.hpp"
#include "kernels/views.hpp"

#include <cstdint>

namespace asperity {

/// The sites of the interface: one tile of the block's lowest layer.
struct InterfaceSites {
    VectorPlane<const double> displacement; ///< u, Å
    VectorPlane<double> force;              ///< output: force on each site, eV/Å (overwritten)
    double spacing = 2.6;                   ///< a, Å
    double reference_height = 0.0;          ///< z of an undisplaced site, Å
    int x0 = 0;                             ///< the tile's first site along x, counted over the box
    int y0 = 0;                             ///< the tile's first site along y
    /// Output, if given and observed: squared distance to the nearest atom, Å^2; no_pair if no atom
    /// is within the cutoff.
    PlaneView<double> nearest_r2{};
    /// Output, if given and observed: 1 if a site is closer than contact_distance() to an atom, or
    /// than contact_gap() to the wall.
    PlaneView<std::uint8_t> in_contact{};
};

/// Squared distance reported if no atom is within the cutoff.
inline constexpr double no_pair = 1e300;

/// Sums of one sweep over the sites, independent of the order. All except force_z are computed only
/// if observed.
struct InterfaceSums {
    ExactSum force_z;            ///< total normal force of the substrate on the sites, eV/Å
    ExactSum energy;             ///< energy of the interface, eV
    std::int64_t in_contact = 0; ///< number of sites in contact
    std::int64_t repulsive = 0;  ///< number of sites whose net normal force is repulsive
    double closest_r2 = no_pair; ///< smallest squared pair distance, Å^2

    /// Adds the sums of other sites.
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
