// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/memory_meter.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

std::atomic<int> counting = 0; ///< meters
std::atomic<long long> bytes_held = 0, most_held = 0, calls = 0;

void* counted(void* memory) {
    if (!memory) throw std::bad_alloc();
    if (!counting.load(std::memory_order_relaxed)) return memory;
    ++calls;
    const long long now = bytes_held += static_cast<long long>(::malloc_usable_size(memory));
    long long most = most_held;
    while (most < now && !most_held.compare_exchange_weak(most, now)) {
    }
    return memory;
}

void release(void* memory) {
    if (memory && counting.load(std::memory_order_relaxed))
        bytes_held -= static_cast<long long>(::malloc_usable_size(memory));
    std::free(memory);
}

} // namespace

// The library's other forms call these. Not inlined: gcc warns of free() of what it sees came from
// new.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
    return counted(std::malloc(bytes ? bytes : 1));
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
    const auto to = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(to, (bytes + to - 1) / to * to));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}

namespace asperity {

MemoryMeter::MemoryMeter()
    : held_before_(bytes_held), calls_before_(calls), outer_peak_(most_held.exchange(bytes_held)) {
    ++counting;
}
MemoryMeter::~MemoryMeter() {
    take_peak();
    --counting;
    most_held = std::max<long long>(outer_peak_, most_held);
}
double MemoryMeter::held() const { return static_cast<double>(bytes_held - held_before_); }
double MemoryMeter::take_peak() {
    const long long peak = most_held.exchange(bytes_held);
    outer_peak_ = std::max(outer_peak_, peak); // it was one of a meter around this one too
    return static_cast<double>(peak - held_before_);
}
long long MemoryMeter::allocations() const { return calls - calls_before_; }

} // namespace asperity
