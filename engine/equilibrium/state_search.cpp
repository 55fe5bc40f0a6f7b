// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/state_search.hpp"

#include "engine/units.hpp"
#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace asperity {

StateSearchOptions search_options(const Case& c, SpectralBlock& block, const Interface& interface,
                                  std::function<bool(long long, double)> report) {
    StateSearchOptions o{sequence_options(c, interface, std::move(report))};
    o.area = c.area();
    o.largest_tension = units::gigapascal * c.largest_tension;
    // Atoms anywhere can bind more than a flat layer does.
    if (c.scene.surface.kind != SurfaceKind::atoms)
        o.flat_energy = [&c, &interface](double distance) {
            const double a = c.scene.surface.spacing;
            return flat_pair_sum(interface.options(), a, c.scene.surface.sites,
                                 interface.substrate_sites(), distance)
                       .energy /
                   (a * a);
        };
    o.flat_depth = c.flat.work_of_adhesion / units::milli_per_unit;
    o.softest_wave = c.simulation.block.softest_wave();
    o.relax_free = [&c, &block, &interface, report = o.report] {
        return find_zero_load(block, interface, interface.start_height(),
                              c.simulation.drive.load_force, c, report);
    };
    return o;
}

StateSearch::StateSearch(SpectralBlock& block, Interface& interface, StateSearchOptions options)
    : block_(block), interface_(interface), options_(std::move(options)),
      sites_(static_cast<double>(interface.tile().sites) * interface.tile().sites),
      points_(block, interface,
              {Constraint::Of::mean_height, 10.0 * options_.tolerance, options_.site_stiffness,
               options_.reference_height}) {}

void StateSearch::start(const ZeroLoad& first) {
    const double height = block_.mean_height();
    points_.begin(height);
    first_.take(state_of(block_));
    first_top_ = block_.top();
    // As all other points, without what a load stretches the block by.
    const RelaxedState state = points_.relax_at(height, false, {});
    if (!state.converged)
        throw io::PhysicsError("the search for states does not start from an equilibrium",
                               fmt::format("the largest force left is {:.2e} eV/Å", state.residual),
                               "a looser drive.tolerance");
    points_.replace();
    now_ = point(state, height);
    now_.force = options_.load;
    trail_.begin(height, now_.force);
    passed_ = {now_};
    found_ = {{first, 0}};
    if (now_.contact >= 1.0) end_ = StateList::End::contact;
}

StateSearch::Point StateSearch::point(const RelaxedState& state, double height) const {
    return {height, state.force, state.interface_energy + state.elastic_energy,
            static_cast<double>(state.in_contact) / sites_,
            outwards_ ? static_cast<int>(instabilities_) : 0};
}

StateSearch::Outcome StateSearch::advance() {
    if (end_ != StateList::End::none) return Outcome::done;
    const double height = next_height();
    const long long iterations = points_.iterations();
    const auto interrupted = [&] {
        points_.put_back();
        points_.set_iterations(iterations);
        return Outcome::interrupted;
    };
    // Whatever looks like an instability after a prediction is looked at again without.
    const bool predicted = smooth_ && points_.predicts(height);
    RelaxedState state = points_.relax_at(height, predicted, options_.report);
    const auto suspect = [&] { return !state.converged || missing(point(state, height)) > 0.0; };
    if (predicted && !state.interrupted && suspect())
        state = points_.relax_at(height, false, options_.report);
    if (state.interrupted) return interrupted();
    if (!state.converged) {
        if (outwards_)
            turn_inwards();
        else
            end_ = StateList::End::no_equilibrium;
        return Outcome::point;
    }
    const Point to = point(state, height);
    const double lost = missing(to);
    const bool smooth = lost <= 0.0;
    const Point &outer = outwards_ ? to : now_, &inner = outwards_ ? now_ : to;
    if (outer.force < options_.load && inner.force >= options_.load) {
        StateCopy here;
        here.take(state_of(block_));
        if (!relax_state(to, smooth)) return interrupted();
        here.restore(state_of(block_));
        block_.apply_constraint(points_.constraint(height));
    }
    if (!outwards_) {
        const double error = trail_.to(height, to.force).error / (now_.height - height);
        const bool far = 2.0 * error < 0.1 * std::abs(to.force - options_.load);
        stride_ = smooth && far ? std::min(2 * stride_, 4) : std::max(stride_ / 2, 1);
    }
    points_.accept(height);
    trail_.add(to.height, to.force);
    if (!outwards_) turned_trail_ = trail_;
    if (!smooth) trail_.begin(to.height, to.force);
    smooth_ = smooth;
    now_ = to;
    passed_.push_back(to);
    if (outwards_) {
        ++outward_points_;
        const bool beyond = (now_.height > passed_.front().height && now_.force < options_.load) ||
                            now_.height >= 0.0; // nothing is in reach
        if (joined() || beyond) turn_inwards();
    } else if (!smooth && lost > options_.least_loss * climb()) {
        turn_outwards();
    }
    if (!outwards_) end_ = end();
    return Outcome::point;
}

