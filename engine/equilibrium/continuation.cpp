// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/continuation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity {

SequenceOptions sequence_options(const Case& c, const Interface& interface,
                                 std::function<bool(long long, double)> report) {
    SequenceOptions o;
    o.step = std::min(c.scene.drive.step, c.longest_step);
    o.tolerance = c.tolerance;
    o.scales = c.scales;
    o.load = c.simulation.drive.load_force;
    o.reference_height = interface.start_height();
    o.report = std::move(report);
    return o;
}

double Continuation::lead(Along along) {
    if (along == along_) return at_;
    along_ = along;
    at_ = along == Along::z ? normal_ : place_[static_cast<std::size_t>(along)];
    before_at_ = at_; // nothing is known along it
    return at_;
}

void Continuation::begin(double at) {
    last_.take(state_of(block_));
    at_ = before_at_ = normal_ = at;
}

/// Over the substrate, with the coordinate there.
void Continuation::place_block(double at) {
    std::array<double, 2> place = place_;
    if (along_ != Along::z) place[static_cast<std::size_t>(along_)] = at;
    interface_.slide_to(place[0], place[1]);
}

void Continuation::accept(double at) {
    moved_ = largest_move().value;
    std::swap(before_, last_);
    last_.take(state_of(block_));
    before_at_ = std::exchange(at_, at);
    if (along_ == Along::z) normal_ = at;
    place_ = interface_.place();
}

void Continuation::put_back() {
    last_.restore(state_of(block_));
    block_.apply_constraint(constraint(at_));
    place_block(at_);
}

bool Continuation::predicts(double at) const {
    constexpr double furthest = 0.58; // ranges, out of which a site in contact still comes back
    return at_ != before_at_ &&
           std::abs((at - at_) / (at_ - before_at_)) * moved_ <= furthest * options_.scales.length;
}

RelaxedState Continuation::relax_at(double at, bool predicted, const Report& report,
                                    const ForceWindow& window) {
    const auto arrays = state_of(block_);
    last_.restore(arrays);
    place_block(at);
    RelaxOptions options;
    options.start = predicted ? Start::predicted : Start::near;
    if (predicted) before_.extrapolate((at - at_) / (at_ - before_at_), arrays);
    options.tolerance = options_.tolerance;
    options.scales = options_.scales;
    options.balance = balance_;
    options.report = report;
    options.force_window = window;
    const RelaxedState state =
        relax(block_, interface_, options_.reference_height, constraint(at), options, phases_);
    iterations_ += state.iterations;
    return state;
}

std::function<double(int, int)> Continuation::moves() const {
    const auto layer = block_.lowest_layer();
    const VectorPlane<const double> old = {last_[0].plane(0), last_[1].plane(0), last_[2].plane(0)};
    return [=](int x, int y) {
        return std::hypot(layer.x(x, y) - old.x(x, y), layer.y(x, y) - old.y(x, y),
                          layer.z(x, y) - old.z(x, y));
    };
}

std::vector<StateArray> Continuation::states() {
    const auto arrays = state_of(block_);
    if (last_.empty()) last_.take(arrays);
    if (before_.empty()) before_.take(arrays);
    std::vector<StateArray> list = last_.arrays(arrays, "");
    for (const StateArray& array : before_.arrays(arrays, "previous_"))
        list.push_back(array);
    std::stable_sort(list.begin(), list.end(),
                     [](const StateArray& a, const StateArray& b) { return a.level < b.level; });
    return list;
}

} // namespace asperity
