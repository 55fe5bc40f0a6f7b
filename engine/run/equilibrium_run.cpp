// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The segments of the path one after the other: "relax" is one relaxation with the top plane
// free, the others are points of a quasi-static path, until the path says that it is there.
#include "engine/equilibrium/quasistatic.hpp"
#include "engine/equilibrium/zero_load.hpp"
#include "engine/interface/flat_reference.hpp"
#include "engine/run/guard.hpp"
#include "engine/run/ledger.hpp"
#include "engine/run/run_record.hpp"
#include "engine/run/run_session.hpp"
#include "engine/run/summary.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace asperity {

namespace {

class EquilibriumRun {
public:
    EquilibriumRun(const Case& c, const RunOptions& options, const Communicator& ranks)
        : run_(c, options, ranks), case_(c),
          interface_(run_.surface, run_.grid.tile(0), c.scene.surface.spacing,
                     c.simulation.interface),
          block_(c.simulation.block, ranks, c.scene.interface.frictionless),
          path_(block_, interface_, path_options(c, interface_, report())) {}

    int carry_out() {
        const auto work = [&] {
            resume();
            run_.open_recorder();
            follow_path();
            run_.maps.write_kept(interface_, run_.recorder());
        };
        return run_.carry_out(block_.bytes() + interface_.bytes(), work,
                              [&](io::Result& result) { add_to(result); });
    }

private:
    void follow_path() {
        for (; segment_ < case_.path.size(); ++segment_, at_end_ = false) {
            const bool whole = now().kind == Segment::relax ? relax_free() : follow_segment();
            if (!whole) return;
        }
    }
    /// The segment under way; of the case, with its amount in the units of the scene.
    const Segment& now() const { return case_.path[segment_]; }

    /// Straight to the relaxed state under the load. False where it was stopped.
    bool relax_free() {
        if (!resumed_) {
            const double height = height_of_strongest_attraction(
                block_, interface_, run_.surface.statistics.lowest, case_.scales.length);
            block_.set_uniform(height - reference_height());
        }
        resumed_ = false;
        // Its displacements so far are the state to resume from.
        if (!find_state(case_.simulation.drive.load_force, state_writer())) {
            run_.stop_now(state_writer(), position());
            return false;
        }
        return true;
    }

    /// Point by point. False where it was stopped.
    bool follow_segment() {
        begin_segment();
        while (!at_end_) {
            if (scene_.drive.max_steps > 0 && path_.now().step >= scene_.drive.max_steps) {
                run_.stop_at_max_steps();
                run_.save_if_on(state_writer());
                return false;
            }
            if (run_.stop_here(state_writer(), position())) return false;
            const auto t = run_.phases.time(Phase::relax);
            const long long before = path_.now().step;
            const QuasistaticPath::Outcome outcome = path_.advance();
            if (outcome == QuasistaticPath::Outcome::interrupted) return stop_at_last_point();
            at_end_ = outcome != QuasistaticPath::Outcome::point;
            if (path_.now().step > before) note_point();
            guard();
        }
        return conclude();
    }

    void begin_segment() {
        if (std::exchange(resumed_, false)) return;
        const bool first = segment_ == 0;
        const bool from_state = !first && case_.path[segment_ - 1].kind == Segment::relax;
        if (first) path_.start();
        if (from_state) path_.start_here(true);
        path_.begin(case_.simulation.drive.path[segment_], segment_);
        if (first || from_state) run_.recorder().row(path_.now(), segment_, scene_.surface.sites);
    }

    void note_point() {
        const StepRecord& point = path_.now();
        run_.results.feel(now(), point);
        run_.results.dissipated = path_.dissipation();
        run_.recorder().row(point, segment_, scene_.surface.sites);
        run_.maps.watch(point.step, now().kind, -point.force, block_.lowest_layer(), interface_,
                        reference_height(), run_.recorder());
        if (run_.progress.due()) run_.progress.update(path_progress());
    }

    void guard() const {
        const auto wrong = violation(path_.now(), run_.lowest_height(), position());
        if (!wrong) return;
        throw io::PhysicsError(
            *wrong,
            "steps that are too long or instabilities that were not resolved miss energy, and "
            "what they miss adds up",
            "take a smaller drive.displacement_step");
    }

    /// Of the last point; its steps are iterations.
    io::Progress::State path_progress() const {
        const auto& at = path_.now();
        return {progress_phase(case_, now().text, at.force, at.in_contact, at.mean_height),
                path_.iterations(), 0.0,
                run_.way_done(segment_, path_.now().top, interface_.start_height())};
    }

    /// What a segment has come to. False where it was stopped on the way to it.
    bool conclude() {
        const Segment::Kind kind = now().kind;
        if (kind == Segment::approach) {
            require_load_reached(case_.simulation.drive.load_force, run_.results.attraction_in,
                                 path_.slack(), case_.area());
            path_.put_back(); // as after a resume, with bitwise identical results
            const bool found = find_state(0.0);
            path_.put_back();
            if (!found) return stop_at_last_point();
        }
        Works works{.on_solids = path_.work(),
                    .lateral = kind == Segment::slide ? path_.work() : 0.0,
                    .lost = path_.dissipation().in_segment,
                    .interface = {},
                    .uncertainty = path_.uncertainty()};
        // A held mean height does not jump: the holder's force is that of the interface.
        if (scene_.drive.control == Control::mean_height)
            works.interface = kind == Segment::slide ? 0.0 : -path_.work();
        ledger_.conclude(segment_, path_.now(), works, {});
        if (case_.maps.segments)
            run_.recorder().fields(fmt::format("segment-{}", segment_), block_.lowest_layer(),
                                   run_.grid, interface_, reference_height());
        return true;
    }
    bool stop_at_last_point() {
        run_.stop_now(state_writer(), position());
        return false;
    }

