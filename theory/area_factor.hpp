// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The area factor S of A*(ζ) = A(ζ) S(q): the ratio of the area that follows the roughness to its
// projection; s = <|∇h|²> of all roughness up to q. Eq. (3) does not say how A* is computed.
#pragma once

#include <string_view>

namespace asperity::theory {

/// Definition of the area factor S(s).
enum class AreaFactor {
    gaussian,    ///< mean of √(1+|∇h|²) over Gaussian slopes of variance s
    small_slope, ///< 1 + s/2, the first two terms of `gaussian`
    none,        ///< A* = A
    lattice, ///< 1/(1 + c s): binding of a tilted interface of two lattices (flat_interface.hpp)
};

/// Returns S(s), 1 at s = 0. c: tilt cost of `lattice`.
[[nodiscard]] double area_factor(AreaFactor definition, double slope_variance, double c = 0);

/// Returns the name of a definition, as in theory.area_factor.
[[nodiscard]] std::string_view name(AreaFactor definition);

} // namespace asperity::theory
