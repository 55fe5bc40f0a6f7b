// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The parts of the path one after the other: "zero-load" is one relaxation with the top plane free,
// approach and pull-off are points of a quasi-static path, until the path says that it is there.
#include "engine/run/equilibrium_run.hpp"

#include "engine/equilibrium/equilibrium.hpp"
#include "engine/equilibrium/quasistatic.hpp"
#include "engine/equilibrium/state_search.hpp"
#include "engine/run/run_frame.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace asperity {

namespace {

class EquilibriumRun final : public RunFrame {
public:
    EquilibriumRun(const Scene& scene, const RunOptions& options, const Communicator& ranks)
        : RunFrame(scene, options, ranks),
          interface_(surface_, grid_.tile(0), scene.surface.spacing, setup_.simulation.interface),
          block_(make_equilibrium(scene, setup_, ranks, grid_)),
          path_(*block_, interface_, path_options()),
          search_(*block_, interface_, search_options()) {}

private:
    void follow() override {
        const bool taken_up = take_up();
        open_recorder(taken_up);
        for (; part_ < scene_.drive.path.size(); ++part_, at_end_ = false) {
            const PathPart part = scene_.drive.path[part_];
            const bool whole = part == PathPart::zero_load  ? relax_free()
                               : part == PathPart::approach ? follow_leg(Leg::approach)
                                                            : follow_leg(Leg::pull_off);
            if (!whole) return;
        }
    }

    /// Straight to the relaxed state under the load. False where it was stopped.
    bool relax_free() {
        if (!searching_ && !relax_first()) return false;
        return scene_.drive.states == States::first || find_all_states();
    }

    bool relax_first() {
        if (!resumed_) {
            const double height = height_of_strongest_attraction(
                *block_, interface_, surface_.statistics.lowest, ranks_);
            block_->set_uniform(height - reference_height());
        }
        resumed_ = false;
        if (!find_state(setup_.simulation.drive.load_force)) {
            // Its displacements so far are the state to go on from.
            save_checkpoint();
            say_where_stopped();
            return false;
        }
        return true;
    }

    /// From the first state inwards. False where it was stopped.
    bool find_all_states() {
        if (!searching_) search_.start(*findings_.zero_load);
        searching_ = true;
        resumed_ = false;
        for (auto outcome = StateSearch::Outcome::point; outcome != StateSearch::Outcome::done;) {
            if (time_to_stop()) return false;
            const auto t = phases_.time(Phase::relax);
            outcome = search_.advance();
            findings_.states = search_.found();
            if (outcome == StateSearch::Outcome::interrupted) return stop_at_last_point();
        }
        search_.restore_first();
        searching_ = false;
        return true;
    }

    /// Point by point. False where it was stopped.
    bool follow_leg(Leg leg) {
        begin_leg(leg);
        while (!at_end_) {
            if (scene_.drive.max_steps > 0 && path_.now().step >= scene_.drive.max_steps) {
                stopped_ = "max_steps";
                if (setup_.effects.on(Effect::checkpoints)) save_checkpoint();
                return false;
            }
            if (time_to_stop()) return false;
            const auto t = phases_.time(Phase::relax);
            const QuasistaticPath::Outcome outcome = path_.advance(leg);
            if (outcome == QuasistaticPath::Outcome::interrupted) return stop_at_last_point();
            at_end_ = outcome != QuasistaticPath::Outcome::point;
            note_point(leg);
        }
        return conclude(leg);
    }

    void begin_leg(Leg leg) {
        leg_ = leg;
        if (std::exchange(resumed_, false)) return;
        if (part_ == 0)
            path_.start();
        else if (scene_.drive.path[part_ - 1] == PathPart::zero_load)
            path_.start_here();
        else
            return; // the path goes on from where it stands
        recorder_->row(path_.now(), leg == Leg::pull_off, scene_.surface.sites);
    }

