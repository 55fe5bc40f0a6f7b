// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/script/stepped_path.hpp"

#include "engine/path/checkpoint.hpp"
#include "engine/path/guard.hpp"
#include "engine/plan/plan.hpp"
#include "engine/units.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace asperity {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const char* where, std::string what, std::string why, std::string fix) {
    throw io::SceneError(io::Problem{where, std::move(what), std::move(why), std::move(fix)});
}

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
    return surface_of(c, ranks);
}

/// Returns the scene in a file that save() wrote.
SceneText saved_scene(const std::string& file) {
    const io::Hdf5File saved(io::FilePlace(file), io::Hdf5File::Mode::read);
    const std::optional<std::string> text = saved.text_attribute("/", "scene");
    const io::Json all = text ? io::parse_json(*text, file) : io::Json();
    const io::Json* scene = io::find(all, "simulation");
    if (!scene)
        throw io::FileError(
            file, text ? "holds a run, not a simulation that was saved" : "holds no simulation",
            "Simulation.resume goes on from what save() wrote",
            "a run's own checkpoint is for `asperity run --resume`");
    return {(*scene)["text"].get<std::string>(), (*scene)["file"].get<std::string>(),
            (*scene)["overrides"].get<std::vector<std::string>>()};
}

/// Refuses to write over anything but a file of save(). A link is not followed.
void require_own_place(const std::string& file) {
    std::error_code error;
    const fs::file_type type = fs::symlink_status(file, error).type();
    if (type == fs::file_type::not_found) return;
    std::string what = "cannot be looked at", why = error.message();
    if (type == fs::file_type::symlink) {
        what = "is a symbolic link", why = "what it points to is not replaced";
    } else if (type == fs::file_type::directory) {
        what = "is a directory", why = "a simulation is saved in one file";
    } else if (type == fs::file_type::regular) {
        try {
            saved_scene(file);
            return;
        } catch (const io::Error&) {
            what = "is there already, and is no file of Simulation.save()";
            why = "only such a file is replaced";
        }
    } else if (type != fs::file_type::none) {
        what = "is no regular file", why = "a device, a pipe or a socket is not replaced";
    }
    refuse(file.c_str(), what, why, "name another file");
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
    : case_(std::move(c)), source_(std::move(source)), ranks_(ranks),
      surface_(checked_surface(case_, ranks)), path_(case_, surface_, ranks) {}

std::shared_ptr<SteppedPath> SteppedPath::resume(const std::string& file,
                                                 const Communicator& ranks) {
    SceneText source = saved_scene(file);
    Case c = source.read(ranks.size());
    // The path starts as a new one: a file has only the path's numbers, without its start height.
    auto path = std::make_shared<SteppedPath>(std::move(c), std::move(source), ranks);
    path->restore(file);
    return path;
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
    LookNowAndThen now_and_then(look);
    long long taken = 0;
    try {
        while (taken < n && !path_.done()) {
            const bool last = taken + 1 == n;
            one_step(last);
            ++taken;
            if (!last) now_and_then();
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
        path_.advance({.energies = due || observed || last});
        guard(path_, [] { return "or resume the last state that was saved"; });
        if (path_.ended()) path_.conclude();
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

void SteppedPath::every(long long n, std::function<void()> f) {
    if (n < 1)
        refuse("every", fmt::format("{} steps", n), "an observer is called each so many steps",
               "a number from 1 on");
    observers_.push_back({n, std::move(f)});
}

std::string SteppedPath::segment() const {
    return done() ? "done" : simulation().drive().now().text;
}

int SteppedPath::segment_number() const {
    return simulation().drive().by_hand() ? -1 : static_cast<int>(path_.segment());
}

void SteppedPath::set_top_position(double z) {
    require_number("top.position", z);
    path_.simulation().block_to_write().set_top(z);
}

double SteppedPath::top_velocity() const {
    const double middle = simulation().time() + 0.5 * simulation().options().dt;
    return simulation().drive().velocity(middle) / units::metre_per_second;
}

void SteppedPath::set_top_velocity(std::optional<double> v) {
    if (v) require_number("top.velocity", *v);
    path_.simulation().drive().set_velocity(v ? std::optional(*v * units::metre_per_second)
                                              : std::nullopt);
}

SteppedPath::View SteppedPath::view_to_write(VectorField<double> Block::Level::*field) {
    if (!viewed_) take_copies(); // copies of the device's fields, if they are newer
    viewed_ = true;
    return const_cast<VectorField<double>&>(lowest_level().*field).plane(0);
}

SteppedPath::View SteppedPath::f() {
    require_processor("f");
    return const_cast<VectorField<double>&>(lowest_level().transferred).plane(0);
}

std::shared_ptr<const void> SteppedPath::lease() {
    auto held = lease_.lock();
    if (!held)
        lease_ = held = std::make_shared<std::shared_ptr<const SteppedPath>>(shared_from_this());
    return held;
}

/// Returns maps. Positions are those of the next step: so is the place of the block over the
/// substrate.
InterfaceMaps SteppedPath::maps() {
    const std::array<double, 2>& place = simulation().place();
    path_.interface().slide_to(place[0], place[1]);
    return path_.interface().maps(simulation().block().lowest_layer(), path_.reference_height());
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
    path_.simulation().push(external_.get());
}

void SteppedPath::clear_external() {
    path_.simulation().push(nullptr);
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
    LookNowAndThen now_and_then(look);
    const auto told = [&](long long, double) { // an exception ends the search
        now_and_then();
        return false;
    };
    const LayerAtRest found = path_.while_watched(told, [this] { return path_.state_from_here(); });
    return {*found.numbers,
            path_.interface().maps(found.layer.view()[0], path_.reference_height())};
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

// ---- Files.

/// All that a file has beside the numbers of the path.
struct SteppedPath::Saved {
    SteppedPath& all;
    struct ExternalWork {
        Simulation& simulation;
        template <class Visitor>
        void visit(Visitor& v) {
            simulation.visit_external(v);
        }
    };
    template <class Visitor>
    void visit(Visitor& v) {
        Simulation& simulation = all.path_.simulation();
        Drive& drive = simulation.drive();
        bool by_hand = drive.by_hand().has_value();
        double velocity = drive.by_hand().value_or(0.0);
        v("top.by_hand", by_hand);
        v("top.velocity", velocity);
        if constexpr (Visitor::restores)
            drive.set_velocity(by_hand ? std::optional(velocity) : std::nullopt);
        ExternalWork work{simulation};
        v("external", work);
        bool pushed = all.external_ != nullptr;
        v("external.acts", pushed);
        if (pushed && !all.external_) {
            all.external_ = std::make_unique<VectorField<double>>(all.tile(), 1);
            simulation.push(all.external_.get());
        }
    }
};

std::vector<StateArray> SteppedPath::own_arrays() {
    std::vector<StateArray> list;
    add_arrays(0, "force", const_cast<VectorField<double>&>(lowest_level().transferred), 1, list);
    if (external_) add_arrays(0, "external", *external_, 1, list);
    return list;
}

/// Returns the scene that the numbers of a file belong to, as it was given, and the contents of its
/// files.
std::string SteppedPath::description() const {
    io::Json scene = {{"text", source_.text},
                      {"file", fs::absolute(source_.file).string()},
                      {"overrides", source_.overrides}};
    if (surface_.file_digest) scene["content_of_surface.file"] = *surface_.file_digest;
    if (case_.table_digest) scene["content_of_tables"] = *case_.table_digest;
    return io::json_text(io::Json{{"simulation", scene}});
}

void SteppedPath::save(const std::string& file) {
    require_whole();
    take_in_writes();
    ranks_.on_root([&] { require_own_place(file); });
    CollectNumbers numbers;
    path_.collect(numbers);
    Saved saved{*this};
    numbers("program", saved);
    write_checkpoint(io::FilePlace(file), ranks_, path_.grid(),
                     joined(path_.arrays(), own_arrays()), numbers.numbers, description());
}

void SteppedPath::restore(const std::string& file) {
    const auto arrays = [this](const StateNumbers& all) {
        RestoreNumbers numbers(all);
        path_.restore(numbers);
        Saved saved{*this};
        numbers("program", saved); // decides if there is a field to be read
        return joined(path_.arrays(), own_arrays());
    };
    read_checkpoint(io::FilePlace(file), ranks_, path_.grid(), arrays, description());
    path_.restored();
    take_copies();
}

} // namespace asperity
