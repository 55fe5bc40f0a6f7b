// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Kernels of sites over a wall: forces, and sites that come to rest, each under its own force,
// while the elastic forces stay as they are (engine/equilibrium/wall_minimiser.hpp). All in double
// precision, but for what the minimiser hands over in single.
#pragma once

#include "kernels/interface_sites.hpp"
#include "kernels/wall_law.hpp"

namespace asperity {

/// A row of sites that come to rest.
template <class T>
struct WallRow {
    const double* below; ///< the wall's height, Å
    const double* u;     ///< where the sites are, Å
    const float* step;   ///< how far they went last, Å
    const T* elastic;    ///< S z, eV/Å, times 1 / norm
    double* next;        ///< out: where they come to rest, Å
};
struct WallRule {
    double reference_height; ///< Å
    double spring;           ///< eV/Å^2: of each site to z - (elastic force) / spring
    double momentum;         ///< z = u + momentum step
    double norm;
    double load; ///< on each site, pressing down, eV/Å
};
struct WallSums {
    double furthest = 0.0; ///< |next - z| and the force left on a site over the spring, Å
    double reversal = 0.0; ///< sum of (z - next) (next - u), Å^2
    double height = 0.0;   ///< sum of next, Å
};

/// Compiled for one processor level.
struct WallKernels {
    /// Forces of rows [row_begin, row_end); [observe]. nearest_r2: the square of the gap, 0 where
    /// it is negative.
    void (*sweep[2])(const InterfaceSites&, const PlaneView<const double>& height, const WallLaw&,
                     int row_begin, int row_end, InterfaceSums&);
    WallSums (*rest_double)(const WallLaw&, const WallRow<double>&, const WallRule&, int sites);
    WallSums (*rest_single)(const WallLaw&, const WallRow<float>&, const WallRule&, int sites);
};

} // namespace asperity
