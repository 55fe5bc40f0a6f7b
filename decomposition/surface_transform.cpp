// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "decomposition/surface_transform.hpp"

#include "decomposition/process_grid.hpp"

#include <fftw3.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace asperity {

namespace {

/// FFTW's names for the two precisions.
struct DoubleFftw {
    using Plan = fftw_plan;
    using Complex = fftw_complex;
    static constexpr auto real_to_waves = fftw_plan_dft_r2c_1d;
    static constexpr auto waves_to_real = fftw_plan_dft_c2r_1d;
    static constexpr auto along = fftw_plan_many_dft;
    static constexpr auto run_real_to_waves = fftw_execute_dft_r2c;
    static constexpr auto run_waves_to_real = fftw_execute_dft_c2r;
    static constexpr auto run_along = fftw_execute_dft;
    static constexpr auto destroy = fftw_destroy_plan;
};
struct FloatFftw {
    using Plan = fftwf_plan;
    using Complex = fftwf_complex;
    static constexpr auto real_to_waves = fftwf_plan_dft_r2c_1d;
    static constexpr auto waves_to_real = fftwf_plan_dft_c2r_1d;
    static constexpr auto along = fftwf_plan_many_dft;
    static constexpr auto run_real_to_waves = fftwf_execute_dft_r2c;
    static constexpr auto run_waves_to_real = fftwf_execute_dft_c2r;
    static constexpr auto run_along = fftwf_execute_dft;
    static constexpr auto destroy = fftwf_destroy_plan;
};
template <class T>
using Fftw = std::conditional_t<std::is_same_v<T, double>, DoubleFftw, FloatFftw>;

} // namespace

Slab::Slab(int n, const Communicator& communicator) : ranks(communicator), sites(n) {
    const Tile mine = ProcessGrid::slabs(ranks.size(), ranks.rank(), sites).tile(0);
    first = mine.y0;
    rows = mine.ny;
}

std::vector<double> OrderedSums::total() const {
    std::vector<int> counts;
    std::size_t count = 0;
    for (int r = 0; r < slab_.ranks.size(); ++r) {
        counts.push_back(static_cast<int>(sums_) * parts_of(r));
        count += static_cast<std::size_t>(counts.back());
    }
    std::vector<double> all(count);
    slab_.ranks.all_gather(parts_, counts, all);
    std::vector<double> sum(sums_, 0.0);
    for (std::size_t i = 0; i < all.size(); ++i)
        sum[i % sums_] += all[i];
    for (double& s : sum)
        s *= static_cast<double>(slab_.sites) * slab_.sites;
    return sum;
}

template <class T>
struct SurfaceTransform<T>::Parts {
    using F = Fftw<T>;
    using Complex = typename F::Complex;
    /// Numbers of a block in one row of one component, and in a cache line.
    static constexpr std::size_t width = 2 * block_columns, line = 64 / sizeof(T);

    Slab slab;
    int components;
    bool under_way = false; ///< a stage lives
    typename F::Plan rows_forward = nullptr, rows_backward = nullptr;
    typename F::Plan columns_forward = nullptr, columns_backward = nullptr;
    /// Number of sites across above which FFTW writes the waves of a column one after another, to
    /// be put side by side afterwards: the columns of a block side by side are then too far from
    /// row to row for the passes of FFTW, which take two to three times as long.
    static constexpr int side_by_side = 256;
    bool one_after_another() const { return slab.sites > side_by_side; }
    /// Returns the distance between two columns one after another, in numbers: a line more than a
    /// column, so that they do not all lie at one place of a page.
    std::size_t column_length() const { return 2 * static_cast<std::size_t>(slab.sites) + line; }
    /// Memory of each thread: two blocks of waves; or a row of sites of each component, and one of
    /// waves. Behind both, the columns of one component one after another.
    struct Own {
        AlignedArray<T> room;
        std::array<T*, 3> rows{};
        T* columns = nullptr;
    };
    std::vector<Own> own;
    /// Waves that are transformed along x: this rank's rows of all blocks, or all rows of this
    /// rank's blocks, which the ranks exchange in place. The part of each rank, its blocks or its
    /// rows, begins at part(). In both a block of a rank's rows is [component][row][column], and
    /// the next one begins a line further, so that the blocks of a row do not all lie at one place
    /// of a page.
    AlignedArray<T> waves_along_x;
    std::vector<std::size_t> begins; ///< places at which the ranks' parts begin, and the end
    AlignedArray<T> sent;            ///< a part that is being exchanged

