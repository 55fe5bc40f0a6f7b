// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The layer: plane strain, normal stress wave on top, no shear there, no displacement at the base.
// With x = qH and κ = 3 - 4ν the surface compliance over that of the half-space is
//     [κ sinh 2x - 2x] / [κ cosh 2x + 2x² + 5 - 12ν + 8ν²],
// 1 for x -> ∞ and the uniaxial x (1-2ν)/2(1-ν)² for x -> 0. Written with e^{-2x} factored out
// so that thick layers do not overflow, and with sinh y - y by its series so that thin
// incompressible ones (ν = ½, where the linear terms cancel) keep their digits.
#include "theory/half_space.hpp"

#include <cmath>
#include <numbers>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

void check_poisson(double nu) {
    if (!(nu > -1 && nu <= 0.5))
        throw InvalidInput(message("Poisson ratio ", nu,
                                   " is outside (-1, 0.5], where an isotropic solid is stable; "
                                   "check the ratio"));
}

/// (sinh y - y), without cancellation at small y.
double sinh_excess(double y) {
    if (y > 0.5) return std::sinh(y) - y;
    double term = y * y * y / 6, sum = 0;
    for (int k = 4; k < 24; k += 2) {
        sum += term;
        term *= y * y / (k * (k + 1));
    }
    return sum;
}

} // namespace

double contact_modulus(double youngs_modulus, double poisson_ratio) {
    check_poisson(poisson_ratio);
    if (!(youngs_modulus > 0) || !std::isfinite(youngs_modulus))
        throw InvalidInput(message("Young's modulus ", youngs_modulus,
                                   " is not positive, so nothing is elastic; check the modulus"));
    return youngs_modulus / (1 - poisson_ratio * poisson_ratio);
}

HertzContact hertz(const Sphere& s, double force) {
    if (!(s.radius > 0 && s.contact_modulus > 0))
        throw InvalidInput(message("Hertz: radius ", s.radius, " and contact modulus ",
                                   s.contact_modulus, " must both be positive; check them"));
    if (!(force >= 0))
        throw InvalidInput(
            message("Hertz: force ", force,
                    " pulls, and without adhesion nothing holds; use jkr or maugis"));
    HertzContact c;
    c.radius = std::cbrt(3 * force * s.radius / (4 * s.contact_modulus));
    c.approach = c.radius * c.radius / s.radius;
    c.pressure = 2 * s.contact_modulus * c.radius / (std::numbers::pi * s.radius);
    return c;
}

double layer_stiffness_ratio(double x, double nu) {
    check_poisson(nu);
    if (!(x > 0))
        throw InvalidInput(message("layer: q H = ", x,
                                   " is not positive; the uniform mode of a layer has stiffness "
                                   "(lambda + 2 mu)/H and no half-space to compare with"));
    const double kappa = 3 - 4 * nu, constant = 5 - 12 * nu + 8 * nu * nu;
    if (x > 20) { // sinh 2x = cosh 2x to rounding
        const double decay = 2 * std::exp(-2 * x);
        return (kappa + decay * (2 * x * x + constant)) / (kappa - decay * 2 * x);
    }
    const double compliance = kappa * sinh_excess(2 * x) + 4 * x * (1 - 2 * nu);
    return (kappa * std::cosh(2 * x) + 2 * x * x + constant) / compliance;
}

double layer_stiffness(double q, double thickness, double youngs_modulus, double poisson_ratio) {
    if (!(q > 0 && thickness > 0))
        throw InvalidInput(message("layer: wavevector ", q, " and thickness ", thickness,
                                   " must both be positive; check them"));
    return q * contact_modulus(youngs_modulus, poisson_ratio) / 2 *
           layer_stiffness_ratio(q * thickness, poisson_ratio);
}

} // namespace asperity::theory
