// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The emulated device. Compiled with fused multiply-add where the processor family has it, as the
// bits of the kernels v3, v4 and of CUDA need it.
#include "kernels/device/limits.hpp"
#include "kernels/device/passes.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <deque>
#include <numeric>
#include <utility>

namespace asperity::emulated {

namespace {

struct Pages {
    std::byte* memory = nullptr;
    std::size_t bytes = 0;
};
std::array<Pages, 64> arenas;
EmulatedSettings settings;

void protect(int access) {
    for (const Pages& pages : arenas)
        if (pages.memory) mprotect(pages.memory, pages.bytes, access);
}

/// What was asked for and has not been done. Copies beside the launches have a queue of their own.
struct Queued {
    std::function<void()> work;
    int mark = -1;
};
std::deque<Queued> launches, beside;
std::array<std::chrono::steady_clock::time_point, device_marks> reached;

void do_first_of(std::deque<Queued>& queue) {
    const Queued next = std::move(queue.front());
    queue.pop_front();
    if (next.work) next.work();
    if (next.mark >= 0)
        reached[static_cast<std::size_t>(next.mark)] = std::chrono::steady_clock::now();
}
void do_all() {
    for (auto* queue : {&launches, &beside})
        while (!queue->empty())
            do_first_of(*queue);
}
bool holds(const std::deque<Queued>& queue, int mark) {
    return std::any_of(queue.begin(), queue.end(),
                       [&](const Queued& queued) { return queued.mark == mark; });
}
const char* put(std::deque<Queued>& queue, Queued next) {
    queue.push_back(std::move(next));
    if (settings.at_once) do_all();
    return nullptr;
}
const char* loss() { return settings.lost_after == 0 ? "the device is lost" : nullptr; }

const char* describe(int, std::string& name, std::size_t& free_bytes) {
    name = "emulated";
    const long pages = sysconf(_SC_AVPHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    free_bytes = settings.memory > 0
                     ? settings.memory
                     : static_cast<std::size_t>(pages) * static_cast<std::size_t>(page);
    return nullptr;
}

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
    do_all();
    for (Pages& pages : arenas)
        if (pages.memory == memory) {
            munmap(pages.memory, pages.bytes);
            pages = {};
        }
}

const char* allocate_pinned(std::size_t bytes, std::byte** memory) {
    *memory = new std::byte[bytes]();
    return nullptr;
}
void release_pinned(std::byte* memory) {
    do_all();
    delete[] memory;
}

void copy_now(void* to, const void* from, std::size_t bytes) {
    const OpenMemory open;
    std::memcpy(to, from, bytes);
}
const char* copy(void* to, const void* from, std::size_t bytes) {
    do_all();
    copy_now(to, from, bytes);
    return loss();
}
const char* queued_copy(void* to, const void* from, std::size_t bytes) {
    return put(launches, {[=] { copy_now(to, from, bytes); }});
}
const char* mark(int number) { return put(launches, {{}, number}); }
const char* fetch_beside(void* to, const void* from, std::size_t bytes, int number) {
    return put(beside, {[=] { copy_now(to, from, bytes); }, number});
}

/// No more than must be done, but that launches are ahead of copies beside them.
const char* wait(int number) {
    while (holds(launches, number))
        do_first_of(launches);
    if (holds(beside, number)) {
        while (!launches.empty())
            do_first_of(launches);
        while (holds(beside, number))
            do_first_of(beside);
    }
    return loss();
}

const char* seconds_between(int first, int second, double& seconds) {
    seconds = std::chrono::duration<double>(reached[static_cast<std::size_t>(second)] -
                                            reached[static_cast<std::size_t>(first)])
                  .count();
    return nullptr;
}

bool takes_mpi(bool) { return settings.open_to_mpi; }
const char* open_to_mpi(bool open) {
    protect(open ? PROT_READ | PROT_WRITE : PROT_NONE);
    return nullptr;
}

} // namespace

OpenMemory::OpenMemory() { protect(PROT_READ | PROT_WRITE); }
OpenMemory::~OpenMemory() { protect(PROT_NONE); }

const char* enqueue(std::function<void()> work) {
    if (settings.lost_after > 0) --settings.lost_after;
    if (const char* error = loss()) return error;
    return put(launches, {std::move(work)});
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
    static const DeviceFunctions functions = {describe,
                                              allocate,
                                              release,
                                              allocate_pinned,
                                              release_pinned,
                                              copy,
                                              copy,
                                              queued_copy,
                                              queued_copy,
                                              mark,
                                              fetch_beside,
                                              wait,
                                              seconds_between,
                                              takes_mpi,
                                              open_to_mpi,
                                              follow,
                                              forces,
                                              restrict_to_shared,
                                              advance,
                                              halo<true>,
                                              halo<false>,
                                              triad,
                                              fused_chain<double>,
                                              fused_chain<float>};
    return functions;
}

EmulatedSettings& emulated_settings() { return emulated::settings; }

} // namespace asperity
