// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/exit_code.hpp"

#include "decomposition/communicator.hpp"
#include "io/error.hpp"
#include "io/json.hpp"
#include "io/terminal.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

namespace asperity {

namespace {

/// Time that an error waits for the other ranks, s.
constexpr double patience = 30.0;

/// Prints the error on rank 0 and returns the exit code.
int report(const std::exception& error, bool json, const Communicator& world) {
    int code = io::exit_code::internal;
    std::string text = error.what();
    std::vector<io::Problem> problems;
    if (const auto* known = dynamic_cast<const io::Error*>(&error)) {
        code = known->code();
        problems = known->problems();
        const std::size_t count = problems.size();
        if (code == io::exit_code::scene && !json)
            text +=
                fmt::format("\n{} problem{}; nothing was written", count, count == 1 ? "" : "s");
    } else if (dynamic_cast<const std::bad_alloc*>(&error)) {
        code = io::exit_code::scene; // the code of a run that is refused because it does not fit
        text =
            "asperity: out of memory"
            "\n    why: a limit (ulimit -v, the batch system's) or other processes left too little"
            "\n    fix: `asperity plan SCENE` says what a run needs";
    } else {
        text = "asperity: internal error: " + text +
               "\n    why: the program met a state it does not expect"
               "\n    fix: please report this, with the scene";
    }
    if (json) {
        const io::Json told = {
            {"code", code}, {"problems", io::problems_json(problems)}, {"text", text}};
        text = io::json_text({{"error", told}});
    }
    if (world.root()) {
        std::fflush(stdout);
        fmt::print(stderr, "{}\n", json ? io::printable(text) : io::folded(text, 2));
        std::fflush(stderr);
    }
    return code;
}

/// Ends a run of several ranks by an error on one of them. The others give rank 0 time to report
/// first; if it does not, the error is not one of rank 0.
[[noreturn]] void end_together(const std::exception& error, bool json, const Communicator& world) {
    const int code = report(error, json, world);
    if (!world.root()) {
        std::this_thread::sleep_for(std::chrono::seconds(5));
        fmt::print(stderr, "rank {}: {}\n", world.rank(), io::printable(error.what()));
        std::fflush(stderr);
    }
    world.abort(code);
}

/// Ends the program by an error that every rank meets alike, or the root for all of them: they
/// agree on the code. If not all ranks come, the others wait for this one elsewhere.
int end_alike(const std::string& what, int code, const Communicator& world) {
    if (!world.all_arrive(patience)) {
        fmt::print(stderr,
                   "rank {}: {}\n    why: other ranks do not meet this, and wait for it: are the "
                   "scene and its files on every machine?\n",
                   world.rank(), what);
        std::fflush(stderr);
        world.abort(code);
    }
    return static_cast<int>(world.max(code));
}

} // namespace

int refuse_unconnected(const ParallelSession& session) {
    if (!ParallelSession::first_started()) {
        std::this_thread::sleep_for(std::chrono::seconds(2)); // launchers end it with the first
        return io::exit_code::scene;
    }
    const std::string started = fmt::format(
        "{} processes were started, and MPI connects none of them", session.unconnected());
    if (ParallelSession::library() == no_mpi)
        throw io::SceneError(
            {"asperity", started,
             "this program was built without MPI: it has one rank with many threads",
             "start it alone, or build it with an MPI (docs/howto/install.md)"});
    throw io::SceneError(
        {"asperity", started,
         fmt::format("this program is linked with {}; the launcher is that of another MPI, or srun "
                     "without the PMI that this MPI speaks",
                     ParallelSession::library()),
         "start it with the mpirun of its own MPI, or by srun --mpi=pmi2 or pmix (srun "
         "--mpi=list)"});
}

int exit_code_of(const Communicator& world, bool json, const std::function<int()>& work) {
    try {
        return work();
    } catch (const io::SceneError& error) { // on every rank, or on the root for all of them
        return end_alike(error.what(), report(error, json, world), world);
    } catch (const io::PhysicsError& error) { // guards compare global numbers: on every rank
        return end_alike(error.what(), report(error, json, world), world);
    } catch (const RootFailure& error) { // the root has the reason and the code
        return end_alike(error.what(), io::exit_code::done, world);
    } catch (const std::exception& error) {
        if (world.size() > 1) end_together(error, json, world);
        return report(error, json, world);
    }
}

} // namespace asperity