    void note_point(Leg leg) {
        const StepRecord& now = path_.now();
        double& attraction =
            leg == Leg::approach ? findings_.attraction_in : findings_.attraction_out;
        attraction = std::max(attraction, -now.force);
        findings_.dissipated = path_.dissipation();
        recorder_->row(now, leg == Leg::pull_off, scene_.surface.sites);
        watch_fields(now.step, leg, -now.force, block_->lowest_layer(), interface_,
                     reference_height());
        if (progress_.due())
            progress_.update({fmt::format("{}, F = {:.1f} eV/Å", name(leg), now.force), now.step,
                              0.0, way_done(leg, now.top, interface_.start_height())});
    }

    /// What a leg has shown. False where it was stopped on the way to it.
    bool conclude(Leg leg) {
        const double area = scene_.edge() * scene_.edge();
        if (leg == Leg::pull_off) {
            findings_.pull_off = -units::milli_per_unit * path_.pull_off_work() / area;
            findings_.pull_off_uncertainty =
                units::milli_per_unit * path_.uncertainty(Leg::pull_off) / area;
            return true;
        }
        findings_.approach = units::milli_per_unit * path_.approach_work() / area;
        findings_.approach_uncertainty =
            units::milli_per_unit * path_.uncertainty(Leg::approach) / area;
        path_.put_back(); // as after a resume, to the same bits
        const bool found = find_state(0.0);
        path_.put_back();
        return found || stop_at_last_point();
    }

    bool stop_at_last_point() {
        save_checkpoint();
        say_where_stopped();
        return false;
    }

    /// The state under a load with the top plane free, from where the block is. False where it was
    /// stopped.
    bool find_state(double load) {
        const auto t = phases_.time(Phase::relax);
        recorder_->flush(); // to be looked at if no state is found
        findings_.zero_load = find_zero_load(*block_, interface_, reference_height(), load, scene_,
                                             setup_, [&](long long iteration, double residual) {
                                                 show_relaxation(progress_, iteration, residual);
                                                 return due() == Due::stop;
                                             });
        if (!findings_.zero_load) return false;
        if (scene_.writes_field("zero-load"))
            recorder_->fields("zero-load", block_->lowest_layer(), grid_, interface_,
                              reference_height());
        return true;
    }

    // What the frame asks.
    std::size_t bytes() const override { return block_->bytes() + interface_.bytes(); }
    double energy_residual() const override {
        return points() ? path_.now().residual : std::numeric_limits<double>::quiet_NaN();
    }
    Phases& phases() override { return phases_; }
    bool points() const { return path_.now().observed; }
    std::string position() const override {
        return searching_ ? fmt::format("point {} of the search for states",
                                        findings_.states ? findings_.states->points : 0)
               : points() ? fmt::format("point {}", path_.now().step)
                          : "an unfinished relaxation";
    }
    void complete(io::ResultRecord& r) const override {
        r.energy.kinetic = 0.0;
        r.run.steps = path_.now().step;
        if (points()) {
            const StepRecord& now = path_.now();
            r.run.iterations = path_.iterations();
            r.energy = {now.residual,         now.work,  0.0, now.elastic_energy,
                        now.interface_energy, now.damped};
        } else if (findings_.zero_load) {
            r.run.iterations =
                static_cast<long long>(findings_.zero_load->iterations) + search_.iterations();
            const double area = scene_.edge() * scene_.edge() / units::milli_per_unit;
            r.energy.elastic = findings_.zero_load->elastic * area;
            r.energy.interface = -findings_.zero_load->pairwise * area;
        }
    }

