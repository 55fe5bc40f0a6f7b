// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "theory/periodic_sphere.hpp"

#include <cmath>
#include <numbers>

#include "theory/error.hpp"
#include "theory/maugis.hpp"

namespace asperity::theory {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double mean_sum = -3.900264920001956; // Σ' 1/R less its mean, square lattice of period 1
constexpr double curvature_sum = 9.033621683100950; // Σ' 1/R³

/// Change of curvature for each unit of force.
double curvature_by_force(const PeriodicSphere& p) {
    if (!(p.period > 0))
        throw InvalidInput(message("periodic sphere: the period ", p.period,
                                   " is not positive; give the edge of the box"));
    return curvature_sum / (2 * pi * p.sphere.contact_modulus * std::pow(p.period, 3));
}

PeriodicState with_height(const PeriodicSphere& p, const SphereState& s) {
    return {s, p.separation - s.approach -
                   mean_sum * s.force / (pi * p.sphere.contact_modulus * p.period)};
}

/// The state that a rule gives for the sphere whose radius its own force has changed.
template <class Rule>
SphereState consistent(const PeriodicSphere& p, const Rule& rule) {
    AdhesiveSphere sphere = p.sphere;
    SphereState state = rule(sphere);
    for (int i = 0; i < 200; ++i) {
        const double before = state.force;
        sphere.radius = p.radius_under(state.force);
        state = rule(sphere);
        if (std::abs(state.force - before) <= 1e-13 * p.sphere.force_unit()) return state;
    }
    throw NoSolution(message("periodic sphere: the images do not converge at period ", p.period,
                             "; the contact is as large as the box, use a larger one"));
}

} // namespace

double PeriodicSphere::radius_under(double force) const {
    const double curvature = 1 / sphere.radius + curvature_by_force(*this) * force;
    if (!(curvature > 0))
        throw NoSolution(message("periodic sphere: pulled with ", -force,
                                 " the images flatten it altogether; use a larger box"));
    return 1 / curvature;
}

PeriodicState jkr_at_radius(const PeriodicSphere& p, double radius) {
    return with_height(
        p, consistent(p, [&](const AdhesiveSphere& s) { return jkr::at_radius(s, radius); }));
}

PeriodicState jkr_pull_off(const PeriodicSphere& p) {
    return with_height(p, consistent(p, [](const AdhesiveSphere& s) { return jkr::pull_off(s); }));
}

double maugis_parameter(const AdhesiveSphere& s, double stress) {
    check(s);
    return 2 * stress *
           std::cbrt(s.radius / (pi * s.work_of_adhesion * s.stiffness() * s.stiffness()));
}

PeriodicState maugis_at_ratio(const PeriodicSphere& p, double stress, double m) {
    return with_height(p, consistent(p, [&](const AdhesiveSphere& s) {
                           return maugis::at_ratio(s, maugis_parameter(s, stress), m);
                       }));
}

PeriodicState maugis_pull_off(const PeriodicSphere& p, double stress) {
    return with_height(p, consistent(p, [&](const AdhesiveSphere& s) {
                           return maugis::pull_off(s, maugis_parameter(s, stress));
                       }));
}

} // namespace asperity::theory
