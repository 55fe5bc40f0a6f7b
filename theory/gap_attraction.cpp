// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The header has the physics. Cost: ~10 ms for gap_attraction, fifty times that for wall_bound,
// whose maximum is found on a net in ln p_eq and then by Brent.
#include "theory/gap_attraction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/special_functions/erf.hpp>
#include <boost/math/tools/minima.hpp>

#include "theory/error.hpp"

namespace asperity::theory {
namespace {

double scale_factor(const AdhesiveContact& c, const WallPotential& wall, WallScale scale) {
    return scale == WallScale::work_of_adhesion ? c.work_of_adhesion / wall.depth() : 1;
}

/// ∫ P w du and ū with the surfaces pressed by p_eq.
void fill_gaps(GapAttraction& g, const AdhesiveContact& c, const WallPotential& wall, double factor,
               double share_held, double spacing) {
    const SeparationDistribution separations(
        {c.spectrum, c.contact_modulus, g.equivalent_pressure, c.beta, share_held}, spacing);
    g.gamma_gap = factor * separations.average([&](double u) { return wall.attraction(u); });
    g.mean_separation = separations.mean();
}

} // namespace

double equivalent_pressure(const AdhesiveContact& c, double area) {
    if (!(area > 0 && area <= 1))
        throw InvalidInput(message("equivalent pressure: area fraction ", area,
                                   " is outside 0..1; no pressure gives it"));
    if (area == 1) return std::numeric_limits<double>::infinity();
    return std::sqrt(2 * stress_variance(c, c.spectrum.q1())) * boost::math::erf_inv(area);
}

GapAttraction gap_attraction(const AdhesiveContact& c, const ContactState& state,
                             const WallPotential& wall, const GapOptions& options) {
    check(c);
    check(wall);
    GapAttraction g;
    if (state.status == Status::no_contact) return g;
    g.area = state.area;
    g.gamma_with = state.gamma_eff;
    g.equivalent_pressure = std::numeric_limits<double>::infinity();
    if (state.area < 1 - 1e-12 && !c.spectrum.smooth()) {
        g.equivalent_pressure = equivalent_pressure(c, state.area);
        const double share_held = options.reading == GapReading::jkr
                                      ? std::min(1.0, c.pressure / g.equivalent_pressure)
                                      : 1;
        fill_gaps(g, c, wall, scale_factor(c, wall, options.scale), share_held, 0.2);
        g.gamma_with += g.gamma_gap;
    }
    g.gamma_with_ratio = c.work_of_adhesion > 0 ? g.gamma_with / c.work_of_adhesion : 0;
    return g;
}

GapAttraction wall_bound(const AdhesiveContact& contact, const WallPotential& wall,
                         const GapOptions& options) {
    check(contact);
    check(wall);
    GapAttraction g;
    g.area = 1;
    if (contact.spectrum.smooth()) {
        g.gamma_with = contact.work_of_adhesion;
        g.gamma_with_ratio = contact.work_of_adhesion > 0 ? 1 : 0;
        g.equivalent_pressure = std::numeric_limits<double>::infinity();
        return g;
    }
    AdhesiveContact pressed = contact; // the same surfaces without adhesion
    pressed.work_of_adhesion = 0;
    const double T = stress_variance(contact, contact.spectrum.q1());
    const double factor = scale_factor(contact, wall, options.scale);
    const auto at = [&](double log_x, double spacing) {
        GapAttraction s;
        s.equivalent_pressure = pressed.pressure = std::exp(log_x) * std::sqrt(2 * T);
        const ContactState state = solve(pressed);
        s.area = state.area;
        fill_gaps(s, contact, wall, factor, 1, spacing);
        s.gamma_with =
            contact.work_of_adhesion * state.real_area - state.elastic_energy + s.gamma_gap;
        return s;
    };
    double best = 0, most = -std::numeric_limits<double>::infinity();
    constexpr double step = 0.75;
    for (double x = std::log(3.0); x > -16; x -= step)
        if (const double gain = at(x, 0.4).gamma_with; gain > most) {
            most = gain;
            best = x;
        }
    const auto loss = [&](double x) { return -at(x, 0.2).gamma_with; };
    const auto minimum = boost::math::tools::brent_find_minima(loss, best - step, best + step, 12);
    g = at(minimum.first, 0.1);
    g.gamma_with_ratio = contact.work_of_adhesion > 0 ? g.gamma_with / contact.work_of_adhesion : 0;
    return g;
}

} // namespace asperity::theory
