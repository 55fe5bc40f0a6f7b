// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/memory.hpp"

#include "io/machine.hpp"

#include <algorithm>

namespace asperity {

std::string MemoryShortage::text() const {
    return io::AvailableMemory{available, because}.shortage(needed, of_process ? "by a process"
                                                                               : "on this machine");
}

std::optional<MemoryShortage> memory_shortage(const Communicator& ranks, double bytes) {
    const double together = ranks.sum_on_machine(bytes);
    const io::AvailableMemory machine = io::memory_of_machine(), own = io::memory_of_process();
    const double of_machine = ranks.max(together / machine.bytes),
                 of_rank = ranks.max(bytes / own.bytes);
    const double worst = std::max(of_machine, of_rank);
    if (worst <= 1.0) return {};
    const io::AvailableMemory& there = of_rank > of_machine ? own : machine;
    return MemoryShortage{worst * there.bytes, there.bytes, of_rank > of_machine, there.because};
}

} // namespace asperity
