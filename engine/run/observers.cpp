// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/observers.hpp"

#include "engine/path/course.hpp"
#include "engine/run/run_session.hpp"
#include "engine/run/summary.hpp"
#include "io/terminal.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace asperity {

bool row_is_due(const Path& path) {
    return path.status() == Path::Status::at_end ||
           path.steps() % path.scene_case().output.series == 0;
}

namespace {

/// Rows of the series, one for each observed step or point.
class Rows : public Observer {
public:
    explicit Rows(RunSession& session) : session_(session) {}
    Path::Wish wish(const Path& path) const override;

protected:
    void look_at_step(const Path& path) override;

private:
    RunSession& session_;
};

/// Frames of the lowest layer (output.trajectory).
class Trajectory : public Observer {
public:
    explicit Trajectory(RunSession& session) : session_(session) {}
    Path::Wish wish(const Path& path) const override;

protected:
    void look_at_step(const Path& path) override;

private:
    bool is_due(long long step) const;
    RunSession& session_;
};

/// The line of progress in the terminal.
class ProgressLine : public Observer {
public:
    ProgressLine(RunSession& session, const Path& path)
        : session_(session), course_(path.scene_case(), path.surface().statistics.rms,
                                     path.interface().reference_height()) {}
    /// Shows an iteration of a relaxation, if it is time.
    void look_within(const Path& path, long long iteration, double residual);

protected:
    void look_at_step(const Path& path) override;
    void look_at_beginning(const Path& path) override;

private:
    void look_at_course(const Path& path);

    RunSession& session_;
    Course course_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

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

/// Tells the course where the path is and when.
void ProgressLine::look_at_course(const Path& path) {
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - start_;
    course_.look(path.segment(), path.now(), since.count());
}

void ProgressLine::look_at_step(const Path& path) {
    if (session_.progress().mode() == io::ProgressMode::off) return;
    if (!path.has_short_steps() || path.now().step % 64 == 0) look_at_course(path);
    look_within(path, 0, 0.0);
}

void ProgressLine::look_at_beginning(const Path& path) {
    session_.progress().say(path.scene_case().path()[path.concluded()].text + " begins");
}

void ProgressLine::look_within(const Path& path, long long iteration, double residual) {
    io::Progress& progress = session_.progress();
    if (!progress.due()) return;
    const Case& c = path.scene_case();
    const StepRecord& now = path.now();
    look_at_course(path);
    const double done = course_.fraction(), left = course_.left();
    if (path.status() == Path::Status::relaxing) {
        progress.update({fmt::format("relaxing, largest force {:.1e} eV/Å", residual), iteration,
                         0.0, done, left});
        return;
    }
    const std::string where = progress_phase(c, c.path()[path.segment()].text, now.force,
                                             now.in_contact, now.mean_height) +
                              (iteration > 0 ? ", relaxing" : "");
    progress.update({where, path.iterations().value_or(path.steps()) + iteration,
                     c.effects.dynamic ? now.time : 0.0, done, left});
}

} // namespace

Observers::Observers(RunSession& session, const Path& of) {
    auto progress = std::make_unique<ProgressLine>(session, of);
    look_within_ = [line = progress.get()](const Path& path, long long iteration, double residual) {
        line->look_within(path, iteration, residual);
    };
    own_.push_back(std::make_unique<Trajectory>(session));
    own_.push_back(std::make_unique<Rows>(session));
    own_.push_back(std::move(progress));
    all_ = {&session.maps()};
    for (const auto& observer : own_)
        all_.push_back(observer.get());
}

Path::Wish Observers::wish(const Path& path) const {
    Path::Wish wish;
    for (const Observer* o : all_)
        wish |= o->wish(path);
    return wish;
}

void Observers::look(const Path& path) const {
    for (Observer* o : all_)
        o->look(path);
}

void Observers::finish(const Path& path) const {
    for (Observer* o : all_)
        o->finish(path);
}

} // namespace asperity
