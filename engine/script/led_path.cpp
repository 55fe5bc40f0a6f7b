// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/script/led_path.hpp"

#include "engine/case/resolving.hpp"
#include "engine/path/checkpoint.hpp"
#include "engine/path/guard.hpp"
#include "engine/path/static_path.hpp"
#include "engine/plan/plan.hpp"
#include "engine/script/refuse.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

namespace asperity {

namespace {

void require_number(double value) {
    if (!std::isfinite(value))
        refuse("Statics", fmt::format("cannot go to {}", value), "that is no number",
               "give a length in Å or a load in MPa");
}

const char* name(Constraint::Of held) {
    return held == Constraint::Of::top ? "the top plane" : "the mean height";
}

/// Returns the case of the same solids, quasi-static.
Case quasistatic(const Case& c) {
    if (c.ranks != 1)
        refuse("Statics", fmt::format("on {} ranks", c.ranks),
               "it is one process, on all its threads",
               "start it without mpirun; runs take ranks (asperity.run)");
    if (!c.effects.dynamic) return c;
    Scene scene = c.scene;
    scene.drive.mode = DriveMode::quasistatic;
    return resolve(scene);
}

Surface checked_surface(const Case& c) {
    require_memory(c, Communicator());
    return surface_of(c);
}

} // namespace

LedPath::LedPath(const Case& c)
    : case_(quasistatic(c)), surface_(checked_surface(case_)), grid_(case_.grid(0)),
      interface_(surface_, grid_.tile(0), case_.simulation.block.spacing,
                 case_.simulation.interface),
      block_(case_.simulation.block, Communicator(), !case_.effects.lateral) {
    remember_sites(block_, interface_);
    before_.mean_height = interface_.reference_height();
}

void LedPath::set_mean_height(double z) { go_to(Held::mean_height, z); }
void LedPath::set_top(double z) { go_to(Held::top, z); }

void LedPath::go_to(Held held, double at) {
    require_number(at);
    hold(held);
    const double from = held == Held::top ? now().top : now().mean_height;
    if (const auto problem = way_out_of_proportion(case_, at - from))
        refuse("Statics", fmt::format("{} Å {}", at, problem->what), problem->why, problem->fix);
    target_ = {.at = held == Held::top ? at : at - interface_.reference_height()};
}

void LedPath::set_load(double pressure) {
    require_number(pressure);
    if (const auto problem = load_out_of_proportion(case_, pressure))
        refuse("Statics", fmt::format("a load of {} MPa {}", pressure, problem->what), problem->why,
               problem->fix);
    target_ = {.load = pressure * units::megapascal * case_.area()};
}

void LedPath::set_hold(double time) {
    if (!case_.effects.branches)
        refuse(
            "hold", "has no effect on this block",
            "it does not relax, so that force balance does not change with time",
            case_.simulation.block.branches.empty()
                ? "give the block branches (block.prony)"
                : "take drive.path = [\"approach\"] in the scene: of one relaxation the state is "
                  "the relaxed one");
    if (!(time > 0.0) || !std::isfinite(time))
        refuse("hold", fmt::format("for {} ps", time), "a time is above 0 ps", "give one");
    target_ = {.hold = time * units::picosecond};
}

namespace {

/// Installs a watch of relaxations as long as it lives, which calls a Look now and then, and stops
/// the relaxation if the Look throws.
class Looking {
public:
    Looking(std::function<bool(long long, double)>& watch, const Look& look)
        : watch_(watch), throttled_look_(look) {
        watch_ = [this](long long, double) {
            try {
                throttled_look_();
            } catch (...) {
                thrown_ = std::current_exception();
            }
            return thrown_ != nullptr;
        };
    }
    ~Looking() { watch_ = {}; }
    Looking(const Looking&) = delete;
    Looking& operator=(const Looking&) = delete;
    /// Throws the exception of the Look again: the state is the last whole one.
    [[noreturn]] void rethrow() const { std::rethrow_exception(thrown_); }

private:
    std::function<bool(long long, double)>& watch_;
    ThrottledLook throttled_look_;
    std::exception_ptr thrown_;
};

} // namespace

LedPath::Point LedPath::relax(const Look& look) {
    begin();
    if (!target_.at && !target_.load && !target_.hold) return now();
    Snapshot from;
    from.take(*points_);
    try { // a target is kept where look throws
        lead_to_goal(look);
    } catch (const io::PhysicsError&) { // the target cannot be reached: the last point is restored
        target_ = {};
        from.restore(*points_);
        throw;
    }
    target_ = {};
    return now();
}

/// Leads the block to the goal, point by point.
void LedPath::lead_to_goal(const Look& look) {
    const double until = points_->now().time + target_.hold.value_or(0.0);
    if (target_.at)
        points_->begin_to(*target_.at);
    else if (target_.hold)
        points_->begin({Segment::hold, *target_.hold});
    else
        points_->begin({Segment::load, *target_.load});
    const Looking looking(watch_, look);
    using Outcome = QuasistaticPath::Outcome;
    for (auto outcome = Outcome::point; outcome == Outcome::point;) {
        outcome = points_->advance();
        if (outcome == Outcome::interrupted) looking.rethrow();
        if (target_.hold) target_.hold = until - points_->now().time;
        if (const auto wrong = violation(points_->now(), case_, surface_)) {
            const Path::Remedy remedy = StaticPath::remedy_of_points();
            throw io::PhysicsError(*wrong, remedy.why, remedy.fix);
        }
    }
}

LedPath::Point LedPath::now() const {
    if (!points_) return before_;
    Point p{points_->now()};
    if (*held_ != Held::top) p.top = 0.0;
    p.instabilities = points_->dissipation().events;
    p.contact_fraction = case_.fraction(p.in_contact);
    p.repulsive_fraction = case_.fraction(p.repulsive);
    return p;
}

InterfaceMaps LedPath::maps() const {
    block_.workspace()->free_kept();
    InterfaceMaps maps = interface_.maps(block_.lowest_layer());
    maps.crop(interface_.sites_across());
    return maps;
}

RestState LedPath::release(const Look& look) {
    const State from = copy();
    try {
        if (!points_ && !remembers_) place_for_relaxation(block_, interface_, surface_, case_);
        const Looking looking(watch_, look);
        const std::optional<ZeroLoad> found =
            find_zero_load(block_, interface_, case_.simulation.drive.load_force, case_, watch_);
        if (!found) looking.rethrow();
        const bool remembers = any_stays_at_rest(block_.memories());
        if (remembers) block_.end_step();
        State there = copy();
        if (!remembers) there.values.resize(there.displacements());
        place(there);
        return {*found, maps()};
    } catch (...) {
        place(from);
        throw;
    }
}

/// Returns the arrays of a state: the displacements, and what the block remembers.
std::vector<RestoredArray> LedPath::arrays() {
    std::vector<RestoredArray> list = state_to_restore(block_);
    for (const std::unique_ptr<Memory>& memory : block_.memories())
        list = joined(std::move(list), memory->arrays());
    return list;
}

LedPath::State LedPath::copy() {
    State state{case_.simulation.block.grid(), block_.drive(), {}};
    for (const RestoredArray& array : arrays()) {
        const PlaneView<const double> plane = std::as_const(*array.field).plane(0);
        for (int y = 0; y < plane.ny; ++y)
            state.values.insert(state.values.end(), plane.line(y), plane.line(y) + plane.nx);
    }
    return state;
}

void LedPath::restore(const State& state) {
    const int sites = case_.simulation.block.grid();
    if (state.sites != sites)
        refuse("restore", fmt::format("of a state of {0} x {0} sites", state.sites),
               fmt::format("the scene has {0} x {0}", sites), "give a state of this scene");
    if (state.remembers() &&
        state.values.size() != arrays().size() * std::size_t(sites) * std::size_t(sites))
        refuse("restore", "of a state with other branches", "the scene has another block.prony",
               "give a state of this scene, or asperity.State(u, top), which has relaxed");
    const auto is_number = [](double value) { return std::isfinite(value); };
    if (!std::all_of(state.values.begin(), state.values.end(), is_number) || !is_number(state.top))
        refuse("restore", "of displacements that are no numbers", "no state follows from them",
               "write numbers there");
    place(state);
}

/// Puts the block into a state; a new path is to begin.
void LedPath::place(const State& state) {
    before_ = now();
    points_.reset();
    target_ = {};
    remembers_ = state.remembers();
    auto from = state.values.begin();
    for (const RestoredArray& array : arrays()) {
        const PlaneView<double> plane = array.field->plane(0);
        const bool given = from != state.values.end();
        for (int y = 0; y < plane.ny; ++y) {
            if (!given) {
                std::fill_n(plane.line(y), plane.nx, 0.0);
                continue;
            }
            std::copy_n(from, plane.nx, plane.line(y));
            from += plane.nx;
        }
    }
    block_.hold(Constraint::top(state.top));
}

void LedPath::hold(Held held) {
    if (held_ && *held_ != held)
        refuse("Statics", fmt::format("holds {}", name(*held_)),
               fmt::format("{} cannot be held on the same path", name(held)),
               "begin another Statics for it");
    held_ = held;
}

/// Begins the path unless it has begun.
void LedPath::begin() {
    if (points_) return;
    hold(held_.value_or(case_.simulation.drive.control == Control::top ? Held::top
                                                                       : Held::mean_height));
    PathOptions options =
        path_options(case_, interface_, [this](long long iteration, double residual) {
            return watch_ && watch_(iteration, residual);
        });
    options.along = *held_;
    points_.emplace(block_, interface_, std::move(options));
    if (!remembers_) return points_->start();
    try {
        points_->start_here({.remembers = *remembers_});
    } catch (const io::PhysicsError&) {
        points_.reset();
        throw;
    }
}

} // namespace asperity
