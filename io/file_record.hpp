// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The record of the files that Asperity wrote in a directory, and the rule that nothing else is
// replaced.
//
// A command claims the names of all its files before it writes the first one. A name is refused if
// a file of that name is there, unless the record says that the file is of a command which did not
// come to its end. Claimed names are "unfinished" in the record, so that a run that is killed at
// any moment can be resumed. At the end of the command the record gets the digest of each file.
//
// The record is the file .asperity-files.json of the directory. python/asperity/files/store.py
// reads and writes the same record; the commands of Python also renew reports, tables and plots
// whose digest is that of the record.
#pragma once

#include "io/files.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace asperity::io {

class FileRecord {
public:
    static constexpr const char* name = ".asperity-files.json";

    /// Keeps the directory; reads and claims nothing yet.
    explicit FileRecord(Directory directory) : directory_(std::move(directory)) {}
    /// Claims the names of the files that a command is about to write. inputs: paths of the files
    /// that the command reads. Throws SceneError with all files that would have to be replaced, and
    /// FileError if the record cannot be read or written.
    void claim(const std::vector<std::string>& names, const std::vector<std::string>& inputs);
    /// Gives up the claim to files that were not written. finished: the others get their digests;
    /// otherwise they stay unfinished. A record that names nothing is removed. Throws FileError.
    void release(bool finished);

private:
    /// Digests by name, as text; "unfinished" of a file that is being written.
    using Names = std::map<std::string, std::string>;
    /// Explains, for an error message, why a file must not be replaced; empty if it may be.
    std::string reason_to_keep(const std::string& file, const std::optional<Names>& names,
                               const std::vector<std::string>& inputs) const;
    /// Returns the contents of the record; nothing if the directory has none. Throws SceneError if
    /// the file of that name is no record.
    std::optional<Names> read() const;
    /// Writes the record that change(record) returns.
    void update(const std::function<Names(const std::optional<Names>&)>& change) const;

    Directory directory_;
    std::vector<std::string> claimed_;
};

} // namespace asperity::io
