// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// All in Maugis' units inside (see jkr.hpp). F is least, -3/2, at a³ = 3/2.
#include "theory/jkr.hpp"

#include <cmath>
#include <numbers>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

double reduced_force(double a) { return a * a * a - std::sqrt(6 * a * a * a); }
double reduced_approach(double a) { return a * a - 2.0 / 3 * std::sqrt(6 * a); }

SphereState state(const AdhesiveSphere& s, double a) {
    return {reduced_force(a) * s.force_unit(), a * s.radius_unit(),
            reduced_approach(a) * s.approach_unit()};
}

} // namespace

double AdhesiveSphere::force_unit() const { return std::numbers::pi * work_of_adhesion * radius; }
double AdhesiveSphere::radius_unit() const {
    return std::cbrt(force_unit() * radius / stiffness());
}
double AdhesiveSphere::approach_unit() const { return radius_unit() * radius_unit() / radius; }

void check(const AdhesiveSphere& s) {
    if (!(s.radius > 0 && s.contact_modulus > 0 && s.work_of_adhesion > 0))
        throw InvalidInput(message("adhesive sphere: radius ", s.radius, ", contact modulus ",
                                   s.contact_modulus, ", work of adhesion ", s.work_of_adhesion,
                                   " must all be positive for its units to exist"));
}

namespace jkr {

SphereState at_radius(const AdhesiveSphere& s, double radius) {
    check(s);
    if (!(radius >= 0))
        throw InvalidInput(message("JKR: contact radius ", radius, " is negative; give a >= 0"));
    return state(s, radius / s.radius_unit());
}

SphereState pull_off(const AdhesiveSphere& s) {
    check(s);
    return state(s, std::cbrt(1.5));
}

double work_from_pull_off(double pull_off_force, double radius) {
    if (!(radius > 0))
        throw InvalidInput(message("JKR: radius ", radius, " is not positive; check it"));
    return std::abs(pull_off_force) / (1.5 * std::numbers::pi * radius);
}

double work_from_binding_energy(double energy, double radius, double contact_modulus) {
    const AdhesiveSphere s{radius, contact_modulus, 1};
    check(s);
    if (!(energy > 0)) return 0;
    const double K = s.stiffness();
    return std::pow(10 * energy * std::cbrt(K * K * radius), 0.6) / (6 * std::numbers::pi * radius);
}

} // namespace jkr
} // namespace asperity::theory
