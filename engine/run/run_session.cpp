// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run_session.hpp"

#include "engine/run/plan.hpp"
#include "engine/run/run_record.hpp"
#include "engine/run/smooth_sphere.hpp"
#include "engine/run/stop_signals.hpp"
#include "engine/run/summary.hpp"
#include "io/described.hpp"
#include "io/json.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <system_error>
#include <utility>

#include <sys/resource.h>

namespace asperity {

namespace {

/// Prints. A standard output that was closed, or is full, is no reason to end a run: its numbers
/// are in its files.
template <class Print>
void print_unless_closed(const Print& print) {
    try {
        print();
    } catch (const std::system_error&) {
    }
}

/// What may not change between a checkpoint and its resumption: keys, and the map or the atoms of a
/// file.
std::string physics_of(const Scene& scene, const Surface& surface) {
    const io::Json all = scene_json(scene);
    io::Json part = io::Json::object();
    for (const char* section : {"surface", "block", "interface", "drive"})
        if (all.contains(section)) part[section] = all[section];
    part["drive"]["max_steps"] = 0;
    part["output"]["fields"] = scene.writes_field("pull-off"); // keeps a layer in the checkpoint
    // What resumes is taken as written where its time is past.
    part["output"]["delayed"] = io::Json::array();
    for (const auto& [delay, name] : scene.delayed_fields())
        part["output"]["delayed"].push_back(name);
    if (scene.surface.radius) part["output"]["series"] = scene.output.series; // averaged over time
    part["output"]["velocities"] = scene.output.trajectory && scene.output.velocities;
    if (surface.file_digest) part["surface"]["content_of_file"] = *surface.file_digest;
    return io::json_text(part);
}

} // namespace

RunSession::RunSession(const Scene& of, const RunOptions& options, const Communicator& on)
    : scene(of), ranks(on), options_(options), setup(make_setup(scene, ranks.size())),
      surface(scene_surface(scene, ranks)),
      grid(make_grid(scene, setup, ranks.size(), ranks.rank())),
      storage_(options, scene.name, ranks), progress(options.progress, !ranks.root()),
      fingerprint_(physics_of(scene, surface)) {
    progress.tell(options.listener);
    if (scene.writes_field("pull-off")) strongest_.layer = VectorField<double>(grid.tile(0), 1);
    print_notes();
}

void RunSession::print_notes() {
    progress.finish();
    for (const std::string& note : storage_.take_notes()) // however little progress is shown
        print_unless_closed([&] { fmt::print(stderr, "{}\n", note); });
}

int RunSession::carry_out(std::size_t bytes, const std::function<void()>& work,
                          const AddToResult& add_to) {
    last_checkpoint_ = seconds();
    try {
        if (ranks.root() && !options_.silent)
            print_unless_closed([&] {
                print_opening(stdout, scene, setup, surface, grid, omp_get_max_threads(), bytes,
                              storage_.path());
            });
        work();
        const auto t = phases.time(Phase::output);
        bring_back_directory(); // the numbers are there: they go where they can
        recorder_->write();
    } catch (const io::Error& error) {
        progress.finish();
        write_failure({error.code(), error.what()}, add_to);
        throw;
    } catch (const std::bad_alloc&) {
        progress.finish();
        write_failure({io::exit_code::scene, "out of memory"}, add_to);
        throw;
    } catch (const std::exception& error) {
        progress.finish();
        write_failure({io::exit_code::internal, error.what()}, add_to);
        throw;
    }
    progress.finish();
    ranks.on_root([&] {
        const io::Result result = write_result(nullptr, add_to);
        throw_if_directory_gone();
        if (options_.silent) return;
        print_unless_closed([&] {
            print_summary(stdout, scene, result, findings.states, storage_.path());
            if (!stopped_.empty())
                fmt::print("  Stopped early ({}): the path is not complete.\n", stopped_);
        });
    });
    return stopped_ == "wall_limit" || stopped_ == "signal" ? io::exit_code::stopped
                                                            : io::exit_code::done;
}

void RunSession::throw_if_directory_gone() {
    if (stopped_ != "directory") return;
    throw io::FileError(
        storage_.directory().path(), "was moved or removed while the run was using it",
        fmt::format("at {} it was not there any more", saved_at_),
        fmt::format("the state is in {0}; resume with --resume auto --out {0}", storage_.path()));
}

/// What this rank knows of.
RunSession::Reason RunSession::reason() const {
    Reason reason = Reason::none;
    if (ranks.root()) {
        const double now = seconds();
        if (setup.effects.on(Effect::checkpoints) &&
            now - last_checkpoint_ >= scene.output.checkpoint)
            reason = Reason::checkpoint;
        if (options_.wall_limit && now >= *options_.wall_limit) reason = Reason::wall_limit;
        if (options_.stop && options_.stop()) reason = Reason::signal;
    }
    if (stop_signals::caught()) reason = Reason::signal;
    if (ranks.root() && !storage_.in_place(*recorder_)) reason = Reason::directory;
    return reason;
}

bool RunSession::wants_stop() const { return reason() > Reason::checkpoint; }

RunSession::Due RunSession::due() {
    const auto agreed = static_cast<Reason>(std::lround(ranks.max(static_cast<double>(reason()))));
    if (agreed == Reason::none) return Due::nothing;
    if (agreed == Reason::checkpoint) return Due::save;
    stopped_ = agreed == Reason::wall_limit ? "wall_limit"
               : agreed == Reason::signal   ? "signal"
                                            : "directory";
    return Due::stop;
}

bool RunSession::look_is_due() {
    if (--steps_to_look_ > 0) return false;
    // The root's clock decides how many steps are about half a second.
    constexpr double most = 1000.0;
    const double interval =
        setup.effects.on(Effect::checkpoints) ? std::min(0.5, scene.output.checkpoint) : 0.5;
    std::array<double, 1> stride = {1.0};
    if (ranks.root()) {
        const double each = (seconds() - last_look_) / static_cast<double>(looked_every_);
        stride[0] = std::clamp(std::floor(interval / std::max(each, 1e-9)), 1.0, most);
    }
    ranks.broadcast(std::span<double>(stride));
    steps_to_look_ = looked_every_ = static_cast<long long>(stride[0]);
    last_look_ = seconds();
    return true;
}

bool RunSession::stop_here(const WriteState& write, const std::string& where) {
    const Due now = due();
    if (now == Due::stop) stop_now(write, where);
    if (now == Due::save) save(write);
    last_look_ = seconds();
    return !stopped_.empty();
}

void RunSession::stop_now(const WriteState& write, const std::string& where) {
    saved_at_ = where;
    bring_back_directory();
    save(write);
    if (ranks.root())
        progress.say(fmt::format(
            "stopping: the state at {} is in {}/checkpoint.h5; resume with --resume auto", where,
            storage_.path()));
}

bool RunSession::stop_relaxation(const WriteState& write) {
    const Due now = due();
    if (now == Due::save && write) save(write);
    return now == Due::stop;
}

void RunSession::save(const WriteState& write) {
    const auto t = phases.time(Phase::checkpoint);
    const auto save_once = [&] {
        recorder_->synchronize();
        storage_.save(write);
    };
    try {
        save_once();
    } catch (const std::exception&) { // on every rank; the root knows whether it was this:
        if (!bring_back_directory()) throw;
        stopped_ = "directory";
        save_once();
    }
    recorder_->write_if_cheap();
    last_checkpoint_ = seconds();
}

/// Of a directory that was moved or removed: makes it usable again. False: it was not. Collective.
bool RunSession::bring_back_directory() {
    const bool away = ranks.root() && !storage_.in_place(*recorder_);
    const bool gone = ranks.max(away ? 1.0 : 0.0) != 0.0;
    if (gone) ranks.on_root([&] { storage_.bring_back(*recorder_); });
    return gone;
}

void RunSession::save_if_on(const WriteState& write) {
    if (setup.effects.on(Effect::checkpoints)) save(write);
}

io::FilePlace RunSession::file(const std::string& name) const {
    return ranks.root() ? storage_.file(name) : io::FilePlace(name);
}

std::optional<io::FilePlace> RunSession::checkpoint_to_resume() {
    const auto place = storage_.checkpoint_to_resume();
    print_notes();
    return place;
}

void RunSession::open_recorder() {
    const auto add = [this, rough = ranks.root() ? rough_sphere(scene, surface, setup.flat)
                                                 : std::nullopt](io::Hdf5File& file) {
        io::describe_origin(file, scene_toml(scene, false));
        write_sphere_curves(file, scene, setup.flat, rough);
    };
    recorder_.emplace(ranks.root() ? storage_.directory() : io::Directory("."), surface, ranks,
                      scene.without_time() ? DriveMode::quasistatic : DriveMode::dynamic,
                      setup.effects.on(Effect::seams), resumed_at_, add);
}

void RunSession::watch_fields(long long step, Leg leg, double attraction,
                              const VectorPlane<const double>& layer, const Interface& interface,
                              double reference_height) {
    if (field_is_due(step))
        recorder_->fields(fmt::format("step-{}", step), layer, grid, interface, reference_height);
    if (leg != Leg::pull_off || attraction <= strongest_.attraction ||
        !scene.writes_field("pull-off"))
        return;
    strongest_.attraction = attraction;
    strongest_.reference_height = reference_height;
    strongest_.kept = true;
    const VectorPlane<double> to = strongest_.layer.plane(0);
    for (int y = 0; y < to.x.ny; ++y) {
        std::copy_n(layer.x.line(y), to.x.nx, to.x.line(y));
        std::copy_n(layer.y.line(y), to.y.nx, to.y.line(y));
        std::copy_n(layer.z.line(y), to.z.nx, to.z.line(y));
    }
}

void RunSession::write_kept_fields(const Interface& interface) {
    if (!strongest_.kept) return;
    recorder_->fields("pull-off", std::as_const(strongest_.layer).plane(0), grid, interface,
                      strongest_.reference_height);
    strongest_.kept = false;
}

RunScalars RunSession::scalars() {
    CollectScalars collect;
    add_position(recorder_->position(), collect.values);
    collect("strongest.attraction", strongest_.attraction);
    collect("strongest.reference_height", strongest_.reference_height);
    collect("strongest.kept", strongest_.kept);
    collect.values.emplace_back("processor_seconds", processor_seconds());
    findings.visit(collect);
    return collect.values;
}

std::vector<StateArray> RunSession::arrays() {
    if (strongest_.layer.empty()) return {};
    return {{"/pull-off/x", 0, &strongest_.layer.x, 1},
            {"/pull-off/y", 0, &strongest_.layer.y, 1},
            {"/pull-off/z", 0, &strongest_.layer.z, 1}};
}

void RunSession::restore(const RunScalars& from) {
    resumed_at_ = position_in(from);
    RestoreScalars restore{from};
    for (const char* name : {"rows", "journal.bytes", "journal.digest"})
        restore.next(name);
    restore("strongest.attraction", strongest_.attraction);
    restore("strongest.reference_height", strongest_.reference_height);
    restore("strongest.kept", strongest_.kept);
    restore("processor_seconds", processor_before_);
    findings.visit(restore);
}

double RunSession::processor_seconds() const {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return processor_before_ + seconds(used.ru_utime) + seconds(used.ru_stime);
}

double RunSession::way_done(Leg leg, double top, double start_height) const {
    const ExpectedPath path = expected_path(setup, start_height);
    const double done = leg == Leg::approach ? -top : 2.0 * path.approach + top;
    return std::clamp(done / (path.approach + path.pull_off), 0.0, 0.99);
}

void RunSession::write_failure(const Failure& failure, const AddToResult& add_to) {
    if (!ranks.root()) return;
    // A run that could not begin to record leaves its directory as it was.
    if (!recorder_ && failure.code != io::exit_code::physics) return;
    try {
        if (recorder_) recorder_->write_on_root();
    } catch (const std::exception&) { // what run.h5 held before must do
    }
    try {
        write_result(&failure, add_to);
    } catch (const std::exception&) { // the first error is the one to report
    }
}

io::Result RunSession::write_result(const Failure* failure, const AddToResult& add_to) {
    io::Result result = run_result(scene, surface, setup, findings, ranks.size());
    add_to(result);
    result.set("run.wall_seconds", seconds());
    result.set("run.processor_seconds", processor_seconds());
    add_phases(phases, result);
    if (!stopped_.empty()) result.set("run.stopped", stopped_);
    if (failure) {
        result.set("failure.exit_code", failure->code);
        result.set("failure.reason", failure->reason);
    }
    if (recorder_ && scene.surface.radius)
        add_sphere_path(read_path(storage_.path() + "/run.h5"), scene, result);
    io::write_result(storage_.directory(), result);
    if (failure || !stopped_.empty()) return result;
    storage_.remove_checkpoints();
    recorder_->remove_journal();
    return result;
}

} // namespace asperity
