// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Version and compiler of this program, and the machine, for `asperity info` and for every result.
#pragma once

#include <string>
#include <string_view>

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
/// Returns the version and tools of this program.
BuildInfo build_info();

/// Sets BuildInfo::git, which is "unknown" before. Called first in main().
void set_commit(const std::string& described);

/// Returns the processor's name and the number of processors seen: "AMD EPYC 9B14, 2 processors".
std::string machine();

/// Memory that can still be allocated, and the limit that determines it.
struct AvailableMemory {
    double bytes = 0.0;  ///< memory left, bytes; infinite without a limit
    std::string because; ///< name of the limit, for messages: "MemAvailable", "ulimit -v"

    /// Returns in words that more is needed: "3 GB are needed by a process, and 2 GB are available
    /// (ulimit -v)". needed: bytes; of: who or what needs them, "by a process".
    std::string shortage(double needed, std::string_view of) const;
};
/// Returns the memory left to all processes of the machine together: the smaller of its free memory
/// (MemAvailable of /proc/meminfo, without swap) and the memory left in the control groups of this
/// process (memory.max or memory.limit_in_bytes).
AvailableMemory memory_of_machine();
/// Returns the memory left to this process by its own limits of address space and data (ulimit -v,
/// -d).
AvailableMemory memory_of_process();
/// Returns the smaller of the two.
AvailableMemory available_memory();

} // namespace asperity::io
