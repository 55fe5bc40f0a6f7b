// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/script/stepped_path.hpp"

#include "engine/path/guard.hpp"
#include "engine/plan/plan.hpp"
#include "engine/script/refuse.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace asperity {

namespace {

void require_number(const char* what, double value) {
    if (!std::isfinite(value))
        refuse(what, fmt::format("= {}", value), "the top plane needs a number", "give one");
}

void require_finite(const char* name, const VectorPlane<const double>& field) {
    for (const auto& plane : {field.x, field.y, field.z})
        for (int y = 0; y < plane.ny; ++y)
            for (int x = 0; x < plane.nx; ++x)
                if (!std::isfinite(plane(x, y)))
                    refuse(name, fmt::format("holds {} at [y, x] = [{}, {}]", plane(x, y), y, x),
                           "only finite numbers can be stepped with", "write numbers there");
}

Surface checked_surface(const Case& c, const Communicator& ranks) {
    if (!c.effects.dynamic)
        refuse("Simulation", fmt::format("cannot step the scene \"{}\"", c.scene.name),
               "drive.mode = \"quasistatic\", or drive.path = [\"relax\"], finds force balance "
               "without steps",
               "take asperity.Statics, or drive.mode = \"dynamic\" and drive.path = "
               "[\"approach\", \"pull-off\"]");
    require_memory(c, ranks);
    return whole(surface_of(c, ranks)); // each rank shows the heights
}

/// Returns the same case without states of force balance at the ends of its segments.
Case without_states(Case c) {
    c.effects.relaxation = {false, "the script relaxes when it asks for it"};
    return c;
}

} // namespace

bool LayerCopy::same(const VectorPlane<const double>& layer) const {
    std::size_t at = 0;
    for (const auto& plane : {layer.x, layer.y, layer.z})
        for (int y = 0; y < plane.ny; ++y, at += static_cast<std::size_t>(plane.nx))
            // NaN differs from itself, and is to be found
            if (!std::equal(plane.line(y), plane.line(y) + plane.nx, values_.data() + at))
                return false;
    return true;
}

void LayerCopy::take(const VectorPlane<const double>& layer) {
    values_.clear();
    for (const auto& plane : {layer.x, layer.y, layer.z})
        for (int y = 0; y < plane.ny; ++y)
            values_.insert(values_.end(), plane.line(y), plane.line(y) + plane.nx);
}

SteppedPath::SteppedPath(Case c, SceneText source, const Communicator& ranks)
    : case_(without_states(std::move(c))), source_(std::move(source)), ranks_(ranks),
      surface_(checked_surface(case_, ranks)), path_(case_, surface_, ranks) {
    path_.simulation().push(&pushing_);
}

long long SteppedPath::step(long long n, const Look& look) {
    if (n < 0)
        refuse("step", fmt::format("cannot make {} steps", n), "time goes forwards",
               "give a number from 0 on");
    require_whole();
    if (stepping_)
        refuse("step", "was called by an observer", "it is called between two steps",
               "step in the loop of the program");
    struct Stepping {
        explicit Stepping(bool& flag) : on(flag) { on = true; }
        ~Stepping() { on = false; }
        bool& on;
    };
    const Stepping guard(stepping_);
    take_in_writes();
    ThrottledLook throttled_look(look);
    long long taken = 0;
    try {
        while (taken < n && !done()) {
            const bool last = taken + 1 == n;
            one_step(last);
            ++taken;
            if (!last) throttled_look();
        }
    } catch (...) {
        bring_up_views();
        throw;
    }
    bring_up_views();
    return taken;
}

void SteppedPath::one_step(bool last) {
    const long long number = path_.steps();
    const bool observed = std::any_of(observers_.begin(), observers_.end(),
                                      [&](const Observer& o) { return number % o.period == 0; });
    const bool due = number % case_.output.series == 0;
    try {
        moved_ = true;
        const Path::Wish wish{.energies = due || observed || last};
        if (hand_)
            path_.step(*hand_, wish);
        else
            path_.advance(wish);
        require_physical();
        if (path_.status() == Path::Status::behind_end) path_.advance({}); // concludes the segment
    } catch (const std::exception& error) {
        failure_ = error.what();
        throw;
    }
    if (!observed) return;
    bring_up_views();
    // By number: an observer may add another.
    for (std::size_t i = 0, count = observers_.size(); i < count; ++i)
        if (number % observers_[i].period == 0) {
            const auto call = observers_[i].call;
            call();
        }
    take_in_writes();
}

/// Throws io::PhysicsError if the last step is no longer physical.
void SteppedPath::require_physical() const {
    const std::optional<std::string> wrong = violation(path_.now(), case_, surface_);
    if (!wrong) return;
    const Path::Remedy remedy = path_.remedy();
    throw io::PhysicsError(*wrong, remedy.why,
                           remedy.fix + "; or resume the last state that was saved");
}

void SteppedPath::every(long long n, std::function<void()> f) {
    if (n < 1)
        refuse("every", fmt::format("{} steps", n), "an observer is called each so many steps",
               "a number from 1 on");
    observers_.push_back({n, std::move(f)});
}

std::string SteppedPath::segment() const { return done() ? "done" : drive().now().text; }

int SteppedPath::segment_number() const { return hand_ ? -1 : static_cast<int>(path_.segment()); }

