// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "theory/jkr.hpp"

#include <cmath>
#include <numbers>

#include "theory/error.hpp"

namespace asperity::theory::jkr {

double pull_off_force(double gamma, double radius) {
    return 1.5 * std::numbers::pi * gamma * radius;
}

double work_from_pull_off(double force, double radius) {
    if (!(radius > 0))
        throw InvalidInput(message("JKR: radius ", radius, " is not positive; check it"));
    return std::abs(force) / (1.5 * std::numbers::pi * radius);
}

double work_from_binding_energy(double energy, double radius, double contact_modulus) {
    if (!(radius > 0 && contact_modulus > 0))
        throw InvalidInput(
            message("JKR: radius ", radius, ", E* ", contact_modulus, ": not positive"));
    if (!(energy > 0)) return 0;
    const double K = 4 * contact_modulus / 3;
    return std::pow(10 * energy * std::cbrt(K * K * radius), 0.6) / (6 * std::numbers::pi * radius);
}

double Sphere::load(double a) const {
    const double cubed = 4 * contact_modulus / 3 * a * a * a;
    return cubed / radius - std::sqrt(6 * std::numbers::pi * gamma * cubed);
}

double Sphere::contact_radius(double load) const {
    const double pull = 3 * std::numbers::pi * gamma * radius;
    const double all = load + pull + std::sqrt(pull * (2 * load + pull));
    return std::cbrt(all * radius / (4 * contact_modulus / 3));
}

} // namespace asperity::theory::jkr
