// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What this program was built from and with, and the machine that it runs on: for `asperity info`
// and for every result.
#pragma once

#include <string>

namespace asperity::io {

struct BuildInfo {
    std::string version; ///< of the project
    std::string
        git; ///< commit, with "-dirty" if the tree had changes; "unknown" outside git and in tests
    std::string compiler; ///< name and version
    std::string flags;    ///< build type and options
    std::string hdf5;     ///< version of the library in use
};
BuildInfo build_info();

/// States the commit; a program calls it first in main(). Until then `git` is "unknown".
void set_commit(const std::string& described);

/// The processor that runs it and how many it sees: "AMD EPYC 9B14, 2 processors".
std::string machine();

/// How much memory a process of this machine can still have.
struct AvailableMemory {
    double bytes = 0.0;  ///< infinite where nothing says
    std::string because; ///< what sets it: "MemAvailable", "ulimit -v", as in messages
};
/// The least of: free memory of the machine (MemAvailable of /proc/meminfo, without swap), what the
/// control groups of this process leave (memory.max or memory.limit_in_bytes), and the limits of
/// address space and data (ulimit -v, -d).
AvailableMemory available_memory();

} // namespace asperity::io
