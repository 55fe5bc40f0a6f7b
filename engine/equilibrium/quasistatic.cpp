// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/quasistatic.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/interface/flat_reference.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "kernels/elastic_level.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace asperity {

PathOptions path_options(const Case& c, const Interface& interface,
                         std::function<bool(long long, double)> report) {
    PathOptions o{sequence_options(c, interface, std::move(report))};
    o.along = c.scene.drive.hold == Hold::top ? Constraint::Of::top : Constraint::Of::mean_height;
    const double flat = c.flat.work_of_adhesion / units::milli_per_unit;
    if (flat > 0.0) o.depth = flat * c.area();
    return o;
}

namespace {

/// A mean height far inside the substrate: there is no end to the forces, nor to the relaxation.
/// Even a flat surface would press with more than the modulus of the block, or ten times the
/// largest attraction. Collective.
void refuse_deep(double height, const Interface& interface, const SpectralBlock& block,
                 const Scales& scales) {
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
    double pressure = inside ? HUGE_VAL : 0.0;
    // Between the atoms of a flat layer the force falls again: the largest from here outwards.
    for (int i = 0; i < 10 && !inside; ++i)
        pressure = std::max(pressure, flat_pair_sum(interface.options(), options.spacing,
                                                    options.sites, interface.substrate_sites(),
                                                    gap + 0.1 * i * scales.length)
                                              .force[2] /
                                          area);
    const double most = std::max(options.young, 10.0 * scales.force / area);
    if (!(pressure > most)) return;
    throw io::PhysicsError(
        fmt::format("a mean height of {:.4g} Å lies too far inside the substrate", height),
        inside ? std::string("it is below the mean plane of the atoms")
               : fmt::format("flat surfaces at this distance press with {:.3g} GPa, and Young's "
                             "modulus of the block is {:.3g} GPa",
                             pressure / units::gigapascal, options.young / units::gigapascal),
        "take a larger height, or lead the block by a load");
}

} // namespace

QuasistaticPath::QuasistaticPath(SpectralBlock& block, Interface& interface, PathOptions options)
    : block_(block), interface_(interface), options_(std::move(options)),
      sites_(static_cast<double>(interface.tile().sites) * interface.tile().sites),
      points_(
          block, interface,
          {options_.along, 0.25 * options_.tolerance, options_.scales, options_.reference_height}),
      length_(options_.step) {}

void QuasistaticPath::start() {
    // Out of reach the block follows the top plane as a whole: that is what the first steps
    // continue.
    block_.set_uniform(options_.step);
    points_.begin(options_.step);
    block_.set_uniform(0.0);
    points_.accept(0.0);
    first_point(0.0, true);
    predicts_ = reversible_ = true;
    direction_ = -1.0;
}

void QuasistaticPath::start_here(bool apart) {
    const double top = options_.along == Constraint::Of::top ? block_.top() : block_.mean_height();
    points_.begin(top);
    first_point(top, apart);
    reversible_ = false;
}

void QuasistaticPath::first_point(double top, bool apart) {
    const RelaxedState state = points_.relax_at(top, false, {});
    if (!state.converged)
        throw io::PhysicsError("the path does not start from an equilibrium",
                               why_not_converged(state, 0.25 * options_.tolerance),
                               "a larger drive.tolerance, or a height further from the substrate");
    points_.replace();
    record_.step = 0;
    const double energy = state.interface_energy + state.elastic_energy;
    record_.work = apart ? energy : 0.0;
    energy_at_start_ = energy - record_.work;
    set_record(state, top);
    trail_.begin(top, state.top_force);
}

void QuasistaticPath::resume() {
    put_back();
    record_.observed = true;
}

void QuasistaticPath::begin(const Segment& segment, std::size_t number) {
    segment_ = number;
    kind_ = segment.kind;
    end_.reset();
    load_.reset();
    const Along along = kind_ != Segment::slide ? Along::z
                        : segment.axis == 0     ? Along::x
                                                : Along::y;
    const double from = points_.lead(along);
    double direction = 0.0;
    switch (kind_) {
    case Segment::approach:
        direction = -1.0;
        break;
    case Segment::load: {
        load_ = segment.amount;
        const double slack = this->slack(record_.in_contact);
        const bool apart = record_.in_contact == 0 && std::abs(record_.force) <= slack;
        if (apart || record_.force < *load_ - slack)
            direction = -1.0;
        else if (record_.force > *load_ + slack)
            direction = 1.0;
        break;
    }
    case Segment::height:
        if (options_.along == Constraint::Of::mean_height)
            refuse_deep(segment.amount, interface_, block_, options_.scales);
        [[fallthrough]];
    case Segment::slide:
        end_ = kind_ == Segment::height ? segment.amount - options_.reference_height
                                        : from + segment.amount;
        if (*end_ != from) direction = *end_ < from ? -1.0 : 1.0;
        break;
    default: // a pull-off
        direction = 1.0;
    }
    begin(along, direction);
}

