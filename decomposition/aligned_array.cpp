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
constexpr std::size_t smallest_kept = 1 << 16, largest_kept = 128 << 20;

bool may_be_kept(std::size_t bytes) { return bytes >= smallest_kept && bytes <= largest_kept; }

struct Kept {
    void* array;
    std::size_t bytes;
};

/// The arrays in use and the kept arrays together never exceed the largest use since the last
/// clear().
class Store {
public:
    Store() { kept_.reserve(256); }
    /// Returns a kept array of this size, nullptr if there is none.
    void* take(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        in_use_ += bytes;
        most_ = std::max(most_, in_use_);
        const auto same = std::find_if(kept_.rbegin(), kept_.rend(),
                                       [&](const Kept& k) { return k.bytes == bytes; });
        if (same == kept_.rend()) {
            shrink_to(most_ - in_use_);
            return nullptr;
        }
        void* const array = same->array;
        kept_.erase(std::next(same).base());
        size_ -= bytes;
        return array;
    }
    void give_back(void* array, std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        in_use_ -= bytes;
        if (kept_.size() == kept_.capacity()) shrink_to(size_ - kept_.front().bytes);
        kept_.push_back({array, bytes}); // within the capacity: it does not throw
        size_ += bytes;
        shrink_to(most_ - in_use_);
    }
    void clear() {
        const std::lock_guard lock(mutex_);
        shrink_to(0);
        most_ = in_use_;
    }
    std::size_t size() {
        const std::lock_guard lock(mutex_);
        return size_;
    }

private:
    /// Frees arrays until this size is left; those unused for the longest time go first.
    void shrink_to(std::size_t size) {
        auto first = kept_.begin();
        for (; size_ > size; ++first) {
            ::operator delete(first->array, cache_line);
            size_ -= first->bytes;
        }
        kept_.erase(kept_.begin(), first);
    }

    std::mutex mutex_;
    std::vector<Kept> kept_;
    std::size_t size_ = 0, in_use_ = 0, most_ = 0; ///< bytes
};

/// Returns the store, which is never destroyed: arrays may be freed after main().
Store& store() {
    static Store& only = *new Store;
    return only;
}

} // namespace

void* new_aligned(std::size_t bytes) {
    if (may_be_kept(bytes))
        if (void* const kept = store().take(bytes)) return kept;
    return ::operator new(bytes, cache_line);
}

void free_aligned(void* array, std::size_t bytes) {
    if (may_be_kept(bytes))
        store().give_back(array, bytes);
    else
        ::operator delete(array, cache_line);
}

void free_kept_arrays() { store().clear(); }

std::size_t kept_arrays() { return store().size(); }

} // namespace asperity
