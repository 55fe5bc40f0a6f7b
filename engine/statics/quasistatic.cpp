// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/quasistatic.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/case/flat_reference.hpp"
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

namespace {
/// A step that is short in time, over the shortest time of the branches.
constexpr double short_time = 0.02;
} // namespace

PathOptions path_options(const Case& c, const Interface& interface,
                         std::function<bool(long long, double)> report) {
    PathOptions o;
    o.along = c.simulation.drive.control == Control::top ? Constraint::Of::top
                                                         : Constraint::Of::mean_height;
    o.step = c.simulation.drive.displacement_step;
    o.tolerance = c.tolerance;
    o.scales = c.scales;
    o.load = c.simulation.drive.load_force;
    if (c.effects.branches) o.velocity = c.simulation.drive.velocity;
    o.reference_height = interface.start_height();
    o.report = std::move(report);
    const double flat = c.flat.work_of_adhesion / units::milli_per_unit;
    if (flat > 0.0) o.depth = flat * c.area();
    return o;
}

namespace {

/// Refuses a mean height far inside the substrate, at which forces and relaxation have no end: even
/// a flat surface would press with more than the modulus of the block, or ten times the
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
    double young = 0.0;
    for (const Material& material : options.materials())
        young = std::max(young, material.young);
    const double most = std::max(young, 10.0 * scales.force / area);
    if (!(pressure > most)) return;
    throw io::PhysicsError(
        fmt::format("a mean height of {:.4g} Å lies too far inside the substrate", height),
        inside ? std::string("it is below the mean plane of the atoms")
               : fmt::format("flat surfaces at this distance press with {:.3g} GPa, and Young's "
                             "modulus of the block is {:.3g} GPa",
                             pressure / units::gigapascal, young / units::gigapascal),
        "take a larger height, or lead the block by a load");
}

} // namespace

QuasistaticPath::QuasistaticPath(SpectralBlock& block, Interface& interface, PathOptions options)
    : block_(block), interface_(interface), options_(std::move(options)),
      sites_(static_cast<double>(interface.tile().sites) * interface.tile().sites),
      last_(
          block, interface,
          {options_.along, 0.25 * options_.tolerance, options_.scales, options_.reference_height}),
      length_(options_.step) {}

void QuasistaticPath::start() {
    block_.set_uniform(0.0);
    first_point(0.0, {.from_apart = true});
}

void QuasistaticPath::start_here(Here here) {
    first_point(options_.along == Constraint::Of::top ? block_.top() : block_.mean_height(), here);
}

void QuasistaticPath::first_point(double top, Here here) {
    const double dt = here.remembers ? 0.0 : HUGE_VAL;
    block_.begin_step(dt);
    last_.accept(top);
    const RelaxedState state = last_.relax_at(top, dt, {});
    if (!state.converged)
        throw io::PhysicsError("the path does not start from an equilibrium",
                               why_not_converged(state, last_.tolerance()),
                               "a larger drive.tolerance, or a height further from the substrate");
    last_.accept(top);
    record_.step = 0;
    const double energy = state.interface_energy + state.elastic_energy;
    record_.work = here.from_apart ? energy : 0.0;
    energy_at_start_ = energy - record_.work;
    set_record(state, top);
    trail_.begin(top, state.top_force);
    if (!here.from_apart) turn();
}

void QuasistaticPath::resume() {
    put_back();
    record_.observed = true;
}

void QuasistaticPath::begin(const Segment& segment, std::size_t number) {
    course_.number = number;
    course_.kind = segment.kind;
    course_.end.reset();
    course_.load.reset();
    const Along along = segment.kind == Segment::hold    ? Along::time
                        : segment.kind != Segment::slide ? Along::z
                        : segment.axis == 0              ? Along::x
                                                         : Along::y;
    const double from = last_.lead(along);
    double direction = 0.0;
    switch (segment.kind) {
    case Segment::approach:
        direction = -1.0;
        break;
    case Segment::load: {
        course_.load = segment.amount;
        const double slack = this->slack(record_.in_contact);
        const bool apart = record_.in_contact == 0 && std::abs(record_.force) <= slack;
        if (apart || record_.force < segment.amount - slack)
            direction = -1.0;
        else if (record_.force > segment.amount + slack)
            direction = 1.0;
        break;
    }
    case Segment::height:
        begin_to(segment.amount - options_.reference_height);
        return;
    case Segment::slide:
        course_.end = from + segment.amount;
        if (*course_.end != from) direction = *course_.end < from ? -1.0 : 1.0;
        break;
    case Segment::hold:
        course_.end = from + segment.amount * options_.velocity;
        direction = *course_.end == from ? 0.0 : 1.0;
        break;
    default: // a pull-off
        direction = 1.0;
    }
    begin(along, direction);
}

