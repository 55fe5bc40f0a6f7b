// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/equilibrium/zero_load.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/driven_path.hpp"
#include "engine/run/guard.hpp"
#include "engine/run/rehearsal.hpp"
#include "engine/units.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"
#include "library/inside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

namespace libasperity {

namespace io = asperity::io;
namespace units = asperity::units;

std::recursive_mutex& at_work() {
    static std::recursive_mutex one;
    return one;
}

void refuse(const char* where, std::string what, std::string why, std::string fix) {
    throw io::SceneError(io::Problem{where, std::move(what), std::move(why), std::move(fix)});
}

namespace {

bool finite(const asperity::PlaneView<const double>& plane, int& bad_x, int& bad_y) {
    for (int y = 0; y < plane.ny; ++y)
        for (int x = 0; x < plane.nx; ++x)
            if (!std::isfinite(plane(x, y))) {
                bad_x = x, bad_y = y;
                return false;
            }
    return true;
}

void require_finite(const char* name, const asperity::VectorPlane<const double>& field) {
    int x = 0, y = 0;
    for (const auto& plane : {field.x, field.y, field.z})
        if (!finite(plane, x, y))
            refuse(name, fmt::format("holds {} at [y, x] = [{}, {}]", plane(x, y), y, x),
                   "only finite numbers can be stepped with", "write numbers there");
}

/// The owned nodes of a layer, to see whether they were written to.
class LayerCopy {
public:
    bool same(const asperity::VectorPlane<const double>& layer) const {
        std::size_t at = 0;
        for (const auto& plane : {layer.x, layer.y, layer.z})
            for (int y = 0; y < plane.ny; ++y, at += static_cast<std::size_t>(plane.nx))
                // NaN differs from itself, and is to be found
                if (!std::equal(plane.line(y), plane.line(y) + plane.nx, values_.data() + at))
                    return false;
        return true;
    }
    void take(const asperity::VectorPlane<const double>& layer) {
        values_.clear();
        for (const auto& plane : {layer.x, layer.y, layer.z})
            for (int y = 0; y < plane.ny; ++y)
                values_.insert(values_.end(), plane.line(y), plane.line(y) + plane.nx);
    }

private:
    std::vector<double> values_;
};

Map map_of(const asperity::InterfaceMaps& maps, const char* unit, std::vector<double> values) {
    return {static_cast<std::size_t>(maps.ny), static_cast<std::size_t>(maps.nx), unit,
            std::move(values)};
}

} // namespace

SiteMaps site_maps(const asperity::Interface& interface,
                   const asperity::VectorPlane<const double>& layer, double height) {
    asperity::InterfaceMaps maps = interface.maps(layer, height);
    SiteMaps all;
    all.contact = map_of(maps, "1", {maps.contact.begin(), maps.contact.end()});
    all.gap = map_of(maps, "Å", std::move(maps.gap));
    all.pressure = map_of(maps, "GPa", std::move(maps.pressure));
    return all;
}

namespace {

/// What the numbers of a file belong to, as a checkpoint keeps it: the scene as it was given, and
/// what was in its files.
std::string description(const SceneSource& source, const asperity::Case& c,
                        const asperity::Surface& surface) {
    io::Json scene = {
        {"text", source.text}, {"file", source.file}, {"overrides", source.overrides}};
    if (surface.file_digest) scene["content_of_surface.file"] = *surface.file_digest;
    if (c.table_digest) scene["content_of_tables"] = *c.table_digest;
    return io::json_text(io::Json{{"simulation", scene}});
}

Scene described_scene(const std::string& file) {
    const io::Hdf5File saved(io::FilePlace(file), io::Hdf5File::Mode::read);
    const auto wrong = [&](const char* what) {
        return io::FileError(file, what, "Simulation::resume goes on from what save() wrote",
                             "a run's own checkpoint is for `asperity run --resume`");
    };
    const std::optional<std::string> text = saved.text_attribute("/", "scene");
    if (!text) throw wrong("holds no simulation");
    const io::Json all = io::parse_json(*text, file);
    const io::Json* scene = io::find(all, "simulation");
    if (!scene) throw wrong("holds a run, not a simulation that was saved");
    return Scene::parse((*scene)["text"].get<std::string>(),
                        (*scene)["overrides"].get<std::vector<std::string>>(),
                        (*scene)["file"].get<std::string>());
}

} // namespace

class Simulation::Inside : public std::enable_shared_from_this<Simulation::Inside> {
public:
    explicit Inside(const Scene& scene)
        : scene_(scene), surface_(checked_surface()), grid_(case_.grid(ranks_.rank())),
          simulation_(case_.simulation, surface_, ranks_, grid_),
          path_(case_, simulation_, results_),
          lowest_height_(surface_.statistics.lowest - reach_of(case_.simulation.interface)) {}