    // Checkpoints: the displacements, where on the path they stand, and what was found.
    struct Place {
        double top;
        std::size_t part;
        bool at_end, on_path, searching;
        template <class Visitor>
        void visit(Visitor& v) {
            v("top", top);
            v("part", part);
            v("at_end", at_end);
            v("on_path", on_path);
            v("searching", searching);
        }
    };
    void write_state(const std::string& path) override {
        CollectScalars collect;
        Place place{block_->top(), part_, at_end_, points(), searching_};
        place.visit(collect);
        if (place.on_path) path_.visit(collect);
        if (place.searching) search_.visit(collect);
        const RunScalars run = run_scalars();
        collect.values.insert(collect.values.end(), run.begin(), run.end());
        write_checkpoint(path, ranks_, grid_, arrays(place), collect.values, fingerprint_);
    }
    std::vector<StateArray> arrays(const Place& place) {
        return place.on_path     ? path_.states()
               : place.searching ? search_.states()
                                 : block_->state();
    }
    bool take_up() {
        const std::optional<std::string> from = checkpoint_to_take_up();
        if (!from) return false;
        const RunScalars scalars = read_checkpoint(*from, ranks_, grid_, {}, fingerprint_);
        RestoreScalars restore{scalars};
        Place place{};
        place.visit(restore);
        part_ = place.part;
        at_end_ = place.at_end;
        read_checkpoint(*from, ranks_, grid_, arrays(place), fingerprint_);
        if (place.on_path) {
            path_.visit(restore);
            path_.resume();
            findings_.dissipated = path_.dissipation();
        } else if (place.searching) {
            search_.visit(restore);
            search_.resume();
            searching_ = true;
        } else {
            block_->settle(Constraint::top(place.top));
        }
        restore_run({scalars.begin() + static_cast<std::ptrdiff_t>(restore.at), scalars.end()});
        resumed_ = true;
        progress_.say(fmt::format("going on from {} of {}", position(), *from));
        return true;
    }

    double reference_height() const { return interface_.start_height(); }
    PathOptions path_options() {
        PathOptions o;
        o.along =
            scene_.drive.hold == Hold::top ? Constraint::Of::top : Constraint::Of::mean_height;
        o.step = scene_.drive.step;
        o.tolerance = scene_.drive.tolerance;
        o.site_stiffness = relax_options(scene_, setup_).site_stiffness;
        o.load = setup_.simulation.drive.load_force;
        o.reference_height = interface_.start_height();
        o.report = [this](long long iteration, double) {
            if (progress_.due())
                progress_.update({fmt::format("{}, relaxing", name(leg_)), iteration, 0.0, -1.0});
            return due() == Due::stop;
        };
        return o;
    }

    StateSearchOptions search_options() {
        StateSearchOptions o;
        o.step = scene_.drive.step;
        o.tolerance = scene_.drive.tolerance;
        o.site_stiffness = relax_options(scene_, setup_).site_stiffness;
        o.load = setup_.simulation.drive.load_force;
        o.reference_height = interface_.start_height();
        o.area = scene_.edge() * scene_.edge();
        o.largest_tension = units::gigapascal * setup_.flat.largest_tension;
        o.report = [this](long long iteration, double) {
            if (progress_.due())
                progress_.update({fmt::format("{}, relaxing", position()), iteration, 0.0, -1.0});
            return due() == Due::stop;
        };
        o.relax_free = [this] {
            return find_zero_load(*block_, interface_, reference_height(),
                                  setup_.simulation.drive.load_force, scene_, setup_,
                                  search_options().report);
        };
        return o;
    }

    Interface interface_;
    std::unique_ptr<Equilibrium> block_;
    QuasistaticPath path_;
    StateSearch search_;
    Phases phases_;
    Leg leg_ = Leg::approach;
    std::size_t part_ = 0;   ///< of the path: the one under way
    bool at_end_ = false;    ///< it has come to its end and is to be concluded
    bool resumed_ = false;   ///< it goes on from a checkpoint
    bool searching_ = false; ///< for all states, the first being found
};

} // namespace

int run_equilibrium(const Scene& scene, const RunOptions& options,
                    const Communicator& communicator) {
    return EquilibriumRun(scene, options, communicator).go();
}

} // namespace asperity
