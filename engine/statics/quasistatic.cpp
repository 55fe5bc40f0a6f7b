// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/quasistatic.hpp"

#include "engine/units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace asperity {

namespace {
/// A step that is short in time, over the shortest time of the branches.
constexpr double short_time = 0.02;
} // namespace

/// Returns the time of a step, fs; infinite if the block does not relax in time.
double QuasistaticPath::time_of(double step) const {
    return options_.velocity > 0.0 ? step / options_.velocity : units::forever;
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

/// Returns the length of the smallest step, Å. If the block is viscoelastic, the length is also at
/// most a tenth of a step that is short in time, unless the rounding of positions forbids it.
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
    const double allowed = allowed_missing(std::min(way, usual_step()), tolerance);
    if (!(options_.velocity > 0.0)) return allowed;
    return std::max(allowed, tolerance * last_.all_moves());
}

/// Returns the step of the path, Å; of a slide over a wall it is half a spacing of the sites if
/// that is longer: every wave of the map is then seen four times.
double QuasistaticPath::usual_step() const {
    const bool sideways = segment_.along == Along::x || segment_.along == Along::y;
    if (!sideways || !options_.over_wall) return options_.step;
    return std::max(options_.step, 0.5 * block_.options().spacing);
}

/// Returns the length of the longest step, Å; a hold is bounded by its errors alone.
double QuasistaticPath::longest_step() const {
    return segment_.along == Along::time ? HUGE_VAL : usual_step();
}

QuasistaticPath::Outcome QuasistaticPath::advance() {
    if (segment_.comes_to_rest) return come_to_rest();
    if (segment_.settles) return settle();
    if (segment_.direction == 0.0) return segment_.load ? Outcome::at_load : Outcome::there;
    for (;;) {
        const Try t = plan();
        last_.relax_to(0.25 * t.tolerance);
        const long long iterations = last_.iterations();
        const bool any_force = t.all_the_way || t.last || segment_.along != Along::z;
        const RelaxedState state =
            last_.relax_at(t.there, time_of(t.way), options_.report,
                           any_force ? ForceWindow{} : acceptable_force(t.there));
        if (state.interrupted) { // resumed, the same step is made
            length_ = t.length;
            put_back();
            last_.set_iterations(iterations);
            return Outcome::interrupted;
        }
        segment_.aim.count();
        if (t.all_the_way) bracket_.reset();
        if (!state.converged && t.last) refuse_place(state, t.there);
        // A load is met by shorter steps than instabilities are followed with.
        const bool shortens = t.way > 1e-6 * smallest_step();
        if (state.converged && to_load() && passes_load(state) && shortens) {
            segment_.aim.pass({t.there, state.force}, at());
            continue;
        }
        if (state.converged) {
            refuse_whole_yield(state, t.there);
            const StepDecision step = judge(state, t);
            // A force that has fallen further than was known asks for a smaller tolerance.
            const bool loose = !t.last && 2.0 * tolerance_at(state.force) < t.tolerance;
            const bool decided = step.verdict != StepDecision::halve;
            if (decided && !loose) {
                accept(state, t.there, step);
                if (t.arrives) length_ = std::max(length_, t.length);
                const Outcome made = outcome();
                if (made == Outcome::at_load) length_ = std::max(length_, segment_.aim.uncut());
                return made;
            }
            // A step that is only loose or coarse passes no instability: there is none to bracket.
            if (!decided && !step.excess && !step.coarse)
                bracket_ = {t.there, point(state, t.there).force};
        } else if (state.jumped && is_short_in_time(t.way)) {
            // The relaxation was abandoned early: the force changes about as much again.
            bracket_ = {t.there, 2.0 * state.force - trail_.continued(t.there)};
        }
        length_ *= 0.5;
    }
}

/// Plans the next step and sets its length.
QuasistaticPath::Try QuasistaticPath::plan() {
    Try t;
    t.all_the_way = bisect();
    if (std::isfinite(last_.last_dt())) // at most twice as long as the step that it continues
        length_ = std::min(length_, 2.0 * last_.last_dt() * options_.velocity);
    if (to_load())
        length_ = segment_.aim.cut(length_, segment_.direction, trail_, segment_.rule.aim(),
                                   options_.reversible());
    t.length = length_;
    const double left = segment_.end ? segment_.direction * (*segment_.end - at()) : HUGE_VAL;
    t.arrives = left <= length_;
    if (t.arrives) length_ = left;
    t.there = t.arrives ? *segment_.end : at() + segment_.direction * length_;
    t.way = std::abs(t.there - at());
    t.last = length_ <= smallest_step();
    t.tolerance = tolerance_to(t.there);
    return t;
}

