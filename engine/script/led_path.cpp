// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/script/led_path.hpp"

#include "engine/path/guard.hpp"
#include "engine/plan/plan.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace asperity {

namespace {

[[noreturn]] void refuse(const char* where, std::string what, std::string why, std::string fix) {
    throw io::SceneError(io::Problem{where, std::move(what), std::move(why), std::move(fix)});
}

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
    : case_(quasistatic(c)), surface_(checked_surface(case_)),
      path_(case_, surface_, Communicator()) {
    before_.mean_height = path_.reference_height();
}

void LedPath::set_mean_height(double z) { go_to(Held::mean_height, z); }
void LedPath::set_top(double z) { go_to(Held::top, z); }

void LedPath::go_to(Held held, double at) {
    require_number(at);
    hold(held);
    target_ = {.at = held == Held::top ? at : at - path_.reference_height()};
}

void LedPath::set_load(double pressure) {
    require_number(pressure);
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

/// Calls work, gives up when look throws, and then rethrows: the path is at its last point.
template <class Work>
auto LedPath::while_looking(const Look& look, const Work& work) {
    LookNowAndThen now_and_then(look);
    std::exception_ptr thrown;
    const auto told = [&](long long, double) {
        try {
            now_and_then();
        } catch (...) {
            thrown = std::current_exception();
        }
        return thrown != nullptr;
    };
    auto done = path_.while_watched(told, work);
    if (!done) std::rethrow_exception(thrown);
    return done;
}

LedPath::Point LedPath::relax(const Look& look) {
    begin();
    if (!target_.at && !target_.load && !target_.hold) return now();
    const double until = path_.now().time + target_.hold.value_or(0.0);
    const auto at_point = [&] {
        if (target_.hold) target_.hold = until - path_.now().time;
        guard(path_);
    };
    const StaticPath::KeptPoint from = path_.keep_point();
    try { // a target is kept where look throws
        while_looking(look, [&] {
            if (target_.at) return path_.lead_to(*target_.at, at_point);
            if (target_.hold) return path_.lead({Segment::hold, *target_.hold}, at_point);
            return path_.lead({Segment::load, *target_.load}, at_point);
        });
    } catch (const io::PhysicsError&) { // the target cannot be reached: the last point is restored
        target_ = {};
        path_.back_to(from);
        throw;
    }
    target_ = {};
    return now();
}

LedPath::Point LedPath::now() const {
    const QuasistaticPath* points = path_.points();
    if (!points) return before_;
    Point p{points->now()};
    if (*held_ != Held::top) p.top = 0.0;
    const double edge = case_.simulation.block.sites, sites = edge * edge;
    p.instabilities = points->dissipation().events;
    p.contact_fraction = static_cast<double>(p.in_contact) / sites;
    p.repulsive_fraction = static_cast<double>(p.repulsive) / sites;
    return p;
}

InterfaceMaps LedPath::maps() const {
    return path_.interface().maps(path_.layer(), path_.reference_height());
}

RestState LedPath::release(const Look& look) {
    const State from = copy();
    try {
        const std::optional<ZeroLoad> found = while_looking(look, [&] {
            return path_.state_from_here(case_.simulation.drive.load_force,
                                         !path_.points() && !remembers_);
        });
        State there = copy();
        there.branches.clear();
        place(there);
        return {*found, maps()};
    } catch (...) {
        place(from);
        throw;
    }
}

LedPath::State LedPath::copy() const {
    State state{case_.simulation.block.sites, {}, path_.block().top()};
    const auto keep = [](const PlaneView<const double>& plane, std::vector<double>& to) {
        for (int y = 0; y < plane.ny; ++y)
            to.insert(to.end(), plane.line(y), plane.line(y) + plane.nx);
    };
    const VectorPlane<const double> layer = path_.layer();
    for (const auto& plane : {layer.x, layer.y, layer.z})
        keep(plane, state.u);
    if (const auto* memory = path_.block().memory())
        for (const SiteField<double>& branch : *memory)
            for (const Field<double>& component : branch)
                keep(component.plane(0), state.branches);
    return state;
}

void LedPath::restore(const State& state) {
    const int sites = case_.simulation.block.sites;
    if (state.sites != sites)
        refuse("restore", fmt::format("of a state of {0} x {0} sites", state.sites),
               fmt::format("the scene has {0} x {0}", sites), "give a state of this scene");
    std::size_t extensions = 0;
    if (const auto* memory = path_.block().memory())
        for (const SiteField<double>& branch : *memory)
            extensions += branch.size() * state.u.size() / 3;
    if (!state.branches.empty() && state.branches.size() != extensions)
        refuse("restore", "of a state with other branches", "the scene has another block.prony",
               "give a state of this scene, or asperity.State(u, top), which has relaxed");
    if (!std::all_of(state.u.begin(), state.u.end(), [](double u) { return std::isfinite(u); }) ||
        !std::isfinite(state.top))
        refuse("restore", "of displacements that are no numbers", "no state follows from them",
               "write numbers there");
    place(state);
}

/// Puts the block into a state; a new path is to begin.
void LedPath::place(const State& state) {
    before_ = now();
    path_.end_points();
    target_ = {};
    remembers_ = !state.branches.empty();
    const VectorPlane<double> layer = path_.block().layer().plane(0);
    auto from = state.u.begin();
    for (const auto& plane : {layer.x, layer.y, layer.z})
        for (int y = 0; y < plane.ny; ++y, from += plane.nx)
            std::copy_n(from, plane.nx, plane.line(y));
    auto extension = state.branches.begin();
    if (auto* memory = path_.block().memory())
        for (SiteField<double>& branch : *memory)
            for (Field<double>& component : branch) {
                const PlaneView<double> plane = component.plane(0);
                for (int y = 0; y < plane.ny; ++y)
                    for (int x = 0; x < plane.nx; ++x)
                        plane(x, y) = state.branches.empty() ? 0.0 : *extension++;
            }
    path_.block().hold(Constraint::top(state.top));
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
    if (path_.points()) return;
    hold(held_.value_or(case_.simulation.drive.control == Control::top ? Held::top
                                                                       : Held::mean_height));
    path_.begin_by_hand(*held_, remembers_);
}

} // namespace asperity
