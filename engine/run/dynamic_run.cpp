// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The parts of the path one after the other, dynamic: steps until the drive has come to its end;
// when the approach has ended, a copy of the block's lowest layer is relaxed under zero load.
#include "engine/device/device_block.hpp"
#include "engine/equilibrium/zero_load.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/driven_path.hpp"
#include "engine/run/guard.hpp"
#include "engine/run/run_record.hpp"
#include "engine/run/run_session.hpp"
#include "engine/run/summary.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity {

namespace {

/// Observed steps between two states kept in memory for the guard.
constexpr long long rows_between_snapshots = 10;

class DynamicRun {
public:
    DynamicRun(const Case& c, const RunOptions& options, const Communicator& ranks)
        : run_(c, options, ranks), case_(c),
          simulation_(c.simulation, run_.surface, ranks, run_.grid),
          path_(c, simulation_, run_.results) {
        if (run_.maps.any() || !delayed_fields_.empty() || c.maps.segments)
            layer_ = VectorField<double>(run_.grid.tile(0), 1);
    }

    int carry_out() {
        const std::size_t bytes = simulation_.block().bytes() + simulation_.interface().bytes();
        const auto work = [&] {
            if (!resume()) path_.start();
            integrate();
            name_fields_left();
            run_.maps.write_kept(simulation_.interface(), run_.recorder());
        };
        return run_.carry_out(bytes, work, [&](io::Result& result) { add_to(result); });
    }

private:
    /// The loop over time: step, guard, record, tell the drive; a segment that has ended is
    /// concluded one step later.
    void integrate() {
        for (;;) {
            if (path_.to_conclude() && !conclude(*path_.to_conclude())) return;
            if (path_.over()) return;
            if (!path_.must_observe() && scene_.drive.max_steps > 0 &&
                simulation_.steps() >= scene_.drive.max_steps) {
                run_.stop_at_max_steps();
                run_.save_if_on(state_writer());
                return;
            }
            if (run_.look_is_due() && run_.stop_here(state_writer(), position())) return;
            const auto frame = begin_frame();
            // The step after a segment and the last of all are observed, so that the guard has seen
            // the energy balance before anything is concluded.
            const bool due = simulation_.steps() % scene_.output.series == 0;
            const bool observed = due || path_.must_observe() || next_step_is_last();
            keep_layer(observed);
            const StepRecord& now = simulation_.step(observed);
            guard(now);
            if (frame) end_frame(*frame);
            if (now.observed) record_row();
            watch_step(now);
            write_delayed_fields(now.time);
            path_.follow(now);
            if (path_.to_conclude() && case_.maps.segments)
                write_maps(fmt::format("segment-{}", *path_.to_conclude()));
            if (run_.progress.due()) run_.progress.update(progress_state(now));
        }
    }

    bool next_step_is_last() const {
        return scene_.drive.max_steps > 0 && simulation_.steps() + 1 >= scene_.drive.max_steps;
    }
    bool frame_is_due() const {
        return scene_.output.trajectory && simulation_.steps() % *scene_.output.trajectory == 0;
    }

    /// Before a step that maps may be written of: after it the block is at the next one, while the
    /// interface and what was summed up are at this one.
    void keep_layer(bool observed) {
        const Segment::Kind kind = simulation_.drive().now().kind;
        const bool kept = (case_.maps.pull_off && observed && kind == Segment::pull_off) ||
                          run_.maps.due(simulation_.steps()) ||
                          delayed_field_is_due(simulation_.time()) ||
                          (case_.maps.segments && path_.must_observe());
        if (!kept) return;
        const auto t = run_.phases.time(Phase::output);
        copy_layer(simulation_.block().lowest_layer(), layer_.plane(0));
    }
    VectorPlane<const double> layer() const { return layer_.plane(0); }
    void write_maps(const std::string& state) {
        const auto t = run_.phases.time(Phase::output);
        run_.recorder().fields(state, layer(), run_.grid, simulation_.interface(),
                               simulation_.reference_height());
    }

    /// Maps that are due so long after the approach has ended.
    void write_delayed_fields(double time) {
        while (delayed_field_is_due(time)) {
            write_maps(delayed_fields_.front().second);
            delayed_fields_.erase(delayed_fields_.begin());
            ++delayed_written_;
        }
    }
    /// The path can end before they are due.
    void name_fields_left() {
        if (!simulation_.drive().done()) return;
        for (const auto& [delay, name] : delayed_fields_)
            run_.progress.say(
                fmt::format("the maps \"{}\" were not written: the path ended before", name));
    }
    bool delayed_field_is_due(double time) const { // fs
        return !delayed_fields_.empty() && run_.results.contact_made &&
               time >=
                   *run_.results.contact_made + delayed_fields_.front().first * units::picosecond;
    }

    /// What a segment has come to. False: stopped on the way to it.
    bool conclude(std::size_t number) {
        const Segment& segment = case_.path[number];
        if (segment.kind == Segment::approach && case_.effects.relaxation) {
            // The block is not touched: a run that is stopped here starts the relaxation again.
            run_.save_if_on(state_writer());
            run_.progress.say("contact is made; relaxing a copy of its lowest layer under no load");
            if (!find_state()) {
                run_.stop_now(state_writer(), position());
                return false;
            }
        }
        path_.conclude(number);
        if (!simulation_.drive().done())
            run_.progress.say(simulation_.drive().now().text + " begins");
        return true;
    }

