// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The distribution of the pressure p between two absorbing ends is a sine series,
//     f(p) = 2/H Σ_n sin(nπP/H) sin(nπp/H) exp(-n²π²V/2H²),
// or, by images at P + 2kH and -P + 2kH, a sum of normal distributions. The integral over p and the
// flux into p = H are the two areas. The series converges fast for large V, the images for small V.
#include "theory/capped_pressure.hpp"

#include "theory/error.hpp"

#include <cmath>
#include <numbers>

namespace asperity::theory {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double negligible = 1e-17;

/// Returns the share that one of two ends has absorbed, by images. distance: distance of the start
/// from that end over that of the two ends; width: √(2V) over the same.
double absorbed(double distance, double width) {
    double sum = 0;
    for (int k = 0;; k += 2) {
        const double near = std::erfc((k + distance) / width);
        sum += near - std::erfc((k + 2 - distance) / width);
        if (near < negligible) return sum;
    }
}

} // namespace

CappedContact capped_contact(double pressure, double hardness, double variance) {
    if (!(hardness > 0 && pressure >= 0 && pressure < hardness && variance >= 0))
        throw InvalidInput(message("capped pressure: pressure ", pressure, ", hardness ", hardness,
                                   ", variance ", variance,
                                   "; a pressure from 0 to below the hardness, and a variance of 0 "
                                   "or more, have a contact"));
    const double x = pressure / hardness, v = variance / hardness / hardness;
    if (v == 0) return {.elastic = x > 0 ? 1.0 : 0.0, .yielding = 0};
    if (v < 0.25) {
        const double width = std::sqrt(2 * v), lost = absorbed(x, width);
        const double yielding = absorbed(1 - x, width);
        return {.elastic = 1 - lost - yielding, .yielding = yielding};
    }
    CappedContact contact{.elastic = 0, .yielding = x};
    for (int n = 1;; ++n) {
        const double weight = 2 / (n * pi) * std::exp(-0.5 * v * n * n * pi * pi);
        if (weight < negligible) return contact;
        const double term = weight * std::sin(n * pi * x);
        contact.elastic += n % 2 == 1 ? 2 * term : 0;
        contact.yielding -= n % 2 == 1 ? term : -term;
    }
}

} // namespace asperity::theory
