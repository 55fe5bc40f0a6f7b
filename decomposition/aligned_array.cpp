// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/aligned_array.hpp"

#include <algorithm>
#include <iterator>
#include <new>

namespace asperity {

namespace {

constexpr std::align_val_t cache_line{64};
constexpr std::size_t smallest_kept = 1 << 16, largest_kept = 128 << 20;

bool may_be_kept(std::size_t bytes) { return bytes >= smallest_kept && bytes <= largest_kept; }

void free_aligned(void* array) { ::operator delete(array, cache_line); }

} // namespace

void* new_aligned(std::size_t bytes) { return ::operator new(bytes, cache_line); }

void FreeAligned::operator()(void* array) const {
    if (home)
        home->give_back(array, bytes);
    else
        free_aligned(array);
}

void* Workspace::take(std::size_t bytes) {
    if (may_be_kept(bytes)) {
        const std::lock_guard lock(mutex_);
        in_use_ += bytes;
        most_ = std::max(most_, in_use_);
        const auto same = std::find_if(kept_.rbegin(), kept_.rend(),
                                       [&](const Array& a) { return a.bytes == bytes; });
        if (same != kept_.rend()) {
            void* const array = same->data;
            kept_.erase(std::next(same).base());
            size_ -= bytes;
            return array;
        }
        shrink_to(most_ - in_use_);
    }
    return new_aligned(bytes);
}

void Workspace::give_back(void* array, std::size_t bytes) {
    if (!may_be_kept(bytes)) return free_aligned(array);
    const std::lock_guard lock(mutex_);
    in_use_ -= bytes;
    if (kept_.size() == kept_.capacity()) shrink_to(size_ - kept_.front().bytes);
    kept_.push_back({array, bytes}); // within the capacity: it does not throw
    size_ += bytes;
    shrink_to(most_ - in_use_);
}

void Workspace::free_kept() {
    const std::lock_guard lock(mutex_);
    shrink_to(0);
    most_ = in_use_;
}

std::size_t Workspace::kept() const {
    const std::lock_guard lock(mutex_);
    return size_;
}

/// Frees arrays until this size is left; those unused for the longest time go first.
void Workspace::shrink_to(std::size_t size) {
    auto first = kept_.begin();
    for (; size_ > size; ++first) {
        free_aligned(first->data);
        size_ -= first->bytes;
    }
    kept_.erase(kept_.begin(), first);
}

} // namespace asperity
