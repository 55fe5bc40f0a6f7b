// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The adhesive sphere between its limits. Maugis' model lets a constant stress σ0 act across the
// gap out to an opening w/σ0; λ = 2σ0 (R/πwK²)^{1/3} says which limit is near: DMT (λ -> 0,
// pull-off 2πwR) or JKR (λ -> ∞, pull-off 3πwR/2). Tabor's number μ says the same of a
// Lennard-Jones contact whose forces have the range z0; matching the depth of the potential gives λ
// = 1.157 μ.
#pragma once

#include "theory/jkr.hpp"

namespace asperity::theory {

/// μ = (R w²/(E² z0³))^{1/3}. The paper takes E, most others E*; the modulus is the caller's.
[[nodiscard]] double tabor_number(double radius, double work_of_adhesion, double modulus,
                                  double range);

namespace maugis {

/// A state in Maugis' units (jkr.hpp), at m = c/a >= 1, c the radius the attraction reaches.
struct Reduced {
    double m = 1, force = 0, radius = 0, approach = 0;
};
[[nodiscard]] Reduced at_ratio(double lambda, double m);
/// Smallest force on the curve: pull-off under a controlled load.
[[nodiscard]] Reduced pull_off(double lambda);

// The same with dimensions.
[[nodiscard]] SphereState at_ratio(const AdhesiveSphere& sphere, double lambda, double m);
[[nodiscard]] SphereState pull_off(const AdhesiveSphere& sphere, double lambda);

} // namespace maugis

} // namespace asperity::theory
