// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The lock of a result directory: one process at a time owns it.
//
// The lock is a flock on run.lock, which says host, process and since when. The system takes the
// flock back when its owner ends, however it does. The lock of another host is refused without a
// flock too: not every file system carries flocks from host to host. If the file system knows none,
// the process that makes the file has the lock, and a file that is there is refused.
//
// The Python package takes the same lock through `asperity hold` (python/asperity/running/lock.py):
// the program takes the lock for the process at the other end of a Unix socket and sends the open
// file there. A flock belongs to the open file, so that process has the lock from then on.
#pragma once

#include "io/files.hpp"

#include <string>

namespace asperity::io {

class DirectoryLock {
public:
    static constexpr const char* name = "run.lock";

    /// Takes the lock of a directory. process: number of its owner. Throws FileError if another
    /// process has the lock, and SceneError if a file of its name is no lock.
    DirectoryLock(Directory directory, int process);
    /// Removes the file and gives the lock back, unless hand_over() was called.
    ~DirectoryLock();
    DirectoryLock(const DirectoryLock&) = delete;
    DirectoryLock& operator=(const DirectoryLock&) = delete;

    /// Returns a note for the user on an owner that is gone; empty if there was none.
    const std::string& note() const { return note_; }
    /// Sends the open file through a Unix socket. The receiver owns the lock then. Throws
    /// FileError.
    void hand_over(int socket);

private:
    bool is_in_place() const;

    Directory directory_;
    Descriptor file_;
    std::string note_;
};

/// Returns the number of the process that made a Unix socket. Throws SceneError if the descriptor
/// is no Unix socket.
int process_behind(int socket);

} // namespace asperity::io
