// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Maugis-Dugdale in reduced units. With s = √(m² - 1) and φ = arctan s,
//     (λa²/2) [s + (m² - 2)φ] + (4λ²a/3) [sφ - m + 1] = 1        opening at c is w/σ0
//     F = a³ - λa² [s + m²φ]
//     δ = a² - (4/3) λ a s
// The first is quadratic in a, so m parametrises the whole curve in closed form and pull-off is the
// minimum of one function of one variable. The brackets cancel to s³ and s² as m -> 1 (the JKR end,
// large λ) and are taken from their series there.
#include "theory/maugis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <boost/math/tools/minima.hpp>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

void check_lambda(double lambda) {
    if (!(lambda > 0) || !std::isfinite(lambda))
        throw InvalidInput(message("Maugis: lambda = ", lambda,
                                   " is not positive; its limits are DMT (0) and JKR (infinity)"));
}

/// s + (s² - 1) arctan s = (m² - 2)φ + s.
double opening_by_hertz(double s) {
    if (s > 0.1) return s + (s * s - 1) * std::atan(s);
    // s + (s² - 1)(s - s³/3 + s⁵/5 - ...) = Σ (-1)^{k} s^{2k+3} [1/(2k+1) + 1/(2k+3)]
    double sum = 0, power = s * s * s;
    for (int k = 0; k < 12; ++k) {
        sum += power * (1.0 / (2 * k + 1) + 1.0 / (2 * k + 3));
        power *= -s * s;
    }
    return sum;
}

/// s arctan s - m + 1.
double opening_by_adhesion(double s, double m) {
    const double tail = s * s / (1 + m); // m - 1
    if (s > 0.1) return s * std::atan(s) - tail;
    // s² [1 - 1/(1+m)] - s⁴/3 + s⁶/5 - ...,  1 - 1/(1+m) = m/(1+m)
    double sum = s * s * m / (1 + m), power = s * s * s * s;
    for (int k = 1; k < 13; ++k) {
        sum -= power / (2 * k + 1);
        power *= -s * s;
    }
    return sum;
}

/// The curve by s, which keeps its digits where m is close to one.
maugis::Reduced on_curve(double lambda, double s) {
    const double m = std::sqrt(1 + s * s), phi = std::atan(s);
    const double A = lambda / 2 * opening_by_hertz(s);
    const double B = 4 * lambda * lambda / 3 * opening_by_adhesion(s, m);
    const double a = 2 / (B + std::sqrt(B * B + 4 * A)); // A a² + B a = 1
    return {m, a * a * a - lambda * a * a * (s + m * m * phi), a, a * a - 4.0 / 3 * lambda * a * s};
}

SphereState with_units(const AdhesiveSphere& s, const maugis::Reduced& r) {
    return {r.force * s.force_unit(), r.radius * s.radius_unit(), r.approach * s.approach_unit()};
}

} // namespace

double tabor_number(double radius, double work_of_adhesion, double modulus, double range) {
    if (!(radius > 0 && work_of_adhesion >= 0 && modulus > 0 && range > 0))
        throw InvalidInput(message("Tabor number: radius ", radius, ", work of adhesion ",
                                   work_of_adhesion, ", modulus ", modulus, ", range ", range,
                                   " must be positive; check them"));
    return std::cbrt(radius * work_of_adhesion * work_of_adhesion /
                     (modulus * modulus * range * range * range));
}

namespace maugis {

Reduced at_ratio(double lambda, double m) {
    check_lambda(lambda);
    if (!(m > 1))
        throw InvalidInput(message("Maugis: m = c/a = ", m,
                                   " is not above 1; the attraction reaches beyond the contact"));
    return on_curve(lambda, std::sqrt((m - 1) * (m + 1)));
}

Reduced pull_off(double lambda) {
    check_lambda(lambda);
    // Once on a coarse net, for the bracket, then Brent.
    const auto force = [&](double x) { return on_curve(lambda, std::exp(x)).force; };
    double best = 0, lowest = 1e300;
    for (double x = -25; x <= 25; x += 0.1)
        if (const double F = force(x); F < lowest) {
            lowest = F;
            best = x;
        }
    const auto minimum = boost::math::tools::brent_find_minima(force, best - 0.2, best + 0.2, 50);
    return on_curve(lambda, std::exp(minimum.first));
}

SphereState at_ratio(const AdhesiveSphere& sphere, double lambda, double m) {
    return with_units(sphere, at_ratio(lambda, m));
}

SphereState pull_off(const AdhesiveSphere& sphere, double lambda) {
    check(sphere);
    return with_units(sphere, pull_off(lambda));
}

} // namespace maugis

} // namespace asperity::theory
