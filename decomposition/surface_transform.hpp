// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The Fourier transform of a surface in slabs of rows over the ranks.
//
// Rows of sites are made, transformed and handed over one at a time in the cache, and so are blocks
// of columns of waves (waves.hpp). Between the two the ranks exchange all waves once. FFTW works in
// arrays of a thread's own, by plans made by estimate, not by measurement, and always on as many
// columns; so a transform is bitwise identical on any number of threads and ranks.
#pragma once

#include "decomposition/aligned_array.hpp"
#include "decomposition/field.hpp"
#include "decomposition/waves.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace asperity {

/// One field for each component of the waves, all of the slab's tile.
template <class T>
using SiteField = std::vector<Field<T>>;
template <class T>
SiteField<T> site_field(const Slab& slab, int components) {
    SiteField<T> field;
    for (int c = 0; c < components; ++c)
        field.emplace_back(slab.tile(), 1, 0);
    return field;
}

/// Between the sites of a surface and its waves; T is double or float. All collective; one at a
/// time.
template <class T>
class SurfaceTransform {
public:
    SurfaceTransform(const Slab& slab, int components);
    ~SurfaceTransform();
    SurfaceTransform(SurfaceTransform&&) noexcept;
    SurfaceTransform& operator=(SurfaceTransform&&) noexcept;

    /// Row y of the slab of each component of a field, in the cache: to be written or read. Called
    /// by all threads, as are the next two.
    using Rows = std::function<void(int y, T* const* rows)>;
    /// Block b of this rank's waves, in the cache: to be read, or changed.
    using Blocks = std::function<void(int b, T* block)>;
    /// Where the waves of block b are: there, or in the room, written by this.
    using Give = std::function<const T*(int b, T* room)>;

    /// Hands over N^2 u_q of the field that make() writes.
    void forward(const Rows& make, const Blocks& use) const;
    /// Hands over the field of some waves.
    void backward(const Give& give, const Rows& use) const;
    /// Hands over N^2 u_q of what change() makes of the field of some waves.
    void through_sites(const Give& give, const Rows& change, const Blocks& use) const;
    /// Hands over the field of what change() makes of N^2 u_q of the field that make() writes.
    void through_waves(const Rows& make, const Blocks& change, const Rows& use) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace asperity
