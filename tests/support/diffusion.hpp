// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Eq. (2) by finite volumes: what the first-passage equation of theory/ is compared with. It shares
// nothing with it but the grid of the variance.
#pragma once

#include "theory/integration.hpp"
#include "theory/persson.hpp"

namespace asperity::theory {

[[nodiscard]] IntegrationPath diffusion(const IntegrationGrid& grid, const IntegrationInput& input,
                                        double spacing);
inline constexpr Integration by_diffusion{diffusion, 2};

} // namespace asperity::theory
