// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// With ψ = πf/2 the curve sin²ψ - α√tan ψ has slope zero where sin 2ψ = α/(2 cos²ψ √tan ψ), that is
//     α = α_0(ψ) = 4 sin^{3/2}ψ cos^{5/2}ψ.
// α_0 rises from zero to one maximum, at tan²ψ = 3/5, and falls to zero: below that maximum there
// are exactly two extremes, on either side of it, and at the maximum itself they merge. The
// pressure at the jump is zero for α = sin^{3/2}ψ cos^{1/2}ψ at most, tan²ψ = 3.
#include "support/westergaard.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

#include <boost/math/tools/toms748_solve.hpp>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

constexpr double pi = std::numbers::pi;

double alpha_of_extreme(double psi) {
    return 4 * std::pow(std::sin(psi), 1.5) * std::pow(std::cos(psi), 2.5);
}

const double merging_psi = std::atan(std::sqrt(0.6));

template <class F>
double root_between(F&& f, double a, double b) {
    std::uintmax_t iterations = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        f, a, b, boost::math::tools::eps_tolerance<double>(52), iterations);
    return (bracket.first + bracket.second) / 2;
}

void check_alpha(double alpha) {
    if (!(alpha >= 0) || !std::isfinite(alpha))
        throw InvalidInput(message("sine: alpha = ", alpha,
                                   " is negative or not a number; it is the square root of "
                                   "adhesion over elasticity, 0 without adhesion"));
}

} // namespace

double AdhesiveSine::full_contact_pressure() const {
    if (!(amplitude > 0 && wavelength > 0 && contact_modulus > 0))
        throw InvalidInput(message("sine: amplitude ", amplitude, ", wavelength ", wavelength,
                                   ", contact modulus ", contact_modulus,
                                   " must all be positive; check them"));
    return pi * contact_modulus * amplitude / wavelength;
}

double AdhesiveSine::alpha() const {
    const double p = full_contact_pressure();
    if (!(work_of_adhesion >= 0))
        throw InvalidInput(
            message("sine: work of adhesion ", work_of_adhesion, " is negative; give 0 for none"));
    return std::sqrt(2 * work_of_adhesion * contact_modulus / wavelength) / p;
}

namespace westergaard {

double reduced_pressure(double alpha, double fraction) {
    check_alpha(alpha);
    if (!(fraction >= 0 && fraction <= 1))
        throw InvalidInput(message("sine: contact fraction ", fraction,
                                   " is outside 0..1; it is contact length over wavelength"));
    const double psi = pi * fraction / 2, s = std::sin(psi);
    return s * s - (alpha > 0 ? alpha * std::sqrt(std::tan(psi)) : 0);
}

double pressure(const AdhesiveSine& sine, double fraction) {
    return sine.full_contact_pressure() * reduced_pressure(sine.alpha(), fraction);
}

double merging_alpha() { return alpha_of_extreme(merging_psi); }

double spontaneous_alpha() {
    const double psi = std::atan(std::sqrt(3.0));
    return std::pow(std::sin(psi), 1.5) * std::sqrt(std::cos(psi));
}

Extremes extremes(double alpha) {
    check_alpha(alpha);
    Extremes e;
    if (alpha >= merging_alpha()) {
        e.exist = false;
        return e;
    }
    if (alpha == 0) { // Westergaard: opens at zero load, closes at p*
        e.jump_in = 1;
        e.jump_in_fraction = 1;
        return e;
    }
    const auto f = [&](double psi) { return alpha_of_extreme(psi) - alpha; };
    e.pull_off_fraction = root_between(f, 0.0, merging_psi) * 2 / pi;
    e.jump_in_fraction = root_between(f, merging_psi, pi / 2) * 2 / pi;
    e.pull_off = reduced_pressure(alpha, e.pull_off_fraction);
    e.jump_in = reduced_pressure(alpha, e.jump_in_fraction);
    return e;
}

double contact_fraction(double alpha, double p) {
    const Extremes e = extremes(alpha);
    if (!e.exist)
        throw NoSolution(message("sine: alpha = ", alpha, " is above ", merging_alpha(),
                                 ", where no partial contact is stable; the surface is in full "
                                 "contact"));
    if (!(p >= e.pull_off && p <= e.jump_in))
        throw NoSolution(message("sine: p/p* = ", p, " is outside ", e.pull_off, " .. ", e.jump_in,
                                 " at alpha = ", alpha,
                                 ", where partial contact is stable: below it is off, above it is "
                                 "full"));
    if (p == e.pull_off) return e.pull_off_fraction;
    if (p == e.jump_in) return e.jump_in_fraction;
    return root_between([&](double a) { return reduced_pressure(alpha, a) - p; },
                        e.pull_off_fraction, e.jump_in_fraction);
}

} // namespace westergaard
} // namespace asperity::theory
