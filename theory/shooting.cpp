// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Bracketing and root finding; the reasons are in the header. Roots by Boost's TOMS 748.
// Cost: a search is ~15 coarse integrations, a follow-up on a finer grid ~4.
#include "theory/shooting.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include <boost/math/tools/toms748_solve.hpp>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

constexpr double vanishing_area = 1e-4; // below this the branch counts as ended

template <class F>
double root_between(F&& f, double a, double b, double fa, double fb, double tolerance) {
    if (fa == 0) return a;
    if (fb == 0) return b;
    std::uintmax_t iterations = 100;
    const auto close = [tolerance](double u, double v) { return std::abs(u - v) <= tolerance; };
    const auto bracket = boost::math::tools::toms748_solve(f, a, b, fa, fb, close, iterations);
    return (bracket.first + bracket.second) / 2;
}

} // namespace

Shooting::Shooting(const AdhesiveContact& contact, const SolverOptions& options)
    : contact_(contact), options_(options), pressing_(contact.pressure > 0) {
    const FullContactState full = full_contact(contact);
    highest_ = contact.work_of_adhesion * full.real_area;
    scale_ = highest_ + full.elastic_energy;
    lowest_ = pressing_ ? -full.elastic_energy
                        : contact.pressure * contact.pressure /
                              (contact.contact_modulus * contact.spectrum.q_L());
}

double Shooting::g0(double x) const {
    return pressing_ ? x * scale_ : lowest_ + contact_.work_of_adhesion * std::exp(x);
}

IntegrationInput Shooting::input(double g0) const {
    return {contact_.contact_modulus, contact_.pressure, contact_.beta, g0};
}

IntegrationGrid Shooting::grid_for(double x, int refinement) const {
    if (!pressing_) {
        // A grid meant to stay starts a little early, so that a neighbouring g0 may use it too.
        const double early = x - std::log(4.0);
        return make_grid(contact_.spectrum, contact_.area_reading(), input(g0(early)),
                         options_.spacing, refinement);
    }
    std::optional<double> onset;
    const auto grid = [&](int r) {
        return make_grid(contact_.spectrum, contact_.area_reading(), input(g0(x)), options_.spacing,
                         r, onset);
    };
    // Where γ_eff leaves zero, found on a coarse grid, then on one refined there.
    for (int pass = 0; pass < 3 && g0(x) < 0; ++pass) {
        const IntegrationGrid coarse = grid(pass > 0 ? 1 : 0);
        const IntegrationPath path = first_passage(coarse, input(g0(x)));
        const auto up = std::find_if(path.gamma.begin(), path.gamma.end(),
                                     [](double gamma) { return gamma > 0; });
        if (up == path.gamma.begin() || up == path.gamma.end()) break;
        const auto i = static_cast<std::size_t>(up - path.gamma.begin());
        const auto y = [&](std::size_t k) { return std::log(coarse.T[k]) + std::log(coarse.q[k]); };
        const double part = -path.gamma[i - 1] / (path.gamma[i] - path.gamma[i - 1]);
        // M3 = T/(π/2 E*²) is what the spectrum's coordinate is made of.
        onset =
            y(i - 1) + part * (y(i) - y(i - 1)) -
            std::log(std::numbers::pi / 2 * contact_.contact_modulus * contact_.contact_modulus);
    }
    return grid(refinement);
}

IntegrationPath Shooting::integration(const IntegrationGrid& grid, double g0,
                                      int refinement) const {
    return options_.integration.follow(grid, input(g0), options_.spacing / (1 << refinement));
}

double Shooting::excess(const IntegrationGrid& grid, const IntegrationPath& path) const {
    const double a = path.area.back(), S = grid.stretch.back();
    if (pressing_) // g0 + u - Δγ A*, Eq. (3) at ζ = 1
        return (path.gamma.back() - contact_.work_of_adhesion) * a * S / scale_;
    return std::log(path.gamma.back() / contact_.work_of_adhesion);
}

double Shooting::excess_at(double x, int refinement, double* area) const {
    const IntegrationGrid grid = make_grid(contact_.spectrum, contact_.area_reading(), input(g0(x)),
                                           options_.spacing, refinement);
    const IntegrationPath path = integration(grid, g0(x), refinement);
    if (area != nullptr) *area = path.area.back();
    return excess(grid, path);
}

