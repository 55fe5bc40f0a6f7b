// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Uninitialised arrays that start on a cache line.
//
// Freed arrays of at most 128 MB are kept for the next arrays of the same size, as many as were in
// use at once: each relaxation makes its fields and waves anew, and fresh pages for them take up to
// a third of the time of a short one, a tenth of a path of 512 x 512 sites.
#pragma once

#include <cstddef>
#include <memory>

namespace asperity {

/// Returns uninitialised memory that starts on a cache line. Callable from any thread. Throws
/// std::bad_alloc.
void* new_aligned(std::size_t bytes);
/// Frees an array of new_aligned(), or keeps it for the next array of the same size.
void free_aligned(void* array, std::size_t bytes);
/// Frees the kept arrays, before work that needs memory of another kind.
void free_kept_arrays();
std::size_t kept_arrays(); ///< returns the size of the kept arrays, bytes

struct FreeAligned {
    std::size_t bytes = 0;
    void operator()(void* array) const { free_aligned(array, bytes); }
};
template <class T>
using AlignedArray = std::unique_ptr<T[], FreeAligned>;

/// Returns an uninitialised array of so many values. Throws std::bad_alloc.
template <class T>
AlignedArray<T> aligned_array(std::size_t size) {
    const std::size_t bytes = size * sizeof(T);
    return {static_cast<T*>(new_aligned(bytes)), FreeAligned{bytes}};
}

} // namespace asperity