double StateSearch::climb() const {
    const auto enthalpy = [this](const Point& p) { return p.energy + options_.load * p.height; };
    double deepest = HUGE_VAL;
    for (const Point& p : passed_)
        deepest = std::min(deepest, enthalpy(p));
    return enthalpy(now_) - deepest;
}

/// Whether the search is over here. Collective.
StateList::End StateSearch::end() {
    const double left = options_.area * (1.0 - now_.contact);
    if (now_.force - options_.load > options_.largest_tension * left)
        return StateList::End::contact;
    if (none_deeper_further_in()) return StateList::End::energy;
    return StateList::End::none;
}

/// Sites not in contact, by their distances from the substrate: below 1, 2, ... bins. Within the
/// cutoff the nearest atom is that far away or further; beyond it, the cutoff is that much closer.
std::vector<std::int64_t> StateSearch::sites_by_distance() {
    if (below_.empty()) below_ = interface_.heights_below();
    const PlaneView<const double> z = block_.lowest_layer().z;
    std::vector<std::int64_t> sites(bins, 0);
    for (int y = 0; y < z.ny; ++y)
        for (int x = 0; x < z.nx; ++x) {
            const auto site = static_cast<std::size_t>(y) * static_cast<std::size_t>(z.nx) +
                              static_cast<std::size_t>(x);
            const double distance = options_.reference_height + z(x, y) - below_[site];
            ++sites[static_cast<std::size_t>(std::clamp(distance / bin, 0.0, bins - 1.0))];
        }
    block_.communicator().sum(sites);
    auto in_contact = static_cast<std::int64_t>(std::lround(now_.contact * sites_));
    for (std::int64_t& count : sites) {
        const std::int64_t touching = std::min(count, in_contact);
        count -= touching;
        in_contact -= touching;
    }
    return sites;
}

/// At a distance s: the most of -U(s - b) - k b^2 / 2 over the bulges b.
void StateSearch::tabulate_gain() {
    constexpr int finer = 5;
    constexpr double step = bin / finer;
    std::vector<double> depth(bins * finer); // -U, once it is on its way out
    double deepest = 0.0;
    for (int i = bins * finer; i-- > 1;) {
        depth[static_cast<std::size_t>(i)] = deepest =
            std::max(deepest, -options_.flat_energy(step * i));
    }
    depth[0] = std::max(deepest, options_.flat_depth);
    for (int i = 0; i < bins; ++i) {
        double most = 0.0;
        for (int j = 0; j <= finer * i; ++j) {
            const double bulge = step * (finer * i - j);
            most = std::max(most, depth[static_cast<std::size_t>(j)] -
                                      0.5 * options_.softest_wave * bulge * bulge);
        }
        gain_.push_back(most * options_.area / sites_);
    }
}

/// Whether the energy stays above the deepest point passed however much further in the block goes.
bool StateSearch::none_deeper_further_in() {
    if (!options_.flat_energy) return false;
    const double climbed = climb(), push = now_.force - options_.load;
    if (climbed <= 0.0 || push <= 0.0) return false;
    if (gain_.empty()) tabulate_gain();
    const double stiffness = std::max(0.0, -trail_.slope());
    const std::vector<std::int64_t> sites = sites_by_distance();
    for (int d = 0; d < bins; ++d) {
        double gain = 0.0;
        for (int i = 0; i < bins; ++i) {
            const int distance = std::max(i - d - 1, 0);
            gain += gain_[static_cast<std::size_t>(distance)] *
                    static_cast<double>(sites[static_cast<std::size_t>(i)]);
        }
        const double further = bin * d;
        if (climbed + (push + 0.5 * stiffness * further) * further <= gain) return false;
    }
    return true;
}

/// Inwards by the present step, outwards to the heights passed on the way inwards and beyond.
double StateSearch::next_height() const {
    if (!outwards_) return now_.height - stride_ * options_.step;
    double next = HUGE_VAL;
    for (const Point& p : passed_)
        if (p.branch == 0 && p.height > now_.height) next = std::min(next, p.height);
    return next < HUGE_VAL ? next : now_.height + options_.step;
}

/// Energy that is missing between the last point and this one, less what the work of the force may
/// be wrong by (a quarter of its bound: a point too much costs little), eV.
double StateSearch::missing(const Point& to) const {
    const ForceTrail::Integral work = trail_.to(to.height, to.force);
    return -work.value - (to.energy - now_.energy) - std::max(accuracy(), 0.25 * work.error);
}

