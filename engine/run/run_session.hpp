// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What every run uses, whatever it does in between: the surface, the result directory and
// what is recorded in it, checkpoints, reasons to stop, what was found, and the result.
//
// A kind of run has one as a member, and reads from top to bottom in its own file: dynamic_run.cpp
// in time, equilibrium_run.cpp without.
//
//     RunSession run(c, options, ranks);
//     return run.carry_out(bytes, [&] { ... the run ... }, add_to);
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
#include "engine/equilibrium/findings.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/curve.hpp"
#include "engine/run/recorder.hpp"
#include "engine/run/run.hpp"
#include "engine/run/run_storage.hpp"
#include "engine/setup/case.hpp"
#include "io/error.hpp"
#include "io/progress.hpp"
#include "io/result.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

class RunSession {
public:
    /// Takes the result directory and makes the surface. Collective, like every member function.
    RunSession(const Case& c, const RunOptions& options, const Communicator& ranks);
    RunSession(const RunSession&) = delete;
    RunSession& operator=(const RunSession&) = delete;

    const Communicator ranks;

private:
    const Case& case_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    const RunOptions& options_;

public:
    const Surface surface;
    const ProcessGrid grid;
    RunStorage storage_; // after the surface: a map that is refused leaves no directory
    io::Progress progress;
    Findings findings;
    Phases phases; ///< relaxations, checkpoints, output

    // The run as a whole.

    /// Adds what a kind of run knows to the result: steps and energies. Called on the root.
    using AddToResult = std::function<void(io::Result&)>;
    /// Prints the opening, does the work, writes the result (also of a failure, which is thrown on)
    /// and prints the summary. bytes: of the block and the interface, for the opening. Returns the
    /// exit code.
    int carry_out(std::size_t bytes, const std::function<void()>& work, const AddToResult& add_to);
    /// The work ends here, at drive.max_steps.
    void stop_at_max_steps() { stopped_ = "max_steps"; }

    // Checkpoints.

    /// Writes the state of the run to this file, with scalars() and arrays() in it.
    using WriteState = std::function<void(const io::FilePlace&)>;
    /// The checkpoint to resume from, if one was asked for and is there.
    std::optional<io::FilePlace> checkpoint_to_resume();
    void save(const WriteState& write);
    /// At drive.max_steps, and before what may take long: only if the scene has checkpoints.
    void save_if_on(const WriteState& write);
    /// The state of what this class holds (records, findings), and back.
    RunScalars scalars();
    std::vector<StateArray> arrays();
    void restore(const RunScalars& scalars);
    /// What may not change between a checkpoint and its resumption: the physics, as text.
    const std::string& fingerprint() const { return fingerprint_; }
    /// Below this the mean height of the lowest layer is beyond the substrate, Å.
    double lowest_height() const {
        return surface.statistics.lowest - reach_of(case_.simulation.interface);
    }
    /// A state for a look, beside the result.
    io::FilePlace file(const std::string& name) const;

    // Reasons to stop.

    /// Whether it is time to call stop_here(), about every half second (more often where
    /// checkpoints are): for steps too short to call it at each.
    bool look_is_due();
    /// Between two steps or points: looks at signals, the wall limit, the checkpoint interval and
    /// the result directory, and writes a checkpoint if one of them asks for it. True: the run must
    /// end. where: "step 1200".
    bool stop_here(const WriteState& write, const std::string& where);
    /// Between two iterations: the same, without a checkpoint before it stops; one that is due
    /// meanwhile is written where the relaxation can go on from one. True: the relaxation must end,
    /// and the run after stop_now().
    bool stop_relaxation(const WriteState& write = {});
    /// Whether the next of these will say so, as far as this rank knows: where it works alone.
    bool wants_stop() const;
    /// With a checkpoint.
    void stop_now(const WriteState& write, const std::string& where);

    // Records.

    /// Before anything is recorded, after restore() if the run is resumed.
    void open_recorder();
    Recorder& recorder() { return *recorder_; }
    /// Maps that the scene asks for along the path: now, if this step is one of every so many; and
    /// those of the largest attraction of the pull-off, kept until the end of the work.
    void watch_fields(long long step, Leg leg, double attraction,
                      const VectorPlane<const double>& layer, const Interface& interface,
                      double reference_height);
    /// Whether watch_fields() has anything to do at all, and at this step without an attraction.
    bool watches_fields() const { return case_.maps.every || case_.maps.pull_off; }
    bool field_is_due(long long step) const {
        return case_.maps.every && step % *case_.maps.every == 0;
    }
    /// Writes the maps that watch_fields() has kept: at the end of the work.
    void write_kept_fields(const Interface& interface);

    /// Done of the whole way from start_height (above the substrate's zero), 0 to 1, as far as the
    /// top plane's displacement tells.
    double way_done(Leg leg, double top, double start_height) const;

private:
    enum class Due { nothing, save, stop };
    Due due();
    /// Why a run may be interrupted; of several the last one counts.
    enum class Reason { none, checkpoint, wall_limit, signal, directory };
    Reason reason() const;
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    /// Of this rank with all its threads, from the first start of the run on.
    double processor_seconds() const;
    void print_notes();
    bool bring_back_directory();
    struct Failure {
        int code;
        std::string reason;
    };
    void write_failure(const Failure& failure, const AddToResult& add_to);
    /// failure: why the run failed, or null. Root only.
    io::Result write_result(const Failure* failure, const AddToResult& add_to);
    void throw_if_directory_gone();

    const std::string fingerprint_;
    std::optional<Recorder> recorder_;
    std::optional<Recorder::Position> resumed_at_;
    std::string stopped_; ///< why the run ends early; empty: it does not

    /// The lowest layer where the pull-off attracted most.
    struct Strongest {
        double attraction = 0.0, reference_height = 0.0;
        bool kept = false;         ///< there is something to be written
        VectorField<double> layer; ///< only if the scene asks for these maps
    } strongest_;

    double processor_before_ = 0.0; ///< s, before the checkpoint that the run was resumed from
    double last_checkpoint_ = 0.0;  ///< s
    std::string saved_at_;          ///< where the last checkpoint was written
    long long steps_to_look_ = 1, looked_every_ = 1;
    double last_look_ = 0.0; ///< s
};

// As run(), which checks the case and chooses.

/// Approach and pull-off at the velocity of the drive.
int run_in_time(const Case& c, const RunOptions& options, const Communicator& communicator);
/// A quasi-static path, or straight to the relaxed state under zero load.
int run_equilibrium(const Case& c, const RunOptions& options, const Communicator& communicator);

} // namespace asperity