    void start() { path_.start(); }

    long long step(long long n, const Look& look) {
        if (n < 0)
            refuse("step", fmt::format("of {} steps", n), "time goes forwards",
                   "a number from 0 on");
        require_whole();
        if (stepping_)
            refuse("step", "was called by an observer", "it is called between two steps",
                   "step in the loop of the program");
        const Stepping guard(stepping_);
        take_in_writes();
        Looking looking(look);
        long long taken = 0;
        try {
            while (taken < n && !path_.over()) {
                const bool last = taken + 1 == n;
                one_step(last);
                ++taken;
                if (!last) looking.now_and_then();
            }
        } catch (...) {
            bring_up_views();
            throw;
        }
        bring_up_views();
        return taken;
    }

    void every(long long n, std::function<void()> f) {
        if (n < 1)
            refuse("every", fmt::format("{} steps", n), "an observer is called each so many steps",
                   "a number from 1 on");
        observers_.push_back({n, std::move(f)});
    }

    RestState relax(const Look& look) {
        require_whole();
        if (external_)
            refuse("relax", "with an external field",
                   "the state at zero load is that without forces from outside",
                   "take the field away before (external = None, clear_external())");
        take_in_writes();
        Looking looking(look);
        const double height = simulation_.reference_height();
        const asperity::LayerAtRest found = asperity::bring_to_rest(
            simulation_.block(), surface_, height, case_,
            [&](long long, double) { // what it throws ends the search
                looking.now_and_then();
                return false;
            },
            simulation_.now().slide);
        const asperity::ZeroLoad& z = *found.numbers;
        RestState state;
        state.binding_energy = z.binding_energy;
        state.elastic_energy = z.elastic;
        state.contact_fraction = z.contact_fraction;
        state.repulsive_fraction = z.repulsive_fraction;
        state.mean_height = z.mean_height;
        state.residual = z.residual;
        state.iterations = z.iterations;
        state.maps = site_maps(simulation_.interface(), found.layer.view()[0], height);
        return state;
    }

    // Views.

    VectorView view(asperity::VectorField<double>& field) {
        const asperity::VectorPlane<double> plane = field.plane(0);
        const auto one = [&](const asperity::PlaneView<double>& p) {
            return View{p.origin, static_cast<std::size_t>(p.ny), static_cast<std::size_t>(p.nx),
                        p.row, lease()};
        };
        return {one(plane.x), one(plane.y), one(plane.z)};
    }
    /// Of displacements or velocities, which may be written to.
    VectorView view_to_write(asperity::VectorField<double> asperity::Block::Level::*field) {
        if (!looked_at_) {
            take_copies(); // of what the device has, if it is newer
            looked_at_ = true;
        }
        const asperity::Block::Level& level = simulation_.block().levels().front();
        return view(const_cast<asperity::VectorField<double>&>(level.*field));
    }
    VectorView forces() {
        require_processor("f");
        const asperity::Block::Level& level = simulation_.block().levels().front();
        return view(const_cast<asperity::VectorField<double>&>(level.transferred));
    }
    View heights() const {
        const auto n = static_cast<std::size_t>(surface_.sites);
        return {const_cast<double*>(surface_.height.data()), n, n, surface_.sites,
                shared_from_this()};
    }

    void set_external(const std::array<const Map*, 3>& maps) {
        require_processor("external");
        const asperity::Tile tile = grid_.tile(0);
        const auto nx = static_cast<std::size_t>(tile.nx), ny = static_cast<std::size_t>(tile.ny);
        auto field = std::make_unique<asperity::VectorField<double>>(tile, 1);
        const auto planes = field->plane(0);
        const std::array to = {planes.x, planes.y, planes.z};
        for (std::size_t c = 0; c < 3; ++c) {
            if (maps[c]->ny != ny || maps[c]->nx != nx || maps[c]->values.size() != nx * ny)
                refuse("external", fmt::format("has the shape [{}, {}]", maps[c]->ny, maps[c]->nx),
                       fmt::format("the lowest layer has [{}, {}] sites, [y, x]", ny, nx),
                       "give a force for each of them, in x, y and z");
            for (int y = 0; y < tile.ny; ++y)
                std::copy_n(&maps[c]->values[static_cast<std::size_t>(y) * nx], nx, to[c].line(y));
        }
        require_finite("external", std::as_const(*field).plane(0));
        if (external_) // views of it stay views of what acts
            external_->copy_from(*field);
        else
            external_ = std::move(field);
        simulation_.push(external_.get());
    }
    VectorView external() { return external_ ? view(*external_) : VectorView(); }
    void clear_external() {
        simulation_.push(nullptr);
        if (external_) dropped_.push_back(std::move(external_)); // views of it may be held
    }

