// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The Fourier transform of a surface in slabs of rows over the ranks.
//
// It is two loops of the caller, over rows of sites and over blocks of columns of waves
// (waves.hpp), with one exchange of the ranks between them:
//
//     #pragma omp parallel for schedule(static) num_threads(t.threads())
//     for (int y = 0; y < slab.rows; ++y) {
//         T* const* rows = t.rows(); // of each component, to be written
//         ...
//         t.put_rows(y);
//     }
//     t.to_blocks();
//     #pragma omp parallel for schedule(static) num_threads(t.threads())
//     for (int b = 0; b < slab.blocks(); ++b)
//         ... t.get_block(b) ...
//
// and back by put_block(), to_rows() and get_rows(). So what is done to a row or a block is done
// while it is in the cache. FFTW works in arrays of a thread's own, by plans made by estimate, not
// by measurement, and always on as many columns: a transform is bitwise identical on any number of
// threads and ranks.
#pragma once

#include "decomposition/aligned_array.hpp"
#include "decomposition/field.hpp"
#include "decomposition/waves.hpp"

#include <cstddef>
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

/// Between the sites of a surface and its waves; T is double or float. One transform at a time.
template <class T>
class SurfaceTransform {
public:
    SurfaceTransform(const Slab& slab, int components);
    ~SurfaceTransform();
    SurfaceTransform(SurfaceTransform&&) noexcept;
    SurfaceTransform& operator=(SurfaceTransform&&) noexcept;

    /// Of a loop over rows or blocks, at most.
    int threads() const;

    /// A row of sites of each component, this thread's own.
    T* const* rows() const;
    /// These become row y of the slab.
    void put_rows(int y) const;
    /// Row y of the slab, in rows().
    T* const* get_rows(int y) const;
    /// From rows that were put to blocks, and back. Collective.
    void to_blocks() const;
    void to_rows() const;
    /// N^2 u_q of this rank's block b, in room(); it may be changed.
    T* get_block(int b) const;
    /// The waves of block b, which may be in room(), as u_q.
    void put_block(int b, const T* waves) const;
    /// A block of this thread's own.
    T* room() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace asperity