/// The state between the last point and this one, where the block is. False where it was stopped.
bool StateSearch::relax_state(const Point& to, bool smooth) {
    if (smooth) {
        points_.retreat((to.force - options_.load) / (to.force - now_.force));
    } else if (outwards_) {
        points_.put_back(); // the point inside the instability
    }
    const auto state = options_.relax_free();
    if (state) add(*state);
    return state.has_value();
}

void StateSearch::add(const ZeroLoad& state) {
    const double energy = units::milli_per_unit * accuracy() / options_.area;
    for (const Found& old : found_)
        if (std::abs(old.state.mean_height - state.mean_height) < 0.5 * options_.step &&
            std::abs(old.state.binding_energy - state.binding_energy) < energy)
            return;
    found_.push_back({state, outwards_ ? static_cast<int>(instabilities_) : 0});
}

void StateSearch::turn_outwards() {
    turn_.take(state_of(block_));
    turned_at_ = now_;
    ++instabilities_;
    outward_points_ = 0;
    outwards_ = true;
}

void StateSearch::turn_inwards() {
    // A branch that joins the other after one step may have been none.
    const bool none = outward_points_ == 1 && joined();
    if (none) {
        --instabilities_;
        passed_.pop_back();
    }
    turn_.restore(state_of(block_));
    block_.apply_constraint(points_.constraint(turned_at_.height));
    points_.begin(turned_at_.height);
    now_ = turned_at_;
    trail_.begin(now_.height, now_.force);
    if (none) trail_ = turned_trail_;
    outwards_ = false;
    smooth_ = false;
}

/// The branch followed outwards has come to a point of the way inwards.
bool StateSearch::joined() const {
    return std::any_of(passed_.begin(), passed_.end(), [&](const Point& p) {
        return p.branch == 0 && p.height == now_.height &&
               std::abs(p.energy - now_.energy) <= accuracy();
    });
}

/// The innermost point of a branch that was followed outwards.
double StateSearch::inner_end(int branch) const {
    double inner = HUGE_VAL;
    for (const Point& p : passed_)
        if (p.branch == branch) inner = std::min(inner, p.height);
    return inner;
}

/// On the way from one state to the next: on the branch of the first to its inner end, and inwards
/// from there. A state on another branch that was followed outwards is reached through the
/// instability at the inner end of that, which can be further in than the state. Nothing where no
/// point that pushes lies on the way.
std::optional<double> StateSearch::largest_force(const Found& from, const Found& to) const {
    const double start = from.state.mean_height - options_.reference_height;
    double end = to.state.mean_height - options_.reference_height;
    if (to.branch != 0 && to.branch != from.branch) end = std::min(end, inner_end(to.branch));
    const double inner = inner_end(from.branch);
    double largest = 0.0;
    for (const Point& p : passed_)
        if (p.height < start && p.height >= end &&
            (p.branch == from.branch || (p.branch == 0 && p.height < inner)))
            largest = std::max(largest, p.force - options_.load);
    if (largest > 0.0) return largest;
    return std::nullopt;
}

void StateSearch::restore_first() {
    first_.restore(state_of(block_));
    block_.apply_constraint(Constraint::top(first_top_));
}

std::vector<StateArray> StateSearch::states() {
    const auto arrays = state_of(block_);
    std::vector<StateArray> list = points_.states();
    for (const auto& [copy, name] : {std::pair{&first_, "first_"}, std::pair{&turn_, "turn_"}}) {
        if (copy->empty()) copy->take(arrays);
        for (const StateArray& array : copy->arrays(arrays, name))
            list.push_back(array);
    }
    std::stable_sort(list.begin(), list.end(),
                     [](const StateArray& a, const StateArray& b) { return a.level < b.level; });
    return list;
}

StateList StateSearch::found() const {
    StateList list;
    std::vector<Found> states = found_;
    std::stable_sort(states.begin(), states.end(), [](const Found& a, const Found& b) {
        return a.state.mean_height > b.state.mean_height;
    });
    // A branch followed outwards may have led beyond the state that the search started in.
    if (!found_.empty())
        list.first = static_cast<std::size_t>(
            std::count_if(found_.begin(), found_.end(), [this](const Found& f) {
                return f.state.mean_height > found_.front().state.mean_height;
            }));
    for (std::size_t i = 0; i < states.size(); ++i) {
        list.all.push_back({states[i].state, std::nullopt});
        if (i + 1 == states.size()) continue;
        if (const auto force = largest_force(states[i], states[i + 1]))
            list.all.back().barrier = *force / options_.area;
    }
    list.step = options_.step;
    list.points = static_cast<long long>(passed_.size());
    list.instabilities = instabilities_;
    for (const Point& p : passed_)
        list.innermost = std::min(list.innermost, options_.reference_height + p.height);
    list.end = end_;
    return list;
}

} // namespace asperity
