// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/observers.hpp"

#include "engine/path/expected_path.hpp"
#include "engine/run/run_session.hpp"
#include "engine/run/summary.hpp"
#include "io/terminal.hpp"

#include <fmt/format.h>

namespace asperity {

bool row_is_due(const Path& path) {
    const Case& c = path.scene_case();
    if (!c.effects.dynamic || path.status() == Path::Status::at_end) return true;
    return path.steps() % c.output.series == 0;
}

Path::Wish Rows::wish(const Path& path) const {
    return row_is_due(path) ? session_.recorder().wish_of_row() : Path::Wish{};
}

void Rows::look_at_step(const Path& path) {
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

void Trajectory::look_at_step(const Path& path) {
    if (!is_due(path.now().step)) return;
    const auto t = session_.phases().time(Phase::output);
    session_.recorder().frame(path, session_.scene_case().output.velocities);
}

void ProgressLine::look_at_step(const Path& path) { look_within(path, 0, 0.0); }

void ProgressLine::look_at_beginning(const Path& path) {
    session_.progress().say(path.scene_case().path()[path.concluded()].text + " begins");
}

void ProgressLine::look_within(const Path& path, long long iteration, double residual) {
    io::Progress& progress = session_.progress();
    if (!progress.due()) return;
    const Case& c = path.scene_case();
    const StepRecord& now = path.now();
    if (path.status() == Path::Status::relaxing) {
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
