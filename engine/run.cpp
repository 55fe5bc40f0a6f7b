// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The life of a run in time: set up, follow the path, relax the zero-load state, write what was
// found. Runs without a path in time are equilibrium_run.cpp.
#include "engine/run.hpp"

#include "engine/checkpoint.hpp"
#include "engine/equilibrium.hpp"
#include "engine/equilibrium_run.hpp"
#include "engine/plan.hpp"
#include "engine/recorder.hpp"
#include "engine/run_record.hpp"
#include "engine/setup.hpp"
#include "engine/summary.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "io/progress.hpp"
#include "io/result.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

namespace asperity {

namespace {

volatile std::sig_atomic_t asked_to_stop = 0;
extern "C" void on_stop_signal(int) { asked_to_stop = 1; }

/// Largest relative error of the energy balance that counts as physics.
constexpr double energy_limit = 0.02;
/// Observed steps between two states kept in memory for the guard.
constexpr long long rows_between_snapshots = 10;

class Run {
public:
    Run(const Scene& scene, const RunOptions& options, const Communicator& ranks)
        : scene_(scene), options_(options), ranks_(ranks), setup_(make_setup(scene, ranks.size())),
          surface_(scene_surface(scene)), grid_(ranks.size(), ranks.rank(), scene.surface.sites,
                                                static_cast<int>(setup_.levels.size())),
          simulation_(setup_.simulation, surface_, ranks, grid_),
          progress_(options.progress, !ranks.root()) {
        ranks_.on_root([&] {
            const auto place =
                io::choose_result_directory(options.out, scene.name, options.resuming());
            directory_ = place.directory;
            namespace fs = std::filesystem;
            if (options.resume == "auto" && !fs::exists(directory_ + "/checkpoint.h5") &&
                fs::exists(directory_ + "/result.json"))
                throw io::SceneError({"--resume auto",
                                      directory_ + " holds a result and no checkpoint",
                                      "the run in it ended before its first checkpoint was due",
                                      "nothing is left to do; for a new run give another --out"});
            if (!place.note.empty()) progress_.say(place.note);
        });
        fingerprint_ = fingerprint();
    }

    int go() {
        ranks_.on_root([&] { io::make_directory(directory_); });
        try {
            if (ranks_.root())
                print_opening(stdout, scene_, setup_, surface_, grid_, omp_get_max_threads(),
                              simulation_.block().bytes() + simulation_.interface().bytes(),
                              directory_);
            follow();
        } catch (const io::Error& e) {
            progress_.finish();
            record_failure(e);
            throw;
        }
        progress_.finish();
        write_record({});
        if (ranks_.root()) {
            for (const std::string& difference : differences_)
                fmt::print("  NOT AS PLANNED: {}\n", difference);
            print_summary(stdout, scene_, setup_, findings_, simulation_.energy_residual(),
                          directory_);
            if (!stopped_.empty())
                fmt::print("  Stopped early ({}): the path is not complete.\n", stopped_);
        }
        return stopped_ == "wall_limit" || stopped_ == "signal" ? io::exit_code::stopped
                                                                : io::exit_code::done;
    }

private:
    void follow() {
        const bool taken_up = take_up();
        recorder_.emplace(directory_ + "/run.h5", surface_, ranks_, taken_up, rows_at_start_);
        if (!taken_up) simulation_.start(simulation_.interface().start_height());
        if (scene_.output.trajectory)
            recorder_->begin_trajectory(simulation_, scene_.output.velocities);
        march();
        const auto t = simulation_.phases().time(Phase::output);
        recorder_->flush();
    }

