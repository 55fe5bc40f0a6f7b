// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/flat_reference.hpp"

#include "engine/units.hpp"

#include <boost/math/tools/minima.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace asperity {

namespace {

/// Returns the number of registries sampled along an axis: all that occur, or enough that the
/// average is exact to rounding (the corrugation's harmonics die out exponentially; beyond 24
/// points they are below 1e-16).
int registries(int sites, int substrate_sites) {
    return std::min(sites / std::gcd(sites, substrate_sites), 24);
}

/// Returns the reference in closed form: the repulsion holds the tension at g = -tension / K.
FlatReference flat_reference(const ExponentialWall& law, double area) {
    FlatReference flat;
    flat.separation = -law.tension() / law.stiffness();
    flat.work_of_adhesion = -units::milli_per_unit * law.energy(flat.separation) / area;
    flat.largest_tension = law.tension() / area / units::gigapascal;
    flat.stiffness = law.stiffness() / area;
    return flat;
}

/// Returns the reference of a shaped law.
FlatReference flat_reference(const ShapedWall& law, double area) {
    FlatReference flat;
    flat.separation = law.deepest();
    flat.work_of_adhesion = -units::milli_per_unit * law.energy(flat.separation) / area;
    flat.largest_tension = law.largest_tension() / area / units::gigapascal;
    flat.tension_separation = law.steepest();
    // Over a linear repulsion that of the repulsion, also without an attraction.
    flat.stiffness = law.stiffness_at(law.has_kink() ? -law.range() : flat.separation) / area;
    return flat;
}

} // namespace

PairSum flat_pair_sum(const InterfaceOptions& options, double spacing, int sites,
                      int substrate_sites, double gap) {
    if (options.wall)
        return std::visit(
            [&](const auto& law) {
                return PairSum{{0.0, 0.0, law.force(gap)}, law.energy(gap), gap * gap};
            },
            mean_wall(options));
    const double level = 0.0; // a single atom, repeated
    const double b = spacing * sites / substrate_sites;
    const SubstrateMap map{&level, 1, b, 0, 1};
    const int count = registries(sites, substrate_sites);
    PairSum mean;
    for (int j = 0; j < count; ++j)
        for (int i = 0; i < count; ++i) {
            const PairSum p = pair_sum(map, options.potential, 0.5 * spacing + i * b / count,
                                       0.5 * spacing + j * b / count, gap);
            mean.force[2] += p.force[2] / (count * count);
            mean.energy += p.energy / (count * count);
            mean.nearest_r2 = std::min(mean.nearest_r2, p.nearest_r2);
        }
    if (options.tail)
        std::visit(
            [&]<class P>(const P& p) {
                if constexpr (P::has_tail) {
                    const Tail tail(p, 1.0 / (b * b));
                    mean.force[2] += tail.force(gap);
                    mean.energy += tail.energy(gap);
                }
            },
            options.potential);
    return mean;
}

FlatReference flat_reference(const InterfaceOptions& options, double spacing, int sites,
                             int substrate_sites) {
    const auto force = [&](double gap) {
        return flat_pair_sum(options, spacing, sites, substrate_sites, gap).force[2];
    };
    if (options.wall) {
        const WallLaw wall = mean_wall(options);
        if (const auto* law = std::get_if<ExponentialWall>(&wall))
            return flat_reference(*law, spacing * spacing);
        if (const auto* law = std::get_if<ShapedWall>(&wall))
            return flat_reference(*law, spacing * spacing);
    }
    const double r0 = zero_of(options.potential); // the length of the potential
    // The minimum: where the force turns from pushing to pulling, by bisection.
    double low = 0.4 * r0, high = 1.2 * r0;
    if (!(force(low) > 0.0 && force(high) < 0.0))
        throw std::invalid_argument(fmt::format(
            "interface: flat on flat has no minimum of energy between {:.3f} and {:.3f} Å for "
            "a potential that is zero at {} Å, cutoff = {} Å, spacing = {} Å",
            low, high, r0, cutoff_of(options.potential), spacing));
    while (high - low > 1e-12 * r0) {
        const double middle = 0.5 * (low + high);
        (force(middle) > 0.0 ? low : high) = middle;
    }
    FlatReference flat;
    flat.separation = 0.5 * (low + high);
    const double area = spacing * spacing;
    const PairSum there = flat_pair_sum(options, spacing, sites, substrate_sites, flat.separation);
    flat.work_of_adhesion = -units::milli_per_unit * there.energy / area;
    const double h = 1e-4 * r0;
    flat.stiffness = -(force(flat.separation + h) - force(flat.separation - h)) / (2.0 * h * area);
    const auto [gap, least] = boost::math::tools::brent_find_minima(
        force, flat.separation, flat.separation + 0.5 * r0, std::numeric_limits<double>::digits);
    flat.tension_separation = gap;
    flat.largest_tension = -least / area / units::gigapascal;
    return flat;
}

} // namespace asperity
