// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The Fourier transform of a surface in slabs of rows over the ranks.
//
// FFTW transforms one row and a few columns at a time, in arrays of a thread's own, by plans made
// by estimate, not by measurement. So a transform is bitwise identical on any number of threads and
// ranks. Between rows and columns the ranks exchange all their waves.
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

/// Between the sites of a surface and its waves; T is double or float. Both directions collective;
/// one at a time. Fields are those of site_field(), whose rows start on cache lines.
template <class T>
class SurfaceTransform {
public:
    explicit SurfaceTransform(const Slab& slab);
    ~SurfaceTransform();
    SurfaceTransform(SurfaceTransform&&) noexcept;
    SurfaceTransform& operator=(SurfaceTransform&&) noexcept;

    /// N^2 u_q of one component.
    void forward(const PlaneView<const T>& field, Waves<T>& waves, int component) const;
    /// The field of one component, whose waves are lost.
    void backward(Waves<T>& waves, int component, const PlaneView<T>& field) const;

    /// Row y of the slab of each component of a field, in the cache: to be written or read. Called
    /// by all threads.
    using Rows = std::function<void(int y, T* const* rows)>;
    /// N^2 u_q of the field that make() writes.
    void forward(const Rows& make, Waves<T>& waves) const;
    /// Hands over the field of some waves, which are lost.
    void backward(Waves<T>& waves, const Rows& use) const;
    /// to <- N^2 u_q of what change() makes of the field of `from`.
    void through(const Waves<T>& from, const Rows& change, Waves<T>& to) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace asperity
