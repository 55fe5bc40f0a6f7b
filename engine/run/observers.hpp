// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The observers of a run except the maps (path_maps.hpp).
#pragma once

#include "engine/path/path.hpp"

namespace asperity {

class RunSession;

/// Returns true if the next step makes a row of the series.
bool row_is_due(const Path& path);

/// Rows of the series, one for each observed step or point.
class Rows : public Observer {
public:
    explicit Rows(RunSession& session) : session_(session) {}
    Path::Wish wish(const Path& path) const override;

protected:
    void look_at_step(const Path& path) override;

private:
    RunSession& session_;
};

/// Frames of the lowest layer (output.trajectory).
class Trajectory : public Observer {
public:
    explicit Trajectory(RunSession& session) : session_(session) {}
    Path::Wish wish(const Path& path) const override;

protected:
    void look_at_step(const Path& path) override;

private:
    bool is_due(long long step) const;
    RunSession& session_;
};

/// The line of progress in the terminal.
class ProgressLine : public Observer {
public:
    explicit ProgressLine(RunSession& session) : session_(session) {}
    /// Shows an iteration of a relaxation, for which the path has no point yet, if it is time.
    void look_within(const Path& path, long long iteration, double residual);

protected:
    void look_at_step(const Path& path) override;
    void look_at_beginning(const Path& path) override;

private:
    RunSession& session_;
};

} // namespace asperity
