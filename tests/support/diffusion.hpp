// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Eq. (2) by finite volumes: what the first-passage equation of theory/ is compared with. It shares
// nothing with it but the grid of the clock.
#pragma once

#include "theory/march.hpp"
#include "theory/persson.hpp"

namespace asperity::theory {

[[nodiscard]] MarchPath diffusion(const MarchGrid& grid, const MarchInput& input, double spacing);
inline constexpr March by_diffusion{diffusion, 2};

} // namespace asperity::theory