    /// The loop over time.
    void march() {
        std::signal(SIGUSR1, on_stop_signal);
        std::signal(SIGTERM, on_stop_signal);
        std::signal(SIGINT, on_stop_signal);
        last_checkpoint_ = seconds();
        std::optional<Leg> ended; // the leg that the last step ended
        while (ended || !simulation_.drive().done()) {
            const bool last =
                scene_.drive.max_steps > 0 && simulation_.steps() + 1 >= scene_.drive.max_steps;
            const bool due = simulation_.steps() % scene_.output.series == 0;
            if (due && !ended && time_to_stop()) return;
            if (scene_.output.trajectory && simulation_.steps() % *scene_.output.trajectory == 0)
                record_frame();
            // The step after a leg and the last of all are observed, so that the guard has seen the
            // energy balance before anything is concluded.
            const StepRecord& now = simulation_.step(due || ended || last);
            guard(now);
            if (now.observed) record_row();
            if (ended)
                conclude(*std::exchange(ended, std::nullopt));
            else
                ended = follow_drive(now);
            if (progress_.due()) progress_.update(progress_state(now));
            if (last && !ended) {
                stopped_ = "max_steps";
                if (setup_.effects.on(Effect::checkpoints)) save_checkpoint();
                return;
            }
        }
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
        return leg;
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
            find_zero_load(*copy, simulation_.interface(), simulation_.reference_height(), scene_,
                           setup_, progress_);
        relaxation_bytes_ = copy->bytes();
        if (setup_.effects.on(Effect::maps))
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
        double worst = -1.0;
        int wx = 0, wy = 0;
        for (int y = 0; y < v.x.ny; ++y)
            for (int x = 0; x < v.x.nx; ++x) {
                double speed = std::sqrt(v.x(x, y) * v.x(x, y) + v.y(x, y) * v.y(x, y) +
                                         v.z(x, y) * v.z(x, y));
                if (!std::isfinite(speed)) speed = std::numeric_limits<double>::max();
                if (speed > worst) worst = speed, wx = x + level.tile.x0, wy = y + level.tile.y0;
            }
        std::array<double, 1> most = {worst};
        ranks_.max(most);
        const double sites = level.tile.sites;
        std::array<double, 1> place = {most[0] == worst ? sites * sites - (wy * sites + wx) : 0.0};
        ranks_.max(place);
        const long long index = static_cast<long long>(sites * sites - place[0]);
        return fmt::format("site ({}, {}) moves at {:.3g} m/s", index % level.tile.sites,
                           index / level.tile.sites, most[0] / units::metre_per_second);
    }

    void record_row() {
        const auto t = simulation_.phases().time(Phase::output);
        const bool keep = recorder_->rows() % rows_between_snapshots == 0;
        recorder_->row(simulation_);
        if (!keep) return;
        snapshot_.take(simulation_);
        snapshot_scalars_ = run_scalars();
    }

    void record_frame() {
        const auto t = simulation_.phases().time(Phase::output);
        recorder_->frame(simulation_);
    }

    /// Between two steps: signals, the wall limit and checkpoints; the root decides for all.
    bool time_to_stop() {
        constexpr double nothing = 0.0, save = 1.0, wall = 2.0, signal = 3.0; // the greatest wins
        double decision = nothing;
        if (ranks_.root()) {
            const double now = seconds();
            if (setup_.effects.on(Effect::checkpoints) &&
                now - last_checkpoint_ >= scene_.output.checkpoint)
                decision = save;
            if (options_.wall_limit && now >= *options_.wall_limit) decision = wall;
        }
        if (asked_to_stop) decision = signal;
        std::array<double, 1> agreed = {decision};
        ranks_.max(agreed);
        if (agreed[0] == nothing) return false;
        save_checkpoint();
        if (agreed[0] == save) return false;
        stopped_ = agreed[0] == wall ? "wall_limit" : "signal";
        progress_.say(fmt::format(
            "stopping: the state at step {} is in {}/checkpoint.h5; go on with --resume auto",
            simulation_.steps(), directory_));
        return true;
    }

    void save_checkpoint() {
        const auto t = simulation_.phases().time(Phase::checkpoint);
        recorder_->flush();
        write_checkpoint(directory_ + "/checkpoint.h5", simulation_, run_scalars(), fingerprint_);
        last_checkpoint_ = seconds();
    }

    RunScalars run_scalars() {
        RunScalars list = {{"rows", static_cast<double>(recorder_->rows())}};
        const auto collect = [&](const char* name, double& value) {
            list.emplace_back(name, value);
        };
        findings_.visit(collect);
        return list;
    }

    /// A checkpoint taken up in another directory brings its series along.
    void bring_series(const std::string& checkpoint) const {
        namespace fs = std::filesystem;
        const fs::path here = fs::path(directory_) / "run.h5";
        const fs::path there = fs::path(checkpoint).parent_path() / "run.h5";
        if (fs::exists(here)) return;
        std::error_code failed;
        fs::copy_file(there, here, failed);
        if (failed)
            throw io::FileError(checkpoint, "cannot be taken up",
                                "the series so far, " + there.string() +
                                    ", cannot be copied: " + failed.message(),
                                "keep a checkpoint and its run.h5 in one folder");
    }

    /// Goes on from a checkpoint if asked. True if it did.
    bool take_up() {
        if (!options_.resuming()) return false;
        std::string path = options_.resume;
        double there = 1.0;
        if (path == "auto") {
            path = directory_ + "/checkpoint.h5";
            if (ranks_.root()) there = std::filesystem::exists(path) ? 1.0 : 0.0;
            ranks_.broadcast(std::span<double>(&there, 1));
        }
        if (there == 0.0) {
            progress_.say("no checkpoint yet: starting from the beginning");
            return false;
        }
        ranks_.on_root([&] { bring_series(path); });
        const RunScalars scalars = read_checkpoint(path, simulation_, fingerprint_);
        rows_at_start_ = static_cast<std::uint64_t>(scalars.front().second);
        std::size_t at = 1;
        const auto restore = [&](const char*, double& value) { value = scalars.at(at++).second; };
        findings_.visit(restore);
        progress_.say(fmt::format("going on from step {} of {}", simulation_.steps(), path));
        return true;
    }

