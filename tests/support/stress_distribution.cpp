// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// P(σ, ζ) from the absorbed fraction: free diffusion from p, less what has been absorbed, each part
// of which would have spread freely from the boundary where it was taken out,
//     P(σ, T) = N(σ - p; T) - ∫ N(σ + b(T'); T - T') dF(T').
// On a short piece b is its middle value and F linear in T', so that the time integral is closed,
//     ∫_{t0}^{t1} N(x; t) dt = [ √(2t/π) e^{-x²/2t} - |x| erfc(|x|/√(2t)) ]_{t0}^{t1},
// and the square root at T' -> T costs no accuracy. The pieces are quarters of the integration's
// intervals, with a and b between the nodes by monotone cubics.
#include "support/stress_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// Boundary and area at a value of the variance.
struct Instant {
    double T, b, area;
};

double variance_of(const ProfilePoint& at) { return at.stress_variance; }

/// Monotone cubic for `value` at a fraction `t` of interval i of the variance; one-sided next to
/// gaps, where the variance does not grow.
double between(const std::vector<ProfilePoint>& p, std::size_t i, double t,
               double ProfilePoint::*value) {
    const auto width = [&](std::size_t k) { return variance_of(p[k]) - variance_of(p[k - 1]); };
    const auto slope = [&](std::size_t k) { return (p[k].*value - p[k - 1].*value) / width(k); };
    const double here = slope(i);
    const auto moves = [&](std::size_t k) { return k >= 1 && k < p.size() && width(k) > 0; };
    const auto at_end = [&](std::size_t neighbour, std::size_t opposite) {
        if (moves(neighbour)) { // weighted harmonic mean, zero at extremes
            const double there = slope(neighbour);
            if (!(here * there > 0)) return 0.0;
            const double w_here = width(i) + 2 * width(neighbour);
            const double w_there = 2 * width(i) + width(neighbour);
            return (w_here + w_there) / (w_here / here + w_there / there);
        }
        if (!moves(opposite)) return here;
        // The parabola through this interval and the one behind it, kept monotone.
        const double lean = width(i) / (width(i) + width(opposite));
        const double m = here + lean * (here - slope(opposite));
        return m * here > 0 ? (std::abs(m) < 3 * std::abs(here) ? m : 3 * here) : 0.0;
    };
    const double h = width(i), m0 = at_end(i - 1, i + 1), m1 = at_end(i + 1, i - 1), t2 = t * t,
                 t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * p[i - 1].*value + (3 * t2 - 2 * t3) * p[i].*value +
           (t3 - 2 * t2 + t) * h * m0 + (t3 - t2) * h * m1;
}

/// The history up to the wavevector q, where the variance is T.
std::vector<Instant> history(const std::vector<ProfilePoint>& p, double T, double q) {
    constexpr int pieces = 4;
    std::vector<Instant> result{{variance_of(p[0]), p[0].detachment_stress, p[0].area}};
    for (std::size_t i = 1; i < p.size() && p[i - 1].q < q; ++i) {
        const double T0 = variance_of(p[i - 1]), T1 = variance_of(p[i]);
        if (!(T1 > T0) || !(T0 > 0)) { // a gap, or before anything was absorbed
            const double fraction = std::min(1.0, (q - p[i - 1].q) / (p[i].q - p[i - 1].q));
            const double b0 = p[i - 1].detachment_stress, b1 = p[i].detachment_stress;
            // b ∝ √q while nothing is absorbed
            result.push_back(
                {std::min(T, T1), std::sqrt(b0 * b0 + fraction * (b1 * b1 - b0 * b0)), p[i].area});
            continue;
        }
        for (int k = 1; k <= pieces; ++k) {
            const double to = std::min(T, T0 + (T1 - T0) * k / pieces);
            const double part = (to - T0) / (T1 - T0);
            result.push_back({to, between(p, i, part, &ProfilePoint::detachment_stress),
                              between(p, i, part, &ProfilePoint::area)});
            if (to >= T) break;
        }
    }
    return result;
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
    const std::vector<Instant> past = history(state.profile, T, q);
    const double boundary = past.back().b;
    std::vector<double> P;
    P.reserve(stress.size());
    for (double sigma : stress) {
        double value = normal(sigma - contact.pressure, T);
        for (std::size_t i = 1; i < past.size(); ++i) {
            const Instant &from = past[i - 1], &to = past[i];
            if (from.area == to.area || !(to.T > from.T)) continue;
            const double x = sigma + (from.b + to.b) / 2;
            value -= (from.area - to.area) / (to.T - from.T) *
                     (normal_over_time(x, T - from.T) - normal_over_time(x, T - to.T));
        }
        P.push_back(sigma <= -boundary ? 0.0 : std::max(0.0, value));
    }
    return P;
}

} // namespace asperity::theory
