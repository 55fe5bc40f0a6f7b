// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The record of the files that Asperity has written in a directory. Other files are never replaced.
//
// A command claims the names of all its files before it writes the first one. The name of an
// existing file is refused, unless the file belongs to a command that was interrupted, according to
// the record. Claimed names are marked "unfinished" in the record, so that a run killed at any
// moment can be resumed. At the end of the command the record receives the digest of each file.
//
// The record is the file .asperity-files.json of the directory. A new one appears whole; while one
// is replaced, the new one is .asperity-files.json.part, a name that belongs to the directory's
// record. python/asperity/files/store.py reads and writes the same record; commands of Python also
// replace reports, tables and plots whose digests agree with the record.
#pragma once

#include "io/files.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity::io {

/// Record of the files of a directory.
class FileRecord {
public:
    static constexpr const char* name = ".asperity-files.json";

    /// Copies the directory; reads and claims nothing yet.
    explicit FileRecord(Directory directory) : directory_(std::move(directory)) {}
    /// Returns true if the record calls a file unfinished. Throws SceneError if the record is none.
    bool calls_unfinished(const std::string& file) const;
    /// Removes the temporary files that a killed command has left, which the record calls
    /// unfinished. Throws FileError.
    void remove_left_over();
    /// Claims a name for a file that is gone when the command ends, unless a file of that name is
    /// there which the record does not call unfinished. Throws as claim() does.
    void claim_passing(const std::string& file);
    /// Claims the names of all files that a command will write, and of its temporary files. inputs:
    /// paths of the files that the command reads. Throws SceneError with all existing
    /// files that may not be replaced, and FileError if the record cannot be read or written.
    void claim(const std::vector<std::string>& names, const std::vector<std::string>& inputs);
    /// Releases the claims: removes names of files that were not written, and records the digests
    /// of written files if `finished`; otherwise these stay unfinished. An empty record is removed.
    /// Throws FileError.
    void release(bool finished);

private:
    /// Digests by name of the file, as text; "unfinished" for a file that is being written.
    using Names = std::map<std::string, std::string>;
    /// Explains, for an error message, why a file must not be replaced; empty if it may be.
    std::string reason_to_keep(const std::string& file, const std::optional<Names>& names,
                               const std::vector<std::string>& inputs) const;
    /// Returns the contents of the record; nothing if the directory has none. Throws SceneError if
    /// the file of that name is no record.
    std::optional<Names> read() const;
    /// Writes the record that change(record) returns.
    void update(const std::function<Names(const std::optional<Names>&)>& change) const;
    /// Writes a text into the place of the record; in place of an earlier one if `replace`.
    void write(const std::string& text, bool replace) const;

    Directory directory_;
    std::vector<std::string> claimed_;
    std::vector<std::string> passing_; ///< names of files that are gone when the command ends
};

} // namespace asperity::io
