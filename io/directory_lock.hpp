// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The lock of a result directory, which one process at a time owns.
//
// The lock is a flock on run.lock, a file with host, process and time of the owner and a digest of
// these. A file of that name without the digest is somebody else's, unless the record of the
// directory names it (file_record.hpp: a crash of the machine may empty a file). The system
// releases the flock when its owner ends in any way. A run.lock of another host is refused even
// without a flock, because not every file system shares flocks between hosts. If the file system
// has no flocks, the process that creates the file has the lock, and an existing file is refused.
//
// The Python package takes the same lock through `asperity hold` (python/asperity/running/lock.py):
// the program locks the file for the process at the other end of a Unix socket and sends the open
// file there. A flock belongs to the open file, so that the receiving process then owns the lock.
#pragma once

#include "io/files.hpp"

#include <string>

namespace asperity::io {

/// Lock of a result directory.
class DirectoryLock {
public:
    static constexpr const char* name = "run.lock";

    /// Locks a directory. process: process ID of the owner, written to the file. Throws FileError
    /// if another process has the lock, and SceneError if the file run.lock is no lock.
    DirectoryLock(Directory directory, int process);
    /// Releases the lock and removes the file, unless hand_over() was called.
    ~DirectoryLock();
    DirectoryLock(const DirectoryLock&) = delete;
    DirectoryLock& operator=(const DirectoryLock&) = delete;

    /// Returns a note for the user if the lock of a dead process was replaced; otherwise an empty
    /// text.
    const std::string& note() const { return note_; }
    /// Sends the open file through a Unix socket to its new owner. Throws FileError.
    void hand_over(int socket);

private:
    bool is_in_place() const;

    Directory directory_;
    Descriptor file_;
    std::string note_;
};

/// Returns the process ID of the peer of a Unix socket. Throws SceneError if the descriptor is no
/// Unix socket.
int process_behind(int socket);

} // namespace asperity::io
