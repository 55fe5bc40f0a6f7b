// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The result directory of a run: who owns it, and its checkpoints.
//
//     run.lock               while a run uses the directory (io/result_directory.hpp)
//     run.journal            entries of the recorder; until the run is over
//     run.h5                 the same as HDF5 (recorder.hpp)
//     checkpoint.h5          the newest state, and the one before; until the run is over
//     checkpoint-before.h5
//     result.json            the result
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

/// The result directory of a run.
class RunStorage {
public:
    /// Takes the directory. Collective.
    RunStorage(const RunOptions& options, const Case& c, const Communicator& ranks);

    // Functions for the root only.
    const std::string& path() const { return directory().path(); }
    io::FilePlace file(const std::string& name) const { return {directory(), name}; }
    const io::Directory& directory() const { return owner_->directory(); }
    void require_in_place() const { owner_->require_in_place(); }
    /// Returns notes for the user and forgets them.
    std::vector<std::string> take_notes();

    /// Returns the newest checkpoint that is whole and whose entries the journal holds, if the run
    /// was asked to resume and there is one. A damaged one is set aside (checkpoint-damaged.h5) and
    /// noted. An empty result on other ranks means the same as on the root. Collective. Throws
    /// io::FileError if all checkpoints are damaged.
    std::optional<io::FilePlace> checkpoint_to_resume();
    /// Calls write_state(place) to write a checkpoint and keeps the last one as the one before.
    /// Collective.
    void save(const std::function<void(const io::FilePlace&)>& write_state);
    /// Removes the files that only serve to resume, after the run.
    void remove_checkpoints();

private:
    std::optional<io::FilePlace> newest_whole();
    std::optional<io::FilePlace> named();

    const RunOptions& options_;
    Communicator ranks_;
    std::unique_ptr<io::ResultDirectory> owner_; ///< root only
    std::vector<std::string> notes_;
};

/// Returns the amount recorded at a checkpoint. Throws io::FileError if the numbers lack it.
Recorder::Position position_in(const StateNumbers& numbers);

} // namespace asperity
