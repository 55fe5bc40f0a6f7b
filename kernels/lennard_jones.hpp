// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The pair potential of the interface (docs/model.md):
//
//     V(r) = 4 epsilon [(r0/r)^12 - (r0/r)^6] - V(r_c)   for r < r_c,   0 beyond.
//
// The force is the plain derivative, so energy is continuous at the cutoff and the force has the
// small step V'(r_c). Near r = 0 the squared distance is held at r2_floor: a start with overlapping
// atoms gives a huge finite force instead of infinity, and the guard of the time step catches it.
#pragma once

#include "kernels/annotations.hpp"

#include <cmath>

namespace asperity {

struct LennardJones {
    double epsilon = 0.1;  ///< depth, eV
    double r0 = 3.28;      ///< zero crossing, Å
    double cutoff = 13.12; ///< r_c, Å

    ASPERITY_HOST_DEVICE double r2_cut() const { return cutoff * cutoff; }
    /// (0.3 r0)^2: repulsion there is 10^7 epsilon, far beyond any physical state.
    ASPERITY_HOST_DEVICE double r2_floor() const { return 0.09 * r0 * r0; }
    /// V(r_c) of the unshifted potential, eV.
    ASPERITY_HOST_DEVICE double shift() const {
        const double s2 = r0 * r0 / (cutoff * cutoff);
        const double s6 = s2 * s2 * s2;
        return 4.0 * epsilon * s6 * (s6 - 1.0);
    }
    /// Distance of the inflection V'' = 0, (26/7)^(1/6) r0: closer than this counts as contact.
    double contact_distance() const { return std::pow(26.0 / 7.0, 1.0 / 6.0) * r0; }

    /// Energy of a pair at squared distance r2, eV.
    ASPERITY_HOST_DEVICE double energy(double r2) const {
        if (r2 >= r2_cut()) return 0.0;
        const double s2 = r0 * r0 / (r2 > r2_floor() ? r2 : r2_floor());
        const double s6 = s2 * s2 * s2;
        return 4.0 * epsilon * s6 * (s6 - 1.0) - shift();
    }
    /// -V'(r)/r: times the distance vector it is the force, eV/Å^2.
    ASPERITY_HOST_DEVICE double force_over_distance(double r2) const {
        if (r2 >= r2_cut()) return 0.0;
        const double inverse = 1.0 / (r2 > r2_floor() ? r2 : r2_floor());
        const double s2 = r0 * r0 * inverse;
        const double s6 = s2 * s2 * s2;
        return 24.0 * epsilon * s6 * (2.0 * s6 - 1.0) * inverse;
    }
};

} // namespace asperity
