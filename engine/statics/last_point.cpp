// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/statics/last_point.hpp"

#include "decomposition/global_sum.hpp"
#include "engine/waves/moving_pattern.hpp"

#include <algorithm>

namespace asperity {

double LastPoint::select(Along along) {
    if (along == along_) return at_;
    along_ = along;
    at_ = along == Along::z      ? normal_
          : along == Along::time ? clock_
                                 : place_[static_cast<std::size_t>(along)];
    return at_;
}

/// Moves the block over the substrate to the place with this coordinate.
void LastPoint::place_block(double at) {
    std::array<double, 2> place = place_;
    if (along_ == Along::x || along_ == Along::y) place[static_cast<std::size_t>(along_)] = at;
    interface_.slide_to(place[0], place[1]);
}

void LastPoint::accept(double at) {
    state_.take(state_of(block_));
    block_.end_step();
    last_dt_ = dt_ > 0.0 ? dt_ : units::forever;
    at_ = at;
    if (along_ == Along::z) normal_ = at;
    if (along_ == Along::time) clock_ = at;
    if (load_)
        normal_ = options_.along == Constraint::Of::top ? block_.drive() : block_.mean_height();
    place_ = interface_.place();
}

void LastPoint::put_back() {
    state_.restore(state_to_restore(block_));
    block_.hold(constraint(at_));
    place_block(at_);
}

RelaxedState LastPoint::relax_at(double at, double dt, const Report& report,
                                 const ForceWindow& window) {
    state_.restore(state_to_restore(block_));
    block_.constrain(constraint(at_));
    block_.begin_step(dt, last_dt_);
    dt_ = dt;
    place_block(at);
    // A wall takes the displacements along.
    const std::array<double, 2>& place = interface_.place();
    if (interface_.wall() && place != place_)
        block_.shift_displacements(place[0] - place_[0], place[1] - place_[1]);
    RelaxOptions options = relax_options(report);
    options.force_window = window;
    const RelaxedState state = relax(block_, interface_, constraint(at), options, phases_);
    iterations_ += state.iterations;
    return state;
}

RelaxOptions LastPoint::relax_options(const Report& report) const {
    RelaxOptions options;
    options.start = Start::near;
    options.tolerance = options_.tolerance;
    options.scales = options_.scales;
    options.balance = balance_;
    options.report = report;
    return options;
}

RelaxedState LastPoint::settle(double velocity, const Report& report) {
    // Turns come nearer by a factor each. Where sites jump to and fro there is no end: the slide
    // then begins from where they are.
    constexpr int most_turns = 200;
    constexpr double loosest = 100.0, closer = 0.1;
    state_.restore(state_to_restore(block_)); // the same bits after a resume
    block_.hold(constraint(at_));
    const MovingPattern pattern(block_.options(), along_ == Along::y ? 1 : 0, velocity);
    RelaxOptions options = relax_options(report);
    const double enough = options_.tolerance;
    for (int turn = 0; turn < most_turns; ++turn) {
        const double left = block_.begin_turn(pattern);
        if (left <= enough) break;
        options.tolerance = std::clamp(closer * left, enough, loosest * enough);
        const RelaxedState state = relax(block_, interface_, constraint(at_), options, phases_);
        iterations_ += state.iterations;
        if (state.interrupted) {
            block_.begin_step(0.0);
            put_back();
            return state;
        }
        if (!state.converged) break;
    }
    block_.settle_branches();
    block_.begin_step(0.0);
    state_.take(state_of(block_));
    block_.end_step();
    return relax_at(at_, 0.0, {});
}

std::function<double(int, int)> LastPoint::moves() const {
    const auto layer = block_.lowest_layer();
    const VectorPlane<const double> old = {state_[0].plane(0), state_[1].plane(0),
                                           state_[2].plane(0)};
    const int across = interface_.sites_across(), first = interface_.tile().y0;
    return [=](int x, int y) {
        if (x >= across || first + y >= across) return 0.0; // beside the substrate
        return std::hypot(layer.x(x, y) - old.x(x, y), layer.y(x, y) - old.y(x, y),
                          layer.z(x, y) - old.z(x, y));
    };
}

std::int64_t LastPoint::sites_moved() const {
    const double far = 0.5 * largest_move().value;
    const auto moved = moves();
    const auto layer = block_.lowest_layer();
    std::array<std::int64_t, 1> count = {0};
    for (int y = 0; y < layer.x.ny; ++y)
        for (int x = 0; x < layer.x.nx; ++x)
            count[0] += moved(x, y) > far;
    block_.communicator().sum(count);
    return count[0];
}

double LastPoint::all_moves() const {
    const auto moved = moves();
    const auto layer = block_.lowest_layer();
    ExactSum sum;
    for (int y = 0; y < layer.x.ny; ++y) {
        for (int x = 0; x < layer.x.nx; ++x)
            sum.add(moved(x, y));
        sum.carry();
    }
    return global_sum(block_.communicator(), sum);
}

std::vector<StateArray> LastPoint::arrays() const {
    std::vector<StateArray> list = state_.arrays(state_of(block_));
    for (const RestoredArray& array : arrays_of_memories())
        list.push_back(array);
    return list;
}

std::vector<RestoredArray> LastPoint::arrays_to_restore() {
    const std::vector<StateArray> displacements = state_of(block_);
    if (state_.empty()) state_.take(displacements);
    std::vector<RestoredArray> list = state_.arrays_to_restore(displacements);
    for (const RestoredArray& array : arrays_of_memories())
        list.push_back(array);
    return list;
}

std::vector<RestoredArray> LastPoint::arrays_of_memories() const {
    std::vector<RestoredArray> list;
    for (const std::unique_ptr<Memory>& memory : block_.memories())
        for (const std::vector<RestoredArray>& arrays :
             {memory->arrays(), memory->arrays_of_last_step()})
            list.insert(list.end(), arrays.begin(), arrays.end());
    return list;
}

} // namespace asperity
