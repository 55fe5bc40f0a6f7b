// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Why a run may be interrupted between two steps, points or iterations, and when it is time to
// look.
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/run/run.hpp"

#include <chrono>

namespace asperity {

/// Of several the last one counts.
enum class Interruption { none, checkpoint, wall_limit, signal };

class Interruptions {
public:
    /// checkpoint: seconds between two of them; HUGE_VAL: none are asked for.
    Interruptions(const RunOptions& options, double checkpoint, const Communicator& ranks)
        : options_(options), checkpoint_(checkpoint), ranks_(ranks) {}

    /// The same on all ranks. Collective.
    Interruption now() const;
    /// Whether it is time to ask, about every half second (more often where checkpoints are): for
    /// steps too short to ask at each. Collective.
    bool look_is_due();
    void looked() { last_look_ = seconds(); }
    void checkpoint_written() { last_checkpoint_ = seconds(); }
    /// Since the start.
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    /// As far as this rank knows.
    Interruption here() const;

    const RunOptions& options_;
    const double checkpoint_;
    const Communicator ranks_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double last_checkpoint_ = 0.0, last_look_ = 0.0; ///< s
    long long steps_to_look_ = 1, looked_every_ = 1;
};

} // namespace asperity
