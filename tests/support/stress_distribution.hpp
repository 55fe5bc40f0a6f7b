// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The distribution of stress of a solved contact: a second way to its area and load.
#pragma once

#include <span>
#include <vector>

#include "theory/persson.hpp"

namespace asperity::theory {

/// P(σ, ζ) of Eq. (1) at the wavevector q, for a state solved before. Contact area only: its
/// integral is A(ζ)/A0.
[[nodiscard]] std::vector<double> stress_distribution(const AdhesiveContact& contact,
                                                      const ContactState& state, double q,
                                                      std::span<const double> stress);

} // namespace asperity::theory
