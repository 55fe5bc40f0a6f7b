// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The result directory of a run: who owns it, and its checkpoints.
//
//     run.lock               while a run uses the directory (io/result_directory.hpp)
//     run.journal            entries of the recorder; until the run is over
//     run.h5                 these entries as HDF5 (recorder.hpp)
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
    /// Locks the directory. Keeps a reference to the options. Collective. Throws io::FileError if
    /// another run uses the directory or results would be overwritten.
    RunStorage(const RunOptions& options, const Case& c, const Communicator& ranks);

    // Functions for the root only.
    const std::string& path() const { return directory().path(); } ///< returns its path
    /// Returns the place of a file in the directory.
    io::FilePlace file(const std::string& name) const { return {directory(), name}; }
    const io::Directory& directory() const { return owner_->directory(); }
    /// Throws io::FileError if the directory was moved or removed.
    void require_in_place() const { owner_->require_in_place(); }
    /// Returns the notes for the user since the last call.
    std::vector<std::string> take_notes();

    /// Returns the newest undamaged checkpoint whose entries the journal holds; nothing if the run
    /// was not asked to resume or no checkpoint exists. All ranks return the same. A damaged
    /// checkpoint is renamed to checkpoint-damaged.h5, with a note. Collective. Throws
    /// io::FileError if all checkpoints are damaged.
    std::optional<io::FilePlace> checkpoint_to_resume();
    /// Renames the last checkpoint to checkpoint-before.h5 and calls write_state(place) to write a
    /// new one. Collective.
    void save(const std::function<void(const io::FilePlace&)>& write_state);
    /// Removes the files that are needed only to resume. Called after the run.
    void remove_checkpoints();

private:
    std::optional<io::FilePlace> newest_whole();
    std::optional<io::FilePlace> named();

    const RunOptions& options_;
    Communicator ranks_;
    std::unique_ptr<io::ResultDirectory> owner_; ///< root only
    std::vector<std::string> notes_;
};

/// Returns the position of the recorder at a checkpoint. Throws io::FileError if the numbers lack
/// it.
Recorder::Position position_in(const StateNumbers& numbers);

} // namespace asperity
