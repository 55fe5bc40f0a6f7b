// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The observers of a run but the maps (path_maps.hpp).
#pragma once

#include "engine/path/checkpoint.hpp"
#include "engine/path/path.hpp"

#include <optional>
#include <string>

namespace asperity {

class RunSession;

/// In time the last good state is kept in memory, to be written as a checkpoint, last-good.h5,
/// where the guard ends the run. Looks after the rows.
class LastGood : public Observer {
public:
    explicit LastGood(RunSession& session) : session_(session) {}
    void look(Path& path) override;
    /// Puts the path back and writes it; what there is to go on from, in words.
    std::string write(Path& path);

private:
    RunSession& session_;
    Snapshot snapshot_;
    CollectNumbers of_session_;
};

/// Ends a run whose numbers are no physics. Looks first.
class Guard : public Observer {
public:
    explicit Guard(LastGood& last_good) : last_good_(last_good) {}
    void look(Path& path) override;
    /// The step or point that ended the run, if one did: the path may have been put back.
    const std::optional<StepRecord>& failed() const { return failed_; }

private:
    LastGood& last_good_;
    std::optional<StepRecord> failed_;
};

/// Whether the next step makes a row of the series.
bool row_is_due(const Path& path);

/// Rows of the series: of each observed step or point.
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
    /// Within a relaxation, of which the path knows no point yet.
    void look_within(const Path& path, long long iteration, double residual);

private:
    RunSession& session_;
};

} // namespace asperity
