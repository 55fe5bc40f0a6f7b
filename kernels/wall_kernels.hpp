// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Kernels of sites over a wall: forces, and the equilibrium of each site under its own force while
// the elastic forces are held fixed (engine/statics/wall_minimiser.hpp). All in double precision
// except the single-precision input of the minimiser. A NaN height of the wall means no solid and
// no force.
#pragma once

#include "kernels/interface_sites.hpp"
#include "kernels/wall_law.hpp"

namespace asperity {

/// Numbers of the wall at the sites of a tile.
struct WallMaps {
    PlaneView<const double> height; ///< height of the wall before it yields, Å; NaN: no solid
    /// Factors of the law of each site (ScaledBySite); no origin: one law for all sites.
    LawFactors<PlaneView<const double>> factors{};
    /// Gap at which the law's force is that of the hardness, Å: at smaller gaps the force is this
    /// one. No origin: no site yields.
    PlaneView<const double> yield_gap{};
    PlaneView<const double> set{}; ///< permanent set by which the wall is lower, Å
};
/// A row of sites that move to their equilibria.
template <class T>
struct WallRow {
    const double* below = nullptr; ///< height of the wall, Å; NaN: no solid
    const double* u;               ///< places of the sites, Å
    const float* step;             ///< last moves of the sites, Å
    const T* elastic;              ///< S z / norm, eV/Å
    /// Factors of the law of each site (ScaledBySite); nullptr: one law for all sites.
    LawFactors<const double*> factors{};
    const double* yield_gap = nullptr; ///< WallMaps::yield_gap; nullptr: no site yields
    const double* set = nullptr;       ///< WallMaps::set; nullptr: no site yields
    double* next;                      ///< output: equilibria of the sites, Å
};
/// Parameters of an equilibrium over a wall; z is the point at which the elastic force is known.
struct WallRule {
    double reference_height; ///< Å
    double spring;           ///< spring from each site to z - (elastic force) / spring, eV/Å^2
    double momentum;         ///< factor of the last move: z = u + momentum step
    double norm;             ///< factor of the elastic forces
    double load;             ///< load on each site, eV/Å; positive presses
};
/// Sums over the sites of a row.
struct WallSums {
    /// Largest |next - z| and largest residual force on a site divided by `spring`, Å.
    double furthest = 0.0;
    double reversal = 0.0; ///< sum of (z - next) (next - u), Å^2
    double height = 0.0;   ///< sum of next, Å
};

/// Kernels of a wall, compiled for one processor level.
struct WallKernels {
    /// Computes the forces on rows [row_begin, row_end); index: [observe]. nearest_r2 is set to the
    /// square of the gap, 0 if the gap is negative. The energy is that of the law, without the
    /// plastic work below the yield gap.
    void (*sweep[2])(const InterfaceSites&, const WallMaps&, const WallLaw&, int row_begin,
                     int row_end, InterfaceSums&);
    /// Moves the sites of a row to their equilibria.
    WallSums (*rest_double)(const WallLaw&, const WallRow<double>&, const WallRule&, int sites);
    WallSums (*rest_single)(const WallLaw&, const WallRow<float>&, const WallRule&, int sites);
};

} // namespace asperity
