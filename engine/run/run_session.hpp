// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The session of a run beside its path: the surface, the result directory (run_storage.hpp) and its
// records (recorder.hpp), checkpoints, reasons to stop (interruptions.hpp), and the result.
#pragma once

#include "decomposition/communicator.hpp"
#include "decomposition/process_grid.hpp"
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
    /// Takes the result directory and makes the surface. Collective, as all member functions.
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

    /// Adds steps and energies to the result. Called on the root.
    using AddToResult = std::function<void(io::Result&)>;
    /// Prints the opening, calls work(), writes the result (also of a failure, which is rethrown)
    /// and prints the summary. Returns the exit code.
    int carry_out(Path& path, const std::function<void()>& work, const AddToResult& add_to);
    /// Resumes from a checkpoint before the first step, if one was asked for and is there.
    void begin(Path& path);

    // Reasons to stop.

    /// Writes a checkpoint between two steps or points if it is time or the run must end. Returns
    /// true if the run must end. Throws io::FileError if the result directory was moved or removed.
    bool stop_here(Path& path);
    /// Returns true between two iterations if the relaxation must end, and after it, by stop_now(),
    /// the run. Writes a checkpoint that is due if the path can be resumed within the relaxation.
    bool stop_within(Path& path);
    /// Writes a checkpoint for a run that ends.
    void stop_now(Path& path);

    // Checkpoints.

    /// Writes a checkpoint before a long part of the run, only if the scene has checkpoints.
    void save_if_on(Path& path);
    /// Collects the numbers of the session (records, maps) as "run.*".
    void collect(CollectNumbers& numbers);
    /// Writes path, maps and these numbers. Throws io::FileError.
    void write_state(const io::FilePlace& place, Path& path, const CollectNumbers& of_session);
    /// Returns the place of a file in the result directory.
    io::FilePlace file(const std::string& name) const;

private:
    /// Reason of an early end of the run.
    enum class Stopped { no, max_steps, wall_limit, signal };
    static const char* name(Stopped stopped);
    Interruption ask();
    void save(Path& path);
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
    void write_failure(const Path& path, const Failure& failure, const AddToResult& add_to);
    /// Writes the result on the root and returns it. failure: why the run failed, or null.
    io::Result write_result(const Path& path, const Failure* failure, const AddToResult& add_to);

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
    /// Processor time before the checkpoint that the run was resumed from, s
    double processor_before_ = 0.0;
};

} // namespace asperity