void QuasistaticPath::begin_to(double at) {
    if (options_.along == Constraint::Of::mean_height)
        refuse_deep(options_.reference_height + at, interface_, block_, options_.scales);
    course_.kind = Segment::height;
    course_.load.reset();
    course_.end = at;
    const double from = last_.lead(Along::z);
    begin(Along::z, at == from ? 0.0 : at < from ? -1.0 : 1.0);
}

void QuasistaticPath::begin(Along along, double direction) {
    if (along != course_.along || direction != course_.direction) {
        // No points of the segment before for the integral.
        if (along != course_.along) trail_.forget_slope();
        course_.along = along;
        course_.direction = direction;
        trail_.begin(at(), force());
        bracket_.reset();
        turn();
    }
    length_ = std::min(length_, longest_step());
    // Beside a load, or where a pull-off ends, forces within the tolerance would add up to a force
    // on the top plane that is none of the contact's.
    double balance = HUGE_VAL;
    if (to_load() && load() != 0.0) balance = 0.5 * load_accuracy * std::abs(load());
    if (course_.kind == Segment::pull_off && strongest_ > 0.0) balance = 1e-4 * strongest_;
    last_.balance_to(balance);
    const double a = block_.options().spacing;
    course_.rule.begin(course_.kind, load(), direction < 0.0, sites_ * a * a, record_.force,
                       slack(record_.in_contact));
    course_.bracketed = course_.comes_to_rest = false;
    course_.work = course_.relaxed = course_.gap = course_.squares = 0.0;
    course_.stored_at_start = record_.energy();
    dissipation_.begin_segment();
}

/// Returns the force on the prescribed coordinate, eV/Å; 0 for a hold.
double QuasistaticPath::force() const {
    switch (course_.along) {
    case Along::z:
        return record_.top_force;
    case Along::time:
        return 0.0;
    default:
        return record_.lateral_force[axis()];
    }
}

/// Returns the time of a step, fs; infinite if the block does not relax in time.
double QuasistaticPath::time_of(double step) const {
    return options_.velocity > 0.0 ? step / options_.velocity : HUGE_VAL;
}

/// Returns true if the step is so short that the block hardly relaxes.
bool QuasistaticPath::is_short_in_time(double step) const {
    if (!(options_.velocity > 0.0)) return true;
    return time_of(step) <= short_time * block_.options().branches.front().time;
}

void QuasistaticPath::turn() {
    if (!(options_.velocity > 0.0)) return;
    last_.turn();
    const double shortest = block_.options().branches.front().time;
    length_ = std::min(length_, short_time * shortest * options_.velocity);
}

/// Returns the length of the smallest step, Å. If the block relaxes, the length is also at most a
/// tenth of a step that is short in time, unless the rounding of positions forbids it.
double QuasistaticPath::smallest_step() const {
    const double smallest = options_.step * 0x1p-16;
    if (!(options_.velocity > 0.0)) return smallest;
    const double shortest = block_.options().branches.front().time;
    return std::min(smallest, std::max(0.1 * short_time * shortest * options_.velocity,
                                       options_.step * 0x1p-30));
}

/// Returns the energy that may be missing in a step of the drive by `way` (Å), eV: no less than the
/// rounding of sums over the sites (kernels/exact_sum.hpp).
double QuasistaticPath::allowed_missing(double way, double tolerance) const {
    return std::max(tolerance * sites_ * way, sites_ * 0x1p-51);
}

/// Returns the energy that may be missing in a step in time, eV. An unstable patch of a slow block
/// moves while the drive hardly moves: the tolerance is then for each Å of the way of each site.
double QuasistaticPath::allowed_missing_in_time(double way, double tolerance) const {
    const double allowed = allowed_missing(std::min(way, options_.step), tolerance);
    if (!(options_.velocity > 0.0)) return allowed;
    return std::max(allowed, tolerance * last_.all_moves());
}

