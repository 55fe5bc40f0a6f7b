// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Fields on a square surface as plane waves, u(r) = sum_q u_q exp(i q r), cut into slabs of rows.
//
// u is real, so half of the waves say everything: columns q_x = 0 .. N/2, rows q_y = 0 .. N-1 (the
// upper half of which are negative). A sum over all waves counts the columns inside twice. With u_q
// normalised like this, Parseval reads  sum_r a.b = N^2 sum_q conj(a_q).b_q.
//
// A rank holds the same rows of the sites and of the waves (surface_transform.hpp).
#pragma once

#include "decomposition/aligned_array.hpp"
#include "decomposition/communicator.hpp"
#include "decomposition/tile.hpp"
#include "kernels/surface_rows.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace asperity {

/// A rank's rows of a square surface of sites * sites.
struct Slab {
    Communicator ranks;
    int sites = 0;
    int first = 0; ///< row
    int rows = 0;

    /// The whole surface, or this rank's share of it. Collective. Throws std::invalid_argument
    /// where a rank would have no row.
    Slab(int sites, const Communicator& ranks);

    int columns() const { return sites / 2 + 1; }
    Tile tile() const { return {0, first, sites, rows, sites}; }
    /// The row that is q_y = 0, if it is this rank's.
    bool holds_uniform() const { return first == 0; }
};

/// Coefficients of one or three components, each [q_y][q_x] as (real, imaginary) pairs of T. The
/// last component is the normal one.
template <class T>
class Waves {
public:
    Waves(const Slab& slab, int components)
        : slab_(slab), components_(components), row_(row_length(slab)),
          component_(static_cast<std::size_t>(slab.rows) * row_) {
        const std::size_t size = static_cast<std::size_t>(components) * component_;
        data_ = aligned_array<T>(size);
        clear();
    }
    void clear() {
#pragma omp parallel for schedule(static)
        for (int y = 0; y < slab_.rows; ++y)
            for (int c = 0; c < components_; ++c)
                for (int i = 0; i < length(); ++i)
                    row(c, y)[i] = T(0);
    }

    const Slab& slab() const { return slab_; }
    int rows() const { return slab_.rows; }
    int columns() const { return slab_.columns(); }
    int length() const { return 2 * columns(); } ///< numbers in a row
    int components() const { return components_; }
    T* component(int c) { return data_.get() + static_cast<std::size_t>(c) * component_; }
    /// Row y of the slab.
    T* row(int c, int y) { return component(c) + offset(y); }
    const T* row(int c, int y) const {
        return data_.get() + static_cast<std::size_t>(c) * component_ + offset(y);
    }
    std::size_t bytes() const {
        return static_cast<std::size_t>(components_) * component_ * sizeof(T);
    }

private:
    /// Rows start on cache lines, and not all at one place of a page.
    static std::size_t row_length(const Slab& slab) {
        constexpr std::size_t line = 64 / sizeof(T), page = 4096 / sizeof(T);
        const std::size_t row = (2 * static_cast<std::size_t>(slab.columns()) + line - 1) / line;
        return (row * line % page == 0 ? row + 1 : row) * line;
    }
    std::size_t offset(int y) const { return static_cast<std::size_t>(y) * row_; }
    Slab slab_;
    int components_ = 0;
    std::size_t row_ = 0, component_ = 0;
    AlignedArray<T> data_;
};

/// Sums over all waves: row by row, then in the order of rows, whatever the number of threads and
/// ranks.
class RowSums {
public:
    RowSums(const Slab& slab, std::size_t sums)
        : slab_(slab), sums_(sums), parts_(static_cast<std::size_t>(slab.rows) * sums) {}
    double* row(int y) { return parts_.data() + static_cast<std::size_t>(y) * sums_; }
    /// Collective; the same on every rank.
    std::vector<double> total() const;

private:
    const Slab& slab_;
    std::size_t sums_;
    std::vector<double> parts_;
};

/// sum_r a.b of the fields that the waves stand for. Collective.
template <class A, class B>
double dot(const Waves<A>& a, const Waves<B>& b) {
    RowSums sums(a.slab(), 1);
#pragma omp parallel for schedule(static)
    for (int y = 0; y < a.rows(); ++y)
        for (int c = 0; c < a.components(); ++c)
            *sums.row(y) += row_dot(a.row(c, y), b.row(c, y), a.slab().sites);
    return sums.total()[0];
}

/// to <- a from + keep to
template <class From, class To>
void combine(double a, const Waves<From>& from, double keep, Waves<To>& to) {
#pragma omp parallel for schedule(static)
    for (int y = 0; y < from.rows(); ++y)
        for (int c = 0; c < from.components(); ++c)
            combine_row(a, from.row(c, y), keep, to.row(c, y), from.length());
}

} // namespace asperity
