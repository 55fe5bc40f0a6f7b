// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/run/memory_meter.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

std::atomic<bool> counting = false;
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

MemoryMeter::MemoryMeter() {
    bytes_held = most_held = calls = 0;
    counting = true;
}
MemoryMeter::~MemoryMeter() { counting = false; }
double MemoryMeter::held() const { return static_cast<double>(bytes_held); }
double MemoryMeter::take_peak() { return static_cast<double>(most_held.exchange(bytes_held)); }
long long MemoryMeter::allocations() const { return calls; }

} // namespace asperity
