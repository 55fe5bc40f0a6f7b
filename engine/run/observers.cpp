// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/observers.hpp"

#include "engine/path/expected_path.hpp"
#include "engine/path/guard.hpp"
#include "engine/run/run_session.hpp"
#include "engine/run/summary.hpp"
#include "io/result_directory.hpp"
#include "io/terminal.hpp"

#include <fmt/format.h>

#include <utility>

namespace asperity {

namespace {

/// Observed steps between two states kept in memory for the guard.
constexpr std::uint64_t rows_between_snapshots = 10;

} // namespace

void LastGood::look(Path& path) {
    const bool kept = path.scene_case().effects.dynamic && path.now().observed;
    if (!kept || session_.recorder().rows() % rows_between_snapshots != 1) return;
    const auto t = session_.phases().time(Phase::output);
    snapshot_.take(path);
    of_session_ = {};
    session_.collect(of_session_);
}

std::string LastGood::write(Path& path) {
    if (snapshot_.empty()) return "no earlier state was kept";
    snapshot_.restore(path);
    const char* file = io::run_file::last_good;
    try {
        session_.write_state(session_.file(file), path, of_session_);
        return fmt::format("the last good state, {}, is in {}", path.position(), file);
    } catch (const std::exception&) { // a full disk must not hide what happened
        return "the last good state could not be written";
    }
}

void Guard::look(Path& path) {
    failed_ = path.now();
    Path::Kept kept;
    if (path.scene_case().effects.dynamic) kept = [&] { return last_good_.write(path); };
    guard(path, kept);
    failed_.reset();
}

bool row_is_due(const Path& path) {
    const Case& c = path.scene_case();
    if (!c.effects.dynamic || path.about_to_conclude()) return true;
    return path.steps() % c.output.series == 0;
}

Path::Wish Rows::wish(const Path& path) const {
    return row_is_due(path) ? session_.recorder().wish_of_row() : Path::Wish{};
}

void Rows::look(Path& path) {
    if (!path.now().observed) return;
    const auto t = session_.phases().time(Phase::output);
    session_.recorder().row(path);
}

bool Trajectory::is_due(long long step) const {
    const std::optional<long long>& every = session_.scene_case().output.trajectory;
    return every && step % *every == 0;
}

Path::Wish Trajectory::wish(const Path& path) const {
    const bool due = is_due(path.steps());
    return {.layer = due, .velocities = due && session_.scene_case().output.velocities};
}

void Trajectory::look(Path& path) {
    if (!is_due(path.now().step)) return;
    const auto t = session_.phases().time(Phase::output);
    session_.recorder().frame(path, session_.scene_case().output.velocities);
}

void ProgressLine::look(Path& path) {
    io::Progress& progress = session_.progress();
    if (progress.due()) look_within(path, 0, 0.0);
}

void ProgressLine::look_within(const Path& path, long long iteration, double residual) {
    const Case& c = path.scene_case();
    const StepRecord& now = path.now();
    io::Progress& progress = session_.progress();
    if (path.ended()) {
        progress.update(
            {fmt::format("relaxing, largest force {:.1e} eV/Å", residual), iteration, 0.0, -1.0});
        return;
    }
    const std::string where = progress_phase(c, c.path()[path.segment()].text, now.force,
                                             now.in_contact, now.mean_height) +
                              (iteration > 0 ? ", relaxing" : "");
    progress.update({where, path.iterations().value_or(path.steps()) + iteration,
                     c.effects.dynamic ? now.time : 0.0,
                     way_done(c, path.reference_height(), path.segment(), now.top)});
}

} // namespace asperity
