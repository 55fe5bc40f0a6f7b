// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The adhesive sphere of Johnson, Kendall and Roberts (whole curve:
// python/asperity/theories/sphere.py).
#pragma once

namespace asperity::theory::jkr {

/// Returns the pull-off force under a controlled load, Eq. (6): F = (3/2) π γ R.
[[nodiscard]] double pull_off_force(double gamma, double radius);
/// Returns γ from a measured pull-off force.
[[nodiscard]] double work_from_pull_off(double force, double radius);
/// Returns γ from the energy U > 0 needed to separate a sphere without a load (JKR 1971), U =
/// (6πγR)^{5/3} / (10 K^{2/3} R^{1/3}), K = 4E*/3. The formula needs no pull-off force.
[[nodiscard]] double work_from_binding_energy(double energy, double radius, double contact_modulus);

/// A sphere: its radius, work of adhesion and contact modulus.
struct Sphere {
    double radius, gamma, contact_modulus;
    /// Returns the load at a contact radius, positive if it presses: K a³/R - sqrt(6 π γ K a³).
    [[nodiscard]] double load(double contact_radius) const;
    /// Returns the contact radius under a load that presses.
    [[nodiscard]] double contact_radius(double load) const;
};

} // namespace asperity::theory::jkr
