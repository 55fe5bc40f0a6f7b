// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The adhesive sphere in a periodic box: the same sphere repeats with period L in both directions.
//
// The images' displacement near the contact is that of point forces F on a square lattice over a
// uniform background: (F / π E*) (φ0/L + φ2 r²/(4 L³)), with the lattice sums φ0 = -3.9002649
// (Σ 1/R less its mean) and φ2 = Σ 1/R³ = 9.0336217. The second term changes the gap like a
// curvature, 1/R -> 1/R + φ2 F / (2π E* L³): a pulled sphere looks larger. The first shifts the
// mean height of the surface. Next order: (a/L)² smaller.
//
// height: mean height of the block's surface above the sphere's apex, z = d0 - δ - φ0 F / (π E* L),
// d0 the separation of two flat surfaces at rest. Units: any consistent set.
#pragma once

#include "theory/jkr.hpp"

namespace asperity::theory {

struct PeriodicSphere {
    AdhesiveSphere sphere;
    double period = 0;     ///< L [length]
    double separation = 0; ///< d0 [length]

    /// R with the images of a sphere that is pressed with this force.
    [[nodiscard]] double radius_under(double force) const;
};

struct PeriodicState {
    SphereState contact;
    double height = 0; ///< z [length]
};

/// JKR at contact radius a.
[[nodiscard]] PeriodicState jkr_at_radius(const PeriodicSphere& what, double radius);
/// JKR's pull-off under a controlled load. NoSolution if the images hold the sphere at any load.
[[nodiscard]] PeriodicState jkr_pull_off(const PeriodicSphere& what);

/// Maugis' λ of a wall whose tension is at most `stress`: 2σ0 (R/πwK²)^{1/3}.
[[nodiscard]] double maugis_parameter(const AdhesiveSphere& sphere, double stress);
/// Maugis-Dugdale at m = c/a > 1 (maugis.hpp), and its pull-off.
[[nodiscard]] PeriodicState maugis_at_ratio(const PeriodicSphere& what, double stress, double m);
[[nodiscard]] PeriodicState maugis_pull_off(const PeriodicSphere& what, double stress);

} // namespace asperity::theory
