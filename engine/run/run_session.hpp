// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What every run uses, whatever it does in between: the surface, the result directory
// (run_storage.hpp) and what is recorded in it (recorder.hpp), checkpoints, reasons to stop
// (interruptions.hpp), what it has come to (path_results.hpp), and the result.
//
// A kind of run has one as a member, and reads from top to bottom in its own file: dynamic_run.cpp,
// equilibrium_run.cpp.
//
//     RunSession run(c, options, ranks);
//     return run.carry_out(bytes, [&] { ... the run ... }, add_to);
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
#include "engine/equilibrium/path_results.hpp"
#include "engine/run/checkpoint.hpp"
#include "engine/run/interruptions.hpp"
#include "engine/run/path_maps.hpp"
#include "engine/run/recorder.hpp"
#include "engine/run/run.hpp"
#include "engine/run/run_storage.hpp"
#include "engine/setup/case.hpp"
#include "io/result.hpp"
#include "io/terminal.hpp"

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

private:
    const Case& case_;
    const RunOptions& options_;

public:
    const Communicator ranks;
    const Surface surface;
    const ProcessGrid grid;

private:
    RunStorage storage_; // after the surface: a map that is refused leaves no directory
    Interruptions interruptions_;

public:
    io::Progress progress;
    PathResults results;
    Phases phases; ///< relaxations, checkpoints, output
    PathMaps maps;

    // The run as a whole.

    /// Adds what a kind of run knows to the result: steps and energies. Called on the root.
    using AddToResult = std::function<void(io::Result&)>;
    /// Prints the opening, does the work, writes the result (also of a failure, which is thrown on)
    /// and prints the summary. bytes: of the block and the interface, for the opening. Returns the
    /// exit code.
    int carry_out(std::size_t bytes, const std::function<void()>& work, const AddToResult& add_to);
    /// The work ends here, at drive.max_steps.
    void stop_at_max_steps() { stopped_ = Stopped::max_steps; }

    // Checkpoints.

    /// Writes the state of the run to this file, with what collect() adds and the arrays of `maps`
    /// in it.
    using WriteState = std::function<void(const io::FilePlace&)>;
    /// The checkpoint to resume from, if one was asked for and is there.
    std::optional<io::FilePlace> checkpoint_to_resume();
    void save(const WriteState& write);
    /// At drive.max_steps, and before what may take long: only if the scene has checkpoints.
    void save_if_on(const WriteState& write);
    /// The numbers of what this class holds (records, maps, results), as "run.*", and back.
    void collect(CollectNumbers& numbers);
    void restore(RestoreNumbers& numbers);
    /// What may not change between a checkpoint and its resumption: the physics, as text.
    const std::string& fingerprint() const { return fingerprint_; }
    /// A state for a look, beside the result.
    io::FilePlace file(const std::string& name) const;

    // Reasons to stop.

    /// Whether it is time to call stop_here(): for steps too short to call it at each.
    bool look_is_due() { return interruptions_.look_is_due(); }
    /// Between two steps or points: writes a checkpoint if it is time or the run must end; then
    /// true. where: "step 1200". Throws io::FileError where the result directory was moved or
    /// removed.
    bool stop_here(const WriteState& write, const std::string& where);
    /// Between two iterations: the same, without a checkpoint before it stops; one that is due
    /// meanwhile is written where the relaxation can go on from one. True: the relaxation must end,
    /// and the run after stop_now().
    bool stop_relaxation(const WriteState& write = {});
    /// With a checkpoint.
    void stop_now(const WriteState& write, const std::string& where);

    // Records.

    /// Before anything is recorded, after restore() if the run is resumed.
    void open_recorder();
    Recorder& recorder() { return *recorder_; }

    /// Below this the mean height of the lowest layer is beyond the substrate, Å.
    double lowest_height() const {
        return surface.statistics.lowest - reach_of(case_.simulation.interface);
    }
    /// Done of the whole way from start_height (above the substrate's zero), 0 to 1, as far as the
    /// top plane's displacement tells.
    double way_done(std::size_t segment, double top, double start_height) const;

private:
    /// Why the run ends early.
    enum class Stopped { no, max_steps, wall_limit, signal };
    static const char* name(Stopped stopped);
    Interruption ask();
    /// Of this rank with all its threads, from the first start of the run on.
    double processor_seconds() const;
    void print_notes();
    struct Failure {
        int code;
        std::string reason;
    };
    void write_failure(const Failure& failure, const AddToResult& add_to);
    /// failure: why the run failed, or null. Root only.
    io::Result write_result(const Failure* failure, const AddToResult& add_to);

    const std::string fingerprint_;
    std::optional<Recorder> recorder_;
    std::optional<Recorder::Position> resumed_at_;
    Stopped stopped_ = Stopped::no;
    double processor_before_ = 0.0; ///< s, before the checkpoint that the run was resumed from
};

// As run(), which checks the case and chooses.

/// Approach and pull-off at the velocity of the drive.
int run_in_time(const Case& c, const RunOptions& options, const Communicator& communicator);
/// A quasi-static path, or straight to the relaxed state under zero load.
int run_equilibrium(const Case& c, const RunOptions& options, const Communicator& communicator);

} // namespace asperity
