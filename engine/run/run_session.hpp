// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What a run has beside its path: the surface, the result directory (run_storage.hpp) and what is
// recorded in it (recorder.hpp), checkpoints, reasons to stop (interruptions.hpp), and the result.
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

class RunSession {
public:
    /// Takes the result directory and makes the surface. Collective, like every member function.
    RunSession(const Case& c, const RunOptions& options, const Communicator& ranks);
    RunSession(const RunSession&) = delete;
    RunSession& operator=(const RunSession&) = delete;

    const Case& scene_case() const { return case_; }
    const Surface& surface() const { return surface_; }
    const ProcessGrid& grid() const { return grid_; }
    io::Progress& progress() { return progress_; }
    Phases& phases() { return phases_; } ///< relaxations, checkpoints, output
    PathMaps& maps() { return maps_; }
    Recorder& recorder() { return *recorder_; }

    // The run as a whole.

    /// Adds steps and energies to the result. Called on the root.
    using AddToResult = std::function<void(io::Result&)>;
    /// Prints the opening, does the work, writes the result (also of a failure, which is thrown on)
    /// and prints the summary. Returns the exit code.
    int carry_out(Path& path, const std::function<void()>& work, const AddToResult& add_to);
    /// Before the first step: goes on from a checkpoint, if one was asked for and is there.
    void begin(Path& path);

    // Reasons to stop.

    /// Between two steps or points: writes a checkpoint if it is time or the run must end; then
    /// true. Throws io::FileError where the result directory was moved or removed.
    bool stop_here(Path& path);
    /// Between two iterations: whether the relaxation must end, and the run after stop_now(). A
    /// checkpoint that is due is written where the path can go on from within.
    bool stop_within(Path& path);
    /// With a checkpoint.
    void stop_now(Path& path);

    // Checkpoints.

    /// Before what may take long: only if the scene has checkpoints.
    void save_if_on(Path& path);
    /// The numbers of what this class holds (records, maps), as "run.*".
    void collect(CollectNumbers& numbers);
    /// Path, maps and these numbers. Throws io::FileError.
    void write_state(const io::FilePlace& place, Path& path, const CollectNumbers& of_session);
    /// A file in the result directory.
    io::FilePlace file(const std::string& name) const;

private:
    /// Why the run ends early.
    enum class Stopped { no, max_steps, wall_limit, signal };
    static const char* name(Stopped stopped);
    Interruption ask();
    void save(Path& path);
    void restore(RestoreNumbers& numbers);
    void open_recorder();
    /// Of this rank with all its threads, from the first start of the run on.
    double processor_seconds() const;
    void print_notes();
    struct Failure {
        int code;
        std::string reason;
    };
    void write_failure(const Path& path, const Failure& failure, const AddToResult& add_to);
    /// failure: why the run failed, or null. Root only.
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
    /// What may not change between a checkpoint and its resumption: the physics, as text.
    const std::string fingerprint_;
    std::optional<Recorder> recorder_;
    std::optional<Recorder::Position> resumed_at_;
    Stopped stopped_ = Stopped::no;
    double processor_before_ = 0.0; ///< s, before the checkpoint that the run was resumed from
};

} // namespace asperity
