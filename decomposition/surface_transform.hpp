// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The Fourier transform of a surface in slabs of rows over the ranks.
//
// A transform consists of two loops of the caller, over rows of sites and over blocks of columns of
// waves (waves.hpp), with one exchange between the ranks in between. Each stage is an object, which
// the next stage consumes, so that the loops have one order and a transform has one owner:
//
//     SiteRows<T> rows = transform.from_sites();
//     #pragma omp parallel for schedule(static) num_threads(rows.threads())
//     for (int y = 0; y < slab.rows; ++y) {
//         ... rows.own() ...  // a row of each component, to be written
//         rows.put(y);
//     }
//     WaveBlocks<T> blocks = std::move(rows).to_blocks();
//     #pragma omp parallel for schedule(static) num_threads(blocks.threads())
//     for (int b = 0; b < slab.blocks(); ++b)
//         ... blocks.get(b) ...
//
// The transform back uses from_waves(), put(), to_rows() and get(). A row or a block is used while
// it is in the cache, and may be changed and put back before the next stage. FFTW works in arrays
// of each thread, with plans made by estimate, not by measurement, and always for the same number
// of columns, so that a transform is bitwise identical on any number of threads and ranks.
#pragma once

#include "decomposition/aligned_array.hpp"
#include "decomposition/field.hpp"
#include "decomposition/waves.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace asperity {

/// One field of the slab's tile for each component of the waves.
template <class T>
using SiteField = std::vector<Field<T>>;
/// Returns a field of zeros. home: workspace to take the memory from; nullptr: none.
template <class T>
SiteField<T> site_field(const Slab& slab, int components, Workspace* home = nullptr) {
    SiteField<T> field;
    for (int c = 0; c < components; ++c)
        field.emplace_back(slab.tile(), 1, 0, home);
    return field;
}

template <class T>
class SiteRows;
template <class T>
class WaveBlocks;

/// Transforms between the sites of a surface and its waves, one at a time; T is double or float.
template <class T>
class SurfaceTransform {
public:
    /// Makes plans and buffers. components: 1 or 3. Throws std::runtime_error if FFTW fails.
    SurfaceTransform(const Slab& slab, int components);
    ~SurfaceTransform();
    SurfaceTransform(SurfaceTransform&&) noexcept;
    SurfaceTransform& operator=(SurfaceTransform&&) noexcept;

    /// Begins a transform from sites, whose rows the caller puts. Throws std::logic_error if a
    /// stage of another transform still exists.
    SiteRows<T> from_sites() const;
    /// Begins a transform from waves, whose blocks the caller puts. Throws std::logic_error like
    /// from_sites().
    WaveBlocks<T> from_waves() const;

    /// Returns the largest number of threads of a loop over rows or blocks.
    int threads() const;
    /// Returns this thread's buffer for one block; get() and put() of blocks overwrite the buffer.
    T* room() const;

    struct Parts;

private:
    std::unique_ptr<Parts> parts_;
};

/// The current stage of a transform. Its destruction ends the transform, unless another stage has
/// consumed it.
template <class T>
class TransformStage {
public:
    /// Returns the largest number of threads of a loop over rows or blocks.
    int threads() const;

protected:
    explicit TransformStage(typename SurfaceTransform<T>::Parts& parts) : parts_(&parts) {}
    struct End {
        void operator()(typename SurfaceTransform<T>::Parts* parts) const;
    };
    std::unique_ptr<typename SurfaceTransform<T>::Parts, End> parts_;
};

/// A transform at its rows of sites.
template <class T>
class SiteRows : public TransformStage<T> {
public:
    /// Returns this thread's buffer for one row of sites of each component.
    T* const* own() const;
    /// Transforms own() along x, as row y of the slab.
    void put(int y) const;
    /// Transforms row y of the slab back along x. Returns own(), which holds the row.
    T* const* get(int y) const;
    /// Exchanges the rows that were put for blocks of waves. Collective.
    WaveBlocks<T> to_blocks() &&;

private:
    friend SurfaceTransform<T>;
    friend WaveBlocks<T>;
    using TransformStage<T>::TransformStage;
};

/// A transform at its blocks of waves.
template <class T>
class WaveBlocks : public TransformStage<T> {
public:
    /// Transforms this rank's block b along y. Returns room(), which holds the waves N^2 u_q and
    /// may be changed.
    T* get(int b) const;
    /// Transforms block b of waves u_q back along y. waves may be room().
    void put(int b, const T* waves) const;
    /// Returns this thread's buffer for one block.
    T* room() const;
    /// Exchanges the blocks that were put for rows of sites. Collective.
    SiteRows<T> to_rows() &&;

private:
    friend SurfaceTransform<T>;
    friend SiteRows<T>;
    using TransformStage<T>::TransformStage;
};

/// Transforms planes of sites, one for each component, or a field, to blocks of waves. Collective.
template <class T>
WaveBlocks<T> to_blocks(const std::vector<PlaneView<const T>>& planes,
                        const SurfaceTransform<T>& by);
template <class T>
WaveBlocks<T> to_blocks(const SiteField<T>& field, const SurfaceTransform<T>& by);
/// Sets a field to rows transformed back along x.
template <class T>
void to_sites(const SiteRows<T>& rows, SiteField<T>& field);
/// Sets waves to N^2 times the waves of a field. Collective.
template <class T>
void to_waves(const SiteField<T>& field, const SurfaceTransform<T>& by, Waves<T>& waves);
/// Sets a field to the sum of its waves u_q. Collective.
template <class From, class T>
void to_sites(const Waves<From>& waves, const SurfaceTransform<T>& by, SiteField<T>& field);

} // namespace asperity