    /// The state under a load with the top plane free, from where the block is. write: of the state
    /// it has come to, where it can be resumed from that. False where it was stopped.
    bool find_state(double load, const RunSession::WriteState& write = {}) {
        const auto t = run_.phases.time(Phase::relax);
        const auto state = find_zero_load(block_, interface_, reference_height(), load, case_,
                                          [&](long long iteration, double residual) {
                                              show_relaxation(run_.progress, iteration, residual);
                                              return run_.stop_relaxation(write);
                                          });
        if (!state) return false;
        // A path that starts in a state comes back to another; its numbers are of the first.
        if (!run_.results.zero_load || !case_.starts_with(Segment::relax))
            run_.results.zero_load = state;
        if (case_.maps.relaxed)
            run_.recorder().fields("relaxed", block_.lowest_layer(), run_.grid, interface_,
                                   reference_height());
        return true;
    }

    bool points() const { return path_.now().observed; }
    std::string position() const {
        return points() ? fmt::format("point {}", path_.now().step) : "an unfinished relaxation";
    }
    /// Points and energies.
    void add_to(io::Result& result) const {
        result.set("run.steps", path_.now().step);
        if (points()) {
            result.set("run.iterations", path_.iterations());
            add_energies(path_.now(), result);
        } else {
            result.set("energy.kinetic", 0.0);
            if (!run_.results.zero_load) return;
            const ZeroLoad& z = *run_.results.zero_load;
            const double area = case_.area() / units::milli_per_unit;
            result.set("run.iterations", static_cast<long long>(z.iterations));
            result.set("energy.elastic", z.elastic * area);
            result.set("energy.interface", -z.pairwise * area);
        }
    }

    // Checkpoints: the displacements, where on the path they stand, and what was
    // found.
    struct Place {
        double top;
        std::size_t segment;
        bool at_end, on_path;
        template <class Visitor>
        void visit(Visitor& v) {
            v("top", top);
            v("segment", segment);
            v("at_end", at_end);
            v("on_path", on_path);
        }
    };
    RunSession::WriteState state_writer() {
        return [&](const io::FilePlace& file) { write_state(file); };
    }
    void write_state(const io::FilePlace& file) {
        CollectNumbers collect;
        Place place{block_.top(), segment_, at_end_, points()};
        collect("place", place);
        collect("ledger", ledger_);
        if (place.on_path) collect("path", path_);
        run_.collect(collect);
        write_checkpoint(file, run_.ranks, run_.grid, arrays(place), collect.numbers,
                         run_.fingerprint());
    }
    std::vector<StateArray> arrays(const Place& place) {
        std::vector<StateArray> list = place.on_path ? path_.states() : state_of(block_);
        for (const StateArray& array : run_.maps.arrays())
            list.push_back(array);
        return list;
    }
    void resume() {
        const std::optional<io::FilePlace> from = run_.checkpoint_to_resume();
        if (!from) return;
        const StateNumbers numbers =
            read_checkpoint(*from, run_.ranks, run_.grid, {}, run_.fingerprint());
        RestoreNumbers restore(numbers);
        Place place{};
        restore("place", place);
        segment_ = place.segment;
        at_end_ = place.at_end;
        read_checkpoint(*from, run_.ranks, run_.grid, arrays(place), run_.fingerprint());
        restore("ledger", ledger_);
        if (place.on_path) {
            restore("path", path_);
            path_.resume();
            run_.results.dissipated = path_.dissipation();
        }
        if (!place.on_path) block_.apply_constraint(Constraint::top(place.top));
        run_.restore(restore);
        resumed_ = true;
        run_.progress.say(fmt::format("going on from {} of {}", position(), from->path()));
    }

    double reference_height() const { return interface_.start_height(); }
    /// Told of the iterations of a point: shows them, and asks whether to stop.
    std::function<bool(long long, double)> report() {
        return [this](long long iteration, double) {
            if (run_.progress.due()) {
                io::Progress::State now = path_progress();
                now.phase += ", relaxing";
                now.steps += iteration;
                run_.progress.update(now);
            }
            return run_.stop_relaxation();
        };
    }

    RunSession run_;
    const Case& case_;
    const Scene& scene_ = case_.scene;
    Interface interface_;
    SpectralBlock block_;
    QuasistaticPath path_;
    Ledger ledger_{case_, run_.results};
    std::size_t segment_ = 0; ///< number of the one under way
    bool at_end_ = false;     ///< it has come to its end and is to be concluded
    bool resumed_ = false;    ///< it goes on from a checkpoint
};

} // namespace

int run_equilibrium(const Case& c, const RunOptions& options, const Communicator& communicator) {
    return EquilibriumRun(c, options, communicator).carry_out();
}

} // namespace asperity