    // The top plane.

    void set_top_position(double z) {
        require_number("top.position", z);
        simulation_.block_to_write().set_top(z);
    }
    void set_top_velocity(double v) {
        require_number("top.velocity", v);
        simulation_.drive().take_over(v * units::metre_per_second);
    }
    double top_velocity() {
        return simulation_.drive().velocity(simulation_.time() + 0.5 * simulation_.options().dt) /
               units::metre_per_second;
    }

    // Files.

    void save(const std::string& file) {
        require_whole();
        take_in_writes();
        asperity::CollectNumbers numbers;
        Saved saved{*this};
        numbers("program", saved);
        asperity::write_checkpoint(io::FilePlace(file), simulation_, numbers, description(),
                                   arrays());
    }
    void resume(const std::string& file) {
        const io::FilePlace place(file);
        const asperity::StateNumbers all = asperity::read_checkpoint_numbers(place);
        asperity::RestoreNumbers numbers(all);
        Saved saved{*this};
        numbers("program", saved); // whether there is a field to be read
        asperity::read_checkpoint(place, simulation_, description(), arrays());
        take_copies();
    }

    const Scene& scene() const { return scene_; }
    const asperity::StepRecord& now() const { return now_; }
    asperity::Simulation& engine() { return simulation_; }
    asperity::Tile tile() const { return grid_.tile(0); }
    const asperity::Case& of_case() const { return case_; }
    const asperity::PathResults& results() const { return results_; }
    const asperity::Surface& surface() const { return surface_; }
    const asperity::DrivenPath& path() const { return path_; }

private:
    struct Observer {
        long long period;
        std::function<void()> call;
    };
    struct Stepping {
        explicit Stepping(bool& flag) : on(flag) { on = true; }
        ~Stepping() { on = false; }
        bool& on;
    };
    /// All that a file has beside the engine's own numbers.
    struct Saved {
        Inside& all;
        template <class Visitor>
        void visit(Visitor& v) {
            v("path", all.path_);
            v("results", all.results_);
            bool by_hand = all.simulation_.drive().by_hand().has_value();
            double velocity = all.simulation_.drive().by_hand().value_or(0.0);
            v("top.by_hand", by_hand);
            v("top.velocity", velocity);
            all.simulation_.drive().take_over(by_hand ? std::optional(velocity) : std::nullopt);
            ExternalWork work{all.simulation_};
            v("external", work);
            bool pushed = all.external_ != nullptr;
            v("external.acts", pushed);
            if (pushed && !all.external_) {
                all.external_ =
                    std::make_unique<asperity::VectorField<double>>(all.grid_.tile(0), 1);
                all.simulation_.push(all.external_.get());
            }
            asperity::StepRecord& r = all.now_;
            v("now.step", r.step);
            v("now.time", r.time);
            v("now.top", r.top);
            v("now.mean_height", r.mean_height);
            v("now.force", r.force);
            v("now.top_force", r.top_force);
            v("now.interface_energy", r.interface_energy);
            v("now.elastic_energy", r.elastic_energy);
            v("now.kinetic_energy", r.kinetic_energy);
            v("now.in_contact", r.in_contact);
            v("now.repulsive", r.repulsive);
            v("now.work", r.work);
            v("now.damped", r.damped);
            v("now.residual", r.residual);
        }
    };
    struct ExternalWork {
        asperity::Simulation& simulation;
        template <class Visitor>
        void visit(Visitor& v) {
            simulation.visit_external(v);
        }
    };