void SteppedPath::set_top_position(double z) {
    require_number("top.position", z);
    path_.simulation().set_top(z);
}

double SteppedPath::top_velocity() const {
    const TopMotion next = hand_.value_or(drive().motion(simulation().middle_of_step()));
    return next.z / units::metre_per_second;
}

void SteppedPath::set_top_velocity(std::optional<double> v) {
    if (v) require_number("top.velocity", *v);
    hand_.reset();
    if (v) hand_ = TopMotion{.z = *v * units::metre_per_second};
}

Block::Fields SteppedPath::fields_to_write() {
    if (!viewed_) take_copies(); // copies of the device's fields, if they are newer
    viewed_ = true;
    return path_.simulation().fields_to_view();
}

SteppedPath::View SteppedPath::f() {
    require_processor("f");
    return path_.simulation().fields_to_view().transferred.plane(0);
}

std::shared_ptr<const void> SteppedPath::lease() {
    auto held = lease_.lock();
    if (!held)
        lease_ = held = std::make_shared<std::shared_ptr<const SteppedPath>>(shared_from_this());
    return held;
}

/// Returns the interface at the place of the sites, which is that of the next step.
const Interface& SteppedPath::interface_here() {
    const std::array<double, 2>& place = simulation().top().place;
    Interface& interface = path_.simulation().interface();
    interface.slide_to(place[0], place[1]);
    return interface;
}

InterfaceMaps SteppedPath::maps() {
    return interface_here().maps(simulation().block().lowest_layer());
}

void SteppedPath::set_external(const VectorPlane<const double>& field) {
    require_processor("external");
    const Tile tile = this->tile();
    for (const auto& plane : {field.x, field.y, field.z})
        if (plane.nx != tile.nx || plane.ny != tile.ny)
            refuse("external", fmt::format("has the shape [{}, {}]", plane.ny, plane.nx),
                   fmt::format("the lowest layer has [{}, {}] sites, [y, x]", tile.ny, tile.nx),
                   "give a force for each of them, in x, y and z");
    require_finite("external", field);
    if (!external_) external_ = std::make_unique<VectorField<double>>(tile, 1);
    const View to = external_->plane(0); // views of it stay views of what acts
    for (const auto& [from, here] :
         {std::pair{&field.x, &to.x}, {&field.y, &to.y}, {&field.z, &to.z}})
        for (int y = 0; y < tile.ny; ++y)
            std::copy_n(from->line(y), tile.nx, here->line(y));
    pushing_.set(external_.get());
}

void SteppedPath::clear_external() {
    pushing_.set(nullptr);
    if (external_) dropped_.push_back(std::move(external_));
}

std::optional<SteppedPath::View> SteppedPath::external() {
    if (!external_) return std::nullopt;
    return external_->plane(0);
}

RestState SteppedPath::relax(const Look& look) {
    require_whole();
    if (external_)
        refuse("relax", "with an external field",
               "the state at zero load is that without forces from outside",
               "take the field away before (external = None)");
    take_in_writes();
    ThrottledLook throttled_look(look);
    const auto told = [&](long long, double) { // an exception ends the search
        throttled_look();
        return false;
    };
    const std::optional<LayerAtRest> found =
        path_.while_watched(told, [this] { return path_.state_from_here(); });
    return {*found->numbers, interface_here().maps(found->layer.view()[0])};
}

void SteppedPath::require_whole() const {
    if (!failure_.empty())
        refuse("Simulation", fmt::format("has ended at step {}", path_.steps()), failure_,
               "begin a new one, or resume the last that was saved");
}

void SteppedPath::require_processor(const char* what) const {
    if (case_.simulation.device.kind != DeviceChoice::Kind::none)
        refuse(what, "on a device", "forces stay in its memory", "take numerics.device = \"none\"");
}

void SteppedPath::take_copies() {
    u_.take(lowest_level().u.view()[0]);
    v_.take(lowest_level().v.view()[0]);
}

/// Brings views up to date after steps.
void SteppedPath::bring_up_views() {
    if (std::exchange(moved_, false) && viewed_) take_copies();
}

/// Makes values written through views part of the state, before steps. Collective.
void SteppedPath::take_in_writes() {
    enum { as_it_was, written, wrong };
    int found = as_it_was;
    std::exception_ptr error;
    try {
        if (external_) require_finite("external", std::as_const(*external_).plane(0));
        if (viewed_) {
            // The views' values: the device's copy is not newer, because it was brought up.
            const Block::Level& level = lowest_level();
            if (!u_.same(level.u.view()[0]) || !v_.same(level.v.view()[0])) {
                found = written;
                require_finite("u", level.u.view()[0]);
                require_finite("v", level.v.view()[0]);
            }
        }
    } catch (const io::Error&) {
        found = wrong;
        error = std::current_exception();
    }
    found = static_cast<int>(ranks_.max(found));
    if (error) std::rethrow_exception(error);
    if (found == wrong)
        refuse("Simulation", "was given values that are no numbers on another rank",
               "that rank says which", "write numbers there");
    if (found == written) {
        path_.simulation().block_to_write().exchange();
        path_.simulation().restart_balance();
        if (viewed_) take_copies();
    }
    if (lease_.expired()) viewed_ = false;
}

} // namespace asperity