    Parts(const Slab& of, int components_) : slab(of), components(components_) {
        const std::size_t room =
            std::max(2 * slab.block_length(components),
                     static_cast<std::size_t>(components) * row_length() + waves_of_row());
        for (int t = 0; t < omp_get_max_threads(); ++t) {
            const std::size_t columns = one_after_another() ? block_columns * column_length() : 0;
            Own& mine = own.emplace_back(Own{aligned_array<T>(room + columns)});
            std::fill_n(mine.room.get(), room + columns, T(0));
            mine.columns = mine.room.get() + room;
            for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c)
                mine.rows[c] = mine.room.get() + c * row_length();
        }
        begins.push_back(0);
        std::size_t longest = 0;
        for (int r = 0; r < slab.ranks.size(); ++r) {
            const std::size_t part = std::max(length_as_rows(r), length_as_blocks(r));
            begins.push_back(begins.back() + part);
            longest = std::max(longest, part);
        }
        waves_along_x = aligned_array<T>(begins.back());
        if (slab.ranks.size() > 1) sent = aligned_array<T>(longest);
        T* const sites = mine();
        auto* const waves = reinterpret_cast<Complex*>(waves_of_mine());
        rows_forward = F::real_to_waves(slab.sites, sites, waves, FFTW_ESTIMATE);
        rows_backward = F::waves_to_real(slab.sites, waves, sites, FFTW_ESTIMATE);
        const auto columns = [&](int sign) {
            auto* const from = reinterpret_cast<Complex*>(sites);
            if (one_after_another())
                return F::along(1, &slab.sites, block_columns, from, nullptr, block_columns, 1,
                                reinterpret_cast<Complex*>(of_thread().columns), nullptr, 1,
                                static_cast<int>(column_length() / 2), sign, FFTW_ESTIMATE);
            return F::along(1, &slab.sites, block_columns, from, nullptr, block_columns, 1,
                            from + slab.block_length(components) / 2, nullptr, block_columns, 1,
                            sign, FFTW_ESTIMATE);
        };
        columns_forward = columns(FFTW_FORWARD);
        columns_backward = columns(FFTW_BACKWARD);
        if (!rows_forward || !rows_backward || !columns_forward || !columns_backward)
            throw std::runtime_error("FFTW has no plan for a surface of " +
                                     std::to_string(slab.sites) + " sites across");
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    ~Parts() {
        for (auto plan : {rows_forward, rows_backward, columns_forward, columns_backward})
            if (plan) F::destroy(plan);
    }

    /// Begins a transform.
    Parts& begin() {
        if (under_way) throw std::logic_error("SurfaceTransform: another transform is under way");
        under_way = true;
        return *this;
    }

    /// Returns no more threads than there were when the arrays were made.
    int threads() const { return std::min(omp_get_max_threads(), static_cast<int>(own.size())); }
    /// Returns the distance between the starts of two rows of sites of a thread, in numbers.
    std::size_t row_length() const {
        return (static_cast<std::size_t>(slab.sites) + line - 1) / line * line;
    }
    std::size_t waves_of_row() const { return static_cast<std::size_t>(slab.all_blocks()) * width; }
    const Own& of_thread() const { return own[static_cast<std::size_t>(omp_get_thread_num())]; }
    T* mine() { return of_thread().room.get(); }
    T* second_block() { return mine() + slab.block_length(components); }
    T* waves_of_mine() { return mine() + static_cast<std::size_t>(components) * row_length(); }

