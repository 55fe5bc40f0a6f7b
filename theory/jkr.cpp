// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// All in Maugis' units inside (see jkr.hpp). With y = √(a³), F = y² - √6 y is a parabola: the
// stable branch is y = (√6 + √(6 + 4F))/2 and ends at y = √6/2, F = -3/2. δ(a) is a monotone
// function of √a beyond its minimum, dδ/da = 2a - √6/(3√a) = 0 at a^{3/2} = √6/6, where F = 1/6 - 1
// = -5/6.
#include "theory/jkr.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

#include <boost/math/tools/toms748_solve.hpp>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

constexpr double root6 = 2.449489742783178098;

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
                                   " must all be positive for its units to exist; without adhesion "
                                   "use hertz"));
}

namespace jkr {

SphereState at_radius(const AdhesiveSphere& s, double radius) {
    check(s);
    if (!(radius >= 0))
        throw InvalidInput(message("JKR: contact radius ", radius, " is negative; give a >= 0"));
    return state(s, radius / s.radius_unit());
}

SphereState at_force(const AdhesiveSphere& s, double force) {
    check(s);
    const double F = force / s.force_unit();
    const double discriminant = 6 + 4 * F;
    if (!(discriminant >= 0))
        throw NoSolution(message("JKR: force ", force, " pulls harder than pull-off, ",
                                 -1.5 * s.force_unit(), ", so the sphere is off; pull less"));
    const double y = (root6 + std::sqrt(discriminant)) / 2;
    return state(s, std::cbrt(y * y));
}

SphereState at_approach(const AdhesiveSphere& s, double approach) {
    check(s);
    const double delta = approach / s.approach_unit();
    const double a_end = std::cbrt(1.0 / 6);
    const double end = reduced_approach(a_end);
    if (!(delta >= end - 1e-14))
        throw NoSolution(message("JKR: approach ", approach, " is beyond the end of the neck at ",
                                 end * s.approach_unit(), ", so the sphere is off; retract less"));
    const auto f = [&](double a) { return reduced_approach(a) - delta; };
    if (f(a_end) >= 0) return state(s, a_end);
    double high = 2 + std::sqrt(std::abs(delta));
    while (f(high) < 0)
        high *= 2;
    std::uintmax_t iterations = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        f, a_end, high, boost::math::tools::eps_tolerance<double>(52), iterations);
    return state(s, (bracket.first + bracket.second) / 2);
}

SphereState pull_off(const AdhesiveSphere& s) {
    check(s);
    return state(s, std::cbrt(1.5));
}

SphereState fixed_grips_pull_off(const AdhesiveSphere& s) {
    check(s);
    return state(s, std::cbrt(1.0 / 6));
}

double work_from_pull_off(double pull_off_force, double radius) {
    if (!(radius > 0))
        throw InvalidInput(message("JKR: radius ", radius, " is not positive; check it"));
    return std::abs(pull_off_force) / (1.5 * std::numbers::pi * radius);
}

} // namespace jkr
} // namespace asperity::theory
