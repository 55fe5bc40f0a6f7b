// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The result directory of a run: who owns it, and its checkpoints.
//
//     run.lock               while a run uses the directory (io/result_directory.hpp)
//     run.journal            what was recorded; until the run is over
//     run.h5                 the same as HDF5 (recorder.hpp)
//     checkpoint.h5          the newest state, and the one before; until the run is over
//     checkpoint-before.h5
//     result.json            how it ended
//
// Everything is written by io::OutputFile: whole, or not at all. The root does all of it; the
// member functions are not collective unless they say so.
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/path/checkpoint.hpp"
#include "engine/run/recorder.hpp"
#include "engine/run/run.hpp"
#include "io/result_directory.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace asperity {

class RunStorage {
public:
    /// Takes the directory. Collective.
    RunStorage(const RunOptions& options, const Case& c, const Communicator& ranks);

    // Root only, like all that follows.
    const std::string& path() const { return directory().path(); }
    io::FilePlace file(const std::string& name) const { return {directory(), name}; }
    const io::Directory& directory() const { return owner_->directory(); }
    void require_in_place() const { owner_->require_in_place(); }
    /// What the user should know, once.
    std::vector<std::string> take_notes();

    /// The newest checkpoint that is whole and whose records the journal holds, if the run was
    /// asked to go on and there is one. A damaged one is set aside (checkpoint-damaged.h5) and
    /// noted. Throws io::FileError where there are only damaged ones. Collective; empty on other
    /// ranks means the same as on the root.
    std::optional<io::FilePlace> checkpoint_to_resume();
    /// Has write_state(place) write a checkpoint; the last one is kept as the one before.
    /// Collective.
    void save(const std::function<void(const io::FilePlace&)>& write_state);
    /// The run is over: what only serves to go on is removed.
    void remove_checkpoints();

private:
    std::optional<io::FilePlace> newest_whole();
    std::optional<io::FilePlace> named();

    const RunOptions& options_;
    Communicator ranks_;
    std::unique_ptr<io::ResultDirectory> owner_; ///< root only
    std::vector<std::string> notes_;
};

/// How much was recorded when a checkpoint was written. Throws io::FileError where it is missing.
Recorder::Position position_in(const StateNumbers& numbers);

} // namespace asperity
