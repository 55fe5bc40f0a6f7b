// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The memory that ranks need beside the memory of their machines. What the ranks of a machine take
// together is compared with the memory left there, what each takes with its own limits (ulimit).
#pragma once

#include "decomposition/communicator.hpp"

#include <optional>
#include <string>

namespace asperity {

/// Memory that a machine or a process lacks.
struct MemoryShortage {
    double needed = 0.0, available = 0.0; ///< bytes
    bool of_process = false; ///< a rank's own limit is too low, not its machine's memory
    std::string because;     ///< name of the limit: "MemAvailable", "ulimit -v"

    /// Returns the shortage in words: "3 GB are needed on this machine, and 2 GB are available
    /// (MemAvailable)".
    std::string text() const;
};

/// Returns the shortage of the machine or the rank that is worst off; empty where the memory
/// suffices. bytes: memory that this rank takes. Collective; all ranks get the same needs.
std::optional<MemoryShortage> memory_shortage(const Communicator& ranks, double bytes);

} // namespace asperity