    /// Returns the number of values of one component of a block with this number of rows;
    /// block_of() returns that of all components, with the line.
    static std::size_t of_component(int rows) { return width * static_cast<std::size_t>(rows); }
    std::size_t block_of(int rows) const {
        return static_cast<std::size_t>(components) * of_component(rows) + line;
    }
    /// Returns the number of blocks of a rank, and of its rows.
    int blocks_of(int rank) const { return slab.first_block(rank + 1) - slab.first_block(rank); }
    int rows_of(int rank) const { return slab.first_row(rank + 1) - slab.first_row(rank); }
    /// Returns the length of the part of a rank: this rank's rows of its blocks, or its rows of
    /// this rank's blocks.
    std::size_t length_as_rows(int rank) const {
        return static_cast<std::size_t>(blocks_of(rank)) * block_of(slab.rows);
    }
    std::size_t length_as_blocks(int rank) const {
        return static_cast<std::size_t>(slab.blocks()) * block_of(rows_of(rank));
    }
    T* part(int rank) { return waves_along_x.get() + begins[static_cast<std::size_t>(rank)]; }

    /// Transforms row y of this rank from its sites along x; get_rows() goes back.
    void put_rows(int y) {
        const auto& rows = of_thread().rows;
        T* const waves = waves_of_mine();
        std::fill(waves + 2 * slab.columns(), waves + waves_of_row(), T(0)); // padding of a block
        for (int c = 0; c < components; ++c) {
            F::run_real_to_waves(rows_forward, rows[static_cast<std::size_t>(c)],
                                 reinterpret_cast<Complex*>(waves));
            each_of_row(y, c, [&](T* there, std::size_t i) {
                std::memcpy(there, waves + i, width * sizeof(T));
            });
        }
    }
    T* const* get_rows(int y) {
        const auto& rows = of_thread().rows;
        T* const waves = waves_of_mine();
        for (int c = 0; c < components; ++c) {
            each_of_row(y, c, [&](const T* there, std::size_t i) {
                __builtin_prefetch(there + 2 * width);
                std::memcpy(waves + i, there, width * sizeof(T));
            });
            F::run_waves_to_real(rows_backward, reinterpret_cast<Complex*>(waves),
                                 rows[static_cast<std::size_t>(c)]);
        }
        return rows.data();
    }
    template <class Copy>
    void each_of_row(int y, int c, const Copy& copy) {
        const std::size_t in_block = static_cast<std::size_t>(c) * of_component(slab.rows) +
                                     static_cast<std::size_t>(y) * width;
        std::size_t i = 0;
        for (int r = 0; r < slab.ranks.size(); ++r) {
            T* there = part(r) + in_block;
            for (int b = 0; b < blocks_of(r); ++b, there += block_of(slab.rows), i += width)
                copy(there, i);
        }
    }

    /// Calls copy() for each rank's rows of this rank's block b with their place in its part, their
    /// place in a whole block, and their number of values.
    template <class Copy>
    void each_of_block(int b, const Copy& copy) {
        for (int r = 0; r < slab.ranks.size(); ++r) {
            const int rows = rows_of(r);
            T* const there = part(r) + static_cast<std::size_t>(b) * block_of(rows);
            for (int c = 0; c < components; ++c)
                copy(there + static_cast<std::size_t>(c) * of_component(rows),
                     static_cast<std::size_t>(c) * of_component(slab.sites) +
                         of_component(slab.first_row(r)),
                     of_component(rows));
        }
    }
    void transform_block(typename F::Plan plan, const T* from, T* to) const {
        // Out of place, FFTW only reads columns.
        for (int c = 0; c < components;
             ++c, from += of_component(slab.sites), to += of_component(slab.sites)) {
            auto* const waves = reinterpret_cast<Complex*>(const_cast<T*>(from));
            if (!one_after_another()) {
                F::run_along(plan, waves, reinterpret_cast<Complex*>(to));
                continue;
            }
            T* const columns = of_thread().columns;
            F::run_along(plan, waves, reinterpret_cast<Complex*>(columns));
            put_side_by_side(columns, to);
        }
    }
    /// Copies the columns of a block from one after another to side by side.
    void put_side_by_side(const T* columns, T* to) const {
        constexpr int rows = 8; // whose waves are a line of each column
        for (int y0 = 0; y0 < slab.sites; y0 += rows) {
            const int y1 = std::min(slab.sites, y0 + rows);
            for (std::size_t k = 0; k < block_columns; ++k)
                for (int y = y0; y < y1; ++y)
                    std::memcpy(to + of_component(y) + 2 * k,
                                columns + k * column_length() + 2 * static_cast<std::size_t>(y),
                                2 * sizeof(T));
        }
    }
    T* get_block(int b) {
        T* const whole = second_block();
        const T* from = part(0) + static_cast<std::size_t>(b) * block_of(slab.rows);
        if (slab.ranks.size() > 1) {
            each_of_block(b, [&](const T* part, std::size_t at, std::size_t count) {
                std::copy_n(part, count, mine() + at);
            });
            from = mine();
        }
        transform_block(columns_forward, from, whole);
        return whole;
    }
    void put_block(int b, const T* waves) {
        if (slab.ranks.size() == 1) {
            transform_block(columns_backward, waves,
                            part(0) + static_cast<std::size_t>(b) * block_of(slab.rows));
            return;
        }
        transform_block(columns_backward, waves, mine());
        each_of_block(b, [&](T* part, std::size_t at, std::size_t count) {
            std::copy_n(mine() + at, count, part);
        });
    }

