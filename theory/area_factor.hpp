// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The area factor S: how much larger the contact area A* that follows the roughness is than its
// projection A,
//     A*(ζ) = A(ζ) S(q),   s = <|∇h|²> of all roughness up to q.
// Eq. (3) of the paper uses A* without saying how it is computed; the readings are named here.
#pragma once

#include <string_view>

namespace asperity::theory {

enum class AreaFactor {
    gaussian,    ///< mean of √(1+|∇h|²) over Gaussian slopes of variance s
    small_slope, ///< 1 + s/2, its first two terms
    none,        ///< A* = A
    lattice, ///< 1/(1 + c s): what a tilted interface of two lattices binds (flat_interface.hpp)
};

/// A reading, with what `lattice` needs to know.
struct AreaReading {
    AreaReading(AreaFactor reading, double cost = 0) : factor(reading), tilt_cost(cost) {}
    AreaFactor factor;
    double tilt_cost; ///< c
};

/// S(s), 1 at s = 0.
[[nodiscard]] double area_factor(AreaReading reading, double slope_variance);

/// "gaussian", "small-slope", "none" or "lattice".
[[nodiscard]] std::string_view name(AreaFactor reading);

} // namespace asperity::theory
