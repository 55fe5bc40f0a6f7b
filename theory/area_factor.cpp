// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The gradient of an isotropic Gaussian surface has |∇h|² = s t with t exponentially distributed,
// so
//     S = ∫ √(1+st) e^{-t} dt = 1 + ½ √(πs) e^{1/s} erfc(1/√s).
// Below s = 1/400 the exponential overflows before erfc underflows is of any help; there the
// asymptotic series S = 1 + (s/2)(1 - s/2 + 3s²/4 - 15s³/8 + ...) has lost nothing in double
// precision.
#include "theory/area_factor.hpp"

#include <cmath>
#include <numbers>

#include "theory/error.hpp"

namespace asperity::theory {

double area_factor(AreaReading reading, double s) {
    if (!(s >= 0))
        throw InvalidInput(message("area factor: slope variance ", s,
                                   " is negative or not a number; it is a mean square"));
    switch (reading.factor) {
    case AreaFactor::none:
        return 1;
    case AreaFactor::lattice:
        return 1 / (1 + reading.tilt_cost * s);
    case AreaFactor::small_slope:
        return 1 + s / 2;
    case AreaFactor::gaussian:
        break;
    }
    if (s < 1.0 / 400) {
        double sum = 0, term = 1;
        for (int k = 1; k <= 10; ++k) {
            sum += term;
            term *= -(2 * k - 1) * s / 2;
        }
        return 1 + s / 2 * sum;
    }
    return 1 +
           0.5 * std::sqrt(std::numbers::pi * s) * std::exp(1 / s) * std::erfc(1 / std::sqrt(s));
}

std::string_view name(AreaFactor reading) {
    switch (reading) {
    case AreaFactor::gaussian:
        return "gaussian";
    case AreaFactor::small_slope:
        return "small-slope";
    case AreaFactor::lattice:
        return "lattice";
    case AreaFactor::none:
        break;
    }
    return "none";
}

} // namespace asperity::theory
