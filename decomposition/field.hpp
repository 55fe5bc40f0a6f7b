// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Storage of fields: one value per node of a tile, a halo, and padding to whole SIMD vectors.
#pragma once

#include "decomposition/aligned_array.hpp"
#include "decomposition/rows_of_thread.hpp"
#include "decomposition/tile.hpp"
#include "kernels/views.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace asperity {

/// Asks the system for pages of 2 MB for a large array, because a pass over a block touches a
/// hundred rows at a time, each on a different small page.
inline void prefer_large_pages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
    constexpr std::uintptr_t page = std::uintptr_t{2} << 20;
    const auto at = reinterpret_cast<std::uintptr_t>(data);
    const auto begin = (at + page - 1) / page * page, end = (at + bytes) / page * page;
    if (begin < end)
        madvise(static_cast<std::byte*>(data) + (begin - at), end - begin, MADV_HUGEPAGE);
#endif
}

/// A stack of planes of T over a tile, initially zero.
template <class T>
class Field {
public:
    Field() = default;

    /// Makes a field of zeros. halo: width of the frame of nodes around the tile, at least
    /// halo_width; home: workspace to take the memory from, nullptr for none.
    Field(const Tile& tile, int planes, int halo = halo_width, Workspace* home = nullptr)
        : size_(size(tile, planes, halo)), halo_(halo) {
        const std::ptrdiff_t left = round_up(halo);
        view_.row = row_length(tile, halo);
        view_.plane = view_.row * (tile.ny + 2 * halo);
        view_.nx = tile.nx;
        view_.ny = tile.ny;
        view_.nz = planes;
        data_ = aligned_array<T>(size_, home);
        prefer_large_pages(data_.get(), size_ * sizeof(T));
        view_.origin = data_.get() + halo * view_.row + left;
        T* const data = data_.get();
        each_row_by_its_thread(tile.ny, halo, planes, [&](int z, int y) {
            std::fill_n(data + z * view_.plane + (y + halo) * view_.row, view_.row, T(0));
        });
        std::fill(data + planes * view_.plane, data + size_, T(0));
    }

    VolumeView<T> view() { return view_; }
    VolumeView<const T> view() const { return view_; }
    PlaneView<T> plane(int z) { return view_[z]; }
    PlaneView<const T> plane(int z) const { return view()[z]; }
    int halo() const { return halo_; }
    /// Returns all values, halo and padding included.
    std::span<T> storage() { return {data_.get(), size_}; }
    std::span<const T> storage() const { return {data_.get(), size_}; }
    bool empty() const { return !data_; }
    std::size_t bytes() const { return size_ * sizeof(T); }
    /// Returns the memory of a field of this shape, bytes.
    static std::size_t bytes_for(const Tile& tile, int planes, int halo = halo_width) {
        return size(tile, planes, halo) * sizeof(T);
    }
    /// Copies the values of a field of the same shape, halo and padding included.
    void copy_from(const Field& other) {
        for (std::size_t i = 0; i < size_; ++i)
            data_[i] = other.data_[i];
    }

private:
    static constexpr std::ptrdiff_t line = 64 / static_cast<std::ptrdiff_t>(sizeof(T));
    static std::ptrdiff_t round_up(std::ptrdiff_t n) { return (n + line - 1) / line * line; }
    /// Returns the length of a stored row: the owned nodes, the halo, and padding for a vector that
    /// starts at the last owned node and is read at the largest offset.
    static std::ptrdiff_t row_length(const Tile& tile, int halo) {
        return round_up(halo) + round_up(tile.nx + halo + line);
    }
    static std::size_t size(const Tile& tile, int planes, int halo) {
        const std::ptrdiff_t plane = row_length(tile, halo) * (tile.ny + 2 * halo);
        return static_cast<std::size_t>(plane) * static_cast<std::size_t>(planes) +
               static_cast<std::size_t>(2 * line);
    }

    AlignedArray<T> data_;
    std::size_t size_ = 0;
    VolumeView<T> view_{};
    int halo_ = halo_width;
};

/// Three fields of one shape: a vector field, structure of arrays.
template <class T>
struct VectorField {
    Field<T> x, y, z;

    VectorField() = default;
    VectorField(const Tile& tile, int planes, int halo = halo_width, Workspace* home = nullptr)
        : x(tile, planes, halo, home), y(tile, planes, halo, home), z(tile, planes, halo, home) {}

    VectorVolume<T> view() { return {x.view(), y.view(), z.view()}; }
    VectorVolume<const T> view() const { return {x.view(), y.view(), z.view()}; }
    VectorPlane<T> plane(int k) { return {x.plane(k), y.plane(k), z.plane(k)}; }
    VectorPlane<const T> plane(int k) const { return {x.plane(k), y.plane(k), z.plane(k)}; }
    bool empty() const { return x.empty(); }
    std::size_t bytes() const { return x.empty() ? 0 : x.bytes() + y.bytes() + z.bytes(); }
    void copy_from(const VectorField& other) {
        x.copy_from(other.x);
        y.copy_from(other.y);
        z.copy_from(other.z);
    }
};

} // namespace asperity
