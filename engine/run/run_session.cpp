// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run_session.hpp"

#include "engine/path/guard.hpp"
#include "engine/run/curve.hpp"
#include "engine/run/run_result.hpp"
#include "engine/run/summary.hpp"
#include "io/run_h5.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <system_error>

#include <sys/resource.h>

namespace asperity {

namespace {

/// Observed steps between two states kept in memory for the guard.
constexpr std::uint64_t rows_between_snapshots = 10;

/// Prints. A standard output that was closed, or is full, is no reason to end a run: its numbers
/// are in its files.
template <class Print>
void print_unless_closed(const Print& print) {
    try {
        print();
    } catch (const std::system_error&) {
    }
}

} // namespace

RunSession::RunSession(const Case& c, const RunOptions& options, const Communicator& ranks)
    : case_(c), options_(options), ranks_(ranks), surface_(surface_of(c, ranks)),
      grid_(c.grid(ranks.rank())), storage_(options, c, ranks),
      interruptions_(options,
                     c.effects.checkpoints ? std::optional(c.output.checkpoint) : std::nullopt,
                     ranks),
      progress_(options.progress, !ranks.root()), maps_(*this),
      fingerprint_(physics_of(c, surface_)) {
    print_notes();
}

void RunSession::print_notes() {
    progress_.finish();
    for (const std::string& note : storage_.take_notes()) // however little progress is shown
        if (!options_.quiet && !options_.json)
            print_unless_closed([&] { io::print_text(stderr, "{}\n", note); });
}

int RunSession::carry_out(const Path& path, const std::function<void()>& work) {
    interruptions_.checkpoint_written();
    try {
        if (ranks_.root() && !options_.quiet && !options_.json)
            print_unless_closed([&] {
                print_opening(stdout, case_, surface_, grid_, omp_get_max_threads(), path.bytes(),
                              storage_.path());
            });
        work();
        const auto t = phases_.time(Phase::output);
        path.free_workspace();
        recorder_->write();
    } catch (const io::Error& error) {
        progress_.finish();
        write_failure(path, {error.code(), error.what()});
        throw;
    } catch (const std::bad_alloc&) {
        progress_.finish();
        write_failure(path, {io::exit_code::scene, "out of memory"});
        throw;
    } catch (const std::exception& error) {
        progress_.finish();
        write_failure(path, {io::exit_code::internal, error.what()});
        throw;
    }
    progress_.finish();
    ranks_.on_root([&] {
        const io::Result result = write_result(path, nullptr);
        storage_.require_in_place();
        print_unless_closed([&] {
            if (options_.json) return fmt::print("{}", result.text(-1));
            print_summary(stdout, summary_of(case_, result, path.results()),
                          options_.quiet ? "" : storage_.path());
            if (stopped_ != Stopped::no)
                fmt::print("  Stopped early ({}): the path is not complete.\n", name(stopped_));
        });
    });
    const bool can_go_on = stopped_ == Stopped::wall_limit || stopped_ == Stopped::signal;
    return can_go_on ? io::exit_code::stopped : io::exit_code::done;
}

const char* RunSession::name(Stopped stopped) {
    switch (stopped) {
    case Stopped::max_steps:
        return "max_steps";
    case Stopped::wall_limit:
        return "wall_limit";
    case Stopped::signal:
        return "signal";
    case Stopped::no:
        break;
    }
    return "";
}

/// Returns the interruption of all ranks together, between two steps or points.
Interruption RunSession::ask() {
    const Interruption now = interruptions_.now();
    if (now == Interruption::wall_limit) stopped_ = Stopped::wall_limit;
    if (now == Interruption::signal) stopped_ = Stopped::signal;
    return now;
}

bool RunSession::stop_here(const Path& path) {
    using Status = Path::Status;
    const Status status = path.status();
    const bool goes_on = status == Status::beginning || status == Status::under_way;
    if (!goes_on && status != Status::at_end) return false;
    const auto& most = case_.simulation.drive.max_steps;
    if (goes_on && most && path.steps() >= *most) {
        stopped_ = Stopped::max_steps;
        save_if_on(path);
        return true;
    }
    if (path.has_short_steps() && !interruptions_.check_is_due()) return false;
    const Interruption now = ask();
    if (now > Interruption::checkpoint) {
        stop_now(path);
        return true;
    }
    if (now == Interruption::checkpoint) save(path);
    interruptions_.checked();
    return false;
}

void RunSession::stop_now(const Path& path) {
    save(path);
    if (ranks_.root())
        progress_.say(fmt::format(
            "stopping: the state at {} is in {}/checkpoint.h5; resume with --resume auto",
            path.position(), storage_.path()));
}

bool RunSession::stop_within(const Path& path) {
    const Interruption now = ask();
    if (now == Interruption::checkpoint && path.status() == Path::Status::relaxing) save(path);
    return now > Interruption::checkpoint;
}

bool RunSession::advance(Path& path, const Path::Wish& wish) {
    if (path.status() == Path::Status::relaxing) {
        if (case_.path()[path.concluded()].kind == Segment::approach) {
            save_if_on(path);
            progress_.say("contact is made; relaxing its lowest layer under no load");
        }
        const auto t = phases_.time(Phase::relax);
        return path.advance(wish);
    }
    if (!path.advance(wish)) return false;
    if (path.has_stepped()) require_physical(path);
    return true;
}

/// Throws io::PhysicsError if the last step or point is no longer physical.
void RunSession::require_physical(Path& path) {
    const std::optional<std::string> wrong = violation(path.now(), case_, surface_);
    if (!wrong) return;
    failed_ = path.now();
    Path::Remedy remedy = path.remedy();
    if (path.has_short_steps()) remedy.fix += "; " + restore_last_good_state(path);
    throw io::PhysicsError(*wrong, remedy.why, remedy.fix);
}

void RunSession::copy_good_state(const Path& path) {
    const bool has_row = path.has_short_steps() && path.has_stepped() && path.now().observed;
    if (!has_row || recorder().rows() % rows_between_snapshots != 1) return;
    const auto t = phases_.time(Phase::output);
    last_good_.take(path);
    session_at_last_good_ = {};
    collect(session_at_last_good_);
}

/// Puts the path back to its last good state and writes it. Returns a sentence on the state to
/// resume from.
std::string RunSession::restore_last_good_state(Path& path) {
    if (last_good_.empty()) return "no earlier state was kept";
    last_good_.restore(path);
    const char* name = io::run_file::last_good;
    try {
        write_state(file(name), path, session_at_last_good_);
        return fmt::format("the last good state, {}, is in {}", path.position(), name);
    } catch (const std::exception&) { // a full disk must not hide what happened
        return "the last good state could not be written";
    }
}

void RunSession::save(const Path& path) {
    const auto t = phases_.time(Phase::checkpoint);
    recorder_->synchronize();
    storage_.save([&](const io::FilePlace& place) {
        CollectNumbers numbers;
        collect(numbers);
        write_state(place, path, numbers);
    });
    path.free_workspace();
    recorder_->write_if_cheap();
    interruptions_.checkpoint_written();
}

/// Writes path, maps and these numbers. Throws io::FileError.
void RunSession::write_state(const io::FilePlace& place, const Path& path,
                             const CollectNumbers& of_session) const {
    CollectNumbers numbers = of_session;
    path.collect(numbers);
    write_checkpoint(place, ranks_, grid_, joined(path.arrays(), maps_.arrays()), numbers.numbers,
                     fingerprint_);
}

/// Writes a checkpoint before a long part of the run, only if the scene has checkpoints.
void RunSession::save_if_on(const Path& path) {
    if (case_.effects.checkpoints) save(path);
}

/// Returns the place of a file in the result directory.
io::FilePlace RunSession::file(const std::string& name) const {
    return ranks_.root() ? storage_.file(name) : io::FilePlace(name);
}

void RunSession::begin(Path& path) {
    const std::optional<io::FilePlace> place = storage_.checkpoint_to_resume();
    print_notes();
    if (place) {
        const auto arrays = [&](const StateNumbers& all) {
            RestoreNumbers numbers(all);
            path.restore(numbers);
            restore(numbers);
            return joined(path.arrays_to_restore(), maps_.arrays_to_restore());
        };
        read_checkpoint(*place, ranks_, grid_, arrays, fingerprint_);
        path.restored();
    }
    open_recorder();
    if (place) progress_.say(fmt::format("going on from {} of {}", path.position(), place->path()));
}

void RunSession::open_recorder() {
    const auto add = [this](io::Hdf5File& file) {
        io::describe_origin(file, scene_toml(case_.scene, false));
    };
    std::vector<const SeriesColumn*> columns;
    for (const SeriesColumn& c : series_columns())
        if (c.is_in(case_.effects)) columns.push_back(&c);
    recorder_.emplace(ranks_.root() ? storage_.directory() : io::Directory("."), surface_, ranks_,
                      std::move(columns), resumed_at_, add);
}

/// Collects the numbers of the session (records, maps) as "run.*".
void RunSession::collect(CollectNumbers& numbers) {
    Recorder::Position records = recorder_->position();
    double processor = processor_seconds();
    numbers("run.records", records);
    numbers("run.processor_seconds", processor);
    numbers("run.maps", maps_);
}

void RunSession::restore(RestoreNumbers& numbers) {
    Recorder::Position records;
    numbers("run.records", records);
    resumed_at_ = records;
    numbers("run.processor_seconds", processor_before_);
    numbers("run.maps", maps_);
}

double RunSession::processor_seconds() const {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return processor_before_ + seconds(used.ru_utime) + seconds(used.ru_stime);
}

void RunSession::write_failure(const Path& path, const Failure& failure) {
    if (!ranks_.root()) return;
    // A run that could not begin to record leaves its directory as it was.
    if (!recorder_ && failure.code != io::exit_code::physics) return;
    try {
        if (recorder_) recorder_->write_on_root();
    } catch (const std::exception&) { // the earlier run.h5 must do
    }
    try {
        write_result(path, &failure);
    } catch (const std::exception&) { // the first error is the one to report
    }
}

io::Result RunSession::write_result(const Path& path, const Failure* failure) {
    io::Result result = run_result(case_, surface_, path.results());
    add_steps(path, failed_, result);
    result.set("run.wall_seconds", interruptions_.seconds());
    result.set("run.processor_seconds", processor_seconds());
    add_phases(phases_, result);
    if (stopped_ != Stopped::no) result.set("run.stopped", std::string(name(stopped_)));
    if (const auto digest = io::sealed_digest(storage_.directory(), io::run_file::series))
        result.set("run.file_digest", io::digest_text(*digest));
    if (failure) {
        result.set("failure.exit_code", failure->code);
        result.set("failure.reason", failure->reason);
    }
    if (recorder_ && case_.radius()) {
        auto series = recorder_->series();
        add_sphere_path({.segment = series["segment"],
                         // A quasi-static path has no vibrations to average.
                         .time = case_.effects.dynamic ? series["time"] : std::vector<double>(),
                         .force = series["force"],
                         .contact_fraction = series["contact_fraction"]},
                        case_.path(), case_.edge(), *case_.radius(), result);
    }
    if (!failure) add_summary(summary_of(case_, result, path.results()), result);
    io::write_result(storage_.directory(), result);
    if (failure || stopped_ != Stopped::no) return result;
    storage_.remove_checkpoints();
    recorder_->remove_journal();
    return result;
}

} // namespace asperity
