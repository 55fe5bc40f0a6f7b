// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Where adhesive contact ends: the critical roughness.
//
// The integration at the lower end of g0 (shooting.hpp) has to reach γ_eff(ζ_1) = Δγ, which is one
// more scalar root, in ln h, and far better conditioned than watching γ_eff go to zero: with the
// area factor off the function is exactly a straight line in ln h. On three grids, extrapolated.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/tools/toms748_solve.hpp>

#include "theory/error.hpp"
#include "theory/shooting.hpp"

namespace asperity::theory {
namespace {

template <class F>
double root_between(F&& f, double a, double b, double tolerance) {
    std::uintmax_t iterations = 100;
    const auto close = [tolerance](double u, double v) { return std::abs(u - v) <= tolerance; };
    const auto bracket = boost::math::tools::toms748_solve(f, a, b, close, iterations);
    return (bracket.first + bracket.second) / 2;
}

/// Widens [x, x] in steps until f changes sign; false if it does not within `reach`.
template <class F>
bool bracket_root(F&& f, double& low, double& high, double step, double reach) {
    const double start = low;
    const bool rising = f(start) <= 0; // the root is above
    for (double x = start; std::abs(x - start) < reach; step *= 1.5) {
        const double next = rising ? x + step : x - step;
        if ((f(next) <= 0) != rising) {
            low = std::min(x, next);
            high = std::max(x, next);
            return true;
        }
        x = next;
    }
    return false;
}

AdhesiveContact at_roughness(const AdhesiveContact& c, double h) {
    AdhesiveContact scaled = c;
    scaled.spectrum = c.spectrum.with_rms_height(h);
    return scaled;
}

} // namespace

CriticalRoughness critical_roughness(const AdhesiveContact& c, const SolverOptions& options) {
    check(c);
    check(options);
    if (c.work_of_adhesion == 0)
        throw NoSolution(
            "critical roughness: without adhesion (work_of_adhesion = 0) there is none "
            "to vanish; give a work of adhesion");
    if (c.beta == 0 && c.pressure == 0)
        throw NoSolution(
            "critical roughness: with beta = 0 a sparse contact costs a^3 and gains a, so "
            "adhesion fades but never ends; give beta > 0");
    CriticalRoughness result;
    const FullContactState unit = full_contact(at_roughness(c, 1));
    // Where adhesion would end if the area were fixed and S one: the natural scale of h.
    const double h_scale = std::sqrt(c.work_of_adhesion / unit.elastic_energy);
    constexpr double reach = 25; // in ln h
    const auto full = [&](double log_h) {
        return -full_contact(at_roughness(c, std::exp(log_h))).gamma_ratio;
    };
    double low = std::log(h_scale), high = low;
    result.full_contact_h_rms = bracket_root(full, low, high, 0.1, reach)
                                    ? std::exp(root_between(full, low, high, 1e-12))
                                    : std::numeric_limits<double>::infinity();

    std::array<double, 3> h{};
    double guess = std::log(h_scale);
    for (int refinement = 0; refinement < 3; ++refinement) {
        const auto excess = [&](double log_h) {
            const AdhesiveContact scaled = at_roughness(c, std::exp(log_h));
            const Shooting shooting(scaled, options);
            if (c.pressure < 0 &&
                shooting.lowest_g0() >= c.work_of_adhesion * full_contact(scaled).real_area)
                return 1.0; // pulled harder than even full contact bears
            return shooting.excess_at_edge(refinement);
        };
        low = high = guess;
        if (!bracket_root(excess, low, high, refinement == 0 ? 0.1 : 1e-3, reach))
            throw NoSolution(message(
                "critical roughness: at p = ", c.pressure,
                " adhesion does not end between h_rms = ", std::exp(guess - reach), " and ",
                std::exp(guess + reach), " (area factor ", name(c.area_factor), ", beta ", c.beta,
                "): either the gain in contact area keeps up with the elastic energy, or the pull "
                "is "
                "too strong at any roughness; try area factor none, or another load"));
        guess = root_between(excess, low, high, 1e-10);
        h[static_cast<std::size_t>(refinement)] = std::exp(guess);
    }
    const Shooting shooting(c, options);
    const Shooting::Limit limit = shooting.extrapolate(h);
    result.h_rms = limit.value;
    result.error = limit.error;
    return result;
}

} // namespace asperity::theory
