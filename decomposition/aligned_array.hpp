// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Uninitialised arrays that start on a cache line.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace asperity {

inline constexpr std::align_val_t cache_line{64};

struct FreeAligned {
    void operator()(void* array) const { ::operator delete(array, cache_line); }
};
template <class T>
using AlignedArray = std::unique_ptr<T[], FreeAligned>;

/// Throws std::bad_alloc.
template <class T>
AlignedArray<T> aligned_array(std::size_t size) {
    return AlignedArray<T>(static_cast<T*>(::operator new(size * sizeof(T), cache_line)));
}

} // namespace asperity