    /// Exchanges the rows of all ranks for this rank's blocks (to_blocks), or sends them back: in
    /// turn with each rank, in place. The part of this rank itself is the same in both.
    void exchange(bool to_blocks) {
        // A wave in single precision is as long as a double.
        const auto span = [](T* at, std::size_t count) {
            return std::span(reinterpret_cast<double*>(at), count * sizeof(T) / sizeof(double));
        };
        const int ranks = slab.ranks.size(), me = slab.ranks.rank();
        for (int turn = 0; turn < ranks; ++turn) {
            const int r = (turn - me + ranks) % ranks; // whose turn is with this rank
            if (r == me) continue;
            const std::size_t rows = length_as_rows(r), blocks = length_as_blocks(r);
            std::copy_n(part(r), to_blocks ? rows : blocks, sent.get());
            const Message message{r, r, 0, span(sent.get(), to_blocks ? rows : blocks),
                                  span(part(r), to_blocks ? blocks : rows)};
            slab.ranks.exchange(std::span(&message, 1));
        }
    }
};

template <class T>
SurfaceTransform<T>::SurfaceTransform(const Slab& slab, int components)
    : parts_(std::make_unique<Parts>(slab, components)) {}
template <class T>
SurfaceTransform<T>::~SurfaceTransform() = default;
template <class T>
SurfaceTransform<T>::SurfaceTransform(SurfaceTransform&&) noexcept = default;
template <class T>
SurfaceTransform<T>& SurfaceTransform<T>::operator=(SurfaceTransform&&) noexcept = default;

template <class T>
SiteRows<T> SurfaceTransform<T>::from_sites() const {
    return SiteRows<T>(parts_->begin());
}
template <class T>
WaveBlocks<T> SurfaceTransform<T>::from_waves() const {
    return WaveBlocks<T>(parts_->begin());
}
template <class T>
int SurfaceTransform<T>::threads() const {
    return parts_->threads();
}
template <class T>
T* SurfaceTransform<T>::room() const {
    return parts_->second_block();
}

template <class T>
int TransformStage<T>::threads() const {
    return parts_->threads();
}
template <class T>
void TransformStage<T>::End::operator()(typename SurfaceTransform<T>::Parts* parts) const {
    parts->under_way = false;
}

template <class T>
T* const* SiteRows<T>::own() const {
    return this->parts_->of_thread().rows.data();
}
template <class T>
void SiteRows<T>::put(int y) const {
    this->parts_->put_rows(y);
}
template <class T>
T* const* SiteRows<T>::get(int y) const {
    return this->parts_->get_rows(y);
}
template <class T>
WaveBlocks<T> SiteRows<T>::to_blocks() && {
    this->parts_->exchange(true);
    return WaveBlocks<T>(*this->parts_.release());
}

