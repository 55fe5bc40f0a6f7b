// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run.hpp"

#include "engine/run/observers.hpp"
#include "engine/run/path_maps.hpp"
#include "engine/run/run_session.hpp"

#include <memory>
#include <vector>

namespace asperity {

namespace {

using Observers = std::vector<Observer*>;

/// Runs the loop to the end of the path or to the point at which the run stops.
void follow(Path& path, RunSession& session, const Observers& observers) {
    while (path.status() != Path::Status::done && !session.stop_here(path)) {
        Path::Wish wish;
        for (const Observer* o : observers)
            wish |= o->wish(path);
        if (!session.advance(path, wish)) return session.stop_now(path);
        for (Observer* o : observers)
            o->look(path);
        session.keep(path);
    }
}

} // namespace

int run(const Case& c, const RunOptions& options, const Communicator& communicator) {
    c.require_runnable();
    RunSession session(c, options, communicator);
    const std::unique_ptr<Path> path = path_of(c, session.surface(), communicator);
    Rows rows(session);
    Trajectory trajectory(session);
    ProgressLine progress(session);
    const Observers observers = {&trajectory, &rows, &session.maps(), &progress};
    path->watch([&](long long iteration, double residual) {
        progress.look_within(*path, iteration, residual);
        return session.stop_within(*path);
    });
    const auto work = [&] {
        session.begin(*path);
        follow(*path, session, observers);
        for (Observer* o : observers)
            o->finish(*path);
    };
    return session.carry_out(*path, work);
}

} // namespace asperity