/// Returns the length of the longest step, Å; a hold is bounded by its errors alone.
double QuasistaticPath::longest_step() const {
    return course_.along == Along::time ? HUGE_VAL : options_.step;
}

QuasistaticPath::Outcome QuasistaticPath::advance() {
    if (course_.comes_to_rest) return come_to_rest();
    if (course_.direction == 0.0) return course_.load ? Outcome::at_load : Outcome::there;
    const double aim = course_.rule.aim();
    for (;;) {
        const bool all_the_way = bisect();
        if (std::isfinite(last_.last_dt())) // at most twice as long as the step that it continues
            length_ = std::min(length_, 2.0 * last_.last_dt() * options_.velocity);
        const double left = course_.end ? course_.direction * (*course_.end - at()) : HUGE_VAL;
        const double planned = length_;
        const bool arrives = left <= length_;
        if (arrives) length_ = left;
        const double there = arrives ? *course_.end : at() + course_.direction * length_;
        const double way = std::abs(there - at());
        const bool last_try = length_ <= smallest_step();
        const bool any_force = all_the_way || last_try || course_.along != Along::z;
        const double tolerance = tolerance_to(there);
        last_.relax_to(0.25 * tolerance);
        const long long iterations = last_.iterations();
        const RelaxedState state =
            last_.relax_at(there, time_of(way), options_.report,
                           any_force ? ForceWindow{} : acceptable_force(there));
        if (state.interrupted) { // resumed, the same step is made
            length_ = planned;
            put_back();
            last_.set_iterations(iterations);
            return Outcome::interrupted;
        }
        if (all_the_way) bracket_.reset();
        if (!state.converged && last_try) refuse_place(state, there);
        // A load is met by shorter steps than instabilities are followed with.
        const bool shortens = length_ > 1e-6 * smallest_step();
        if (state.converged && to_load() && passes_load(state, aim) && shortens) {
            const double part = (aim - record_.force) / (state.force - record_.force);
            length_ *= std::clamp(part, 0.02, 0.98);
            course_.bracketed = true;
            continue;
        }
        if (state.converged) {
            const PathPoint trial = point(state, there);
            const StepDecision step =
                decide(point(), trial, trail_,
                       {allowed_missing_in_time(way, tolerance), allowed_uncertainty(tolerance),
                        last_try, is_short_in_time(way), state.branches.error});
            // A force that has fallen further than was known asks for a smaller tolerance.
            const bool loose = !last_try && 2.0 * tolerance_under(state.force) < tolerance;
            const bool decided = step.verdict != StepDecision::halve;
            if (decided && !loose) {
                accept(state, there, step);
                if (arrives) length_ = std::max(length_, planned);
                return outcome();
            }
            // A step that is only loose or coarse passes no instability: there is none to bracket.
            if (!decided && !step.excess && !step.coarse) bracket_ = {there, trial.force};
        } else if (state.jumped && is_short_in_time(way)) {
            bracket_ = {there, state.force};
        }
        length_ *= 0.5;
    }
}

/// Returns the outcome of a step that was made.
QuasistaticPath::Outcome QuasistaticPath::outcome() {
    if (course_.end) return at() == *course_.end ? Outcome::there : Outcome::point;
    const bool apart = options_.reference_height + record_.top >= interface_.start_height() &&
                       std::abs(record_.force) <= 1e-6 * strongest_;
    switch (course_.rule.look(record_.force, apart, slack(record_.in_contact),
                              std::exchange(course_.bracketed, false))) {
    case SegmentRule::End::at_load:
        return Outcome::at_load;
    case SegmentRule::End::apart:
        // A block that relaxes may still be stretched: the next point is the one at rest.
        course_.comes_to_rest = options_.velocity > 0.0;
        return course_.comes_to_rest ? Outcome::point : Outcome::apart;
    case SegmentRule::End::no:
        break;
    }
    return Outcome::point;
}

