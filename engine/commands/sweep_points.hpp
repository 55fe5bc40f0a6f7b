// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The simulations of a sweep: a child process each, `asperity run SCENE --set ... --out DIRECTORY`,
// as many side by side as asked for.
//
// Why processes and not calls of run(): each has its own team of threads, its own signals, memory
// that is given back, and a death of its own (a guard, a crash, the kernel's out-of-memory killer)
// that the others do not notice; points run side by side; and what a point did can be repeated by
// hand. Starting one costs some ten milliseconds. Ranks come with a launcher in front ("mpirun -n
// 4"), so the sweep itself is never started under mpirun.
//
// A child is asked to stop with USR1, which mpirun passes on: it leaves a checkpoint and exits with
// 75. That happens when the sweep is interrupted (INT, TERM, USR1), at its wall limit, and when the
// sweep dies (PR_SET_PDEATHSIG). Started again, a point goes on from its checkpoint; one that had
// none starts anew; a result of the same scene is taken as it is.
#pragma once

#include "engine/scene/scene.hpp"
#include "io/json_value.hpp"
#include "io/progress.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

struct SweepJob {
    std::string name;                   ///< "rms=3,seed=1"
    std::string directory;              ///< its own
    std::vector<std::string> overrides; ///< "key=value"
    Scene scene;                        ///< what these make of the file
};

enum class PointState { waiting, finished, failed };

/// What a point's directory holds.
struct PointOutcome {
    PointState state = PointState::waiting;
    io::JsonValue result;   ///< result.json, if there is one
    int exit_code = 0;      ///< of a failure
    std::string reason;     ///< of a failure, its first line
    bool was_there = false; ///< found, not run by this sweep
};

/// A failure of the physics counts as an outcome, any other (a full disk) is tried again.
/// Throws io::SceneError if there is a result of another scene.
PointOutcome look_at(const SweepJob& job);

struct SweepRunOptions {
    int at_once = 1; ///< --jobs
    int threads = 0; ///< of each, whatever the environment says; 0: they share the machine
    std::vector<std::string> launcher; ///< words to put before the program
    std::optional<double> wall_limit;  ///< s
    io::ProgressMode progress = io::ProgressMode::automatic;
};

/// Runs those that wait, and fills in what came of them. done(i) is called after each.
/// False: stopped before all of them had run.
bool run_points(const std::vector<SweepJob>& jobs, std::vector<PointOutcome>& outcomes,
                const SweepRunOptions& options, const std::function<void(std::size_t)>& done);

} // namespace asperity