/// Returns what becomes of a step that ended in this state.
StepDecision QuasistaticPath::judge(const RelaxedState& state, const Try& t) const {
    const PathPoint trial = point(state, t.there);
    if (options_.reversible()) return reversible_step(point(), trial, energy_error());
    return decide(point(), trial, trail_,
                  {allowed_missing_in_time(t.way, t.tolerance), allowed_uncertainty(t.tolerance),
                   t.last, is_short_in_time(t.way), state.error});
}

/// Returns the outcome of a step that was made.
QuasistaticPath::Outcome QuasistaticPath::outcome() {
    if (segment_.end) return at() == *segment_.end ? Outcome::there : Outcome::point;
    // Without attraction a surface with a set is apart far below the heights that it had.
    const bool clear =
        interface_.yielding_wall() && !options_.attracts() && record_.in_contact == 0;
    const bool beyond = interface_.reference_height() + record_.top >= interface_.start_height();
    const bool apart = are_apart(clear || beyond, record_.force, strongest_);
    switch (segment_.rule.look(record_.force, apart, slack(record_.in_contact),
                               segment_.aim.take_was_cut())) {
    case SegmentRule::End::at_load:
        return Outcome::at_load;
    case SegmentRule::End::apart:
        // A viscoelastic block may still be stretched: the next point is the one at rest.
        segment_.comes_to_rest = options_.velocity > 0.0;
        return segment_.comes_to_rest ? Outcome::point : Outcome::apart;
    case SegmentRule::End::no:
        break;
    }
    return Outcome::point;
}

/// Relaxes the block after the solids have come apart: it dissipates its stored energy without
/// work.
QuasistaticPath::Outcome QuasistaticPath::come_to_rest() {
    const long long iterations = last_.iterations();
    RelaxedState state = last_.relax_at(at(), units::forever, options_.report);
    if (state.interrupted) {
        put_back();
        last_.set_iterations(iterations);
        return Outcome::interrupted;
    }
    if (!state.converged) refuse_place(state, at());
    const PathPoint before = point();
    state[Term::in_block] = std::max(
        before.energy - record_.dissipated() - state[Term::interface] - state[Term::elastic], 0.0);
    const PathPoint there = point(state, at());
    accept(state, at(), {.gap = before.energy - there.energy, .smooth = false});
    segment_.comes_to_rest = false;
    return Outcome::apart;
}