/// Relaxes the block after the solids have come apart: it dissipates its stored energy without
/// work.
QuasistaticPath::Outcome QuasistaticPath::come_to_rest() {
    const long long iterations = last_.iterations();
    RelaxedState state = last_.relax_at(at(), HUGE_VAL, options_.report);
    if (state.interrupted) {
        put_back();
        last_.set_iterations(iterations);
        return Outcome::interrupted;
    }
    if (!state.converged) refuse_place(state, at());
    const PathPoint before = point();
    state.branches.dissipated = std::max(
        before.energy - record_.relaxed - state.interface_energy - state.elastic_energy, 0.0);
    const PathPoint there = point(state, at());
    accept(state, at(), {.gap = before.energy - there.energy, .smooth = false});
    course_.comes_to_rest = false;
    return Outcome::apart;
}

void QuasistaticPath::refuse_place(const RelaxedState& state, double at) const {
    throw io::PhysicsError(fmt::format("no equilibrium was found with the {} {:.6g} Å",
                                       course_.along != Along::z ? "block moved sideways by"
                                       : options_.along == Constraint::Of::top
                                           ? "top plane displaced by"
                                           : "mean height displaced by",
                                       at),
                           fmt::format("after {} iterations {}", state.iterations,
                                       why_not_converged(state, last_.tolerance())),
                           "a larger drive.tolerance, or a height further from the substrate");
}

/// Sums the lateral force of the substrate on the lowest layer, eV/Å, of the last relaxation.
/// Collective.
std::array<double, 2> QuasistaticPath::lateral_force() const {
    const VectorPlane<double> f = block_.interface_force();
    std::array<ExactSum, 2> sums;
    elastic_kernels().sum(f.x, 0, f.x.ny, sums[0]);
    elastic_kernels().sum(f.y, 0, f.y.ny, sums[1]);
    return global_sums(block_.communicator(), sums);
}

/// Returns the uncertainty of the force of a point, eV/Å: a quarter of the tolerance, to which
/// points are relaxed, for each site that counts. Under a prescribed top plane every site counts;
/// at a prescribed mean height only sites that the substrate holds, because the residuals of the
/// others cannot add up to a force. On the way to a load the uncertainty is at most that of the
/// load.
double QuasistaticPath::slack(std::int64_t in_contact) const {
    const bool all = options_.along == Constraint::Of::top;
    const double count = all ? sites_ : std::max(static_cast<double>(in_contact), 1.0);
    const double slack = 0.25 * tolerance_under(record_.force) * count;
    const double load = to_load() ? this->load() : 0.0;
    return load == 0.0 ? slack : std::min(slack, load_accuracy * std::abs(load));
}

/// Returns the tolerance of a step to this place: that under the smallest force on the way, as far
/// as it is known; on the way down to a load, no less than under that.
double QuasistaticPath::tolerance_to(double to) const {
    double force = record_.force;
    if (course_.along == Along::z) force = std::min(force, trail_.continued(to));
    if (to_load() && course_.direction > 0.0) force = std::max(force, load());
    return tolerance_under(force);
}

/// Returns true if the load lies between the last point and this state, or if the attraction was
/// too weak to be told from the slack.
bool QuasistaticPath::passes_load(const RelaxedState& state, double aim) const {
    const double slack = this->slack(state.in_contact);
    if (course_.direction > 0.0) return record_.force >= aim - slack && state.force < aim - slack;
    return record_.force <= aim + slack && state.force > aim + slack;
}

/// Sets the next step to half of the way to the far end of the bracket, or to all of the way once
/// the work of such a step is known well enough. Returns true in the latter case.
bool QuasistaticPath::bisect() {
    if (!bracket_) return false;
    const double way = std::abs(bracket_->x - at());
    const bool known = is_short_in_time(way) && work_is_known(bracket_->x, bracket_->f);
    if (way > smallest_step() && !known) {
        length_ = std::min(length_, 0.5 * way);
        return false;
    }
    length_ = way;
    return true;
}

/// Returns true if the work of a step is known well enough, by the rule of decide() for missing
/// energy.
bool QuasistaticPath::work_is_known(double to, double there) const {
    const double step = std::abs(to - at());
    const double tolerance = tolerance_to(to);
    return trail_.to(to, there).error <= allowed_missing(step, tolerance) ||
           0.5 * step * trail_.jump(to, there) <= allowed_uncertainty(tolerance);
}

