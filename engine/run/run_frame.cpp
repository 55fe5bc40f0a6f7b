// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run_frame.hpp"

#include "engine/run/plan.hpp"
#include "engine/run/run_record.hpp"
#include "engine/run/summary.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <span>
#include <utility>

#include <sys/resource.h>

namespace asperity {

namespace {

volatile std::sig_atomic_t asked_to_stop = 0;
extern "C" void on_stop_signal(int) { asked_to_stop = 1; }

} // namespace

RunFrame::RunFrame(const Scene& scene, const RunOptions& options, const Communicator& ranks)
    : scene_(scene), options_(options), ranks_(ranks), setup_(make_setup(scene, ranks.size())),
      surface_(scene_surface(scene)), grid_(make_grid(scene, setup_, ranks.size(), ranks.rank())),
      progress_(options.progress, !ranks.root()) {
    ranks_.on_root([&] { choose_directory(); });
    fingerprint_ = fingerprint();
}

void RunFrame::choose_directory() {
    const auto place = io::choose_result_directory(options_.out, scene_.name, options_.resuming());
    directory_ = place.directory;
    namespace fs = std::filesystem;
    if (options_.resume == "auto" && !fs::exists(directory_ + "/checkpoint.h5") &&
        fs::exists(directory_ + "/result.json"))
        throw io::SceneError({"--resume auto", directory_ + " holds a result and no checkpoint",
                              "the run in it ended before its first checkpoint was due",
                              "nothing is left to do; for a new run give another --out"});
    if (!place.note.empty()) progress_.say(place.note);
}

int RunFrame::go() {
    ranks_.on_root([&] { io::make_directory(directory_); });
    std::signal(SIGUSR1, on_stop_signal);
    std::signal(SIGTERM, on_stop_signal);
    std::signal(SIGINT, on_stop_signal);
    last_checkpoint_ = seconds();
    try {
        if (ranks_.root())
            print_opening(stdout, scene_, setup_, surface_, grid_, omp_get_max_threads(), bytes(),
                          directory_);
        follow();
        const auto t = phases().time(Phase::output);
        write_strongest();
        recorder_->flush();
    } catch (const io::Error& e) {
        progress_.finish();
        record_failure(e);
        throw;
    }
    progress_.finish();
    write_record({});
    if (ranks_.root()) {
        write_sphere_curves(directory_ + "/run.h5", curve_, scene_, setup_.flat);
        print_summary(stdout, scene_, setup_, findings_, energy_residual(), directory_);
        if (!stopped_.empty())
            fmt::print("  Stopped early ({}): the path is not complete.\n", stopped_);
    }
    return stopped_ == "wall_limit" || stopped_ == "signal" ? io::exit_code::stopped
                                                            : io::exit_code::done;
}

RunFrame::Due RunFrame::due() {
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
    if (agreed[0] == nothing) return Due::nothing;
    if (agreed[0] == save) return Due::save;
    stopped_ = agreed[0] == wall ? "wall_limit" : "signal";
    return Due::stop;
}

bool RunFrame::time_to_stop() {
    const Due now = due();
    if (now == Due::nothing) return false;
    save_checkpoint();
    if (now == Due::save) return false;
    say_where_stopped();
    return true;
}

void RunFrame::save_checkpoint() {
    const auto t = phases().time(Phase::checkpoint);
    write_strongest();
    recorder_->flush();
    write_state(directory_ + "/checkpoint.h5");
    last_checkpoint_ = seconds();
}

void RunFrame::say_where_stopped() {
    progress_.say(
        fmt::format("stopping: the state at {} is in {}/checkpoint.h5; go on with --resume auto",
                    position(), directory_));
}

/// A checkpoint taken up in another directory brings its series along.
void RunFrame::bring_series(const std::string& checkpoint) const {
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

std::optional<std::string> RunFrame::checkpoint_to_take_up() {
    if (!options_.resuming()) return std::nullopt;
    std::string path = options_.resume;
    double there = 1.0;
    if (path == "auto") {
        path = directory_ + "/checkpoint.h5";
        if (ranks_.root()) there = std::filesystem::exists(path) ? 1.0 : 0.0;
        ranks_.broadcast(std::span<double>(&there, 1));
    }
    if (there == 0.0) {
        progress_.say("no checkpoint yet: starting from the beginning");
        return std::nullopt;
    }
    ranks_.on_root([&] { bring_series(path); });
    return path;
}

void RunFrame::open_recorder(bool taken_up) {
    recorder_.emplace(directory_ + "/run.h5", surface_, ranks_,
                      scene_.without_time() ? DriveMode::quasistatic : DriveMode::dynamic, taken_up,
                      rows_at_start_);
}

void RunFrame::watch_fields(long long step, Leg leg, double attraction,
                            const VectorPlane<const double>& layer, const Interface& interface,
                            double reference_height) {
    if (field_stride_ && step % *field_stride_ == 0)
        recorder_->fields(fmt::format("step-{}", step), layer, grid_, interface, reference_height);
    if (leg != Leg::pull_off || attraction <= strongest_.attraction ||
        !scene_.writes_field("pull-off"))
        return;
    strongest_.attraction = attraction;
    strongest_.reference_height = reference_height;
    strongest_.interface = &interface;
    if (strongest_.layer.empty()) strongest_.layer = VectorField<double>(grid_.tile(0), 1);
    const VectorPlane<double> to = strongest_.layer.plane(0);
    for (int y = 0; y < to.x.ny; ++y) {
        std::copy_n(layer.x.line(y), to.x.nx, to.x.line(y));
        std::copy_n(layer.y.line(y), to.y.nx, to.y.line(y));
        std::copy_n(layer.z.line(y), to.z.nx, to.z.line(y));
    }
}

void RunFrame::write_strongest() {
    if (!strongest_.interface) return;
    recorder_->fields("pull-off", std::as_const(strongest_.layer).plane(0), grid_,
                      *strongest_.interface, strongest_.reference_height);
    strongest_.interface = nullptr;
}

RunScalars RunFrame::run_scalars() {
    CollectScalars collect;
    collect.values.emplace_back("rows", static_cast<double>(recorder_->rows()));
    collect("strongest", strongest_.attraction);
    collect.values.emplace_back("processor_seconds", processor_seconds());
    findings_.visit(collect);
    return collect.values;
}

void RunFrame::restore_run(const RunScalars& scalars) {
    RestoreScalars restore{scalars};
    restore("rows", rows_at_start_);
    restore("strongest", strongest_.attraction);
    restore("processor_seconds", processor_before_);
    findings_.visit(restore);
}

double RunFrame::processor_seconds() const {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return processor_before_ + seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// The physics of the scene, as text: what may not change between a checkpoint and its resumption.
std::string RunFrame::fingerprint() const {
    const io::JsonValue all = scene_json(scene_);
    io::JsonValue part = io::JsonValue::object();
    for (const char* section : {"surface", "block", "interface", "drive"})
        if (const auto* value = all.find(section)) part[section] = *value;
    part["drive"]["max_steps"] = 0;
    return part.dump(-1);
}

double RunFrame::way_done(Leg leg, double top, double start_height) const {
    const ExpectedWay way = expected_way(setup_, start_height);
    const double done = leg == Leg::approach ? -top : 2.0 * way.down + top;
    return std::clamp(done / (way.down + way.up), 0.0, 0.99);
}

void RunFrame::record_failure(const io::Error& e) {
    io::ResultRecord::Failure failure;
    failure.exit_code = e.code();
    failure.reason = e.what();
    try {
        write_record(failure);
    } catch (const std::exception&) { // the first error is the one to report
    }
}

void RunFrame::write_record(const io::ResultRecord::Failure& failure) {
    if (!ranks_.root()) return;
    io::ResultRecord r = run_record(scene_, surface_, setup_, findings_, ranks_.size());
    complete(r);
    r.run.wall_seconds = seconds();
    r.extra.emplace_back("run.processor_seconds", processor_seconds());
    add_phases(phases(), r);
    if (recorder_) {
        recorder_.reset(); // closes run.h5, to be read
        curve_ = read_path(directory_ + "/run.h5");
        add_path(curve_, scene_, r);
    }
    r.run.stopped = stopped_;
    r.failure = failure;
    io::write_result(directory_, r);
}

} // namespace asperity
