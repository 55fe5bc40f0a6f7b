// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Factors by which the law of a wall differs from site to site (wall_law.hpp). A plane of numbers
// for each factor goes through the kernels. A new factor is a name here, its use in scaled() of the
// laws, and its value in InterfaceOptions::law_factors() (engine/options/interface_options.cpp).
#pragma once

#include "kernels/annotations.hpp"

#include <cstddef>

namespace asperity {

/// A factor of the law of a site.
enum class LawFactor : std::size_t {
    attraction, ///< factor of the attraction
    count       ///< number of factors
};

/// A value for each factor.
template <class V>
struct LawFactors {
    static constexpr std::size_t count = static_cast<std::size_t>(LawFactor::count);

    V of[count];

    ASPERITY_INLINE V& operator[](LawFactor k) { return of[static_cast<std::size_t>(k)]; }
    ASPERITY_INLINE const V& operator[](LawFactor k) const {
        return of[static_cast<std::size_t>(k)];
    }
};

} // namespace asperity