/// Returns the interval of forces that continue the branch smoothly for a step to this place, half
/// as wide again, because a fall of the force may partly reverse.
ForceWindow QuasistaticPath::acceptable_force(double to) const {
    return {trail_.continued(to),
            1.5 * 2.0 * allowed_uncertainty(tolerance_to(to)) / std::abs(to - at())};
}

PathPoint QuasistaticPath::point(const RelaxedState& state, double at) const {
    const double force = course_.along == Along::z      ? state.top_force
                         : course_.along == Along::time ? 0.0
                                                        : lateral_force()[axis()];
    return {at, force,
            state.interface_energy + state.elastic_energy + record_.relaxed +
                state.branches.dissipated};
}

void QuasistaticPath::accept(const RelaxedState& state, double at, const StepDecision& step) {
    course_.work += step.work;
    // An extension that is wrong acts on with the larger ones that follow: twice.
    course_.gap += std::abs(step.gap) + 2.0 * state.branches.error;
    course_.squares += step.uncertain * step.uncertain;
    record_.work += step.work;
    const double way = std::abs(at - this->at());
    if (options_.velocity > 0.0) record_.time += time_of(way);
    if (course_.along != Along::time) way_ += way;
    if (step.dissipated > 0.0) {
        dissipation_.add(describe(state, step.dissipated));
        if (!is_short_in_time(way)) dissipation_.not_followed += step.dissipated;
        record_.damped = dissipation_.total();
    }
    const double force = point(state, at).force;
    const bool same_branch = step.smooth && step.dissipated == 0.0;
    if (same_branch)
        trail_.add(at, force);
    else
        trail_.begin(at, force);
    last_.accept(at);
    ++record_.step;
    course_.relaxed += state.branches.dissipated;
    record_.relaxed += state.branches.dissipated;
    set_record(state, at);
    strongest_ = std::max(strongest_, -record_.force);
    length_ *= step.growth;
    // An instability was bracketed with ever smaller steps. Beyond it they begin at four times the
    // last one: in a far longer one the next instability would hide.
    if (!same_branch) length_ = std::max({length_, 4.0 * way, options_.step / 256.0});
    if (!step.smooth) turn();
    length_ = std::clamp(length_, smallest_step(), longest_step());
}

void QuasistaticPath::set_record(const RelaxedState& state, double at) {
    if (course_.along == Along::z)
        record_.top = at;
    else if (course_.along != Along::time)
        record_.slide[axis()] = at;
    if (interface_.options().slides) record_.lateral_force = lateral_force();
    record_.mean_height = options_.reference_height + state.mean_height;
    record_.force = state.force;
    record_.top_force = state.top_force;
    record_.observed = true;
    record_.interface_energy = state.interface_energy;
    record_.elastic_energy = state.elastic_energy;
    record_.branch_energy = state.branches.stored;
    static_cast<ContactCount&>(record_) = state;
    const double gained = state.interface_energy + state.elastic_energy - energy_at_start_;
    scale_ = std::max(
        {scale_, std::abs(state.interface_energy), state.elastic_energy, std::abs(record_.work)});
    // The balance says nothing of small energies: those below an eightieth of the work of the scale
    // of forces on the way so far and a step more, or below a twentieth of flat surfaces'. Neither
    // depends on the tolerance.
    const double least = std::min(options_.scales.force * sites_ * (way_ + options_.step) / 80.0,
                                  0.05 * options_.depth);
    const double scale = std::max(scale_, least);
    const double spent = record_.damped + record_.relaxed;
    record_.residual = scale > 0.0 ? (record_.work - gained - spent) / scale : 0.0;
}

Instability QuasistaticPath::describe(const RelaxedState& state, double energy) const {
    Instability instability;
    instability.energy = energy;
    instability.segment = course_.number;
    instability.top = record_.top;
    instability.height_before = record_.mean_height;
    instability.height_after = options_.reference_height + state.mean_height;
    instability.slide = record_.slide;
    instability.force_before = force();
    instability.force_after = point(state, at()).force;
    instability.contact_before = record_.in_contact;
    instability.contact_after = state.in_contact;
    const LargestSite most = last_.largest_move();
    std::array<std::int64_t, 1> count = {0};
    const auto moved = last_.moves();
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
