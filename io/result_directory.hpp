// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The directory to which a command writes its result.
//
// The directory is that of --out; without --out it is results/<name>, or the first free one of
// results/<name>-2, -3, ... A result is never overwritten. An unfinished run leaves run.journal; a
// directory with run.journal is refused unless the run is resumed (--resume) or discarded
// (--restart).
//
// One process at a time owns the directory (directory_lock.hpp).
//
// Only files of an interrupted command are replaced (file_record.hpp).
#pragma once

#include "io/directory_lock.hpp"
#include "io/file_record.hpp"
#include "io/files.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace asperity::io {

/// Options of a command for its directory.
struct ResultRequest {
    std::string asked; ///< --out; empty: results/<name>
    std::string name;  ///< name of the result without --out
    /// Resume an unfinished run; without --out in the last directory of this name.
    bool resume = false;
    bool restart = false;                 ///< discard an unfinished run
    std::vector<std::string> files = {};  ///< names of all files that the command writes
    std::vector<std::string> inputs = {}; ///< paths of the files that the command reads
};

/// A result directory, locked by this process.
class ResultDirectory {
public:
    /// Makes and locks the directory and claims the files. Throws SceneError if the directory holds
    /// a result, an unfinished run (unless the request resumes or restarts it), or a file that may
    /// not be replaced, and FileError if the directory is in use or cannot be made.
    explicit ResultDirectory(const ResultRequest& request);
    /// Releases the directory. Files of a run that can be resumed stay unfinished in the record. A
    /// directory that this object has made is removed if it is empty.
    ~ResultDirectory();
    ResultDirectory(const ResultDirectory&) = delete;
    ResultDirectory& operator=(const ResultDirectory&) = delete;

    const Directory& directory() const { return directory_; }
    const std::string& path() const { return directory_.path(); }
    /// Throws FileError if the directory was moved or replaced, so that path() leads elsewhere.
    void require_in_place() const;
    /// Returns notes for the user: an unexpected name of the directory, or a replaced lock of a
    /// dead process.
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
    "checkpoint-next.part"; ///< complete checkpoint before its renaming
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
