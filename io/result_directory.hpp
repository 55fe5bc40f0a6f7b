// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The directory that a command writes its result to, and its owner.
//
// The directory is that of --out, else results/<name>, then results/<name>-2, -3, ... A result that
// is there is never written over. A run that has not come to its end leaves run.journal; a
// directory that holds one is refused unless the run goes on (--resume) or is thrown away
// (--restart).
//
// One process at a time owns it (directory_lock.hpp).
//
// No file in it is replaced but those of a command that did not come to its end
// (file_record.hpp).
#pragma once

#include "io/directory_lock.hpp"
#include "io/file_record.hpp"
#include "io/files.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

struct ResultRequest {
    std::string asked; ///< --out; empty: results/<name>
    std::string name;
    bool resume = false;  ///< an unfinished run goes on, without --out in the name's last directory
    bool restart = false; ///< an unfinished run is thrown away
    std::vector<std::string> files = {};  ///< names of all files that the command writes
    std::vector<std::string> inputs = {}; ///< paths of the files that the command reads
};

class ResultDirectory {
public:
    /// Makes the directory and takes it. Throws SceneError if the directory holds a result, an
    /// unfinished run (unless the request resumes or restarts it), or a file that would have to be
    /// replaced, and FileError if the directory is in use or cannot be made.
    explicit ResultDirectory(const ResultRequest& request);
    /// Releases the directory. The files of a run that can be resumed stay unfinished in the
    /// record. A directory that was made and is still empty is removed.
    ~ResultDirectory();
    ResultDirectory(const ResultDirectory&) = delete;
    ResultDirectory& operator=(const ResultDirectory&) = delete;

    const Directory& directory() const { return directory_; }
    const std::string& path() const { return directory_.path(); }
    /// Throws FileError if the directory was moved or replaced, so that path() leads elsewhere.
    void require_in_place() const;
    /// Returns notes for the user: on another name than expected, or a lock whose owner is gone.
    const std::vector<std::string>& notes() const { return notes_; }

private:
    ResultDirectory(const ResultRequest& request, const std::string& path);

    std::vector<std::string> notes_;
    bool made_; ///< true if this object has made the directory
    Directory directory_;
    std::optional<DirectoryLock> lock_;
    FileRecord record_;
};

/// Files of a run in its directory.
namespace run_file {
inline constexpr const char* series = "run.h5";
inline constexpr const char* result = "result.json";
inline constexpr const char* last_good = "last-good.h5";
inline constexpr const char* checkpoint_damaged = "checkpoint-damaged.h5";
inline constexpr const char* checkpoint_next =
    "checkpoint-next.part"; ///< a whole one before its renaming
inline constexpr const char* journal = "run.journal";
inline constexpr const char* checkpoint = "checkpoint.h5";
inline constexpr const char* checkpoint_before = "checkpoint-before.h5";
inline constexpr const char* lock = DirectoryLock::name;
/// Names of all files except the lock.
inline constexpr std::array all = {
    journal, checkpoint, checkpoint_before, checkpoint_damaged, checkpoint_next,
    series,  result,     last_good};
} // namespace run_file

} // namespace asperity::io