Shooting::Outcome Shooting::search(int refinement) const {
    const auto f = [&](double x) { return excess_at(x, refinement); };
    if (pressing_) {
        const double low = lowest_ / scale_, high = highest_ / scale_;
        const double f_low = f(low), f_high = f(high);
        // The ends hold exactly in the continuum; at full contact they may miss by rounding.
        if (f_low >= 0) return {true, low, f_low};
        if (f_high <= 0) return {true, high, f_high};
        return {true, root_between(f, low, high, f_low, f_high, 1e-13), 0};
    }
    if (!(highest_ > lowest_)) return {false, 0, std::numeric_limits<double>::infinity()};
    // Come down from above until γ_eff(ζ_1) falls below Δγ.
    const double top = std::log((highest_ - lowest_) / contact_.work_of_adhesion);
    double bottom = -80;
    if (lowest_ > 0) bottom = std::log(1e-10 * lowest_ / contact_.work_of_adhesion);
    double x_high = top, f_high = f(top), least = f_high;
    if (f_high <= 0) return {true, top, f_high};
    double step = 0.25, area = 1;
    while (x_high > bottom) {
        const double x_low = std::max(bottom, x_high - step);
        const double f_low = excess_at(x_low, refinement, &area);
        least = std::min(least, f_low);
        if (f_low <= 0) return {true, root_between(f, x_low, x_high, f_low, f_high, 1e-12), 0};
        if (lowest_ == 0 && area < vanishing_area) break;
        x_high = x_low;
        f_high = f_low;
        step = std::min(2.0, 1.5 * step);
    }
    return {false, 0, least};
}

Shooting::Outcome Shooting::follow(const Outcome& near, int refinement) const {
    const IntegrationGrid grid = grid_for(near.x, refinement);
    const auto f = [&](double x) { return excess(grid, integration(grid, g0(x), refinement)); };
    const double far = pressing_ ? std::numeric_limits<double>::infinity() : std::log(2.0);
    double x0 = near.x, f0 = f(x0);
    double x1 = x0 + (pressing_ ? 1e-4 : 1e-2) * (f0 > 0 ? -1 : 1);
    for (int iteration = 0; iteration < 12; ++iteration) {
        if (f0 == 0) return {true, x0, 0};
        const double f1 = f(x1);
        if (f1 == f0) break;
        const double next = x1 - f1 * (x1 - x0) / (f1 - f0);
        x0 = x1;
        f0 = f1;
        if (!std::isfinite(next) || std::abs(next - near.x) > far) break;
        const double moved = std::abs(next - x1);
        x1 = next;
        if (moved < (pressing_ ? 1e-10 : 1e-8)) return {true, x1, 0};
    }
    return search(refinement);
}

double Shooting::excess_at_edge(int refinement) const {
    if (pressing_) return excess_at(0, refinement); // γ_eff(1) = 0
    if (lowest_ > 0)                                // the path starts on the boundary
        return excess_at(std::log(1e-9 * lowest_ / contact_.work_of_adhesion), refinement);
    // Zero load: g0 -> 0 with A -> 0; what is left of A² is the error of stopping short.
    // W must be in its linear part, a² << β. A falls as a power of g0, so one look tells how far
    // down to go.
    const double small = std::clamp(0.01 * std::sqrt(contact_.beta), 1e-5, 1e-3);
    double a = 1, x = -20, value = excess_at(x, refinement, &a);
    for (int attempt = 0; a > small && x > -160 && attempt < 20; ++attempt) {
        x = std::max({-160.0, 2 * x, 1.05 * x * std::log(small) / std::log(a)});
        value = excess_at(x, refinement, &a);
    }
    return value;
}

Shooting::Limit Shooting::extrapolate(std::span<const double> values) const {
    // Error terms: spacing^order, and spacing² where the order is lower.
    const auto eliminate = [](double coarse, double fine, double ratio) {
        return fine + (fine - coarse) / (ratio - 1);
    };
    const double ratio = std::pow(2, options_.integration.order);
    const auto once = [&](std::span<const double> v) {
        return eliminate(v[v.size() - 2], v[v.size() - 1], ratio);
    };
    const auto best = [&](std::span<const double> v) {
        if (options_.integration.order == 2) return once(v);
        return eliminate(once(v.first(v.size() - 1)), once(v), 4);
    };
    const double value = best(values);
    if (values.size() > 3 || options_.integration.order == 2)
        return {value, std::abs(value - best(values.first(values.size() - 1)))};
    return {value, std::abs(value - once(values))};
}

} // namespace asperity::theory
