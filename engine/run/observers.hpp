// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The observers of a run: rows of the series, frames, maps (path_maps.hpp) and the line of
// progress. A new one is a class in observers.cpp and a line of the list there.
#pragma once

#include "engine/path/path.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace asperity {

class RunSession;

/// Returns true if the next time step is recorded as a row of the series; each point is.
bool row_is_due(const Path& path);

/// The observers of a run, in any order.
class Observers {
public:
    /// Makes the observers that the scene asks for. Keeps a reference to the session.
    Observers(RunSession& session, const Path& path);

    /// Returns the quantities that the observers need of the next step.
    Path::Wish wish(const Path& path) const;
    /// Looks at the path after advance().
    void look(const Path& path) const;
    /// Shows an iteration of a relaxation in the line of progress. residual: largest residual
    /// force, eV/Å.
    void look_within(const Path& path, long long iteration, double residual) const {
        look_within_(path, iteration, residual);
    }
    /// Ends the observation when the run ends, on a complete or an interrupted path.
    void finish(const Path& path) const;

private:
    std::vector<std::unique_ptr<Observer>> own_;
    std::vector<Observer*> all_; ///< the observers above and the maps of the session
    std::function<void(const Path&, long long, double)> look_within_;
};

} // namespace asperity