    asperity::Surface checked_surface() const {
        if (!case_.in_time)
            refuse("Simulation",
                   fmt::format("of the scene \"{}\", which has no time", case_.scene.name),
                   "drive.mode = \"quasistatic\", or drive.path = [\"zero-load\"], finds force "
                   "balance without steps",
                   "take libasperity::Statics (asperity.Statics), or drive.mode = \"dynamic\" and "
                   "drive.path = "
                   "[\"approach\", \"pull-off\"]");
        if (case_.ranks != ranks_.size())
            refuse("Simulation", fmt::format("on {} ranks", ranks_.size()),
                   fmt::format("its scene was read for {}", case_.ranks),
                   "read the scene while the Parallel lives");
        case_.require_runnable();
        asperity::require_memory(case_, ranks_);
        return asperity::surface_of(case_, ranks_);
    }

    void require_whole() const {
        if (failure_.empty()) return;
        refuse("Simulation", fmt::format("has ended at step {}", simulation_.steps()), failure_,
               "begin a new one, or resume the last that was saved");
    }
    void require_processor(const char* what) const {
        if (case_.simulation.device.kind == asperity::DeviceChoice::Kind::none) return;
        refuse(what, "on a device", "forces stay in its memory", "take numerics.device = \"none\"");
    }
    static void require_number(const char* what, double value) {
        if (std::isfinite(value)) return;
        refuse(what, fmt::format("= {}", value), "the top plane needs a number", "give one");
    }

