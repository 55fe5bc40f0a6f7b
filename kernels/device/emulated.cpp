// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The emulated device. Compiled with fused multiply-add where the processor family has it, as the
// bits of the kernels v3, v4 and of CUDA need it.
#include "kernels/device/passes.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <numeric>

namespace asperity::emulated {

namespace {

struct Pages {
    std::byte* memory = nullptr;
    std::size_t bytes = 0;
};
std::array<Pages, 64> arenas;
EmulatedSettings settings;

const char* loss() { return settings.lost_after == 0 ? "the device is lost" : nullptr; }

const char* allocate(int, std::size_t bytes, std::byte** memory) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t size = (bytes + page - 1) / page * page;
    if (settings.memory > 0 && size > settings.memory) return "out of memory";
    for (Pages& pages : arenas) {
        if (pages.memory) continue;
        void* at = mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (at == MAP_FAILED) return "there is not so much memory";
        pages = {static_cast<std::byte*>(at), size};
        *memory = pages.memory;
        return nullptr;
    }
    return "too many blocks on the emulated device";
}

void release(std::byte* memory) {
    for (Pages& pages : arenas)
        if (pages.memory == memory) {
            munmap(pages.memory, pages.bytes);
            pages = {};
        }
}

const char* copy(void* to, const void* from, std::size_t bytes) {
    open_memory(true);
    std::memcpy(to, from, bytes);
    open_memory(false);
    return loss();
}

} // namespace

void open_memory(bool open) {
    for (const Pages& pages : arenas)
        if (pages.memory)
            mprotect(pages.memory, pages.bytes, open ? PROT_READ | PROT_WRITE : PROT_NONE);
}

const char* count_launch() {
    if (settings.lost_after > 0) --*settings.lost_after;
    return loss();
}

long long node_in_order(long long k, long long count) {
    const unsigned order = settings.order;
    if (order == 0) return k;
    // A stride that shares no divisor with the count visits every node once.
    long long stride = count / 2 + static_cast<long long>(order) * 7919 % (count + 1) + 1;
    while (std::gcd(stride, count) != 1)
        ++stride;
    return (k * stride + order) % count;
}

} // namespace asperity::emulated

namespace asperity {

const DeviceFunctions& emulated_device() {
    using namespace emulated;
    static const DeviceFunctions functions = functions_with(allocate, release, copy);
    return functions;
}

EmulatedSettings& emulated_settings() { return emulated::settings; }

} // namespace asperity
