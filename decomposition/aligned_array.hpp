// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Uninitialised arrays aligned to cache lines, and a workspace that reuses their memory.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace asperity {

/// Memory for arrays that are made repeatedly. Each relaxation makes new fields and waves, and the
/// page faults of fresh memory take up to a third of the time of a short relaxation, a tenth of a
/// path of 512 x 512 sites. The workspace keeps freed arrays for the next arrays of the same size;
/// used and kept arrays together never exceed the largest use so far. A workspace must outlive its
/// arrays. Callable from any thread.
class Workspace {
public:
    Workspace() { kept_.reserve(256); }
    ~Workspace() { free_kept(); }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

    /// Returns uninitialised memory that starts on a cache line. Throws std::bad_alloc.
    void* take(std::size_t bytes);
    /// Frees an array of take(), or keeps it for the next array of the same size. Arrays of more
    /// than 128 MB and of less than 64 KB are freed.
    void give_back(void* array, std::size_t bytes);
    /// Frees the kept arrays, so that other work can use the memory.
    void free_kept();
    std::size_t kept() const; ///< returns the size of the kept arrays, bytes

private:
    struct Array {
        void* data;
        std::size_t bytes;
    };
    void shrink_to(std::size_t size);

    mutable std::mutex mutex_;
    std::vector<Array> kept_;
    std::size_t size_ = 0, in_use_ = 0, most_ = 0; ///< bytes
};

/// Returns uninitialised memory that starts on a cache line. Throws std::bad_alloc.
void* new_aligned(std::size_t bytes);

/// Deleter that frees an array or returns it to its workspace.
struct FreeAligned {
    std::size_t bytes = 0;
    Workspace* home = nullptr;
    void operator()(void* array) const;
};
template <class T>
using AlignedArray = std::unique_ptr<T[], FreeAligned>;

/// Returns an uninitialised array of `size` values. home: workspace to take the memory from;
/// nullptr: none. Throws std::bad_alloc.
template <class T>
AlignedArray<T> aligned_array(std::size_t size, Workspace* home = nullptr) {
    const std::size_t bytes = size * sizeof(T);
    return {static_cast<T*>(home ? home->take(bytes) : new_aligned(bytes)),
            FreeAligned{bytes, home}};
}

} // namespace asperity
