// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// How much memory this process allocates with operator new, which memory_meter.cpp replaces. Not
// counted is what C libraries take from malloc() themselves (FFTW, HDF5, MPI).
#pragma once

namespace asperity {

/// Counts from its construction on, all threads together. One may be made and gone while another
/// counts.
class MemoryMeter {
public:
    MemoryMeter();
    ~MemoryMeter();
    MemoryMeter(const MemoryMeter&) = delete;
    MemoryMeter& operator=(const MemoryMeter&) = delete;

    /// Allocated since and not freed, bytes.
    double held() const;
    /// The most that was held at once since the last call, bytes.
    double take_peak();
    /// Calls of operator new.
    long long allocations() const;

private:
    long long held_before_, calls_before_, outer_peak_; ///< before it was made
};

} // namespace asperity