/// Brings the block into the shape in which it slides steadily. The energy for that is work, apart
/// from that of the slide.
QuasistaticPath::Outcome QuasistaticPath::settle() {
    const long long iterations = last_.iterations();
    last_.relax_to(0.25 * tolerance_at(record_.force));
    const RelaxedState state =
        last_.settle(segment_.direction * options_.velocity, options_.report);
    if (state.interrupted) {
        last_.set_iterations(iterations);
        return Outcome::interrupted;
    }
    if (!state.converged) refuse_place(state, at());
    last_.accept(at());
    const double gained = state.stored() - record_.stored();
    segment_.flows[Term::work] += gained;
    segment_.settling = gained + segment_.held.value_or(0.0) * (lifted(state) - record_.top);
    record_[Term::work] += gained;
    ++record_.step;
    set_record(state, at());
    trail_.begin(at(), force());
    turn();
    segment_.settles = false;
    return Outcome::point;
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

/// Returns the tolerance at a point with this force: that of the load to which the segment leads,
/// if the force comes down to it.
double QuasistaticPath::tolerance_at(double force) const {
    const bool of_load = to_load() && segment_.direction > 0.0;
    return tolerance_under(of_load ? std::max(force, load()) : force);
}

/// Returns the tolerance of a step to this place: that at the smallest force on the way, as far as
/// it is known.
double QuasistaticPath::tolerance_to(double to) const {
    double force = record_.force;
    if (segment_.along == Along::z) force = std::min(force, trail_.continued(to));
    return tolerance_at(force);
}

/// Returns the uncertainty of the energy of a point on a reversible path, eV: that of residual
/// forces in the softest wave.
double QuasistaticPath::energy_error() const {
    const BlockOptions& block = block_.options();
    const double softest = block.softest_wave() * block.spacing * block.spacing;
    return 0.5 * sites_ * last_.tolerance() * last_.tolerance() / softest;
}

/// Returns true if the load lies between the last point and this state, or if the attraction was
/// too weak to be told from the slack.
bool QuasistaticPath::passes_load(const RelaxedState& state) const {
    const double aim = segment_.rule.aim();
    const double slack = this->slack(state.in_contact);
    if (segment_.direction > 0.0) return record_.force >= aim - slack && state.force < aim - slack;
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

/// Returns how early or late the block may have become unstable in the last relaxation, Å: forces
/// of twice the relaxation's tolerance, which may be left before and beyond the instability, on all
/// sites that moved, over the stiffness with which the drive presses them. This is the stiffness of
/// the wave that bears the load of a punch of their area with the punch's displacement, q = 4/(pi
/// a), in series with the uniform stretch if the top plane is led. Collective.
double QuasistaticPath::error_of_place() const {
    const BlockOptions& block = block_.options();
    const int n = block.grid();
    const double radius =
        std::sqrt(std::max(1.0, static_cast<double>(last_.sites_moved())) / std::numbers::pi);
    const int wave = std::clamp(
        static_cast<int>(2.0 * n / (std::numbers::pi * std::numbers::pi * radius)), 1, n / 2);
    double compliance = block.normal_compliance(wave_phase(wave, n), wave_phase(0, n));
    if (options_.along == Constraint::Of::top && !block.free_edges)
        compliance += block.normal_compliance(wave_phase(0, n), wave_phase(0, n));
    return 2.0 * compliance * last_.tolerance();
}

/// Returns the interval of forces that continue the branch smoothly for a step to this place, half
/// as wide again, because a fall of the force may partly reverse.
ForceWindow QuasistaticPath::acceptable_force(double to) const {
    return {trail_.continued(to),
            1.5 * 2.0 * allowed_uncertainty(tolerance_to(to)) / std::abs(to - at())};
}

void QuasistaticPath::accept(const RelaxedState& state, double at, const StepDecision& step) {
    // A load works as well.
    const double pressed = -segment_.held.value_or(0.0) * (lifted(state) - record_.top);
    Energies flows;
    flows.take_flows(state); // losses of memories in the step
    flows[Term::work] = step.work + pressed;
    const bool jumped = step.verdict == StepDecision::jump;
    flows[Term::lost] = jumped ? step.lost : std::max(0.0, owed_ + step.lost);
    if (!jumped) owed_ = std::min(0.0, owed_ + step.lost);
    segment_.flows += flows;
    record_ += flows;
    record_[Term::lost] = segment_.start[Term::lost] + segment_.flows[Term::lost]; // by segments
    if (segment_.along == Along::x || segment_.along == Along::y) segment_.lateral += step.work;
    if (step.of_energies) segment_.work_left_out += step.gap;
    if (options_.reversible() && !any_stays_at_rest(block_.memories())) // no error is kept
        segment_.errors.end_at(step.gap);
    else // An extension that is wrong acts on with the larger ones that follow: twice.
        segment_.errors.add_gap(std::abs(step.gap) + 2.0 * state.error);
    const double way = std::abs(at - this->at());
    if (!(step.uncertain > 0.0))
        segment_.errors.add_smooth(step.sigma, step.lost);
    else if (step.smooth)
        segment_.errors.add_bracketed(step.sigma);
    else // the force jumps by 2 step.uncertain/way
        segment_.errors.add_bracketed(
            std::hypot(step.sigma, 2.0 * step.uncertain / way * error_of_place()));
    if (jumped && !step.smooth) segment_.errors.add_instability(at, way, step.lost);
    if (options_.velocity > 0.0) record_.time += time_of(way);
    if (segment_.along != Along::time) way_ += way;
    refuse_to_creep(way);
    if (jumped) {
        dissipation_.add(describe(state, step.lost));
        if (!is_short_in_time(way)) dissipation_.not_followed += step.lost;
    }
    dissipation_.total = record_[Term::lost];
    const double force = point(state, at).force;
    const bool same_branch = step.smooth && !jumped;
    if (same_branch)
        trail_.add(at, force);
    else
        trail_.begin(at, force);
    last_.accept(at);
    ++record_.step;
    set_record(state, at);
    strongest_ = std::max(strongest_, -record_.force);
    length_ *= step.growth;
    // An instability was bracketed with ever smaller steps. Beyond it they begin at four times the
    // last one: in a far longer one the next instability would hide.
    if (!same_branch) length_ = std::max({length_, 4.0 * way, options_.step / 256.0});
    if (!step.smooth) turn();
    length_ = std::clamp(length_, smallest_step(), longest_step());
}

} // namespace asperity
