// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "theory/half_space.hpp"

#include <cmath>

#include "theory/error.hpp"

namespace asperity::theory {

double contact_modulus(double youngs_modulus, double poisson_ratio) {
    if (!(poisson_ratio > -1 && poisson_ratio <= 0.5))
        throw InvalidInput(message("Poisson ratio ", poisson_ratio,
                                   " is outside (-1, 0.5], where an isotropic solid is stable; "
                                   "check the ratio"));
    if (!(youngs_modulus > 0) || !std::isfinite(youngs_modulus))
        throw InvalidInput(message("Young's modulus ", youngs_modulus,
                                   " is not positive, so nothing is elastic; check the modulus"));
    return youngs_modulus / (1 - poisson_ratio * poisson_ratio);
}

} // namespace asperity::theory
