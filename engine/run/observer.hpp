// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What looks at a path while a run drives it (run.cpp): the guard, the records, the maps, the line
// of progress. An observer changes nothing of the path.
#pragma once

#include "engine/path/path.hpp"

namespace asperity {

class Observer {
public:
    virtual ~Observer() = default;
    /// What it needs of the next step.
    virtual Path::Wish wish(const Path&) const { return {}; }
    /// After each step or point.
    virtual void look(Path& path) = 0;
    /// Where the step or point has ended a segment, after look(): path.at_end().
    virtual void look_at_end(Path&) {}
    /// Of a state of force balance that find_state() has found.
    virtual void look_at_state(Path&, const LayerAtRest&) {}
    /// When the run ends, whether or not the path has come to its end.
    virtual void finish(Path&) {}
};

} // namespace asperity
