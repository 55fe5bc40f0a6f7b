// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The session of a run beside its path: the surface, the result directory (run_storage.hpp) and its
// records (recorder.hpp), checkpoints, the last good state, reasons to stop (interruptions.hpp),
// and the result.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
#include "engine/path/checkpoint.hpp"
#include "engine/path/path.hpp"
#include "engine/run/interruptions.hpp"
#include "engine/run/path_maps.hpp"
#include "engine/run/recorder.hpp"
#include "engine/run/run.hpp"
#include "engine/run/run_storage.hpp"
#include "io/result.hpp"
#include "io/terminal.hpp"

#include <functional>
#include <optional>
#include <string>

namespace asperity {

/// Session of a run.
class RunSession {
public:
    /// Locks the result directory and makes the surface. Keeps references to the case and the
    /// options. All member functions are collective.
    RunSession(const Case& c, const RunOptions& options, const Communicator& ranks);
    RunSession(const RunSession&) = delete;
    RunSession& operator=(const RunSession&) = delete;

    const Case& scene_case() const { return case_; }
    const Surface& surface() const { return surface_; }
    const ProcessGrid& grid() const { return grid_; }
    io::Progress& progress() { return progress_; }
    Phases& phases() { return phases_; } ///< returns the clocks of relaxations, checkpoints, output
    PathMaps& maps() { return maps_; }
    Recorder& recorder() { return *recorder_; }

    // Run as a whole.

    /// Prints the opening, calls work(), writes the result and prints the summary. Returns the exit
    /// code. If work() throws, the failure is written to the result and the exception rethrown.
    int carry_out(const Path& path, const std::function<void()>& work);
    /// Resumes from a checkpoint, if the options ask for it and a checkpoint exists. Must be called
    /// before the first step.
    void begin(Path& path);
    /// Advances the path (Path::advance()). Writes a checkpoint before a relaxation at the end of
    /// an approach: a run that is stopped during the relaxation resumes from there. Returns false
    /// if the watch has stopped a relaxation. Throws io::PhysicsError if the energy balance or a
    /// coordinate of a step or point is no longer physical (guard.hpp); a dynamic path is then
    /// restored to its last good state, which is written to last-good.h5.
    bool advance(Path& path, const Path::Wish& wish);
    /// Copies the state of a dynamic path as its last good state, every few rows of the series.
    /// Must be called after the observers have looked.
    void copy_good_state(const Path& path);

    // Reasons to stop.

    /// Writes a checkpoint between two steps or points if a checkpoint is due or the run must end.
    /// Returns true if the run must end; drive.max_steps does not end a run before an ended segment
    /// is concluded. Throws io::FileError if the result directory was moved or removed.
    bool stop_here(const Path& path);
    /// Returns true between two iterations of a relaxation if the run must end: the caller ends the
    /// relaxation and calls stop_now(). Writes a checkpoint that is due if the path can be resumed
    /// within the relaxation.
    bool stop_within(const Path& path);
    /// Writes a checkpoint for a run that ends.
    void stop_now(const Path& path);

private:
    /// Reason of an early end of the run.
    enum class Stopped { no, max_steps, wall_limit, signal };
    static const char* name(Stopped stopped);
    Interruption ask();
    void save(const Path& path);
    void save_if_on(const Path& path);
    void require_physical(Path& path);
    std::string restore_last_good_state(Path& path);
    void collect(CollectNumbers& numbers);
    void write_state(const io::FilePlace& place, const Path& path,
                     const CollectNumbers& of_session) const;
    io::FilePlace file(const std::string& name) const;
    void restore(RestoreNumbers& numbers);
    void open_recorder();
    /// Returns the processor time of this rank with all its threads, from the first start of the
    /// run, s.
    double processor_seconds() const;
    void print_notes();
    struct Failure {
        int code;
        std::string reason;
    };
    void write_failure(const Path& path, const Failure& failure);
    /// Writes the result on the root and returns it. failure: why the run failed, or null.
    io::Result write_result(const Path& path, const Failure* failure);

    const Case& case_;
    const RunOptions& options_;
    const Communicator ranks_;
    const Surface surface_;
    const ProcessGrid grid_;
    RunStorage storage_; // after the surface: a map that is refused leaves no directory
    Interruptions interruptions_;
    io::Progress progress_;
    Phases phases_;
    PathMaps maps_;
    /// Physics as text, which may not change between a checkpoint and its resumption.
    const std::string fingerprint_;
    std::optional<Recorder> recorder_;
    std::optional<Recorder::Position> resumed_at_;
    Stopped stopped_ = Stopped::no;
    /// Last good state of a dynamic path, and the numbers of the session at that state.
    Snapshot last_good_;
    CollectNumbers session_at_last_good_;
    /// The step or point at which a guard ended the run; the path may have been restored since.
    std::optional<StepRecord> failed_;
    /// Processor time before the checkpoint that the run was resumed from, s
    double processor_before_ = 0.0;
};

} // namespace asperity
