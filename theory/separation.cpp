// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The integrals of separation.hpp. In x = w p'/E* the inner one depends on its lower end alone,
//     J(x) = ∫_x^∞ (dt/t) [β + 3(1-β) erf²t] e^{-t²} = (β/2) E1(x²) + 3(1-β) K(x),
// with x = p(ζ)/√(2(T - T_ζ)). It dies as e^{-x²}, so the outer integrand vanishes with all its
// derivatives at q -> ζq_L where w diverges, and Gauss rules on pieces that grow away from there
// converge fast. The pieces end at the spectrum's kinks and gaps.
#include "theory/separation.hpp"

#include <boost/math/special_functions/expint.hpp>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

using Rule = boost::math::quadrature::gauss<double, 7>;

constexpr double negligible = 6; // J(6) ~ e^{-36}

double pressure_integral(double x, double beta, double share_held) {
    if (x > negligible) return 0;
    const double P = std::erf(x);
    const double withdrawn = (1 - share_held) * (beta + 3 * (1 - beta) * P * P) * std::exp(-x * x);
    const auto saturating = [](double t) {
        const double e = std::erf(t);
        return e * e * std::exp(-t * t) / t;
    };
    const double K =
        boost::math::quadrature::gauss<double, 20>::integrate(saturating, x, negligible);
    return beta / 2 * boost::math::expint(1, x * x) + 3 * (1 - beta) * K + withdrawn;
}

/// One magnification: clock, stress variance, area, mean separation.
struct Level {
    double y, T, area, separation;
};

class Squeezing {
public:
    explicit Squeezing(const SqueezedContact& c) : c_(c), bands_(c.spectrum.bands()) {}

    [[nodiscard]] double T(const Magnification& m) const {
        return std::numbers::pi / 2 * c_.contact_modulus * c_.contact_modulus * m.slope;
    }

    /// ū seen from a magnification with stress variance T0 and pressure p0 in its contact.
    [[nodiscard]] double separation(double y0, double T0, double p0) const {
        const auto rate = [&](double y) { // √π q² C w J dq/dy
            const Magnification m = c_.spectrum.at_log_clock(y);
            const double left = 2 * (T(m) - T0);
            if (!(left > 0)) return 0.0;
            const double x = p0 / std::sqrt(left);
            if (x > negligible) return 0.0;
            const double cubic = m.q * m.q * m.q * c_.spectrum(m.q);
            const double dq_dy = 1 / (cubic / m.slope + 1 / m.q);
            const double w = c_.contact_modulus / std::sqrt(left);
            return cubic / m.q * w * pressure_integral(x, c_.beta, c_.share_held) * dq_dy;
        };
        // Nothing happens before x has come down to `negligible`.
        const double T_first = T0 + p0 * p0 / (2 * negligible * negligible);
        const double T_end = T(c_.spectrum.last());
        if (T_first >= T_end) return 0;
        double sum = 0;
        for (const auto& band : bands_) {
            const double T_band = T(c_.spectrum.at_log_clock(band.y_end));
            if (T_band <= T_first) continue;
            // Lowest y that can matter here: ln T rises at most as fast as y.
            double y = std::max(band.y_begin,
                                band.y_end - std::log(T_band / T_first) - spectrum_log_width());
            y = std::max(y, y0);
            while (y < band.y_end) {
                const double offset = std::isfinite(y0) ? y - y0 : 1.0;
                const double step = std::min(band.y_end - y, std::clamp(offset, 0.03, 0.5));
                sum += Rule::integrate(rate, y, y + step);
                y += step;
                if (band.y_end - y < 1e-12 * std::abs(band.y_end)) break;
            }
        }
        return sum / std::numbers::inv_sqrtpi;
    }

    [[nodiscard]] double area(double T) const {
        return T > 0 ? std::erf(c_.pressure / std::sqrt(2 * T)) : 1;
    }

private:
    [[nodiscard]] double spectrum_log_width() const {
        return std::log(c_.spectrum.q1() / c_.spectrum.q_L());
    }

    const SqueezedContact& c_;
    std::vector<Spectrum::Band> bands_;
};

void check(const SqueezedContact& c) {
    if (!(c.contact_modulus > 0))
        throw InvalidInput(message("separation: contact modulus ", c.contact_modulus,
                                   " is not positive, so nothing is elastic; check it"));
    if (!(c.pressure > 0) || !std::isfinite(c.pressure))
        throw InvalidInput(message("separation: pressure ", c.pressure,
                                   " does not press, and without it the surfaces are apart without "
                                   "limit; give p > 0"));
    if (!(c.beta >= 0 && c.beta <= 1))
        throw InvalidInput(message("separation: beta = ", c.beta, " is outside 0..1"));
}

} // namespace

double mean_separation(const SqueezedContact& c) {
    check(c);
    if (c.spectrum.smooth()) return 0;
    return Squeezing(c).separation(-std::numeric_limits<double>::infinity(), 0, c.pressure);
}

SeparationDistribution::SeparationDistribution(const SqueezedContact& c, double spacing) {
    check(c);
    area_ = 1;
    if (c.spectrum.smooth()) return;
    const Squeezing squeezing(c);
    const double p = c.pressure;

    Level before{-std::numeric_limits<double>::infinity(), 0, 1,
                 squeezing.separation(-std::numeric_limits<double>::infinity(), 0, p)};
    const auto visit = [&](double y, double y_middle) {
        const Magnification m = c.spectrum.at_log_clock(y);
        const double T = squeezing.T(m);
        Level now{y, T, squeezing.area(T), 0};
        now.separation = squeezing.separation(y, T, p / now.area);
        const double lost = before.area - now.area;
        if (lost > 1e-13) { // before that A ū has lost nothing either
            const double spread =
                std::sqrt(c.spectrum.height_variance_above(c.spectrum.at_log_clock(y_middle).q));
            parts_.push_back({lost,
                              (before.area * before.separation - now.area * now.separation) / lost,
                              spread});
            before = now;
        }
    };
    // Before x = p/√(2T) = 5 the area is whole to 1e-12.
    const double T_end = squeezing.T(c.spectrum.last());
    const double T_start = p * p / 50;
    for (const auto& band : c.spectrum.bands()) {
        const double T_band = squeezing.T(c.spectrum.at_log_clock(band.y_end));
        if (T_band <= T_start) continue;
        const double width = std::log(c.spectrum.q1() / c.spectrum.q_L());
        const double begin =
            std::max(band.y_begin, band.y_end - std::log(T_band / T_start) - width);
        const int steps = std::max(1, static_cast<int>(std::ceil((band.y_end - begin) / spacing)));
        const double step = (band.y_end - begin) / steps;
        for (int k = 1; k <= steps; ++k) {
            const double y = k == steps ? band.y_end : begin + k * step;
            visit(y, y - step / 2);
        }
    }
    area_ = squeezing.area(T_end);
}

double SeparationDistribution::density(double u) const {
    double sum = 0;
    for (const Part& part : parts_) {
        if (!(part.spread > 0)) continue;
        const double x = (u - part.centre) / part.spread, y = (u + part.centre) / part.spread;
        sum += part.weight * (std::exp(-x * x / 2) + std::exp(-y * y / 2)) /
               (part.spread * std::sqrt(2 * std::numbers::pi));
    }
    return sum;
}

double SeparationDistribution::mean() const {
    return average([](double u) { return u; });
}

} // namespace asperity::theory
