// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Version and compiler of this program, and the machine that it runs on: for `asperity info` and
// for every result.
#pragma once

#include <string>

namespace asperity::io {

/// Version of the program and the tools that built it.
struct BuildInfo {
    std::string version; ///< version of the project
    /// Commit, with "-dirty" if the tree had changes; "unknown" outside git and in tests.
    std::string git;
    std::string compiler; ///< name and version
    std::string flags;    ///< build type and options
    std::string hdf5;     ///< version of the HDF5 library in use
};
BuildInfo build_info();

/// Sets the commit; a program calls it first in main(). Until then BuildInfo::git is "unknown".
void set_commit(const std::string& described);

/// Returns the processor's name and the number of processors seen: "AMD EPYC 9B14, 2 processors".
std::string machine();

/// Memory that this process can still have, and its limit.
struct AvailableMemory {
    double bytes = 0.0;  ///< memory left, bytes; infinite if nothing limits it
    std::string because; ///< name of the limit, for messages: "MemAvailable", "ulimit -v"
};
/// Returns the least of: free memory of the machine (MemAvailable of /proc/meminfo, without swap),
/// memory left by the control groups of this process (memory.max or memory.limit_in_bytes), and the
/// limits of address space and data (ulimit -v, -d).
AvailableMemory available_memory();

} // namespace asperity::io
