// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The elastic half-space. Units: any consistent set.
#pragma once

namespace asperity::theory {

/// E* = E/(1-ν²), one body rigid.
[[nodiscard]] double contact_modulus(double youngs_modulus, double poisson_ratio);

} // namespace asperity::theory
