// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/aligned_array.hpp"

#include <algorithm>
#include <mutex>
#include <new>
#include <vector>

namespace asperity {

namespace {

constexpr std::align_val_t cache_line{64};
constexpr std::size_t smallest_kept = 1 << 16, largest_kept = 2 << 20, most_kept = 24 << 20;

struct Kept {
    void* array;
    std::size_t bytes;
};

struct Store {
    std::mutex mutex;
    std::vector<Kept> arrays; ///< the last freed at the end
    std::size_t bytes = 0;
    Store() { arrays.reserve(most_kept / smallest_kept + 1); } // free_aligned() cannot throw
};

/// Never destroyed: arrays may be freed after main().
Store& store() {
    static Store& only = *new Store;
    return only;
}

} // namespace

void* new_aligned(std::size_t bytes) {
    if (bytes >= smallest_kept && bytes <= largest_kept) {
        Store& s = store();
        const std::lock_guard lock(s.mutex);
        const auto same = std::find_if(s.arrays.rbegin(), s.arrays.rend(),
                                       [&](const Kept& k) { return k.bytes == bytes; });
        if (same != s.arrays.rend()) {
            void* const array = same->array;
            s.arrays.erase(std::next(same).base());
            s.bytes -= bytes;
            return array;
        }
    }
    return ::operator new(bytes, cache_line);
}

void free_aligned(void* array, std::size_t bytes) {
    if (bytes >= smallest_kept && bytes <= largest_kept) {
        Store& s = store();
        const std::lock_guard lock(s.mutex);
        // Room is made by those that nobody has asked for the longest.
        while (!s.arrays.empty() && s.bytes + bytes > most_kept) {
            ::operator delete(s.arrays.front().array, cache_line);
            s.bytes -= s.arrays.front().bytes;
            s.arrays.erase(s.arrays.begin());
        }
        s.arrays.push_back({array, bytes});
        s.bytes += bytes;
        return;
    }
    ::operator delete(array, cache_line);
}

} // namespace asperity
