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

/// A complex number, moved as a whole.
template <class T>
struct Wave {
    T re, im;
};
template <class T>
Wave<T>* waves_in(T* row) {
    return reinterpret_cast<Wave<T>*>(row);
}
template <class T>
const Wave<T>* waves_in(const T* row) {
    return reinterpret_cast<const Wave<T>*>(row);
}

/// Of `count` things, the first that part `p` of `parts` has.
int first_of(int count, int parts, int p) {
    return static_cast<int>(static_cast<long long>(count) * p / parts);
}

} // namespace

Slab::Slab(int n, const Communicator& communicator) : ranks(communicator), sites(n) {
    const Tile mine = ProcessGrid::slabs(ranks.size(), ranks.rank(), sites).tile(0);
    first = mine.y0;
    rows = mine.ny;
}

std::vector<double> RowSums::total() const {
    // Of all rows in their order, whatever the ranks are.
    const int ranks = slab_.ranks.size();
    std::vector<int> counts;
    for (int r = 0; r < ranks; ++r)
        counts.push_back(static_cast<int>(sums_) *
                         ProcessGrid::slabs(ranks, r, slab_.sites).tile(0).ny);
    std::vector<double> all(static_cast<std::size_t>(slab_.sites) * sums_);
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
    /// Columns that a thread takes at a time: a cache line of a row. Always as many, whatever they
    /// are: what FFTW does to one does not depend on the others.
    static constexpr int at_once = 32 / static_cast<int>(sizeof(T));

    Slab slab;
    typename F::Plan rows_forward = nullptr, rows_backward = nullptr;
    typename F::Plan columns_forward = nullptr, columns_backward = nullptr;
    /// Of each thread: columns of waves, [y][column], and their transforms; or rows of sites.
    std::vector<AlignedArray<T>> own;
    /// Of several ranks: the waves of this rank's rows, and those of its columns, both by rank and
    /// column, and within a column by row.
    AlignedArray<T> of_rows, of_columns;

    explicit Parts(const Slab& of) : slab(of) {
        const std::size_t n = static_cast<std::size_t>(slab.sites);
        const std::size_t room = std::max(2 * transformed(), 3 * row_length());
        for (int t = 0; t < omp_get_max_threads(); ++t) {
            own.push_back(aligned_array<T>(room));
            std::fill_n(own.back().get(), room, T(0));
        }
        if (slab.ranks.size() > 1) {
            of_rows = aligned_array<T>(2 * static_cast<std::size_t>(slab.rows) *
                                       static_cast<std::size_t>(slab.columns()));
            of_columns = aligned_array<T>(2 * n * static_cast<std::size_t>(my_columns()));
        }
        auto* const waves = reinterpret_cast<Complex*>(own.front().get());
        Field<T> field(slab.tile(), 1, 0);
        T* const sites = field.plane(0).line(0);
        rows_forward = F::real_to_waves(slab.sites, sites, waves, FFTW_ESTIMATE);
        rows_backward = F::waves_to_real(slab.sites, waves, sites, FFTW_ESTIMATE);
        const auto columns = [&](int sign) {
            return F::along(1, &slab.sites, at_once, waves, nullptr, at_once, 1,
                            waves + transformed() / 2, nullptr, at_once, 1, sign, FFTW_ESTIMATE);
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

    /// No more than there were when the arrays were made.
    int threads() const { return std::min(omp_get_max_threads(), static_cast<int>(own.size())); }
    /// Numbers before the transforms of some columns.
    std::size_t transformed() const { return 2 * at_once * static_cast<std::size_t>(slab.sites); }
    /// From the start of one row of a thread's own arrays to that of the next.
    std::size_t row_length() const {
        constexpr std::size_t line = 64 / sizeof(T);
        return (static_cast<std::size_t>(slab.sites) + line - 1) / line * line;
    }
    T* mine() { return own[static_cast<std::size_t>(omp_get_thread_num())].get(); }

    int first_column(int rank) const { return first_of(slab.columns(), slab.ranks.size(), rank); }
    int my_columns() const {
        return first_column(slab.ranks.rank() + 1) - first_column(slab.ranks.rank());
    }
    int first_row(int rank) const { return first_of(slab.sites, slab.ranks.size(), rank); }

    /// Of columns [y][at_once], some of which may be of no meaning. Returns their transforms.
    Wave<T>* transform_some(Wave<T>* columns, bool forward) const {
        Wave<T>* const out = columns + transformed() / 2;
        F::run_along(forward ? columns_forward : columns_backward,
                     reinterpret_cast<Complex*>(columns), reinterpret_cast<Complex*>(out));
        return out;
    }

    /// A row of sites, and the waves of one, which are lost.
    void to_waves(const T* sites, T* waves) const {
        // Out of place, FFTW only reads.
        F::run_real_to_waves(rows_forward, const_cast<T*>(sites),
                             reinterpret_cast<Complex*>(waves));
    }
    void to_sites(T* waves, T* sites) const {
        F::run_waves_to_real(rows_backward, reinterpret_cast<Complex*>(waves), sites);
    }
    /// Rows of sites of a thread's own.
    std::array<T*, 3> sites_of_mine() {
        std::array<T*, 3> rows;
        for (std::size_t c = 0; c < rows.size(); ++c)
            rows[c] = mine() + c * row_length();
        return rows;
    }

    /// All columns of the waves, which are whole on one rank.
    void columns_of_one_rank(const Waves<T>& from, Waves<T>& to, int component, bool forward) {
        const int columns = slab.columns();
#pragma omp parallel for schedule(static) num_threads(threads())
        for (int x0 = 0; x0 < columns; x0 += at_once) {
            const int width = std::min(at_once, columns - x0);
            Wave<T>* const some = waves_in(mine());
            const auto copy = [width](const Wave<T>* these, Wave<T>* there) {
                if (width == at_once)
                    std::memcpy(there, these, at_once * sizeof(Wave<T>)); // a line
                else
                    std::copy_n(these, width, there);
            };
            for (int y = 0; y < slab.sites; ++y)
                copy(waves_in(from.row(component, y)) + x0, some + y * at_once);
            const Wave<T>* const done = transform_some(some, forward);
            for (int y = 0; y < slab.sites; ++y)
                copy(done + y * at_once, waves_in(to.row(component, y)) + x0);
        }
    }

    /// The same of several: every rank transforms its columns.
    void columns_of_all_ranks(const Waves<T>& from, Waves<T>& to, int component, bool forward) {
        each_in_rows([&](Wave<T>& in_column, int x, int y) {
            in_column = waves_in(from.row(component, y))[x];
        });
        exchange(true);
#pragma omp parallel for schedule(static) num_threads(threads())
        for (int x0 = 0; x0 < my_columns(); x0 += at_once) {
            const int width = std::min(at_once, my_columns() - x0);
            Wave<T>* const some = waves_in(mine());
            const auto each = [&](Wave<T>* all, const auto& copy) {
                for (int r = 0; r < slab.ranks.size(); ++r)
                    for (int i = 0; i < width; ++i) {
                        Wave<T>* const column = in_columns(r, x0 + i);
                        for (int y = first_row(r); y < first_row(r + 1); ++y)
                            copy(all[y * at_once + i], column[y - first_row(r)]);
                    }
            };
            each(some, [](Wave<T>& in_row, const Wave<T>& in_column) { in_row = in_column; });
            each(transform_some(some, forward),
                 [](const Wave<T>& in_row, Wave<T>& in_column) { in_column = in_row; });
        }
        exchange(false);
        each_in_rows([&](const Wave<T>& in_column, int x, int y) {
            waves_in(to.row(component, y))[x] = in_column;
        });
    }

    /// Of rank r's rows, this rank's column x.
    Wave<T>* in_columns(int r, int x) {
        const auto rows = static_cast<std::ptrdiff_t>(first_row(r + 1) - first_row(r));
        return waves_in(of_columns.get()) +
               static_cast<std::ptrdiff_t>(first_row(r)) * my_columns() + x * rows;
    }
    /// Of `of_rows`, where column x starts at x * rows, each wave.
    template <class Copy>
    void each_in_rows(const Copy& copy) {
#pragma omp parallel for schedule(static)
        for (int x = 0; x < slab.columns(); ++x) {
            Wave<T>* const column =
                waves_in(of_rows.get()) + static_cast<std::ptrdiff_t>(x) * slab.rows;
            for (int y = 0; y < slab.rows; ++y)
                copy(column[y], x, y);
        }
    }
    /// Every rank's rows of this rank's columns come here, or go back.
    void exchange(bool to_columns) {
        std::vector<Message> messages;
        const int me = slab.ranks.rank();
        for (int r = 0; r < slab.ranks.size(); ++r) {
            Wave<T>* const rows =
                waves_in(of_rows.get()) + static_cast<std::ptrdiff_t>(first_column(r)) * slab.rows;
            const auto its = static_cast<std::size_t>(first_column(r + 1) - first_column(r)) *
                             static_cast<std::size_t>(slab.rows);
            Wave<T>* const columns = in_columns(r, 0);
            const auto mine_of_it = static_cast<std::size_t>(first_row(r + 1) - first_row(r)) *
                                    static_cast<std::size_t>(my_columns());
            if (r == me) {
                if (to_columns)
                    std::copy_n(rows, its, columns);
                else
                    std::copy_n(columns, mine_of_it, rows);
                continue;
            }
            // A wave in single precision is as long as a double.
            const auto span = [](Wave<T>* at, std::size_t count) {
                return std::span(reinterpret_cast<double*>(at),
                                 count * (sizeof(Wave<T>) / sizeof(double)));
            };
            const auto here = span(rows, its), there = span(columns, mine_of_it);
            messages.push_back(to_columns ? Message{r, r, 0, here, there}
                                          : Message{r, r, 0, there, here});
        }
        slab.ranks.exchange(messages);
    }

    void transform_columns(const Waves<T>& from, Waves<T>& to, int component, bool forward) {
        if (slab.ranks.size() == 1)
            columns_of_one_rank(from, to, component, forward);
        else
            columns_of_all_ranks(from, to, component, forward);
    }
    void transform_columns(const Waves<T>& from, Waves<T>& to, bool forward) {
        for (int c = 0; c < to.components(); ++c)
            transform_columns(from, to, c, forward);
    }
};

template <class T>
SurfaceTransform<T>::SurfaceTransform(const Slab& slab) : parts_(std::make_unique<Parts>(slab)) {}
template <class T>
SurfaceTransform<T>::~SurfaceTransform() = default;
template <class T>
SurfaceTransform<T>::SurfaceTransform(SurfaceTransform&&) noexcept = default;
template <class T>
SurfaceTransform<T>& SurfaceTransform<T>::operator=(SurfaceTransform&&) noexcept = default;

template <class T>
void SurfaceTransform<T>::forward(const PlaneView<const T>& field, Waves<T>& waves,
                                  int component) const {
#pragma omp parallel for schedule(static) num_threads(parts_->threads())
    for (int y = 0; y < waves.rows(); ++y)
        parts_->to_waves(field.line(y), waves.row(component, y));
    parts_->transform_columns(waves, waves, component, true);
}

template <class T>
void SurfaceTransform<T>::backward(Waves<T>& waves, int component,
                                   const PlaneView<T>& field) const {
    parts_->transform_columns(waves, waves, component, false);
#pragma omp parallel for schedule(static) num_threads(parts_->threads())
    for (int y = 0; y < waves.rows(); ++y)
        parts_->to_sites(waves.row(component, y), field.line(y));
}

template <class T>
void SurfaceTransform<T>::forward(const Rows& make, Waves<T>& waves) const {
#pragma omp parallel for schedule(static) num_threads(parts_->threads())
    for (int y = 0; y < waves.rows(); ++y) {
        const auto rows = parts_->sites_of_mine();
        make(y, rows.data());
        for (int c = 0; c < waves.components(); ++c)
            parts_->to_waves(rows[static_cast<std::size_t>(c)], waves.row(c, y));
    }
    parts_->transform_columns(waves, waves, true);
}

template <class T>
void SurfaceTransform<T>::backward(Waves<T>& waves, const Rows& use) const {
    parts_->transform_columns(waves, waves, false);
#pragma omp parallel for schedule(static) num_threads(parts_->threads())
    for (int y = 0; y < waves.rows(); ++y) {
        const auto rows = parts_->sites_of_mine();
        for (int c = 0; c < waves.components(); ++c)
            parts_->to_sites(waves.row(c, y), rows[static_cast<std::size_t>(c)]);
        use(y, rows.data());
    }
}

template <class T>
void SurfaceTransform<T>::through(const Waves<T>& from, const Rows& change, Waves<T>& to) const {
    parts_->transform_columns(from, to, false);
#pragma omp parallel for schedule(static) num_threads(parts_->threads())
    for (int y = 0; y < to.rows(); ++y) {
        const auto rows = parts_->sites_of_mine();
        for (int c = 0; c < to.components(); ++c)
            parts_->to_sites(to.row(c, y), rows[static_cast<std::size_t>(c)]);
        change(y, rows.data());
        for (int c = 0; c < to.components(); ++c)
            parts_->to_waves(rows[static_cast<std::size_t>(c)], to.row(c, y));
    }
    parts_->transform_columns(to, to, true);
}

template class SurfaceTransform<double>;
template class SurfaceTransform<float>;

} // namespace asperity
