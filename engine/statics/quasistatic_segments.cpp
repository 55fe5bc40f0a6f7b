// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The beginnings of a quasi-static path and of its segments.
#include "engine/statics/quasistatic.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/case/flat_reference.hpp"
#include "engine/interface/plastic_set.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "kernels/elastic_level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

namespace asperity {

namespace {

/// Refuses a mean height far inside the substrate, at which forces and relaxation have no end: even
/// a flat surface would press with more than the modulus of the block, or ten times the
/// largest attraction. Collective.
void refuse_deep(double height, const Interface& interface, const SpectralBlock& block,
                 const Scales& scales) {
    if (interface.yielding_wall())
        return; // the pressure has a bound, which refuse_whole_yield() tells
    const BlockOptions& options = block.options();
    const double n = options.sites, area = options.spacing * options.spacing;
    double mean = 0.0;
    if (interface.wall()) {
        const PlaneView<const double> below = interface.wall()->height();
        ExactSum sum;
        elastic_kernels().sum(below, 0, below.ny, sum);
        mean = global_sum(block.communicator(), sum) / (n * n);
    } else {
        const std::span<const double> map = interface.tables().map;
        if (map.empty()) return; // atoms anywhere
        mean = std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
    }
    const double gap = height - mean;
    const bool inside = !interface.wall() && gap <= 0.0;
    double pressure = 0.0;
    // Between the atoms of a flat layer the force falls again: the largest from here outwards.
    for (int i = 0; i < 10 && !inside; ++i)
        pressure = std::max(pressure, flat_pair_sum(interface.options(), options.spacing,
                                                    options.sites, interface.substrate_sites(),
                                                    gap + 0.1 * i * scales.length)
                                              .force[2] /
                                          area);
    double young = 0.0;
    for (const Material& material : options.materials())
        young = std::max(young, material.young);
    const double most = std::max(young, 10.0 * scales.force / area);
    if (!inside && !(pressure > most)) return;
    throw io::PhysicsError(
        fmt::format("a mean height of {:.4g} Å lies too far inside the substrate", height),
        inside ? std::string("it is below the mean plane of the atoms")
               : fmt::format("flat surfaces at this distance press with {:.3g} GPa, and Young's "
                             "modulus of the block is {:.3g} GPa",
                             pressure / units::gigapascal, young / units::gigapascal),
        "take a larger height, or lead the block by a load");
}

} // namespace

void remember_sites(SpectralBlock& block, Interface& interface) {
    if (interface.yielding_wall())
        block.add_memory(std::make_unique<PlasticSet>(interface, block.communicator(),
                                                      [&block] { return block.lowest_layer(); }));
}

QuasistaticPath::QuasistaticPath(SpectralBlock& block, Interface& interface, PathOptions options)
    : block_(block), interface_(interface), options_(std::move(options)),
      sites_(static_cast<double>(interface.tile().sites) * interface.tile().sites),
      box_sites_(static_cast<double>(block.options().sites) * block.options().sites),
      last_(block, interface, {options_.along, 0.25 * options_.tolerance, options_.scales}),
      length_(options_.step) {}

void QuasistaticPath::start() {
    block_.set_uniform(0.0);
    first_point(0.0, {.from_apart = true});
}

void QuasistaticPath::start_here(StartOptions options) {
    first_point(options_.along == Constraint::Of::top ? block_.drive() : block_.mean_height(),
                options);
}

void QuasistaticPath::first_point(double top, StartOptions options) {
    const double dt = options.remembers ? 0.0 : units::forever;
    block_.begin_step(dt);
    last_.accept(top);
    const RelaxedState state = last_.relax_at(top, dt, {});
    if (!state.converged)
        throw io::PhysicsError("the path does not start from an equilibrium",
                               why_not_converged(state, last_.tolerance()),
                               "a larger drive.tolerance, or a height further from the substrate");
    last_.accept(top);
    record_.step = 0;
    record_[Term::work] = options.from_apart ? state.stored() : 0.0;
    balance_.begin(state.stored() - record_[Term::work]);
    owed_ = 0.0;
    set_record(state, top);
    trail_.begin(top, state.top_force);
    if (!options.from_apart) turn();
}

void QuasistaticPath::restored() {
    put_back();
    record_.observed = true;
}

void QuasistaticPath::begin(const Segment& segment, std::size_t number) {
    segment_.number = number;
    segment_.kind = segment.kind;
    segment_.end.reset();
    segment_.load.reset();
    const Along along = segment.kind == Segment::hold    ? Along::time
                        : segment.kind != Segment::slide ? Along::z
                        : segment.axis == 0              ? Along::x
                                                         : Along::y;
    const double from = last_.select(along);
    hold_load(segment.under);
    double direction = 0.0;
    switch (segment.kind) {
    case Segment::approach:
        direction = -1.0;
        break;
    case Segment::load: {
        segment_.load = segment.amount;
        const double slack = this->slack(record_.in_contact);
        const bool apart = record_.in_contact == 0 && std::abs(record_.force) <= slack;
        if (apart || record_.force < segment.amount - slack)
            direction = -1.0;
        else if (record_.force > segment.amount + slack)
            direction = 1.0;
        break;
    }
    case Segment::height:
        begin_to(segment.amount - interface_.reference_height());
        return;
    case Segment::slide:
        segment_.end = from + segment.amount;
        if (*segment_.end != from) direction = *segment_.end < from ? -1.0 : 1.0;
        break;
    case Segment::hold:
        segment_.end = from + segment.amount * options_.velocity;
        direction = *segment_.end == from ? 0.0 : 1.0;
        break;
    default: // a pull-off
        direction = 1.0;
    }
    begin(along, direction);
    segment_.settles = segment.until_steady && options_.velocity > 0.0;
}

void QuasistaticPath::begin_to(double at) {
    if (options_.along == Constraint::Of::mean_height)
        refuse_deep(interface_.reference_height() + at, interface_, block_, options_.scales);
    segment_.kind = Segment::height;
    segment_.load.reset();
    segment_.end = at;
    const double from = last_.select(Along::z);
    hold_load({});
    begin(Along::z, at == from ? 0.0 : at < from ? -1.0 : 1.0);
}

/// Holds a load in place of what the path prescribes along z, or no longer.
void QuasistaticPath::hold_load(std::optional<double> load) {
    segment_.held = load;
    last_.prescribe_load(load);
}

void QuasistaticPath::begin(Along along, double direction) {
    if (along != segment_.along || direction != segment_.direction) {
        // No points of the segment before for the integral.
        if (along != segment_.along) trail_.reset_slope();
        segment_.along = along;
        segment_.direction = direction;
        trail_.begin(at(), force());
        bracket_.reset();
        turn();
    }
    length_ = std::min(length_, longest_step());
    // Beside a load, or where a pull-off ends, forces within the tolerance would add up to a force
    // on the top plane that is none of the contact's.
    double balance = HUGE_VAL;
    if (to_load() && load() != 0.0) balance = 0.5 * load_accuracy * std::abs(load());
    if (segment_.kind == Segment::pull_off && strongest_ > 0.0) balance = 1e-4 * strongest_;
    last_.balance_to(balance);
    const double a = block_.options().spacing;
    segment_.rule.begin(segment_.kind, load(), direction < 0.0, box_sites_ * a * a, record_.force,
                        slack(record_.in_contact));
    segment_.aim.begin();
    segment_.errors.begin();
    segment_.errors.add_smooth(-owed_, owed_); // losses of this segment may pay it
    segment_.comes_to_rest = segment_.settles = false;
    segment_.crept = 0;
    segment_.from = at();
    segment_.lateral = segment_.settling = segment_.work_left_out = 0.0;
    segment_.start = record_;
    segment_.flows = {};
}

} // namespace asperity
