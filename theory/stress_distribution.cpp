// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// P(σ, ζ) from the absorbed fraction: free diffusion from p, less what has been absorbed, each part
// of which would have spread freely from the boundary where it was taken out,
//     P(σ, T) = N(σ - p; T) - ∫ N(σ + b(T'); T - T') dF(T').
// Within an interval b is its middle value and F linear in T', so that the time integral is closed,
//     ∫_{t0}^{t1} N(x; t) dt = [ √(2t/π) e^{-x²/2t} - |x| erfc(|x|/√(2t)) ]_{t0}^{t1},
// and the square root at T' -> T costs no accuracy.
#include "theory/persson.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

double normal(double x, double variance) {
    return std::exp(-x * x / (2 * variance)) / std::sqrt(2 * std::numbers::pi * variance);
}

double normal_over_time(double x, double t) {
    if (!(t > 0)) return 0;
    return std::sqrt(2 * t / std::numbers::pi) * std::exp(-x * x / (2 * t)) -
           std::abs(x) * std::erfc(std::abs(x) / std::sqrt(2 * t));
}

} // namespace

std::vector<double> stress_distribution(const AdhesiveContact& contact, const ContactState& state,
                                        double q, std::span<const double> stress) {
    if (state.profile.empty()) return std::vector<double>(stress.size(), 0.0);
    const double T = stress_variance(contact, q);
    if (!(q >= contact.spectrum.q_L() && q <= contact.spectrum.q1() * (1 + 1e-12)) || !(T > 0))
        throw InvalidInput(message("stress distribution: at q = ", q,
                                   " it is a spike or undefined; choose q inside the spectrum, "
                                   "above ",
                                   contact.spectrum.q_L(), " and up to ", contact.spectrum.q1()));
    const auto& points = state.profile;
    std::vector<double> P;
    P.reserve(stress.size());
    for (double sigma : stress) {
        double value = normal(sigma - contact.pressure, T);
        double boundary = points.front().detachment_stress;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const double T0 = points[i - 1].stress_variance, T1 = points[i].stress_variance;
            const double b0 = points[i - 1].detachment_stress, b1 = points[i].detachment_stress;
            if (T0 >= T && points[i - 1].q >= q) break;
            const double end = std::min(T, T1);
            const double part = T1 > T0 ? (end - T0) / (T1 - T0) : 1.0;
            boundary = b0 + (b1 - b0) * part;
            const double absorbed = points[i - 1].area - points[i].area;
            if (absorbed == 0 || !(T1 > T0)) continue;
            const double x = sigma + b0 + (b1 - b0) * part / 2;
            value -=
                absorbed / (T1 - T0) * (normal_over_time(x, T - T0) - normal_over_time(x, T - end));
        }
        P.push_back(sigma <= -boundary ? 0.0 : std::max(0.0, value));
    }
    return P;
}

} // namespace asperity::theory
