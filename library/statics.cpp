// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/quasistatic.hpp"
#include "engine/run/guard.hpp"
#include "engine/run/rehearsal.hpp"
#include "engine/units.hpp"
#include "io/units.hpp"
#include "library/inside.hpp"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <optional>
#include <utility>

namespace libasperity {

namespace io = asperity::io;
namespace units = asperity::units;

namespace {

using Held = asperity::Constraint::Of;

const char* name(Held held) { return held == Held::top ? "the top plane" : "the mean height"; }

/// The same solids without time.
asperity::Case without_time(const asperity::Case& c) {
    if (c.ranks != 1)
        refuse("Statics", fmt::format("on {} ranks", c.ranks),
               "it is one process, on all its threads",
               "start it without mpirun; runs take ranks (libasperity::run)");
    if (!c.in_time) return c;
    asperity::Scene scene = c.scene;
    scene.drive.mode = asperity::DriveMode::quasistatic;
    return asperity::resolve(scene);
}

} // namespace

class Statics::Inside {
public:
    explicit Inside(const Scene& scene)
        : case_(without_time(scene.inside().resolved)), surface_(checked_surface()),
          interface_(surface_, case_.grid(0).tile(0), case_.scene.surface.spacing,
                     case_.simulation.interface),
          block_(case_.simulation.block, asperity::Communicator(),
                 case_.scene.interface.frictionless) {}

    void go_to(Held held, double at) {
        if (!std::isfinite(at)) refuse_number(at);
        hold(held);
        target_ = {.at = held == Held::top ? at : at - interface_.start_height()};
    }
    void go_to_load(double pressure) {
        if (!std::isfinite(pressure)) refuse_number(pressure);
        target_ = {.load = pressure * units::megapascal * case_.area()};
    }

    Point relax(const Simulation::Look& look) {
        if (!path_)
            hold(case_.scene.drive.hold == asperity::Hold::top ? Held::top : Held::mean_height);
        if (!started_) path_->start();
        started_ = true;
        Looking looking(look);
        looking_ = &looking;
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

    Point now() const {
        Point p;
        if (!started_) {
            p.mean_height = interface_.start_height();
            return p;
        }
        const asperity::StepRecord& r = path_->now();
        const double sites = case_.scene.surface.sites;
        p.top = *held_ == Held::top ? r.top : 0.0;
        p.mean_height = r.mean_height;
        p.force = r.force;
        p.elastic_energy = r.elastic_energy;
        p.interface_energy = r.interface_energy;
        p.energy = r.elastic_energy + r.interface_energy;
        p.work = r.work;
        p.dissipated = r.damped;
        p.instabilities = path_->dissipation().events;
        p.contact_fraction = static_cast<double>(r.in_contact) / (sites * sites);
        p.repulsive_fraction = static_cast<double>(r.repulsive) / (sites * sites);
        p.number = r.step;
        return p;
    }
    SiteMaps maps() const {
        return site_maps(interface_, block_.lowest_layer(), interface_.start_height());
    }

private:
    /// To the target, which is kept where it was interrupted.
    void lead() {
        using Outcome = asperity::QuasistaticPath::Outcome;
        if (target_.at)
            path_->begin_to(*target_.at);
        else
            path_->begin({asperity::Segment::load, *target_.load});
        for (auto outcome = Outcome::point; outcome == Outcome::point;) {
            outcome = path_->advance();
            if (outcome == Outcome::interrupted)
                std::rethrow_exception(std::exchange(thrown_, nullptr));
            guard();
        }
    }
    asperity::Surface checked_surface() const {
        case_.require_runnable();
        asperity::require_memory(case_, asperity::Communicator());
        return asperity::surface_of(case_);
    }
    [[noreturn]] static void refuse_number(double value) {
        refuse("Statics", fmt::format("is led to {}", value), "that is no number", "give one");
    }
    void hold(Held held) {
        if (held_ && *held_ != held)
            refuse("Statics", fmt::format("holds {}", name(*held_)),
                   fmt::format("{} cannot be held on the same path", name(held)),
                   "begin another Statics for it");
        if (held_) return;
        held_ = held;
        asperity::PathOptions options =
            asperity::path_options(case_, interface_, [this](long long, double) { return look(); });
        options.along = held;
        path_.emplace(block_, interface_, std::move(options));
    }
    /// True: it threw, which is kept until the path is back at its last point.
    bool look() {
        try {
            looking_->now_and_then();
        } catch (...) {
            thrown_ = std::current_exception();
        }
        return thrown_ != nullptr;
    }
    void guard() const {
        const auto wrong = asperity::violation(
            path_->now(), surface_.statistics.lowest - reach_of(case_.simulation.interface),
            fmt::format("point {}", path_->now().step));
        if (wrong)
            throw io::PhysicsError(*wrong,
                                   "it was led there, or steps missed too much of the energy",
                                   "lead it less far, or take a smaller drive.tolerance");
    }

    const asperity::Case case_;
    const asperity::Surface surface_;
    asperity::Interface interface_;
    asperity::SpectralBlock block_;
    std::optional<Held> held_;
    std::optional<asperity::QuasistaticPath> path_;
    bool started_ = false;
    struct Goal {
        std::optional<double> at{}, load{}; ///< Å, eV/Å
    };
    Goal target_; ///< where the next relaxation leads it
    Looking* looking_ = nullptr;
    std::exception_ptr thrown_;
};

Statics::Statics(const Scene& scene)
    : inside_(at_work_on([&] { return std::make_shared<Inside>(scene); })) {}

void Statics::set_mean_height(double z) {
    translated([&] { inside_->go_to(Held::mean_height, z); });
}
void Statics::set_top(double z) {
    translated([&] { inside_->go_to(Held::top, z); });
}
void Statics::set_load(double pressure) {
    translated([&] { inside_->go_to_load(pressure); });
}
void Statics::set_load(const std::string& pressure) {
    translated([&] {
        const io::ParsedQuantity parsed = io::parse_quantity(pressure, "MPa");
        if (!parsed.why.empty())
            refuse("load", fmt::format("= \"{}\"", pressure), parsed.why, parsed.fix);
        inside_->go_to_load(parsed.value);
    });
}
Point Statics::relax(const Simulation::Look& look) {
    return at_work_on([&] { return inside_->relax(look); });
}
Point Statics::now() const { return inside_->now(); }
SiteMaps Statics::maps() const {
    return at_work_on([&] { return inside_->maps(); });
}

} // namespace libasperity
