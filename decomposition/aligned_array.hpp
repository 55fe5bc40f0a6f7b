// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Uninitialised arrays that start on a cache line, and the workspace that some of them come from.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace asperity {

/// Memory for arrays that are made again and again: each relaxation makes its fields and waves
/// anew, and fresh pages for them take up to a third of the time of a short one, a tenth of a path
/// of 512 x 512 sites. Freed arrays are kept for the next arrays of the same size; the arrays in
/// use and the kept arrays together never exceed the largest use so far. The owner of a workspace
/// outlives its arrays. Callable from any thread.
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
    /// Frees the kept arrays, before work that needs memory of another kind.
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

/// Frees an array, or gives it back to its workspace.
struct FreeAligned {
    std::size_t bytes = 0;
    Workspace* home = nullptr;
    void operator()(void* array) const;
};
template <class T>
using AlignedArray = std::unique_ptr<T[], FreeAligned>;

/// Returns an uninitialised array of so many values. home: workspace that it comes from; null:
/// none. Throws std::bad_alloc.
template <class T>
AlignedArray<T> aligned_array(std::size_t size, Workspace* home = nullptr) {
    const std::size_t bytes = size * sizeof(T);
    return {static_cast<T*>(home ? home->take(bytes) : new_aligned(bytes)),
            FreeAligned{bytes, home}};
}

} // namespace asperity
