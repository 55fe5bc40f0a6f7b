// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How far apart the surfaces are where they do not touch. Without adhesion, at pressure p, the mean
// separation (Yang and Persson 2008) and its distribution (Almqvist, Campañá, Prodanov, Persson
// 2011):
//     ū(ζ) = √π ∫_{ζq_L}^{q1} q² C w ∫_{p(ζ)}^∞ (dp'/p') [β + 3(1-β) P²] e^{-(w p'/E*)²} dp' dq
//     w(q, ζ) = (π ∫_{ζq_L}^{q} q'³ C dq')^{-1/2},  P = erf(w p'/E*),  p(ζ) = p A0/A(ζ)
//     u1(ζ) = ū + ū' A/A'            the mean separation of what loses contact between ζ and ζ + dζ
//     P(u)  = ∫ (-A'/A0) [ N(u - u1; h²(ζ)) + N(u + u1; h²(ζ)) ] dζ,   u > 0
// with h²(ζ) the height variance of roughness shorter than L/ζ. P(u) integrates to 1 - A/A0. ū and
// the elastic energy of Eq. (5) obey p = -dU_el/dū exactly, which is how the tests judge it.
//
// Pulling back at fixed area. An adhesive contact bears less load than the same area would without
// adhesion. Johnson, Kendall and Roberts reach theirs in two strokes: press without adhesion until
// the area is right, then take load off with the area held, which raises the surface by load over
// stiffness. The stiffness at fixed area is that of the contact without adhesion, -dp/dū. The same
// two strokes at every magnification, from p down to the load p_held, give
//     ū(ζ) -> ū(ζ) + (1 - p_held/p) p |∂ū/∂p|(ζ),
// which adds (1 - p_held/p) [β + 3(1-β)P²] e^{-(w p'/E*)²} at p' = p(ζ) to the inner integral.
//
// P(u) is kept as what it is, a mixture of folded normals, so that averages over it need no grid in
// u. Units: any consistent set. Cost: ~20 ms near full contact, ~0.1 s at light contact (many
// decades of T).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>

#include "theory/spectrum.hpp"

namespace asperity::theory {

struct SqueezedContact {
    Spectrum spectrum;
    double contact_modulus = 0; ///< E* [stress]
    double pressure = 0;        ///< p > 0 [stress], sets the area
    double beta = 0.45;
    double share_held = 1; ///< p_held/p: 1 no adhesion, 0 zero net load, negative pulled
};

/// ū(1), the load taken off included [length].
[[nodiscard]] double mean_separation(const SqueezedContact& contact);

class SeparationDistribution {
public:
    /// Part of the surface that came off at one magnification.
    struct Part {
        double weight; ///< -dA/A0
        double centre; ///< u1 [length]
        double spread; ///< h(ζ) [length]
    };

    /// `spacing` in ln T + ln q.
    explicit SeparationDistribution(const SqueezedContact& contact, double spacing = 0.1);

    [[nodiscard]] double contact_area() const { return area_; } ///< A(ζ_1)/A0
    [[nodiscard]] double density(double u) const;               ///< P(u) [1/length], u > 0
    [[nodiscard]] double mean() const;                          ///< ∫ u P du [length]
    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }

    /// ∫ f(u) P(u) du.
    template <class F>
    [[nodiscard]] double average(F&& f) const;

private:
    double area_ = 0;
    std::vector<Part> parts_;
};

template <class F>
double SeparationDistribution::average(F&& f) const {
    using Rule = boost::math::quadrature::gauss<double, 30>;
    constexpr double reach = 8; // standard deviations
    double sum = 0;
    for (const Part& part : parts_) {
        if (!(part.spread > 0)) {
            sum += part.weight * f(std::abs(part.centre));
            continue;
        }
        const auto folded = [&](double u) {
            const double x = (u - part.centre) / part.spread, y = (u + part.centre) / part.spread;
            return f(u) * (std::exp(-x * x / 2) + std::exp(-y * y / 2)) /
                   (part.spread * std::sqrt(2 * std::numbers::pi));
        };
        const double c = std::abs(part.centre);
        const double low = std::max(0.0, c - reach * part.spread), high = c + reach * part.spread;
        const double middle = std::max(c, (low + high) / 2);
        sum += part.weight *
               (Rule::integrate(folded, low, middle) + Rule::integrate(folded, middle, high));
    }
    return sum;
}

} // namespace asperity::theory