    /// False: stopped before the state was found.
    bool find_state() {
        const auto t = run_.phases.time(Phase::relax);
        const double height = simulation_.reference_height();
        const LayerAtRest found = bring_to_rest(
            simulation_.block(), run_.surface, height, case_,
            [&](long long iteration, double residual) {
                show_relaxation(run_.progress, iteration, residual);
                return run_.stop_relaxation();
            },
            simulation_.now().slide);
        if (!found.numbers) return false;
        run_.results.zero_load = found.numbers;
        if (case_.maps.relaxed)
            run_.recorder().fields("relaxed", std::as_const(found.layer).view()[0], run_.grid,
                                   simulation_.interface(), height);
        return true;
    }

    void guard(const StepRecord& now) {
        const auto wrong = violation(now, run_.lowest_height(), fmt::format("step {}", now.step));
        if (!wrong) return;
        failed_ = now; // what follows puts the simulation back
        const std::string where = fastest_site(simulation_);
        std::string kept = "no earlier state was kept";
        if (!snapshot_.empty()) {
            snapshot_.restore(simulation_);
            const char* file = "last-good.h5";
            try {
                write_checkpoint(run_.file(file), simulation_, snapshot_numbers_,
                                 run_.fingerprint());
                kept =
                    fmt::format("the last good state, step {}, is in {}", snapshot_.step(), file);
            } catch (const std::exception&) { // a full disk must not hide what happened
                kept = "the last good state could not be written";
            }
        }
        throw step_failed(*wrong, where, case_, kept);
    }

    void record_row() {
        const auto t = run_.phases.time(Phase::output);
        const bool keep = run_.recorder().rows() % rows_between_snapshots == 0;
        run_.recorder().row(simulation_.now(), simulation_.drive().segment(), scene_.surface.sites);
        if (!keep) return;
        snapshot_.take(simulation_);
        snapshot_numbers_ = {};
        run_.collect(snapshot_numbers_);
    }

    /// Of the positions that the next step starts from, if one is due; else nothing.
    std::optional<Recorder::Frame> begin_frame() {
        if (!frame_is_due()) return std::nullopt;
        const auto t = run_.phases.time(Phase::output);
        return run_.recorder().begin_frame(simulation_, scene_.output.velocities);
    }
    void end_frame(const Recorder::Frame& frame) {
        const auto t = run_.phases.time(Phase::output);
        run_.recorder().end_frame(frame, simulation_);
    }

    void watch_step(const StepRecord& now) {
        if (!run_.maps.any()) return;
        if (!now.observed && !run_.maps.due(now.step)) return;
        const auto t = run_.phases.time(Phase::output);
        run_.maps.watch(now.step, simulation_.drive().now().kind, now.observed ? -now.force : 0.0,
                        layer(), simulation_.interface(), simulation_.reference_height(),
                        run_.recorder());
    }

    /// Goes on from a checkpoint if asked. True if it did.
    bool resume() {
        const std::optional<io::FilePlace> place = run_.checkpoint_to_resume();
        if (!place) {
            run_.open_recorder();
            return false;
        }
        const StateNumbers numbers =
            read_checkpoint(*place, simulation_, run_.fingerprint(), run_.maps.arrays());
        RestoreNumbers restore(numbers);
        restore("loop", path_);
        restore("delayed_written", delayed_written_);
        run_.restore(restore);
        run_.open_recorder();
        const auto written = std::min(delayed_written_, delayed_fields_.size());
        delayed_fields_.erase(delayed_fields_.begin(),
                              delayed_fields_.begin() + static_cast<std::ptrdiff_t>(written));
        run_.progress.say(
            fmt::format("going on from step {} of {}", simulation_.steps(), place->path()));
        return true;
    }

    RunSession::WriteState state_writer() {
        return [&](const io::FilePlace& place) {
            CollectNumbers collect;
            collect("loop", path_);
            collect("delayed_written", delayed_written_);
            run_.collect(collect);
            write_checkpoint(place, simulation_, collect, run_.fingerprint(), run_.maps.arrays());
        };
    }
    std::string position() const { return fmt::format("step {}", simulation_.steps()); }

    io::Progress::State progress_state(const StepRecord& now) const {
        const Drive& drive = simulation_.drive();
        return {progress_phase(case_, drive.now().text, now.force, now.in_contact, now.mean_height),
                simulation_.steps(), now.time,
                run_.way_done(drive.segment(), now.top, simulation_.reference_height())};
    }

    /// Steps and energies.
    void add_to(io::Result& result) const {
        add_phases(simulation_.phases(), result);
        const StepRecord& now = failed_ ? *failed_ : simulation_.now();
        result.set("run.steps", failed_ ? failed_->step : simulation_.steps());
        result.set("run.device", describe_device(case_.simulation.device));
        if (simulation_.steps() == 0) return;
        add_energies(now, result);
    }

    RunSession run_;
    const Case& case_;
    const Scene& scene_ = case_.scene;
    Simulation simulation_;
    DrivenPath path_;
    std::optional<StepRecord> failed_; ///< the step that a guard ended the run at
    std::vector<std::pair<double, std::string>> delayed_fields_ = case_.maps.after_approach;
    std::size_t delayed_written_ = 0; ///< of these, the first
    VectorField<double> layer_;       ///< the lowest one, at the step of the record
    Snapshot snapshot_;
    CollectNumbers snapshot_numbers_;
};

} // namespace

int run_in_time(const Case& c, const RunOptions& options, const Communicator& communicator) {
    return DynamicRun(c, options, communicator).carry_out();
}

} // namespace asperity
