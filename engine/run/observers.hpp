// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The observers of a run except the maps (path_maps.hpp).
#pragma once

#include "engine/path/checkpoint.hpp"
#include "engine/path/path.hpp"

#include <optional>
#include <string>

namespace asperity {

class RunSession;

/// Copy of the last good state of a dynamic run, in memory, to be written as the checkpoint
/// last-good.h5 when the guard ends the run. Looks after the rows.
class LastGood : public Observer {
public:
    explicit LastGood(RunSession& session) : session_(session) {}
    void look(Path& path) override;
    /// Puts the path back and writes it. Returns a sentence on the state to resume from.
    std::string write(Path& path);

private:
    RunSession& session_;
    Snapshot snapshot_;
    CollectNumbers of_session_;
};

/// Guard that ends the run if the energy balance or a coordinate is no longer physical. Must be the
/// first observer.
class Guard : public Observer {
public:
    explicit Guard(LastGood& last_good) : last_good_(last_good) {}
    void look(Path& path) override;
    /// Returns the step or point that ended the run, if one did: the path may have been put back.
    const std::optional<StepRecord>& failed() const { return failed_; }

private:
    LastGood& last_good_;
    std::optional<StepRecord> failed_;
};

/// Returns true if the next step makes a row of the series.
bool row_is_due(const Path& path);

/// Rows of the series, one for each observed step or point.
class Rows : public Observer {
public:
    explicit Rows(RunSession& session) : session_(session) {}
    Path::Wish wish(const Path& path) const override;
    void look(Path& path) override;

private:
    RunSession& session_;
};

/// Frames of the lowest layer (output.trajectory).
class Trajectory : public Observer {
public:
    explicit Trajectory(RunSession& session) : session_(session) {}
    Path::Wish wish(const Path& path) const override;
    void look(Path& path) override;

private:
    bool is_due(long long step) const;
    RunSession& session_;
};

/// The line of progress in the terminal.
class ProgressLine : public Observer {
public:
    explicit ProgressLine(RunSession& session) : session_(session) {}
    void look(Path& path) override;
    /// Shows an iteration of a relaxation, for which the path has no point yet.
    void look_within(const Path& path, long long iteration, double residual);

private:
    RunSession& session_;
};

} // namespace asperity