template <class T>
T* WaveBlocks<T>::get(int b) const {
    return this->parts_->get_block(b);
}
template <class T>
void WaveBlocks<T>::put(int b, const T* waves) const {
    this->parts_->put_block(b, waves);
}
template <class T>
T* WaveBlocks<T>::room() const {
    return this->parts_->second_block();
}
template <class T>
SiteRows<T> WaveBlocks<T>::to_rows() && {
    this->parts_->exchange(false);
    return SiteRows<T>(*this->parts_.release());
}

template <class T>
WaveBlocks<T> to_blocks(const std::vector<PlaneView<const T>>& planes,
                        const SurfaceTransform<T>& by) {
    SiteRows<T> rows = by.from_sites();
#pragma omp parallel for schedule(static) num_threads(rows.threads())
    for (int y = 0; y < planes.front().ny; ++y) {
        for (std::size_t c = 0; c < planes.size(); ++c)
            std::copy_n(planes[c].line(y), planes[c].nx, rows.own()[c]);
        rows.put(y);
    }
    return std::move(rows).to_blocks();
}

template <class T>
WaveBlocks<T> to_blocks(const SiteField<T>& field, const SurfaceTransform<T>& by) {
    std::vector<PlaneView<const T>> planes;
    for (const Field<T>& component : field)
        planes.push_back(component.plane(0));
    return to_blocks(planes, by);
}

template <class T>
void to_sites(const SiteRows<T>& rows, SiteField<T>& field) {
#pragma omp parallel for schedule(static) num_threads(rows.threads())
    for (int y = 0; y < field.front().plane(0).ny; ++y) {
        const T* const* own = rows.get(y);
        for (Field<T>& component : field) {
            const PlaneView<T> plane = component.plane(0);
            std::copy_n(*own++, plane.nx, plane.line(y));
        }
    }
}

template <class T>
void to_waves(const SiteField<T>& field, const SurfaceTransform<T>& by, Waves<T>& waves) {
    const WaveBlocks<T> blocks = to_blocks(field, by);
#pragma omp parallel for schedule(static) num_threads(blocks.threads())
    for (int b = 0; b < waves.blocks(); ++b)
        std::copy_n(blocks.get(b), waves.length(), waves.block(b));
}

template <class From, class T>
void to_sites(const Waves<From>& waves, const SurfaceTransform<T>& by, SiteField<T>& field) {
    WaveBlocks<T> blocks = by.from_waves();
#pragma omp parallel for schedule(static) num_threads(blocks.threads())
    for (int b = 0; b < waves.blocks(); ++b) {
        if constexpr (std::is_same_v<From, T>) {
            blocks.put(b, waves.block(b));
        } else {
            combine_row(1.0, waves.block(b), 0.0, blocks.room(), static_cast<int>(waves.length()));
            blocks.put(b, blocks.room());
        }
    }
    to_sites(std::move(blocks).to_rows(), field);
}

template class SurfaceTransform<double>;
template class SurfaceTransform<float>;
template class TransformStage<double>;
template class TransformStage<float>;
template class SiteRows<double>;
template class SiteRows<float>;
template class WaveBlocks<double>;
template class WaveBlocks<float>;
template WaveBlocks<double> to_blocks(const std::vector<PlaneView<const double>>&,
                                      const SurfaceTransform<double>&);
template WaveBlocks<float> to_blocks(const SiteField<float>&, const SurfaceTransform<float>&);
template WaveBlocks<double> to_blocks(const SiteField<double>&, const SurfaceTransform<double>&);
template void to_sites(const SiteRows<float>&, SiteField<float>&);
template void to_sites(const SiteRows<double>&, SiteField<double>&);
template void to_waves(const SiteField<float>&, const SurfaceTransform<float>&, Waves<float>&);
template void to_waves(const SiteField<double>&, const SurfaceTransform<double>&, Waves<double>&);
template void to_sites(const Waves<float>&, const SurfaceTransform<float>&, SiteField<float>&);
template void to_sites(const Waves<double>&, const SurfaceTransform<float>&, SiteField<float>&);
template void to_sites(const Waves<double>&, const SurfaceTransform<double>&, SiteField<double>&);

} // namespace asperity