void QuasistaticPath::begin_to(double at) {
    if (options_.along == Constraint::Of::mean_height)
        refuse_deep(options_.reference_height + at, interface_, block_, options_.scales);
    kind_ = Segment::height;
    load_.reset();
    end_ = at;
    const double from = points_.lead(Along::z);
    begin(Along::z, at == from ? 0.0 : at < from ? -1.0 : 1.0);
}

void QuasistaticPath::begin(Along along, double direction) {
    if (along != along_ || direction != direction_) {
        // No points of the segment before for the integral.
        along_ = along;
        direction_ = direction;
        trail_.begin(at(), force());
        bracket_.known = false;
        predicts_ = reversible_;
    }
    const double load = to_load() ? load_.value_or(options_.load) : 0.0;
    // Beside a load, or where a pull-off ends, forces within the tolerance would add up to a force
    // on the top plane that is none of the contact's.
    double balance = HUGE_VAL;
    if (load != 0.0) balance = 0.5 * load_accuracy * std::abs(load);
    if (kind_ == Segment::pull_off && strongest_ > 0.0) balance = 1e-4 * strongest_;
    points_.balance_to(balance);
    attracted_ = bracketed_ = false;
    work_ = 0.0;
    error_ = {};
    dissipation_.begin_segment();
}

QuasistaticPath::Outcome QuasistaticPath::advance() {
    if (direction_ == 0.0) return load_ ? Outcome::at_load : Outcome::there;
    const double load = load_.value_or(options_.load);
    if (load_) // it may be beyond that load already
        attracted_ = attracted_ || record_.force < load - slack(record_.in_contact);
    const bool down = direction_ < 0.0;
    const double aim = !down || attracted_ ? load : std::max(load, 0.0); // through attraction
    for (;;) {
        const Bracket bracket = bracket_;
        const bool all_the_way = bisect();
        const double left = end_ ? direction_ * (*end_ - at()) : HUGE_VAL;
        const double planned = length_;
        const bool arrives = left <= length_;
        if (arrives) length_ = left;
        const double there = arrives ? *end_ : at() + direction_ * length_;
        predicts_ = predicts_ && points_.predicts(there);
        const long long iterations = points_.iterations();
        const bool last_try = length_ <= smallest_step();
        const bool any_force = all_the_way || last_try || along_ != Along::z;
        const RelaxedState state = points_.relax_at(
            there, predicts_, options_.report, any_force ? ForceWindow{} : acceptable_force(there));
        if (state.interrupted) { // resumed, the same step is made
            bracket_ = bracket;
            length_ = planned;
            put_back();
            points_.set_iterations(iterations);
            return Outcome::interrupted;
        }
        if (!state.converged && !predicts_ && last_try)
            throw io::PhysicsError(
                fmt::format("no equilibrium was found with the {} {:.6g} Å",
                            along_ != Along::z                      ? "block moved sideways by"
                            : options_.along == Constraint::Of::top ? "top plane displaced by"
                                                                    : "mean height displaced by",
                            there),
                fmt::format("after {} iterations {}", state.iterations,
                            why_not_converged(state, 0.25 * options_.tolerance)),
                "a larger drive.tolerance, or a height further from the substrate");
        // A load is met by shorter steps than instabilities are followed with.
        const bool shortens = length_ > 1e-6 * smallest_step();
        if (state.converged && to_load() && passes_load(state, aim) && shortens) {
            const double part = (aim - record_.force) / (state.force - record_.force);
            length_ *= std::clamp(part, 0.02, 0.98);
            bracketed_ = true;
            continue;
        }
        const Trial trial{state, there,
                          along_ == Along::z ? state.top_force : lateral_force()[axis()]};
        StepCheck step;
        if (state.converged) step = check(trial);
        if (last_try) step.accepted = state.converged;
        if (step.accepted && (!predicts_ || step.dissipated == 0.0)) {
            accept(trial, step);
            if (arrives) length_ = std::max(length_, planned);
            break;
        }
        // What looks like an instability after a prediction is looked at again without.
        if (std::exchange(predicts_, false) && !state.jumped) continue;
        if (state.jumped) bracket_ = {true, there, state.force};
        if (state.converged && !step.excess) bracket_ = {true, there, trial.force};
        length_ *= 0.5;
        predicts_ = reversible_;
    }
    return outcome();
}

