// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How much memory a process of this machine can still have.
#pragma once

#include <string>

namespace asperity::io {

struct AvailableMemory {
    double bytes = 0.0;  ///< infinite where nothing says
    std::string because; ///< what sets it: "MemAvailable", "the cgroup's memory.max", "ulimit -v"
};

/// The least of: free memory of the machine (MemAvailable of /proc/meminfo, without swap), what the
/// control groups of this process leave (memory.max or memory.limit_in_bytes), and the limits of
/// address space and data (ulimit -v, -d).
AvailableMemory available_memory();

} // namespace asperity::io
