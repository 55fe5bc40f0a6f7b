// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Non-owning views of lattice fields.
//
// A plane is a tile of nx * ny nodes with a frame of halo nodes around it; a volume is a stack of
// planes. x runs fastest. Indices are tile coordinates: (0, 0) is the first node owned, negative
// indices and indices >= nx are halo. A row is aligned to 64 bytes at x = 0 and padded for a whole
// SIMD vector that starts at any owned x, so that loops over x need no scalar remainder.
#pragma once

#include "kernels/annotations.hpp"

#include <array>
#include <cstddef>
#include <type_traits>

namespace asperity {

/// Halo width of every tile: two, because a coarse node inside the tile needs the force on a
/// constrained node one site outside, which depends on one site further.
inline constexpr int halo_width = 2;

/// View of a plane.
template <class T>
struct PlaneView {
    T* origin = nullptr;    ///< node (0, 0)
    std::ptrdiff_t row = 0; ///< distance between rows, in elements
    int nx = 0;             ///< nodes owned along x
    int ny = 0;             ///< nodes owned along y

    ASPERITY_HOST_DEVICE T& operator()(int x, int y) const { return origin[y * row + x]; }
    ASPERITY_HOST_DEVICE T* line(int y) const { return origin + y * row; }
    ASPERITY_HOST_DEVICE operator PlaneView<const T>() const { return {origin, row, nx, ny}; }
};

/// View of a stack of planes.
template <class T>
struct VolumeView {
    T* origin = nullptr;      ///< node (0, 0, 0)
    std::ptrdiff_t row = 0;   ///< distance between rows, in elements
    std::ptrdiff_t plane = 0; ///< distance between planes, in elements
    int nx = 0;               ///< nodes owned along x
    int ny = 0;               ///< nodes owned along y
    int nz = 0;               ///< number of planes

    ASPERITY_HOST_DEVICE T& operator()(int x, int y, int z) const {
        return origin[z * plane + y * row + x];
    }
    ASPERITY_HOST_DEVICE PlaneView<T> operator[](int z) const {
        return {origin + z * plane, row, nx, ny};
    }
    ASPERITY_HOST_DEVICE operator VolumeView<const T>() const {
        return {origin, row, plane, nx, ny, nz};
    }
};

/// The three Cartesian components of a vector field, structure of arrays.
template <class View>
struct Vector3 {
    View x, y, z;

    template <class Other>
    ASPERITY_HOST_DEVICE operator Vector3<Other>() const requires(!std::is_same_v<Other, View>) {
        return {x, y, z};
    }
    ASPERITY_HOST_DEVICE auto operator[](int plane) const { // components of a plane of a volume
        return Vector3<decltype(x[plane])>{x[plane], y[plane], z[plane]};
    }
};

template <class T>
using VectorPlane = Vector3<PlaneView<T>>;
template <class T>
using VectorVolume = Vector3<VolumeView<T>>;

/// Returns the lines of the three components at y.
template <class T>
std::array<T*, 3> lines(const VectorPlane<T>& plane, int y) {
    return {plane.x.line(y), plane.y.line(y), plane.z.line(y)};
}

} // namespace asperity
