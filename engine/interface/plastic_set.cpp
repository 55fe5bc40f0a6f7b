// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/interface/plastic_set.hpp"

#include "decomposition/global_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace asperity {

namespace {

/// A site is at the hardness if its net pressure is this part of the hardness or more.
constexpr double at_hardness = 0.999;

} // namespace

std::vector<RestoredArray> PlasticSet::arrays() {
    return {{"/level0/set", 0, &interface_.set(), 1}};
}

void PlasticSet::accept() {
    const OverWall& wall = *interface_.yielding_wall();
    const PlaneView<const double> u = displacement_().z;
    const PlaneView<double> set = interface_.set().plane(0);
    const double reference = interface_.reference_height();
#pragma omp parallel for schedule(static)
    for (int y = 0; y < u.ny; ++y)
        for (int x = 0; x < u.nx; ++x)
            set(x, y) += 0.97 * wall.growth(x, y, reference + u(x, y));
}

StepEnergies PlasticSet::energies() const {
    const OverWall& wall = *interface_.yielding_wall();
    const PlaneView<const double> u = displacement_().z;
    const double reference = interface_.reference_height();
    ExactSum sum;
    for (int y = 0; y < u.ny; ++y) {
        for (int x = 0; x < u.nx; ++x)
            if (const double growth = wall.growth(x, y, reference + u(x, y)); growth > 0.0)
                sum.add(growth * wall.yield_force(x, y));
        sum.carry();
    }
    StepEnergies energies;
    energies[Term::in_surface] = global_sum(ranks_, sum);
    return energies;
}

YieldState yield_state(const Interface& interface, const VectorPlane<const double>& displacement,
                       const Communicator& ranks) {
    const OverWall& wall = *interface.yielding_wall();
    const PlaneView<const double> u = displacement.z, set = wall.set();
    const double reference = interface.reference_height(), across = interface.sites_across();
    YieldState state;
    ExactSum sum;
    std::array<std::int64_t, 1> sites{};
    for (int y = 0; y < u.ny; ++y) {
        for (int x = 0; x < u.nx; ++x) {
            if (std::isnan(wall.below(x, y))) continue;
            sites[0] +=
                wall.force(x, y, reference + u(x, y)) >= at_hardness * wall.yield_force(x, y);
            sum.add(set(x, y));
            state.largest_set = std::max(state.largest_set, set(x, y));
        }
        sum.carry();
    }
    ranks.sum(sites);
    state.at_hardness = sites[0];
    state.largest_set = ranks.max(state.largest_set);
    state.mean_set = global_sum(ranks, sum) / (across * across);
    return state;
}

} // namespace asperity
