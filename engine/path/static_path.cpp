// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/path/static_path.hpp"

#include "engine/units.hpp"

#include <fmt/format.h>

#include <utility>

namespace asperity {

StaticPath::StaticPath(const Case& c, const Surface& surface, const Communicator& ranks)
    : Path(c, surface), grid_(c.grid(ranks.rank())),
      interface_(surface, grid_.tile(0), c.simulation.block.spacing, c.simulation.interface),
      block_(c.simulation.block, ranks, !c.effects.lateral) {
    nowhere_.mean_height = interface_.start_height();
}

Constraint::Of StaticPath::held_of(const Case& c) {
    return c.simulation.drive.control == Control::top ? Constraint::Of::top
                                                 : Constraint::Of::mean_height;
}

void StaticPath::make_points(Constraint::Of held) {
    PathOptions options =
        path_options(case_, interface_, [this](long long iteration, double residual) {
            return told(iteration, residual);
        });
    options.along = held;
    points_.emplace(block_, interface_, std::move(options));
}

Path::Made StaticPath::advance(const Wish&) {
    const long long before = now().step;
    const bool first = segment_ == 0;
    const bool from_state = !first && case_.path()[segment_ - 1].kind == Segment::relax;
    if (!begun_) {
        if (first || from_state) make_points(held_of(case_));
        if (first) points_->start();
        if (from_state) points_->start_here({.from_apart = true});
        points_->begin(case_.path()[segment_], segment_);
        begun_ = true;
        if (first || from_state) return Made::step;
    }
    const QuasistaticPath::Outcome outcome = points_->advance();
    if (outcome == QuasistaticPath::Outcome::interrupted) return Made::interrupted;
    at_end_ = outcome != QuasistaticPath::Outcome::point;
    results_.dissipated = points_->dissipation();
    if (now().step == before) return Made::nothing;
    results_.record_force(case_.path()[segment_], now());
    return Made::step;
}

std::optional<std::size_t> StaticPath::ended() const {
    if (!done() && (at_end_ || kind() == Segment::relax)) return segment_;
    return std::nullopt;
}

std::optional<LayerAtRest> StaticPath::find_state() {
    const bool held = kind() != Segment::relax;
    if (held) points_->put_back(); // the same state as after a resume, bitwise
    const std::optional<ZeroLoad> found = state_from_here(
        held ? 0.0 : case_.simulation.drive.load_force, !held && !std::exchange(resumed_, false));
    LayerAtRest state;
    if (found) {
        // A path that starts in a state comes back to another; its numbers are of the first.
        if (!results_.zero_load || !case_.starts_with(Segment::relax)) results_.zero_load = found;
        state.numbers = found;
        state.layer = VectorField<double>(grid_.tile(0), 1);
        copy_layer(layer(), state.layer.plane(0));
    }
    if (held) points_->put_back();
    if (!found) return std::nullopt;
    return state;
}

std::optional<ZeroLoad> StaticPath::state_from_here(double load, bool from_afar) {
    if (from_afar) {
        const double height = height_of_strongest_attraction(
            block_, interface_, surface_.statistics.lowest, case_.scales.length,
            case_.tolerance * surface_.sites * surface_.sites);
        block_.set_uniform(height - reference_height());
    }
    return find_zero_load(
        block_, interface_, reference_height(), load, case_,
        [this](long long iteration, double residual) { return told(iteration, residual); });
}

void StaticPath::conclude() {
    if (kind() != Segment::relax) {
        const bool slide = kind() == Segment::slide;
        Works works{.on_solids = points_->work(),
                    .lateral = slide ? points_->work() : 0.0,
                    .relaxed = points_->relaxed(),
                    .lost = points_->dissipation().in_segment,
                    .stored = points_->stored(),
                    .interface = {},
                    .uncertainty = points_->uncertainty()};
        // A held mean height does not jump: the holder's force is that of the interface.
        if (case_.simulation.drive.control == Control::mean_height)
            works.interface = slide ? 0.0 : -points_->work();
        ledger_.conclude(segment_, now(), works, {});
    }
    ++segment_;
    begun_ = at_end_ = resumed_ = false;
}

std::string StaticPath::position() const {
    return points_ ? fmt::format("point {}", now().step) : "an unfinished relaxation";
}

std::optional<long long> StaticPath::iterations() const {
    return points_ ? std::optional(points_->iterations()) : std::nullopt;
}

Path::Remedy StaticPath::remedy() const {
    return {"steps that are too long or instabilities that were not resolved miss energy, and what "
            "they miss adds up",
            "take a smaller drive.displacement_step"};
}

// ---- Checkpoints.

std::vector<StateArray> StaticPath::arrays() {
    return points_ ? points_->states() : state_of(block_);
}

void StaticPath::restored() {
    if (points_)
        points_->resume();
    else
        block_.hold(Constraint::top(top_restored_));
    if (points_) results_.dissipated = points_->dissipation();
    resumed_ = true;
}

// ---- By hand.

void StaticPath::begin_by_hand(Constraint::Of held, std::optional<bool> remembers) {
    make_points(held);
    if (!remembers) return points_->start();
    try {
        points_->start_here({.remembers = *remembers});
    } catch (const io::PhysicsError&) {
        points_.reset();
        throw;
    }
}

StaticPath::KeptPoint StaticPath::keep_point() {
    KeptPoint kept;
    kept.fields.take(points_->states());
    CollectNumbers collect;
    collect("points", *points_);
    kept.numbers = std::move(collect.numbers);
    return kept;
}

void StaticPath::back_to(const KeptPoint& point) {
    point.fields.restore(points_->states());
    RestoreNumbers restore(point.numbers);
    restore("points", *points_);
    points_->resume();
}

bool StaticPath::lead_to(double at, const std::function<void()>& look) {
    points_->begin_to(at);
    return lead(look);
}

bool StaticPath::lead(const Segment& segment, const std::function<void()>& look) {
    points_->begin(segment);
    return lead(look);
}

bool StaticPath::lead(const std::function<void()>& look) {
    using Outcome = QuasistaticPath::Outcome;
    for (auto outcome = Outcome::point; outcome == Outcome::point;) {
        outcome = points_->advance();
        if (outcome == Outcome::interrupted) return false;
        look();
    }
    return true;
}

} // namespace asperity
