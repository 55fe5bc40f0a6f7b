// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Eqs. (1) to (5): from a contact to a state. The recipe:
//     smooth, non-adhesive and full contact have closed forms and are answered first;
//     else the coarsest grid finds g0 from nothing,
//     each finer grid follows it, and the last three are extrapolated to spacing zero.
#include "theory/persson.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>

#include "theory/error.hpp"
#include "theory/shooting.hpp"

namespace asperity::theory {

constinit const Integration Integration::first_passage{
    [](const IntegrationGrid& grid, const IntegrationInput& input, double) {
        return asperity::theory::first_passage(grid, input);
    },
    1.5};

namespace {

ContactState come_apart(std::string reason) {
    ContactState s;
    s.reason = std::move(reason);
    return s;
}

/// Values at the end of an integration that are worth extrapolating.
struct Ends {
    double gamma, area, energy, contact_stress;
};

Ends ends_of(const IntegrationPath& path, double pressure, double g0) {
    Ends e{g0, path.area.back(), path.energy.back(), pressure};
    // Each path absorbed takes -σ_a away with it, so what stays in contact gains it.
    for (std::size_t i = 1; i < path.area.size(); ++i)
        e.contact_stress += (path.area[i - 1] - path.area[i]) *
                            (path.detachment_stress[i - 1] + path.detachment_stress[i]) / 2;
    return e;
}

void fill_profile(ContactState& s, const AdhesiveContact& c, const IntegrationGrid& grid,
                  const IntegrationPath& path, double g0) {
    const double q_L = c.spectrum.q_L(), total = path.energy.back();
    s.profile.clear();
    s.profile.reserve(grid.q.size() + 1);
    if (grid.q.front() > q_L || grid.T.front() > 0) {
        ProfilePoint first;
        first.q = q_L;
        first.gamma_eff = g0;
        first.detachment_stress = std::sqrt(std::max(g0, 0.0) * c.contact_modulus * q_L);
        first.elastic_energy = total;
        s.profile.push_back(first);
    }
    for (std::size_t i = 0; i < grid.q.size(); ++i) {
        ProfilePoint p;
        p.q = grid.q[i];
        p.zeta = p.q / q_L;
        p.area = path.area[i];
        p.real_area = path.area[i] * grid.stretch[i];
        p.gamma_eff = path.gamma[i];
        p.detachment_stress = path.detachment_stress[i];
        p.elastic_energy = total - path.energy[i];
        p.stress_variance = grid.T[i];
        s.profile.push_back(p);
    }
    s.nodes = static_cast<int>(grid.q.size());
}

void describe(ContactState& s, const AdhesiveContact& c) {
    if (s.gamma_eff > 0) {
        s.status = Status::adhesive;
        s.reason = message("bound: gamma_eff = ", s.gamma_eff,
                           " > 0 at h_rms = ", c.spectrum.rms_height());
    } else {
        s.status = Status::pressed;
        s.reason = message("in contact only because of the load p = ", c.pressure,
                           ": the elastic energy ", s.elastic_energy,
                           " exceeds the adhesion energy ", c.work_of_adhesion * s.real_area);
    }
}

/// No roughness is ever felt by the boundary: a = 1.
ContactState conforming(const AdhesiveContact& c, const FullContactState& full) {
    ContactState s;
    s.gamma_eff = full.gamma;
    s.gamma_ratio = full.gamma_ratio;
    s.area = 1;
    s.real_area = full.real_area;
    s.elastic_energy = full.elastic_energy;
    s.contact_stress = c.pressure;
    const IntegrationInput in{c.contact_modulus, c.pressure, c.beta, full.gamma};
    IntegrationGrid grid; // for the profile only
    constexpr int points = 128;
    const double ratio = std::log(c.spectrum.q1() / c.spectrum.q_L());
    for (int k = 0; k <= points; ++k) {
        const double q =
            k == points ? c.spectrum.q1() : c.spectrum.q_L() * std::exp(ratio * k / points);
        const Magnification m = c.spectrum.at(q);
        grid.q.push_back(q);
        grid.T.push_back(stress_variance(c, q));
        grid.energy.push_back(std::numbers::pi / 2 * c.contact_modulus * m.energy);
        grid.stretch.push_back(area_factor(c.area_reading(), 2 * std::numbers::pi * m.slope));
    }
    grid.ever_detaches = false;
    fill_profile(s, c, grid, first_passage(grid, in), full.gamma);
    describe(s, c);
    return s;
}

/// Δγ = 0: the boundary stays at zero stress and everything is closed form or one quadrature.
ContactState without_adhesion(const AdhesiveContact& c, const SolverOptions& options) {
    if (!(c.pressure > 0))
        return come_apart(message("no contact: without adhesion (work_of_adhesion = 0) a load p = ",
                                  c.pressure, " <= 0 holds nothing together"));
    const IntegrationInput in{c.contact_modulus, c.pressure, c.beta, 0};
    // g0 far below zero keeps the boundary at zero while the grid is laid out.
    IntegrationInput never = in;
    never.g0 = -full_contact(c).elastic_energy;
    const IntegrationGrid grid =
        make_grid(c.spectrum, c.area_reading(), never, options.spacing / 4, 0);
    IntegrationPath path;
    path.energy.push_back(grid.energy.front());
    for (std::size_t i = 0; i < grid.q.size(); ++i) {
        path.area.push_back(nonadhesive_area(c.pressure, grid.T[i]));
        path.detachment_stress.push_back(0);
        if (i == 0) continue;
        const auto rate = [&](double log_q) { // Eq. (5)
            const double q = std::exp(log_q);
            const double a = nonadhesive_area(c.pressure, stress_variance(c, q));
            return std::numbers::pi / 2 * c.contact_modulus * q * q * q * c.spectrum(q) *
                   energy_fraction(a, c.beta);
        };
        using Rule = boost::math::quadrature::gauss<double, 7>;
        const double step =
            grid.T[i] > grid.T[i - 1] && grid.q[i] > grid.q[i - 1]
                ? Rule::integrate(rate, std::log(grid.q[i - 1]), std::log(grid.q[i]))
                : 0;
        path.energy.push_back(path.energy.back() + step);
    }
    ContactState s;
    s.area = path.area.back();
    s.real_area = s.area * grid.stretch.back();
    s.elastic_energy = path.energy.back();
    s.gamma_eff = -s.elastic_energy;
    s.contact_stress = c.pressure;
    for (std::size_t i = 0; i < grid.q.size(); ++i)
        path.gamma.push_back((path.energy[i] - s.elastic_energy) /
                             (path.area[i] * grid.stretch[i]));
    fill_profile(s, c, grid, path, s.gamma_eff);
    describe(s, c);
    return s;
}

} // namespace

ContactState solve(const AdhesiveContact& c, const SolverOptions& options) {
    check(c);
    check(options);
    if (c.work_of_adhesion == 0 && !c.spectrum.smooth()) return without_adhesion(c, options);

    const FullContactState full = full_contact(c);
    const double least_g0 =
        c.pressure < 0 ? c.pressure * c.pressure / (c.contact_modulus * c.spectrum.q_L()) : 0;
    if (c.spectrum.smooth()) {
        if (c.pressure < 0 && full.gamma <= least_g0)
            return come_apart(
                message("no contact: the pull p = ", c.pressure,
                        " exceeds the detachment stress of the smooth surface, ",
                        -std::sqrt(full.gamma * c.contact_modulus * c.spectrum.q_L())));
        if (c.work_of_adhesion == 0 && !(c.pressure > 0))
            return come_apart("no contact: neither adhesion nor load");
        return conforming(c, full);
    }
    if (full.gamma > least_g0 || c.pressure > 0) {
        const IntegrationInput in{c.contact_modulus, c.pressure, c.beta, full.gamma};
        if (!make_grid(c.spectrum, c.area_reading(), in, options.spacing, 0).ever_detaches)
            return conforming(c, full);
    }

    const Shooting shooting(c, options);
    Shooting::Outcome at = shooting.search(0);
    constexpr int base = 2; // three grids for a first extrapolation
    // A coarse grid may miss the very end of the branch.
    if (!at.found && at.least_excess < 0.03) at = shooting.search(base);
    if (!at.found)
        return come_apart(message(
            "no contact: h_rms = ", c.spectrum.rms_height(), " at p = ", c.pressure,
            " has no adhesive solution; the elastic energy of conforming exceeds what adhesion (",
            c.work_of_adhesion, ") pays"));

    ContactState s;
    std::vector<Ends> ends;
    IntegrationGrid grid;
    IntegrationPath path;
    for (int refinement = 0;; ++refinement) {
        const Shooting::Outcome here = shooting.follow(at, refinement);
        if (here.found) {
            // Always the grid laid out for the first g0, or the grids would not be nested.
            const double g0 = shooting.g0(here.x);
            grid = shooting.grid_for(at.x, refinement);
            path = shooting.integration(grid, g0, refinement);
            ends.push_back(ends_of(path, c.pressure, g0));
        } else if (refinement >= base && ends.empty()) {
            return come_apart(message("no contact: h_rms = ", c.spectrum.rms_height(), " at p = ",
                                      c.pressure, " has no adhesive solution on the finest grid"));
        } else {
            ends.clear(); // gone on this grid: what coarser ones said does not count
        }
        if (ends.size() < 3) {
            if (refinement < options.max_refinement) continue;
            if (ends.empty())
                return come_apart(
                    message("no contact: the adhesive branch at h_rms = ", c.spectrum.rms_height(),
                            " vanishes as the grid is refined"));
        }
        const std::size_t n = ends.size();
        const auto limit = [&](double Ends::*what) {
            std::vector<double> values;
            for (const Ends& e : ends)
                values.push_back(e.*what);
            if (n < 3) return Shooting::Limit{values.back(), std::abs(values.back())};
            return shooting.extrapolate(values);
        };
        const Shooting::Limit gamma = limit(&Ends::gamma), area = limit(&Ends::area);
        s.gamma_eff = c.pressure > 0 ? gamma.value : std::max(gamma.value, ends[n - 1].gamma / 2);
        s.gamma_ratio = s.gamma_eff / c.work_of_adhesion;
        s.gamma_ratio_error = gamma.error / c.work_of_adhesion;
        s.area = std::clamp(area.value, 0.0, 1.0);
        s.area_error = area.error;
        s.real_area = s.area * full.real_area;
        s.elastic_energy = limit(&Ends::energy).value;
        s.contact_stress = limit(&Ends::contact_stress).value;
        s.converged =
            s.gamma_ratio_error <= options.tolerance * std::max(1.0, std::abs(s.gamma_ratio)) &&
            s.area_error <= options.tolerance;
        if (s.converged || refinement >= options.max_refinement) break;
    }
    fill_profile(s, c, grid, path, ends.back().gamma);
    describe(s, c);
    return s;
}

FullContactState full_contact(const AdhesiveContact& c) {
    check(c);
    const Magnification end = c.spectrum.last();
    FullContactState s;
    s.real_area = area_factor(c.area_reading(), 2 * std::numbers::pi * end.slope);
    s.elastic_energy = std::numbers::pi / 2 * c.contact_modulus * end.energy;
    s.gamma = c.work_of_adhesion * s.real_area - s.elastic_energy;
    s.gamma_ratio = c.work_of_adhesion > 0 ? s.gamma / c.work_of_adhesion : 0;
    return s;
}

double nonadhesive_area(double pressure, double T) {
    if (!(pressure > 0)) return 0;
    return T > 0 ? std::erf(pressure / std::sqrt(2 * T)) : 1;
}

double stress_variance(const AdhesiveContact& c, double q) {
    return std::numbers::pi / 2 * c.contact_modulus * c.contact_modulus * c.spectrum.at(q).slope;
}

double adhesion_parameter(double contact_modulus, double h_rms, double q0,
                          double work_of_adhesion) {
    if (!(work_of_adhesion > 0))
        throw InvalidInput(message("theta: work of adhesion ", work_of_adhesion,
                                   " is not positive, and theta divides by it; without adhesion "
                                   "there is no theta"));
    return contact_modulus * h_rms * h_rms * q0 / work_of_adhesion;
}

std::string_view name(Status status) {
    switch (status) {
    case Status::adhesive:
        return "adhesive";
    case Status::pressed:
        return "pressed";
    case Status::no_contact:
        break;
    }
    return "no contact";
}

void check(const AdhesiveContact& c) {
    if (!(c.contact_modulus > 0) || !std::isfinite(c.contact_modulus))
        throw InvalidInput(message("contact modulus E* = ", c.contact_modulus,
                                   " is not positive, so nothing is elastic; give E/(1-nu^2)"));
    if (!(c.work_of_adhesion >= 0) || !std::isfinite(c.work_of_adhesion))
        throw InvalidInput(message("work of adhesion ", c.work_of_adhesion,
                                   " is negative or not a number; surfaces that repel are not in "
                                   "this theory, give 0 for no adhesion"));
    if (!std::isfinite(c.pressure))
        throw InvalidInput(
            message("pressure ", c.pressure, " is not a finite number; give p = load/area"));
    if (!(c.beta >= 0 && c.beta <= 1))
        throw InvalidInput(message("beta = ", c.beta,
                                   " is outside 0..1, where W(1) = 1 and W >= 0; the usual value "
                                   "is 0.45"));
    if (!(c.spectrum.q_L() > 0))
        throw InvalidInput("the contact has no spectrum, so there are no wavevectors to integrate "
                           "over; build one with Spectrum::self_affine or Spectrum::tabulated");
}

void check(const SolverOptions& o) {
    if (!(o.spacing > 0 && o.spacing <= 1))
        throw InvalidInput(message("solver: spacing ", o.spacing,
                                   " is outside 0..1, beyond which a step has spurious roots; the "
                                   "default is 0.4"));
    if (!(o.tolerance > 0))
        throw InvalidInput(message("solver: tolerance ", o.tolerance,
                                   " is not positive and can never be met; the default is 1e-5"));
    if (o.max_refinement < 2 || o.max_refinement > 8)
        throw InvalidInput(message("solver: max_refinement ", o.max_refinement,
                                   " is outside 2..8; three grids are needed for an error "
                                   "estimate, and eight halvings take hours"));
}

} // namespace asperity::theory
