// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A run in time: follow the path step by step, relax the zero-load state, tell what was found. What
// every run has is run_frame.cpp; runs without a path in time are equilibrium_run.cpp.
#include "engine/run/run.hpp"

#include "decomposition/global_largest.hpp"
#include "engine/equilibrium/equilibrium.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/equilibrium_run.hpp"
#include "engine/run/run_frame.hpp"
#include "engine/setup/memory.hpp"
#include "engine/units.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <optional>
#include <utility>

namespace asperity {

namespace {

/// Largest relative error of the energy balance that counts as physics.
constexpr double energy_limit = 0.02;
/// Observed steps between two states kept in memory for the guard.
constexpr long long rows_between_snapshots = 10;

class DynamicRun final : public RunFrame {
public:
    DynamicRun(const Scene& scene, const RunOptions& options, const Communicator& ranks)
        : RunFrame(scene, options, ranks), simulation_(setup_.simulation, surface_, ranks, grid_) {}

private:
    std::size_t bytes() const override {
        return simulation_.block().bytes() + simulation_.interface().bytes();
    }
    double energy_residual() const override { return simulation_.energy_residual(); }
    Phases& phases() override { return simulation_.phases(); }
    std::string position() const override { return fmt::format("step {}", simulation_.steps()); }
    void write_state(const std::string& path) override {
        write_checkpoint(path, simulation_, run_scalars(), fingerprint_);
    }
    void complete(io::ResultRecord& r) const override {
        r.run.steps = simulation_.steps();
        r.extra.emplace_back("run.device", describe_device(setup_.simulation.device));
        if (simulation_.steps() == 0) return;
        const StepRecord& now = simulation_.now(); // energies of the last observed step
        r.energy = {now.residual,         now.work,  now.kinetic_energy, now.elastic_energy,
                    now.interface_energy, now.damped};
    }

    void follow() override {
        const bool taken_up = take_up();
        open_recorder(taken_up);
        if (!taken_up) simulation_.start(simulation_.interface().start_height());
        if (scene_.output.trajectory)
            recorder_->begin_trajectory(simulation_, scene_.output.velocities);
        march();
    }