    void one_step(bool last) {
        const long long number = simulation_.steps();
        const bool observed =
            std::any_of(observers_.begin(), observers_.end(),
                        [&](const Observer& o) { return number % o.period == 0; });
        const bool due = number % case_.scene.output.series == 0;
        try {
            moved_ = true;
            now_ = simulation_.step(due || observed || last || path_.must_observe());
            if (const auto wrong =
                    asperity::violation(now_, lowest_height_, fmt::format("step {}", number)))
                throw asperity::step_failed(*wrong, asperity::fastest_site(simulation_), case_,
                                            "or resume the last state that was saved");
            path_.follow(now_);
            if (const auto segment = path_.to_conclude()) path_.conclude(*segment);
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

    std::shared_ptr<const void> lease() {
        auto held = lease_.lock();
        if (!held) lease_ = held = std::make_shared<std::shared_ptr<Inside>>(shared_from_this());
        return held;
    }
    void take_copies() {
        const asperity::Block::Level& level = simulation_.block().levels().front();
        u_.take(level.u.view()[0]);
        v_.take(level.v.view()[0]);
    }
    /// After steps: views show the fields as they are now.
    void bring_up_views() {
        if (std::exchange(moved_, false) && looked_at_) take_copies();
    }
    /// Before steps: what was written through views becomes the state. Collective.
    void take_in_writes() {
        enum { as_it_was, written, wrong };
        int found = as_it_was;
        std::exception_ptr error;
        try {
            if (external_) require_finite("external", std::as_const(*external_).plane(0));
            if (looked_at_) {
                // As the views have it: the device's copy is not newer, for it was brought up.
                const asperity::Block::Level& level = simulation_.block().levels().front();
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
            simulation_.block_to_write().exchange();
            simulation_.restart_balance();
            if (looked_at_) take_copies();
        }
        if (lease_.expired()) looked_at_ = false;
    }

    std::vector<asperity::StateArray> arrays() {
        std::vector<asperity::StateArray> list;
        const asperity::Block::Level& level = simulation_.block().levels().front();
        asperity::add_arrays(
            0, "force", const_cast<asperity::VectorField<double>&>(level.transferred), 1, list);
        if (external_) asperity::add_arrays(0, "external", *external_, 1, list);
        return list;
    }
    std::string description() const {
        return libasperity::description(scene_.inside().source, case_, surface_);
    }

    const Scene scene_;
    const asperity::Case& case_ = scene_.inside().resolved;
    const asperity::Communicator ranks_ = world();
    const asperity::Surface surface_;
    const asperity::ProcessGrid grid_;
    asperity::Simulation simulation_;
    asperity::PathResults results_;
    asperity::DrivenPath path_;
    const double lowest_height_; ///< below it the block has passed through the substrate, Å
    asperity::StepRecord now_;
    std::vector<Observer> observers_;
    bool stepping_ = false;
    std::string failure_; ///< why no step can follow; empty: one can
    std::unique_ptr<asperity::VectorField<double>> external_;
    std::vector<std::unique_ptr<asperity::VectorField<double>>> dropped_;

    /// Held by all views. Views of u and v were given away, and may be held: what they showed last.
    std::weak_ptr<std::shared_ptr<Inside>> lease_;
    bool looked_at_ = false;
    bool moved_ = false; ///< since they were brought up to date
    LayerCopy u_, v_;
};

Simulation::Simulation(const Scene& scene)
    : inside_(at_work_on([&] { return std::make_shared<Inside>(scene); })) {
    at_work_on([&] { inside_->start(); });
}

Simulation Simulation::resume(const std::string& file) {
    return at_work_on([&] {
        auto inside = std::make_shared<Inside>(described_scene(file));
        inside->start(); // the height that it hangs at, of which a file has but the path's numbers
        inside->resume(file);
        return Simulation(std::move(inside));
    });
}

Scene Simulation::scene() const { return inside_->scene(); }

long long Simulation::step(long long n, const Look& look) {
    return at_work_on([&] { return inside_->step(n, look); });
}
void Simulation::every(long long n, std::function<void()> f) {
    translated([&] { inside_->every(n, std::move(f)); });
}
bool Simulation::done() const { return inside_->path().over(); }

long long Simulation::steps() const { return inside_->engine().steps(); }
double Simulation::time() const { return inside_->now().time * 1e-3; } // as the series has it
double Simulation::force() const { return inside_->now().force; }
double Simulation::top_force() const { return inside_->now().top_force; }
double Simulation::mean_height() const { return inside_->now().mean_height; }

Energies Simulation::energy() const {
    const asperity::StepRecord& r = inside_->now();
    return {r.elastic_energy, r.interface_energy, r.kinetic_energy, r.work, r.damped, r.residual};
}

double Simulation::contact_fraction() const {
    const double sites = inside_->of_case().scene.surface.sites;
    return static_cast<double>(inside_->now().in_contact) / (sites * sites);
}
double Simulation::repulsive_fraction() const {
    const double sites = inside_->of_case().scene.surface.sites;
    return static_cast<double>(inside_->now().repulsive) / (sites * sites);
}

std::string Simulation::segment() const {
    const asperity::Drive& drive = std::as_const(inside_->engine()).drive();
    return inside_->path().over() ? "done" : drive.now().text;
}
BothWays Simulation::work_of_adhesion() const {
    const asperity::PathResults& found = inside_->results();
    return {found.approach.interface_work, found.pull_off.interface_work};
}
BothWays Simulation::work_of_drive() const {
    const asperity::PathResults& found = inside_->results();
    return {found.approach.drive_work, found.pull_off.drive_work};
}
std::optional<double> Simulation::lost_in_cycle() const { return inside_->results().lost_in_cycle; }

double Simulation::top_position() const { return std::as_const(inside_->engine()).block().top(); }
void Simulation::set_top_position(double z) {
    translated([&] { inside_->set_top_position(z); });
}
double Simulation::top_velocity() const { return inside_->top_velocity(); }
void Simulation::set_top_velocity(double v) {
    translated([&] { inside_->set_top_velocity(v); });
}
void Simulation::release_top() { inside_->engine().drive().take_over(std::nullopt); }

VectorView Simulation::u() {
    return translated([&] { return inside_->view_to_write(&asperity::Block::Level::u); });
}
VectorView Simulation::v() {
    return translated([&] { return inside_->view_to_write(&asperity::Block::Level::v); });
}
VectorView Simulation::f() {
    return translated([&] { return inside_->forces(); });
}
View Simulation::substrate_height() const { return inside_->heights(); }
double Simulation::substrate_edge() const { return inside_->surface().length; }
Tile Simulation::tile() const {
    const asperity::Tile tile = inside_->tile();
    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    return {size(tile.y0), size(tile.x0), size(tile.ny), size(tile.nx)};
}
double Simulation::spacing() const { return inside_->of_case().scene.surface.spacing; }
SiteMaps Simulation::maps() const {
    return translated([&] {
        return site_maps(inside_->engine().interface(), inside_->engine().block().lowest_layer(),
                         inside_->engine().reference_height());
    });
}

void Simulation::set_external(const Map& x, const Map& y, const Map& z) {
    translated([&] { inside_->set_external({&x, &y, &z}); });
}
VectorView Simulation::external() { return inside_->external(); }
void Simulation::clear_external() { inside_->clear_external(); }
double Simulation::external_work() const { return inside_->engine().balance().external; }

RestState Simulation::relax(const Look& look) {
    return at_work_on([&] { return inside_->relax(look); });
}
void Simulation::save(const std::string& file) {
    at_work_on([&] { inside_->save(file); });
}

} // namespace libasperity
