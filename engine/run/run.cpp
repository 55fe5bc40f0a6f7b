// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/run.hpp"

#include "decomposition/aligned_array.hpp"
#include "engine/run/observers.hpp"
#include "engine/run/path_maps.hpp"
#include "engine/run/run_result.hpp"
#include "engine/run/run_session.hpp"

#include <memory>
#include <string>
#include <vector>

namespace asperity {

namespace {

using Observers = std::vector<Observer*>;

/// Concludes a segment. Returns false if the run stops on the way to its state.
bool conclude(Path& path, RunSession& session, const Observers& observers) {
    const Case& c = path.scene_case();
    const std::size_t number = *path.ended();
    const Segment& segment = c.path()[number];
    const bool approached = segment.kind == Segment::approach;
    if (c.effects.relaxation && (approached || segment.kind == Segment::relax)) {
        if (approached) {
            session.save_if_on(path); // a run that is stopped here starts the relaxation again
            session.progress().say("contact is made; relaxing its lowest layer under no load");
        }
        const auto t = session.phases().time(Phase::relax);
        const std::optional<LayerAtRest> state = path.find_state();
        if (!state) {
            session.stop_now(path);
            return false;
        }
        for (Observer* o : observers)
            o->look_at_state(path, *state);
    }
    path.conclude();
    if (number + 1 < c.path().size()) session.progress().say(c.path()[number + 1].text + " begins");
    return true;
}

/// Runs the loop to the end of the path or to the point at which the run stops.
void follow(Path& path, RunSession& session, const Observers& observers) {
    for (;;) {
        while (path.ended())
            if (!conclude(path, session, observers)) return;
        if (path.done() || session.stop_here(path)) return;
        Path::Wish wish;
        for (const Observer* o : observers)
            wish |= o->wish(path);
        const Path::Made made = path.advance(wish);
        if (made == Path::Made::interrupted) return session.stop_now(path);
        if (made == Path::Made::step)
            for (Observer* o : observers)
                o->look(path);
        if (path.at_end())
            for (Observer* o : observers)
                o->look_at_end(path);
    }
}

} // namespace

int run(const Case& c, const RunOptions& options, const Communicator& communicator) {
    c.require_runnable();
    RunSession session(c, options, communicator);
    free_kept_arrays(); // arrays of the surface
    const std::unique_ptr<Path> path = path_of(c, session.surface(), communicator);
    LastGood last_good(session);
    Guard guard(last_good);
    Rows rows(session);
    Trajectory trajectory(session);
    ProgressLine progress(session);
    const Observers observers = {&guard,     &trajectory,     &rows,
                                 &last_good, &session.maps(), &progress};
    path->watch([&](long long iteration, double residual) {
        if (session.progress().due()) progress.look_within(*path, iteration, residual);
        return session.stop_within(*path);
    });
    const auto work = [&] {
        session.begin(*path);
        follow(*path, session, observers);
        for (Observer* o : observers)
            o->finish(*path);
    };
    const auto add_to = [&](io::Result& result) { add_steps(*path, guard.failed(), result); };
    return session.carry_out(*path, work, add_to);
}

} // namespace asperity
