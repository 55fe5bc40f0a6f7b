// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/static_path.hpp"

#include "engine/equilibrium/zero_load.hpp"
#include "engine/run/guard.hpp"
#include "engine/run/plan.hpp"
#include "engine/units.hpp"
#include "io/units.hpp"

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
        refuse("Statics", fmt::format("is led to {}", value), "that is no number", "give one");
}

const char* name(Constraint::Of held) {
    return held == Constraint::Of::top ? "the top plane" : "the mean height";
}

/// The same solids on a quasi-static path.
Case without_time(const Case& c) {
    if (c.ranks != 1)
        refuse("Statics", fmt::format("on {} ranks", c.ranks),
               "it is one process, on all its threads",
               "start it without mpirun; runs take ranks (asperity.run)");
    if (!c.in_time) return c;
    Scene scene = c.scene;
    scene.drive.mode = DriveMode::quasistatic;
    return resolve(scene);
}

Surface checked_surface(const Case& c) {
    c.require_runnable();
    require_memory(c, Communicator());
    return surface_of(c);
}

} // namespace

StaticPath::StaticPath(const Case& c)
    : case_(without_time(c)), surface_(checked_surface(case_)),
      interface_(surface_, case_.grid(0).tile(0), case_.scene.surface.spacing,
                 case_.simulation.interface),
      block_(case_.simulation.block, Communicator(), case_.scene.interface.frictionless) {
    before_.mean_height = interface_.start_height();
}

void StaticPath::set_mean_height(double z) { go_to(Held::mean_height, z); }
void StaticPath::set_top(double z) { go_to(Held::top, z); }

void StaticPath::go_to(Held held, double at) {
    require_number(at);
    hold(held);
    target_ = {.at = held == Held::top ? at : at - interface_.start_height()};
}

void StaticPath::set_load(double pressure) {
    require_number(pressure);
    target_ = {.load = pressure * units::megapascal * case_.area()};
}

void StaticPath::set_load(const std::string& pressure) {
    const io::ParsedQuantity parsed = io::parse_quantity(pressure, "MPa");
    if (!parsed.why.empty())
        refuse("load", fmt::format("= \"{}\"", pressure), parsed.why, parsed.fix);
    set_load(parsed.value);
}

StaticPath::Point StaticPath::relax(const Look& look) {
    LookNowAndThen now_and_then(look);
    looking_ = &now_and_then;
    begin();
    if (!target_.at && !target_.load) return now();
    try {
        lead();
    } catch (const io::PhysicsError&) { // it cannot be reached
        target_ = {};
        throw;
    }
    target_ = {};
    return now();
}

StaticPath::Point StaticPath::now() const {
    if (!path_) return before_;
    Point p{path_->now()};
    if (*held_ != Held::top) p.top = 0.0;
    const double sites = static_cast<double>(surface_.sites) * surface_.sites;
    p.instabilities = path_->dissipation().events;
    p.contact_fraction = static_cast<double>(p.in_contact) / sites;
    p.repulsive_fraction = static_cast<double>(p.repulsive) / sites;
    return p;
}

InterfaceMaps StaticPath::maps() const {
    return interface_.maps(block_.lowest_layer(), interface_.start_height());
}

RestState StaticPath::release(const Look& look) {
    LookNowAndThen now_and_then(look);
    looking_ = &now_and_then;
    const State from = copy();
    std::optional<ZeroLoad> found;
    try {
        if (!path_ && !placed_) {
            const double height = height_of_strongest_attraction(
                block_, interface_, surface_.statistics.lowest, case_.scales.length);
            block_.set_uniform(height - interface_.start_height());
        }
        found = find_zero_load(block_, interface_, interface_.start_height(),
                               case_.simulation.drive.load_force, case_,
                               [this](long long, double) { return interrupts(); });
    } catch (const io::PhysicsError&) {
        place(from);
        throw;
    }
    if (!found) {
        place(from);
        std::rethrow_exception(std::exchange(thrown_, nullptr));
    }
    place(copy());
    return {*found, maps()};
}

StaticPath::State StaticPath::copy() const {
    State state{surface_.sites, {}, block_.top()};
    const VectorPlane<const double> layer = block_.lowest_layer();
    for (const auto& plane : {layer.x, layer.y, layer.z})
        for (int y = 0; y < plane.ny; ++y)
            state.u.insert(state.u.end(), plane.line(y), plane.line(y) + plane.nx);
    return state;
}

void StaticPath::restore(const State& state) {
    if (state.sites != surface_.sites)
        refuse("restore", fmt::format("of a state of {0} x {0} sites", state.sites),
               fmt::format("the scene has {0} x {0}", surface_.sites),
               "give a state of this scene");
    if (!std::all_of(state.u.begin(), state.u.end(), [](double u) { return std::isfinite(u); }) ||
        !std::isfinite(state.top))
        refuse("restore", "of displacements that are no numbers", "no state follows from them",
               "write numbers there");
    place(state);
}

/// The block there; a new path is to begin.
void StaticPath::place(const State& state) {
    before_ = now();
    path_.reset();
    target_ = {};
    placed_ = true;
    const VectorPlane<double> layer = block_.layer().plane(0);
    auto from = state.u.begin();
    for (const auto& plane : {layer.x, layer.y, layer.z})
        for (int y = 0; y < plane.ny; ++y, from += plane.nx)
            std::copy_n(from, plane.nx, plane.line(y));
    block_.apply_constraint(Constraint::top(state.top));
}

void StaticPath::hold(Held held) {
    if (held_ && *held_ != held)
        refuse("Statics", fmt::format("holds {}", name(*held_)),
               fmt::format("{} cannot be held on the same path", name(held)),
               "begin another Statics for it");
    held_ = held;
}

/// The path, if it has not begun.
void StaticPath::begin() {
    if (path_) return;
    hold(held_.value_or(case_.scene.drive.control == Control::top ? Held::top : Held::mean_height));
    PathOptions options =
        path_options(case_, interface_, [this](long long, double) { return interrupts(); });
    options.along = *held_;
    path_.emplace(block_, interface_, std::move(options));
    if (!placed_) return path_->start();
    try {
        path_->start_here();
    } catch (const io::PhysicsError&) {
        path_.reset();
        throw;
    }
}

/// To the target, which is kept where it was interrupted.
void StaticPath::lead() {
    using Outcome = QuasistaticPath::Outcome;
    if (target_.at)
        path_->begin_to(*target_.at);
    else
        path_->begin({Segment::load, *target_.load});
    for (auto outcome = Outcome::point; outcome == Outcome::point;) {
        outcome = path_->advance();
        if (outcome == Outcome::interrupted)
            std::rethrow_exception(std::exchange(thrown_, nullptr));
        guard();
    }
}

/// True: look threw, which is kept until the path is back at its last point.
bool StaticPath::interrupts() {
    try {
        (*looking_)();
    } catch (...) {
        thrown_ = std::current_exception();
    }
    return thrown_ != nullptr;
}

void StaticPath::guard() const {
    const auto wrong =
        violation(path_->now(), surface_.statistics.lowest - reach_of(case_.simulation.interface),
                  fmt::format("point {}", path_->now().step));
    if (wrong)
        throw io::PhysicsError(*wrong, "it was led there, or steps missed too much of the energy",
                               "lead it less far, or take a smaller drive.displacement_step");
}

} // namespace asperity
