// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Records of the points of a quasi-static path.
#include "engine/statics/quasistatic.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/interface/plastic_set.hpp"
#include "io/error.hpp"
#include "kernels/elastic_level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {

/// Returns the force on the prescribed coordinate, eV/Å; 0 for a hold.
double QuasistaticPath::force() const {
    switch (segment_.along) {
    case Along::z:
        return record_.top_force;
    case Along::time:
        return 0.0;
    default:
        return record_.lateral_force[axis()];
    }
}

void QuasistaticPath::refuse_place(const RelaxedState& state, double at) const {
    throw io::PhysicsError(fmt::format("no equilibrium was found with the {} {:.6g} Å",
                                       segment_.along != Along::z ? "block moved sideways by"
                                       : options_.along == Constraint::Of::top
                                           ? "top plane displaced by"
                                           : "mean height displaced by",
                                       at),
                           fmt::format("after {} iterations {}", state.iterations,
                                       why_not_converged(state, last_.tolerance())),
                           "a larger drive.tolerance, or a height further from the substrate");
}

void QuasistaticPath::refuse_whole_yield(const RelaxedState& state, double at) const {
    constexpr double nearly = 1.0 - 1e-6;
    if (state.force < nearly * options_.yield_force) return;
    throw io::PhysicsError(
        fmt::format("the mean pressure has reached the hardness with the {} displaced by {:.6g} Å",
                    options_.along == Constraint::Of::top ? "top plane" : "mean height", at),
        "the whole surface yields (interface.hardness), and nothing ends its set",
        "a smaller load, a height further from the substrate, or a larger hardness");
}

/// Counts the points that are as close together as points can be, and throws if there are more in a
/// row than instabilities take: the path would go on for days.
void QuasistaticPath::refuse_to_creep(double way) {
    constexpr std::int64_t most = 300;
    segment_.crept = way <= smallest_step() ? segment_.crept + 1 : 0;
    if (segment_.crept < most) return;
    throw io::PhysicsError(
        fmt::format("the path does not get on: the last {} points are {:.2g} Å apart, as close "
                    "as points can be",
                    most, way),
        "work and energies differ in every step by more than drive.tolerance allows, so that steps "
        "are halved again and again",
        "a larger drive.tolerance");
}

/// Sums the lateral force of the substrate on the lowest layer, eV/Å, of the last relaxation.
/// Collective.
std::array<double, 2> QuasistaticPath::lateral_force() const {
    const VectorPlane<double> f = block_.interface_force();
    std::array<ExactSum, 2> sums;
    if (const OverWall* const wall = interface_.wall()) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const PlaneView<const double> slope = wall->slope(axis);
            for (int y = 0; y < f.z.ny; ++y) {
                for (int x = 0; x < f.z.nx; ++x)
                    sums[axis].add(-f.z(x, y) * slope(x, y));
                sums[axis].carry();
            }
        }
        return global_sums(block_.communicator(), sums);
    }
    elastic_kernels().sum(f.x, 0, f.x.ny, sums[0]);
    elastic_kernels().sum(f.y, 0, f.y.ny, sums[1]);
    return global_sums(block_.communicator(), sums);
}

PathPoint QuasistaticPath::point(const RelaxedState& state, double at) const {
    const double force = segment_.along == Along::z      ? state.top_force
                         : segment_.along == Along::time ? 0.0
                                                         : lateral_force()[axis()];
    return {at, force,
            state.stored() + record_.dissipated() + state.dissipated() +
                segment_.held.value_or(0.0) * lifted(state)};
}

void QuasistaticPath::set_record(const RelaxedState& state, double at) {
    if (segment_.along == Along::z)
        record_.drive = at;
    else if (segment_.along != Along::time)
        record_.slide[axis()] = at;
    if (segment_.held)
        record_.drive = options_.along == Constraint::Of::top ? block_.drive() : state.mean_height;
    if (interface_.options().slides) record_.lateral_force = lateral_force();
    record_.top = options_.along == Constraint::Of::top ? state.top : record_.drive;
    record_.mean_height = interface_.reference_height() + state.mean_height;
    record_.force = state.force;
    record_.top_force = state.top_force;
    record_.observed = true;
    Energies now = state;
    now.take_flows(record_);
    static_cast<Energies&>(record_) = now;
    static_cast<ContactCount&>(record_) = state;
    if (interface_.yielding_wall())
        static_cast<YieldState&>(record_) =
            yield_state(interface_, block_.lowest_layer(), block_.communicator());
    // The balance says nothing of small energies: those below an eightieth of the work of the scale
    // of forces on the way so far and a step more, or below a twentieth of flat surfaces'. Neither
    // depends on the tolerance.
    double least = options_.scales.force * sites_ * (way_ + options_.step) / 80.0;
    if (options_.binding_energy) least = std::min(least, 0.05 * *options_.binding_energy);
    record_.residual = balance_.residual(record_, least);
}

Instability QuasistaticPath::describe(const RelaxedState& state, double energy) const {
    Instability instability;
    instability.energy = energy;
    instability.segment = segment_.number;
    instability.top = record_.top;
    instability.height_before = record_.mean_height;
    instability.height_after = interface_.reference_height() + state.mean_height;
    instability.slide = record_.slide;
    instability.force_before = force();
    instability.force_after = point(state, at()).force;
    instability.contact_before = record_.in_contact;
    instability.contact_after = state.in_contact;
    const LargestSite most = last_.largest_move();
    instability.site_x = most.x;
    instability.site_y = most.y;
    instability.largest_move = most.value;
    instability.sites_moved = last_.sites_moved();
    return instability;
}

} // namespace asperity