    /// The physics of the scene, as text: what may not change between a checkpoint and its
    /// resumption.
    std::string fingerprint() const {
        const io::JsonValue all = scene_json(scene_);
        io::JsonValue part = io::JsonValue::object();
        for (const char* section : {"surface", "block", "interface", "drive"})
            if (const auto* value = all.find(section)) part[section] = *value;
        part["drive"]["max_steps"] = 0;
        return part.dump(-1);
    }

    io::Progress::State progress_state(const StepRecord& now) const {
        const ExpectedWay way = expected_way(setup_, simulation_.interface().start_height());
        const double done =
            simulation_.leg() == Leg::approach ? -now.top : 2.0 * way.down + now.top;
        return {fmt::format("{}, F = {:.1f} eV/Å", name(simulation_.leg()), now.force),
                simulation_.steps(), now.time, std::clamp(done / (way.down + way.up), 0.0, 0.99)};
    }

    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    void record_failure(const io::Error& e) {
        io::ResultRecord::Failure failure;
        failure.exit_code = e.code();
        failure.reason = e.what();
        try {
            write_record(failure);
        } catch (const std::exception&) { // the first error is the one to report
        }
    }

    void write_record(const io::ResultRecord::Failure& failure);

    /// What was done of each effect, by this rank.
    EffectBooks books() const {
        EffectBooks done = common_books(surface_, simulation_.interface(), findings_);
        const StepWork& work = simulation_.work();
        const Phases& phases = simulation_.phases();
        done[Effect::inertia] = {work.nodes, simulation_.block().motion_bytes()};
        done[Effect::lateral] = {work.steps, 2 * simulation_.block().bytes() / 3};
        done[Effect::damping] = {work.damped, 0};
        done[Effect::temperature] = {phases[Phase::thermostat].calls, 0};
        done[Effect::coarse_levels] = {phases[Phase::interpolate].calls,
                                       simulation_.block().coarse_bytes()};
        done[Effect::relaxation].bytes = relaxation_bytes_;
        done[Effect::observation] = {work.observed, snapshot_.bytes()};
        done[Effect::checkpoints] = {phases[Phase::checkpoint].calls, 0};
        if (recorder_) done[Effect::maps] = {recorder_->maps(), 0};
        if (recorder_) done[Effect::trajectory] = {recorder_->frames(), 0};
        return done;
    }

    const Scene& scene_;
    const RunOptions& options_;
    Communicator ranks_;
    Setup setup_;
    Surface surface_;
    ProcessGrid grid_;
    Simulation simulation_;
    io::Progress progress_;
    std::optional<Recorder> recorder_;
    Findings findings_;
    Snapshot snapshot_;
    RunScalars snapshot_scalars_;
    std::string directory_, fingerprint_, stopped_;
    std::vector<std::string> differences_; ///< between the effects planned and done
    std::size_t relaxation_bytes_ = 0;
    std::uint64_t rows_at_start_ = 0;
    double last_checkpoint_ = 0.0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void Run::write_record(const io::ResultRecord::Failure& failure) {
    if (!ranks_.root()) return;
    io::ResultRecord r = run_record(scene_, surface_, setup_, findings_, ranks_.size());
    if (simulation_.steps() > 0) {
        const StepRecord& now = simulation_.now(); // energies of the last observed step
        r.energy = {now.residual,         now.work,  now.kinetic_energy, now.elastic_energy,
                    now.interface_energy, now.damped};
    }
    r.run.wall_seconds = seconds();
    r.run.steps = simulation_.steps();
    add_phases(simulation_.phases(), r);
    const bool complete = stopped_.empty() && failure.exit_code == 0 && !options_.resuming();
    if (simulation_.work().steps > 0)
        differences_ = add_effects(setup_.effects, books(), complete, r);
    r.run.stopped = stopped_;
    r.failure = failure;
    io::write_result(directory_, r);
}

} // namespace

int run(const Scene& scene, const RunOptions& options, const Communicator& communicator) {
    io::Problems problems = scene.problems();
    not_yet(scene, problems);
    problems.throw_if_any();
    if (!Effects(scene).on(Effect::inertia)) return run_equilibrium(scene, options, communicator);
    return Run(scene, options, communicator).go();
}

} // namespace asperity
