// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Reasons to interrupt a run between two steps, points or iterations, and the times at which to
// look for them.
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/run/run.hpp"

#include <chrono>
#include <optional>

namespace asperity {

/// Reasons to interrupt a run. If there are several, the last one in this list counts.
enum class Interruption { none, checkpoint, wall_limit, signal };

/// Interruptions of a run.
class Interruptions {
public:
    /// Starts the clock. checkpoint: seconds between two checkpoints; empty if none are written.
    Interruptions(const RunOptions& options, std::optional<double> checkpoint,
                  const Communicator& ranks)
        : options_(options), checkpoint_(checkpoint), ranks_(ranks) {}

    /// Returns the reason to interrupt now, the same on all ranks. Collective.
    Interruption now() const;
    /// Returns true about every half second (more often with frequent checkpoints). Callers with
    /// short steps call now() only then. Collective.
    bool check_is_due();
    /// Notes the time of a call of now().
    void checked() { last_check_ = seconds(); }
    /// Notes the time of a checkpoint.
    void checkpoint_written() { last_checkpoint_ = seconds(); }
    /// Returns the seconds since the start.
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    /// Returns the reason known to this rank.
    Interruption here() const;

    const RunOptions& options_;
    const std::optional<double> checkpoint_; ///< s
    const Communicator ranks_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double last_checkpoint_ = 0.0, last_check_ = 0.0; ///< s
    long long steps_to_check_ = 1, check_period_ = 1;
};

} // namespace asperity
