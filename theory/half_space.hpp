// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Elastic half-space and layer without adhesion: Hertz, and the stiffness of a layer of finite
// thickness. Units: any consistent set.
#pragma once

namespace asperity::theory {

/// E* = E/(1-ν²), one body rigid.
[[nodiscard]] double contact_modulus(double youngs_modulus, double poisson_ratio);

/// Hertz: a rigid sphere of radius R on a half-space of modulus E*.
struct Sphere {
    double radius = 0;          ///< R [length]
    double contact_modulus = 0; ///< E* [stress]
};

struct HertzContact {
    double radius = 0;   ///< a = (3FR/4E*)^(1/3) [length]
    double pressure = 0; ///< p0 = 3F/2πa², at the centre [stress]
    double approach = 0; ///< δ = a²/R [length]
};
[[nodiscard]] HertzContact hertz(const Sphere& sphere, double force);

/// Normal stiffness (stress over displacement) of the frictionless surface of a layer of thickness
/// H bonded to a rigid base, for the wavevector q.
[[nodiscard]] double layer_stiffness(double q, double thickness, double youngs_modulus,
                                     double poisson_ratio);

/// The same over that of a half-space, q E*/2. q H = x.
[[nodiscard]] double layer_stiffness_ratio(double x, double poisson_ratio);

} // namespace asperity::theory