/// Of a step that was made.
QuasistaticPath::Outcome QuasistaticPath::outcome() {
    if (end_) return at() == *end_ ? Outcome::there : Outcome::point;
    const double load = load_.value_or(options_.load), slack = this->slack(record_.in_contact);
    if (direction_ < 0.0) {
        const double aim = attracted_ ? load : std::max(load, 0.0);
        attracted_ = attracted_ || record_.force < std::min(load, 0.0) - slack;
        const bool back = attracted_ && record_.force >= load;
        const bool there =
            back || (std::exchange(bracketed_, false) && record_.force >= aim - slack);
        if (there && load_ && load < -slack && !attracted_) refuse_pull(load);
        return there ? Outcome::at_load : Outcome::point;
    }
    if (load_ && std::exchange(bracketed_, false) && record_.force <= load + slack)
        return Outcome::at_load;
    const bool apart = options_.reference_height + record_.top >= interface_.start_height() &&
                       std::abs(record_.force) <= 1e-6 * strongest_;
    if (!apart) return Outcome::point;
    if (!load_) return Outcome::apart;
    if (load < -slack) refuse_pull(load);
    return Outcome::at_load; // an attraction too weak to be told from none
}

void QuasistaticPath::refuse_pull(double load) const {
    const double a = block_.options().spacing;
    throw io::PhysicsError(fmt::format("no attraction was as large as the pull of {:.4g} MPa",
                                       -load / (sites_ * a * a * units::megapascal)),
                           "it is nowhere that large on this way", "take a smaller pull");
}

/// Of the substrate on the lowest layer, by the forces of the last relaxation. Collective.
std::array<double, 2> QuasistaticPath::lateral_force() const {
    const VectorPlane<double> f = block_.interface_force();
    std::array<ExactSum, 2> sums;
    elastic_kernels().sum(f.x, 0, f.x.ny, sums[0]);
    elastic_kernels().sum(f.y, 0, f.y.ny, sums[1]);
    return global_sums(block_.communicator(), sums);
}

/// What the force of a point may be wrong by, eV/Å: a quarter of the tolerance, which points are
/// relaxed to, for each site that counts. Under a prescribed top plane that is each site; at a
/// prescribed mean height the others' residuals cannot add up to a force, only those of sites that
/// the substrate holds move it. On the way to a load no more than the load may be missed by.
double QuasistaticPath::slack(std::int64_t in_contact) const {
    const bool all = options_.along == Constraint::Of::top;
    const double count = all ? sites_ : std::max(static_cast<double>(in_contact), 1.0);
    const double slack = 0.25 * options_.tolerance * count;
    const double load = to_load() ? load_.value_or(options_.load) : 0.0;
    return load == 0.0 ? slack : std::min(slack, load_accuracy * std::abs(load));
}

/// With the last point still on the other side of it. Also where the attraction
/// was too weak to be told from the slack.
bool QuasistaticPath::passes_load(const RelaxedState& state, double aim) const {
    const double slack = this->slack(state.in_contact);
    if (direction_ > 0.0) return record_.force >= aim - slack && state.force < aim - slack;
    return record_.force <= aim + slack && state.force > aim + slack;
}

/// The next step goes half of the way to the far end of the bracket; or all of it, once the work of
/// such a step is known well enough: then true.
bool QuasistaticPath::bisect() {
    if (!bracket_.known) return false;
    const double way = std::abs(bracket_.at - at());
    if (way > smallest_step() && !work_is_known(bracket_.at, bracket_.force)) {
        length_ = std::min(length_, 0.5 * way);
        return false;
    }
    length_ = way;
    predicts_ = false;
    bracket_.known = false;
    return true;
}

/// As check() has it where energy is missing.
bool QuasistaticPath::work_is_known(double to, double there) const {
    const double step = std::abs(to - at());
    return trail_.to(to, there).error <= options_.tolerance * sites_ * step ||
           0.5 * step * std::abs(there - force()) <= allowed_uncertainty();
}

/// A force outside is too far from a smooth continuation for a step to this place; a half more than
/// that, for a fall may come back a little.
ForceWindow QuasistaticPath::acceptable_force(double to) const {
    return {trail_.continued(to), 1.5 * 2.0 * allowed_uncertainty() / std::abs(to - at())};
}