    /// The loop over time: step, guard, record, tell the drive; a leg that has ended is concluded
    /// one step later.
    void march() {
        std::optional<Leg> ended; // the leg that the last step ended
        while (ended || !simulation_.drive().done()) {
            const bool due = simulation_.steps() % scene_.output.series == 0;
            const bool last = next_step_is_last();
            if (due && !ended && time_to_stop()) return;
            if (frame_is_due()) record_frame();
            // The step after a leg and the last of all are observed, so that the guard has seen the
            // energy balance before anything is concluded.
            const StepRecord& now = simulation_.step(due || ended || last);
            guard(now);
            if (now.observed) record_row();
            watch_step(now);
            if (ended)
                conclude(*std::exchange(ended, std::nullopt));
            else
                ended = follow_drive(now);
            if (!delayed_fields_.empty()) write_delayed_fields(now.time);
            if (progress_.due()) progress_.update(progress_state(now));
            if (last && !ended) {
                stopped_ = "max_steps";
                if (setup_.effects.on(Effect::checkpoints)) save_checkpoint();
                return;
            }
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
            leg == Leg::approach ? findings_.attraction_in : findings_.attraction_out;
        attraction = std::max(attraction, -now.force);
        const double strongest = std::max(findings_.attraction_in, findings_.attraction_out);
        const bool gone = now.top >= 0.0 && std::abs(now.force) <= 1e-6 * strongest;
        if (!simulation_.drive().observe(now.time, now.force, gone)) return std::nullopt;
        if (leg == Leg::approach) findings_.contact_made = now.time;
        return leg;
    }

    /// Maps that are due so long after the approach has ended.
    void write_delayed_fields(double time) {
        const auto& [delay, field] = delayed_fields_.front();
        if (!is_due(delay, time)) return;
        const auto t = simulation_.phases().time(Phase::output);
        recorder_->fields(field, std::as_const(simulation_).block().lowest_layer(), grid_,
                          simulation_.interface(), simulation_.reference_height());
        delayed_fields_.erase(delayed_fields_.begin());
    }
    bool is_due(double delay, double time) const { // ps, fs
        return findings_.contact_made &&
               time >= *findings_.contact_made + delay * units::picosecond;
    }

    /// What a leg has shown.
    void conclude(Leg leg) {
        const double area = scene_.edge() * scene_.edge();
        if (leg == Leg::pull_off) {
            findings_.pull_off = -units::milli_per_unit * simulation_.ledger().pull_off / area;
            return;
        }
        findings_.approach = units::milli_per_unit * simulation_.ledger().approach / area;
        progress_.say("contact is made; relaxing a copy of this state under zero load");
        relax_copy();
        if (!simulation_.drive().done()) progress_.say("pull-off begins");
    }

    void relax_copy() {
        const auto t = simulation_.phases().time(Phase::relax);
        recorder_->flush(); // to be looked at if no state is found
        const auto copy = at_rest(simulation_.block().copy_at_rest());
        findings_.zero_load =
            find_zero_load(*copy, simulation_.interface(), simulation_.reference_height(), 0.0,
                           scene_, setup_, [&](long long iteration, double residual) {
                               show_relaxation(progress_, iteration, residual);
                               return false;
                           });
        if (scene_.writes_field("zero-load"))
            recorder_->fields("zero-load", copy->lowest_layer(), grid_, simulation_.interface(),
                              simulation_.reference_height());
    }

    void guard(const StepRecord& now) {
        const bool finite = std::isfinite(now.force) && std::isfinite(now.mean_height) &&
                            std::isfinite(now.top_force);
        const double residual = now.observed ? simulation_.energy_residual() : 0.0;
        const bool balanced = std::isfinite(residual) && std::abs(residual) <= energy_limit;
        if (finite && balanced) return;
        const StepRecord failed = now; // what follows puts the simulation back
        const std::string where = fastest_site();
        std::string kept = "no earlier state was kept";
        recorder_->flush();
        if (!snapshot_.empty()) {
            snapshot_.restore(simulation_);
            const std::string path = directory_ + "/last-good.h5";
            write_checkpoint(path, simulation_, snapshot_scalars_, fingerprint_);
            kept = fmt::format("the last good state, step {}, is in {} for a look",
                               snapshot_.step(), path);
        }
        const double limit = setup_.longest_timestep;
        throw io::PhysicsError(
            finite ? fmt::format("the energy balance is off by {:.1f} % at step {}",
                                 100.0 * residual, failed.step)
                   : fmt::format("the motion diverged at step {}: the force is {}", failed.step,
                                 failed.force),
            fmt::format("{}; drive.timestep = {:.4g} fs is stable up to {:.4g} fs in an unloaded "
                        "contact, and less "
                        "where atoms are pressed into the wall or hit it fast",
                        where, scene_.drive.timestep, limit),
            fmt::format("start again with a smaller drive.timestep (for example {:.2g} fs) or "
                        "drive.velocity; {}",
                        std::min(0.5 * scene_.drive.timestep, 0.2 * limit), kept));
    }

    /// The site of the lowest layer that moves fastest (or not by a number any more).
    std::string fastest_site() {
        const auto& level = simulation_.block().levels().front();
        const auto v = level.v.view()[0];
        const LargestSite fastest = global_largest(ranks_, level.tile, [&](int x, int y) {
            return std::sqrt(v.x(x, y) * v.x(x, y) + v.y(x, y) * v.y(x, y) + v.z(x, y) * v.z(x, y));
        });
        return fmt::format("site ({}, {}) moves at {:.3g} m/s", fastest.x, fastest.y,
                           fastest.value / units::metre_per_second);
    }

    void record_row() {
        const auto t = simulation_.phases().time(Phase::output);
        const bool keep = recorder_->rows() % rows_between_snapshots == 0;
        const bool pulling = simulation_.leg() == Leg::pull_off ||
                             (simulation_.leg() == Leg::done && scene_.has(PathPart::pull_off));
        recorder_->row(simulation_.now(), pulling, scene_.surface.sites);
        if (!keep) return;
        snapshot_.take(simulation_);
        snapshot_scalars_ = run_scalars();
    }

    void record_frame() {
        const auto t = simulation_.phases().time(Phase::output);
        recorder_->frame(simulation_);
    }

    /// The block is a step further than what was observed: no more than it moves in one.
    void watch_step(const StepRecord& now) {
        if (!field_stride_ && !scene_.writes_field("pull-off")) return;
        if (!now.observed && !(field_stride_ && now.step % *field_stride_ == 0)) return;
        const auto t = simulation_.phases().time(Phase::output);
        watch_fields(now.step, simulation_.leg(), now.observed ? -now.force : 0.0,
                     std::as_const(simulation_).block().lowest_layer(), simulation_.interface(),
                     simulation_.reference_height());
    }

    /// Goes on from a checkpoint if asked. True if it did.
    bool take_up() {
        const std::optional<std::string> path = checkpoint_to_take_up();
        if (!path) return false;
        restore_run(read_checkpoint(*path, simulation_, fingerprint_));
        std::erase_if(delayed_fields_, [&](const auto& field) { // written before it stopped
            return is_due(field.first, simulation_.now().time);
        });
        progress_.say(fmt::format("going on from step {} of {}", simulation_.steps(), *path));
        return true;
    }

    io::Progress::State progress_state(const StepRecord& now) const {
        return {fmt::format("{}, F = {:.1f} eV/Å", name(simulation_.leg()), now.force),
                simulation_.steps(), now.time,
                way_done(simulation_.leg(), now.top, simulation_.interface().start_height())};
    }

    Simulation simulation_;
    std::vector<std::pair<double, std::string>> delayed_fields_ = scene_.delayed_fields();
    Snapshot snapshot_;
    RunScalars snapshot_scalars_;
};

} // namespace

int run(const Scene& scene, const RunOptions& options, const Communicator& communicator) {
    io::Problems problems = scene.problems();
    not_yet(scene, problems);
    problems.throw_if_any();
    require_memory(scene, communicator, omp_get_max_threads());
    if (!Effects(scene).on(Effect::inertia)) return run_equilibrium(scene, options, communicator);
    return DynamicRun(scene, options, communicator).go();
}

} // namespace asperity
