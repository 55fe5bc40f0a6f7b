// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run.hpp"

#include "engine/run/observers.hpp"
#include "engine/run/run_session.hpp"

#include <memory>

namespace asperity {

namespace {

/// Runs the loop to the end of the path or to the point at which the run stops.
void follow(Path& path, RunSession& session, const Observers& observers) {
    while (path.status() != Path::Status::done && !session.stop_here(path)) {
        if (!session.advance(path, observers.wish(path))) return session.stop_now(path);
        observers.look(path);
        session.copy_good_state(path);
    }
}

} // namespace

int run(const Case& c, const RunOptions& options, const Communicator& communicator) {
    c.require_runnable();
    RunSession session(c, options, communicator);
    const std::unique_ptr<Path> path = path_of(c, session.surface(), communicator);
    const Observers observers(session, *path);
    path->watch([&](long long iteration, double residual) {
        observers.look_within(*path, iteration, residual);
        return session.stop_within(*path);
    });
    const auto work = [&] {
        session.begin(*path);
        follow(*path, session, observers);
        observers.finish(*path);
    };
    return session.carry_out(*path, work);
}

} // namespace asperity
