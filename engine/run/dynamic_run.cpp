// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The parts of the path one after the other in time: steps until the drive has come to its end;
// when the approach has ended, a copy of the block's lowest layer is relaxed under zero load.
#include "decomposition/global_largest.hpp"
#include "engine/dynamics/approach_start.hpp"
#include "engine/equilibrium/zero_load.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/guard.hpp"
#include "engine/run/run_record.hpp"
#include "engine/run/run_session.hpp"
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
          simulation_(c.simulation, run_.surface, ranks, run_.grid) {}

    int carry_out() {
        const std::size_t bytes = simulation_.block().bytes() + simulation_.interface().bytes();
        const auto work = [&] {
            if (!resume()) start();
            integrate();
            name_fields_left();
            run_.maps.write_kept(simulation_.interface(), run_.recorder());
        };
        return run_.carry_out(bytes, work, [&](io::Result& result) { add_to(result); });
    }

    /// Where the loop stands, for checkpoints.
    template <class Visitor>
    void visit(Visitor& v) {
        v("ended", ended_);
        v("concluding", concluding_);
        v("start", start_);
        v("kinetic_at_start", kinetic_at_start_);
        v("turn", turn_);
    }

private:
    /// A warm block starts where nothing is in reach: the way down is what warms it.
    void start() {
        start_.height = simulation_.interface().start_height();
        if (scene_.drive.temperature == 0.0)
            start_ = approach_start(simulation_.block_to_write(), simulation_.interface());
        simulation_.start(start_.height);
    }

    /// The loop over time: step, guard, record, tell the drive; a leg that has ended is concluded
    /// one step later.
    void integrate() {
        for (;;) {
            if (concluding_) {
                if (!conclude(*concluding_)) return;
                concluding_.reset();
            }
            if (!ended_ && simulation_.drive().done()) return;
            if (!ended_ && scene_.drive.max_steps > 0 &&
                simulation_.steps() >= scene_.drive.max_steps) {
                run_.stop_at_max_steps();
                run_.save_if_on(state_writer());
                return;
            }
            if (run_.look_is_due() && run_.stop_here(state_writer(), position())) return;
            const auto frame = begin_frame();
            // The step after a leg and the last of all are observed, so that the guard has seen the
            // energy balance before anything is concluded.
            const bool due = simulation_.steps() % scene_.output.series == 0;
            const StepRecord& now = simulation_.step(due || ended_ || next_step_is_last());
            if (now.step == 0) kinetic_at_start_ = now.kinetic_energy;
            guard(now);
            if (frame) end_frame(*frame);
            if (now.observed) record_row();
            watch_step(now);
            if (ended_)
                concluding_ = std::exchange(ended_, std::nullopt);
            else
                ended_ = follow_drive(now);
            write_delayed_fields(now.time);
            if (run_.progress.due()) run_.progress.update(progress_state(now));
        }
    }

    bool next_step_is_last() const {
        return scene_.drive.max_steps > 0 && simulation_.steps() + 1 >= scene_.drive.max_steps;
    }
    bool frame_is_due() const {
        return scene_.output.trajectory && simulation_.steps() % *scene_.output.trajectory == 0;
    }

    /// Tells the drive what the step felt. The leg that ended with it, if one did.
    std::optional<Leg> follow_drive(const StepRecord& now) {
        const Leg leg = simulation_.leg();
        double& attraction =
            leg == Leg::approach ? run_.findings.attraction_in : run_.findings.attraction_out;
        attraction = std::max(attraction, -now.force);
        const double strongest =
            std::max(run_.findings.attraction_in, run_.findings.attraction_out);
        const bool gone = out_of_reach(now.top, now.force, strongest, start_.force);
        if (!simulation_.drive().observe(now.time, now.force, gone)) return std::nullopt;
        if (leg == Leg::approach) {
            require_load_reached(simulation_.options().drive.load_force, attraction, 0.0,
                                 case_.area());
            run_.findings.contact_made = now.time;
        }
        return leg;
    }

    /// Maps that are due so long after the approach has ended.
    void write_delayed_fields(double time) {
        while (!delayed_fields_.empty() && is_due(delayed_fields_.front().first, time)) {
            const auto t = run_.phases.time(Phase::output);
            run_.recorder().fields(delayed_fields_.front().second,
                                   simulation_.block().lowest_layer(), run_.grid,
                                   simulation_.interface(), simulation_.reference_height());
            delayed_fields_.erase(delayed_fields_.begin());
        }
    }
    /// The path can end before they are due.
    void name_fields_left() {
        if (!simulation_.drive().done()) return;
        for (const auto& [delay, name] : delayed_fields_)
            run_.progress.say(
                fmt::format("the maps \"{}\" were not written: the path ended before", name));
    }
    bool is_due(double delay, double time) const { // ps, fs
        return run_.findings.contact_made &&
               time >= *run_.findings.contact_made + delay * units::picosecond;
    }

    /// What a leg has shown. False: stopped on the way to it.
    bool conclude(Leg leg) {
        if (leg == Leg::pull_off) {
            conclude_pull_off();
            return true;
        }
        if (case_.on(Effect::relaxation)) {
            // The block is not touched: a run that is stopped here starts the relaxation again.
            run_.save_if_on(state_writer());
            run_.progress.say("contact is made; relaxing a copy of its lowest layer under no load");
            if (!find_state()) {
                run_.stop_now(state_writer(), position());
                return false;
            }
        }
        conclude_approach();
        if (!simulation_.drive().done()) run_.progress.say("pull-off begins");
        return true;
    }

    // The path is taken from rest to rest, out of reach: the drive also sets the block in motion
    // before the first step and stops it after the last, and brings it in and out as a rigid body
    // where what binds it then is the interface's energy.

    void conclude_approach() {
        LegEnergies& in = run_.findings.approach;
        turn_ = account();
        in.interface_work = per_area_ * (simulation_.ledger().approach - start_.energy);
        in.drive_work = -per_area_ * (turn_.drive_work + start_.energy + kinetic_at_start_);
        if (reaches_the_state())
            in.lost =
                per_area_ * (turn_.lost + turn_.energy) + run_.findings.zero_load->binding_energy;
    }
    void conclude_pull_off() {
        Findings& found = run_.findings;
        const double bound = simulation_.now().interface_energy;
        const Account end = account();
        found.pull_off.interface_work = -per_area_ * (simulation_.ledger().pull_off + bound);
        found.pull_off.drive_work =
            per_area_ * (end.drive_work - turn_.drive_work - bound - kinetic_at_start_);
        if (scene_.drive.temperature > 0.0) return; // heat goes both ways
        found.lost_in_cycle = per_area_ * (end.lost + end.energy - bound - kinetic_at_start_);
        if (reaches_the_state()) found.pull_off.lost = *found.lost_in_cycle - *found.approach.lost;
    }
    /// The approach ends, but for vibrations, in the state at zero load.
    bool reaches_the_state() const {
        return run_.findings.zero_load && scene_.drive.temperature == 0.0 &&
               scene_.drive.load == 0.0;
    }

    /// At an observed step, eV.
    struct Account {
        double drive_work = 0.0; ///< of the top plane and the damping medium, which move alike
        double lost = 0.0;       ///< damped, or taken by absorbing seams
        double energy = 0.0;     ///< kinetic, elastic and of the interface

        template <class Visitor>
        void visit(Visitor& v) {
            v("drive_work", drive_work);
            v("lost", lost);
            v("energy", energy);
        }
    };
    Account account() const {
        const StepRecord& now = simulation_.now();
        const Ledger& ledger = simulation_.ledger();
        return {ledger.top_work + ledger.drag_work, ledger.lost(),
                now.interface_energy + now.elastic_energy + now.kinetic_energy};
    }

    /// False: stopped before the state was found.
    bool find_state() {
        const auto t = run_.phases.time(Phase::relax);
        const double height = simulation_.reference_height();
        const LayerAtRest found =
            bring_to_rest(simulation_.block(), run_.surface, height, case_,
                          [&](long long iteration, double residual) {
                              show_relaxation(run_.progress, iteration, residual);
                              return run_.stop_relaxation();
                          });
        if (!found.numbers) return false;
        run_.findings.zero_load = found.numbers;
        if (case_.maps.zero_load)
            run_.recorder().fields("zero-load", std::as_const(found.layer).view()[0], run_.grid,
                                   simulation_.interface(), height);
        return true;
    }

    void guard(const StepRecord& now) {
        const auto wrong = violation(now, run_.lowest_height(), fmt::format("step {}", now.step));
        if (!wrong) return;
        failed_ = now; // what follows puts the simulation back
        const std::string where = fastest_site();
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
        const double limit = case_.longest_timestep;
        throw io::PhysicsError(
            *wrong,
            fmt::format("{}; drive.timestep = {:.4g} fs is stable up to {:.4g} fs in an unloaded "
                        "contact, and less "
                        "where atoms are pressed into the wall or hit it fast",
                        where, scene_.drive.timestep, limit),
            fmt::format("start again with a smaller drive.timestep (for example {:.2g} fs) or "
                        "drive.velocity; {}",
                        std::min(0.5 * scene_.drive.timestep, 0.2 * limit), kept));
    }

    /// The site of the lowest layer with the largest velocity, which may be infinite or no number.
    std::string fastest_site() {
        const auto& level = simulation_.block().levels().front();
        const auto v = level.v.view()[0];
        const LargestSite fastest = global_largest(run_.ranks, level.tile, [&](int x, int y) {
            return std::sqrt(v.x(x, y) * v.x(x, y) + v.y(x, y) * v.y(x, y) + v.z(x, y) * v.z(x, y));
        });
        return fmt::format("site ({}, {}) moves at {:.3g} m/s", fastest.x, fastest.y,
                           fastest.value / units::metre_per_second);
    }

    void record_row() {
        const auto t = run_.phases.time(Phase::output);
        const bool keep = run_.recorder().rows() % rows_between_snapshots == 0;
        const bool pulling = simulation_.leg() == Leg::pull_off ||
                             (simulation_.leg() == Leg::done && scene_.has(PathPart::pull_off));
        run_.recorder().row(simulation_.now(), pulling, scene_.surface.sites);
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

    /// The block is a step further than what was observed: no more than it moves in one.
    void watch_step(const StepRecord& now) {
        if (!run_.maps.any()) return;
        if (!now.observed && !run_.maps.due(now.step)) return;
        const auto t = run_.phases.time(Phase::output);
        run_.maps.watch(now.step, simulation_.leg(), now.observed ? -now.force : 0.0,
                        simulation_.block().lowest_layer(), simulation_.interface(),
                        simulation_.reference_height(), run_.recorder());
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
        restore("loop", *this);
        run_.restore(restore);
        run_.open_recorder();
        std::erase_if(delayed_fields_, [&](const auto& field) { // written before it stopped
            return is_due(field.first, simulation_.now().time);
        });
        run_.progress.say(
            fmt::format("going on from step {} of {}", simulation_.steps(), place->path()));
        return true;
    }

    RunSession::WriteState state_writer() {
        return [&](const io::FilePlace& place) {
            CollectNumbers collect;
            collect("loop", *this);
            run_.collect(collect);
            write_checkpoint(place, simulation_, collect, run_.fingerprint(), run_.maps.arrays());
        };
    }
    std::string position() const { return fmt::format("step {}", simulation_.steps()); }

    io::Progress::State progress_state(const StepRecord& now) const {
        return {fmt::format("{}, F = {:.1f} eV/Å", name(simulation_.leg()), now.force),
                simulation_.steps(), now.time,
                run_.way_done(simulation_.leg(), now.top, simulation_.reference_height())};
    }

    /// Steps and energies.
    void add_to(io::Result& result) const {
        add_phases(simulation_.phases(), result);
        const StepRecord& now = failed_ ? *failed_ : simulation_.now();
        result.set("run.steps", failed_ ? failed_->step : simulation_.steps());
        result.set("run.device", describe_device(case_.simulation.device));
        if (simulation_.steps() == 0) return;
        add_energies(now, result);
        if (case_.on(Effect::seams)) result.set("energy.radiated", now.radiated);
    }

    RunSession run_;
    const Case& case_;
    const Scene& scene_ = case_.scene;
    Simulation simulation_;
    const double per_area_ = units::milli_per_unit / (case_.area());
    ApproachStart start_;
    double kinetic_at_start_ = 0.0;    ///< of the block moving with the drive, eV
    Account turn_;                     ///< where the approach ended
    std::optional<StepRecord> failed_; ///< the step that a guard ended the run at
    std::optional<Leg> ended_;         ///< the leg that the last step ended
    std::optional<Leg> concluding_;    ///< the leg that ended the step before
    std::vector<std::pair<double, std::string>> delayed_fields_ = case_.maps.after_zero_load;
    Snapshot snapshot_;
    CollectNumbers snapshot_numbers_;
};

} // namespace

int run_in_time(const Case& c, const RunOptions& options, const Communicator& communicator) {
    return DynamicRun(c, options, communicator).carry_out();
}

} // namespace asperity