QuasistaticPath::StepCheck QuasistaticPath::check(const Trial& to) const {
    const RelaxedState& state = to.state;
    const double step = std::abs(to.at - at());
    const double gained = state.interface_energy + state.elastic_energy - record_.interface_energy -
                          record_.elastic_energy;
    const double allowed = options_.tolerance * sites_ * step;
    const ForceTrail::Integral integral = trail_.to(to.at, to.force);
    StepCheck v;
    v.work = -integral.value;
    const double missing = v.work - gained;
    const double error = std::min(integral.error, std::abs(missing));
    v.margin = allowed / std::max(error, 1e-6 * allowed);
    if (std::abs(missing) <= allowed) {
        v.accepted = true;
        v.gap = missing;
        return v;
    }
    // What is less than the work may be wrong by, or allowed, is left unaccounted for: it shows in
    // the residual.
    double uncertain = integral.error;
    v.smooth = uncertain <= allowed;
    v.accepted = v.smooth;
    if (!v.smooth) {
        v.work = -trail_.trapezium(to.at, to.force);
        uncertain = 0.5 * step * std::abs(to.force - force());
        v.accepted = uncertain <= allowed_uncertainty();
    }
    if (v.work - gained > std::max(uncertain, allowed)) v.dissipated = v.work - gained;
    v.gap = v.work - gained - v.dissipated;
    v.uncertain = uncertain;
    v.excess = gained - v.work > std::max(uncertain, allowed);
    v.accepted = v.accepted && !v.excess;
    return v;
}

void QuasistaticPath::accept(const Trial& to, const StepCheck& step) {
    work_ += step.work;
    error_.gap += std::abs(step.gap);
    error_.squares += step.uncertain * step.uncertain;
    record_.work += step.work;
    if (step.dissipated > 0.0) {
        dissipation_.add(describe(to.state, step.dissipated));
        record_.damped = dissipation_.total();
    }
    if (step.smooth)
        trail_.add(to.at, to.force);
    else
        trail_.begin(to.at, to.force);
    points_.accept(to.at);
    predicts_ = reversible_ = step.dissipated == 0.0;
    if (bracket_.known && direction_ * (bracket_.at - to.at) <= 0.0) bracket_.known = false;
    ++record_.step;
    way_ += std::abs(to.at - at());
    set_record(to.state, to.at);
    strongest_ = std::max(strongest_, -record_.force);
    // The error of a smooth step goes with the fourth power of its length, for each Å.
    const double growth = std::clamp(0.8 * std::sqrt(std::sqrt(step.margin)), 0.5, 2.0);
    length_ *= growth;
    // An instability was bracketed with ever smaller steps; beyond it there is no reason for them.
    if (!step.smooth) length_ = std::max(length_, options_.step / 4.0);
    length_ = std::clamp(length_, smallest_step(), options_.step);
}

void QuasistaticPath::set_record(const RelaxedState& state, double at) {
    if (along_ == Along::z)
        record_.top = at;
    else
        record_.slide[axis()] = at;
    if (interface_.options().slides) record_.lateral_force = lateral_force();
    record_.mean_height = options_.reference_height + state.mean_height;
    record_.force = state.force;
    record_.top_force = state.top_force;
    record_.observed = true;
    record_.interface_energy = state.interface_energy;
    record_.elastic_energy = state.elastic_energy;
    record_.in_contact = state.in_contact;
    record_.repulsive = state.repulsive;
    record_.closest = state.closest;
    const double gained = state.interface_energy + state.elastic_energy - energy_at_start_;
    scale_ = std::max(
        {scale_, std::abs(state.interface_energy), state.elastic_energy, std::abs(record_.work)});
    // Of energies that are still small the balance says nothing: of those below an eightieth of
    // what the scale of the forces does on the way so far and a step more, or a twentieth of flat
    // surfaces'. Neither depends on the tolerance.
    const double least = std::min(options_.scales.force * sites_ * (way_ + options_.step) / 80.0,
                                  0.05 * options_.depth);
    const double scale = std::max(scale_, least);
    record_.residual = scale > 0.0 ? (record_.work - gained - record_.damped) / scale : 0.0;
}

Instability QuasistaticPath::describe(const RelaxedState& state, double energy) const {
    Instability instability;
    instability.energy = energy;
    instability.segment = segment_;
    instability.top = record_.top;
    instability.height_before = record_.mean_height;
    instability.height_after = options_.reference_height + state.mean_height;
    instability.slide = record_.slide;
    instability.force_before = force();
    instability.force_after = along_ == Along::z ? state.top_force : lateral_force()[axis()];
    instability.contact_before = record_.in_contact;
    instability.contact_after = state.in_contact;
    const LargestSite most = points_.largest_move();
    std::array<std::int64_t, 1> count = {0};
    const auto moved = points_.moves();
    const auto layer = block_.lowest_layer();
    for (int y = 0; y < layer.x.ny; ++y)
        for (int x = 0; x < layer.x.nx; ++x)
            count[0] += moved(x, y) > 0.5 * most.value;
    block_.communicator().sum(count);
    instability.site_x = most.x;
    instability.site_y = most.y;
    instability.largest_move = most.value;
    instability.sites_moved = count[0];
    return instability;
}

} // namespace asperity
