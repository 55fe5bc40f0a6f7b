// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Fields on a square surface as plane waves, u(r) = sum_q u_q exp(i q r).
//
// u is real, so that half of the waves suffice: columns q_x = 0 .. N/2, rows q_y = 0 .. N-1 (of
// which the upper half are negative). A sum over all waves counts the inner columns twice. With
// this normalisation of u_q, Parseval reads sum_r a.b = N^2 sum_q conj(a_q).b_q.
//
// A rank holds a slab of rows of the sites and a range of columns of the waves. The columns are
// stored in blocks of block_columns (kernels/surface_rows.hpp), the last block padded with zeros. A
// block of all components fits into a core's cache, so that it is transformed along y and
// multiplied with one read and one write of memory (surface_transform.hpp).
#pragma once

#include "decomposition/aligned_array.hpp"
#include "decomposition/communicator.hpp"
#include "decomposition/tile.hpp"
#include "kernels/surface_rows.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace asperity {

/// A rank's share of a square surface of sites * sites.
struct Slab {
    Communicator ranks;
    int sites = 0;
    int first = 0; ///< first row of sites of this rank
    int rows = 0;  ///< number of rows of sites

    /// Cuts a surface into equal shares of the ranks. Collective. Throws std::invalid_argument if a
    /// rank would have no row.
    Slab(int sites, const Communicator& ranks);

    /// Returns the number of columns of waves of all ranks.
    int columns() const { return sites / 2 + 1; }
    /// Returns this rank's sites.
    Tile tile() const { return {0, first, sites, rows, sites}; }
    /// Returns a rank's first row of sites.
    int first_row(int rank) const {
        return static_cast<int>(static_cast<long long>(sites) * rank / ranks.size());
    }
    /// Returns the number of blocks of the waves of all ranks.
    int all_blocks() const { return (columns() + block_columns - 1) / block_columns; }
    /// Returns a rank's first block. The first rank has at least one block, others may have none.
    int first_block(int rank) const {
        return (all_blocks() * rank + ranks.size() - 1) / ranks.size();
    }
    int first_block() const { return first_block(ranks.rank()); }
    /// Returns the number of blocks of this rank.
    int blocks() const { return first_block(ranks.rank() + 1) - first_block(); }
    /// Returns a rank's first column of waves; columns() behind the last rank.
    int first_column(int rank) const {
        return std::min(columns(), first_block(rank) * block_columns);
    }
    int first_column() const { return first_column(ranks.rank()); }
    /// Returns the column behind this rank's last one.
    int end_column() const { return first_column(ranks.rank() + 1); }
    /// Returns true if this rank holds a column of waves.
    bool holds(int column) const { return first_column() <= column && column < end_column(); }
    /// Returns the number of values in a block of waves.
    std::size_t block_length(int components) const {
        return 2 * block_columns * static_cast<std::size_t>(components) *
               static_cast<std::size_t>(sites);
    }
    /// Returns true if this rank holds the wave q = 0.
    bool holds_uniform() const { return ranks.rank() == 0; }
    /// Returns the multiplicities of the columns of a block of this rank in a sum over all waves.
    std::array<double, block_columns> weights(int block) const {
        std::array<double, block_columns> of{};
        for (int i = 0; i < block_columns; ++i) {
            const int x = (first_block() + block) * block_columns + i;
            of[static_cast<std::size_t>(i)] = x == 0 || 2 * x == sites ? 1.0
                                              : x < columns()          ? 2.0
                                                                       : 0.0;
        }
        return of;
    }
};

/// Coefficients of one or three components, as (real, imaginary) pairs of T, in blocks of columns:
/// [block][component][q_y][column]. The last component is the normal one.
template <class T>
class Waves {
public:
    /// Makes waves of zeros. components: 1 or 3; home: workspace of the memory, nullptr for none.
    Waves(const Slab& slab, int components, Workspace* home = nullptr)
        : slab_(slab), components_(components),
          data_(aligned_array<T>(static_cast<std::size_t>(blocks()) * length(), home)) {
        clear();
    }
    /// Sets all coefficients to zero.
    void clear() {
#pragma omp parallel for schedule(static)
        for (int b = 0; b < blocks(); ++b)
            std::fill_n(block(b), length(), T(0));
    }

    const Slab& slab() const { return slab_; }
    int components() const { return components_; }
    int blocks() const { return slab_.blocks(); } ///< returns the number of blocks of this rank
    /// Returns the number of values in a block.
    std::size_t length() const { return slab_.block_length(components_); }
    T* block(int b) { return data_.get() + static_cast<std::size_t>(b) * length(); }
    const T* block(int b) const { return data_.get() + static_cast<std::size_t>(b) * length(); }
    /// Returns the coefficient (real, imaginary) of component c of a wave; nullptr if another rank
    /// holds the wave.
    const T* wave(int c, int nx, int ny) const {
        const int b = nx / block_columns - slab_.first_block();
        if (b < 0 || b >= blocks()) return nullptr;
        return block(b) + 2 * (block_columns * (static_cast<std::ptrdiff_t>(c) * slab_.sites + ny) +
                               nx % block_columns);
    }
    /// Returns the real part of the wave q = 0 of component c. Requires slab().holds_uniform().
    T& uniform(int c) { return block(0)[slab_.block_length(c)]; }
    T uniform(int c) const { return block(0)[slab_.block_length(c)]; }
    std::size_t bytes() const { return static_cast<std::size_t>(blocks()) * length() * sizeof(T); }

private:
    Slab slab_;
    int components_ = 0;
    AlignedArray<T> data_;
};

/// Sums over the surface by parts (rows of sites or blocks of waves): first within a part, then
/// over parts in their order, with identical results for any number of threads and ranks.
class OrderedSums {
public:
    /// Kind of parts.
    enum class Over { rows, blocks };
    /// Makes sums of zero. sums: number of sums. Keeps a reference to the slab.
    OrderedSums(const Slab& slab, Over over, std::size_t sums)
        : slab_(slab), over_(over), sums_(sums),
          parts_(static_cast<std::size_t>(parts_of(slab.ranks.rank())) * sums) {}
    /// Returns the sums of part i of this rank, for writing.
    double* part(int i) { return parts_.data() + static_cast<std::size_t>(i) * sums_; }
    /// Returns the sums over all parts times N^2, the same on every rank. Collective.
    std::vector<double> total() const;

private:
    int parts_of(int rank) const {
        return over_ == Over::rows ? slab_.first_row(rank + 1) - slab_.first_row(rank)
                                   : slab_.first_block(rank + 1) - slab_.first_block(rank);
    }
    const Slab& slab_;
    Over over_;
    std::size_t sums_;
    std::vector<double> parts_;
};

/// Returns the contribution of block b to dot().
template <class A, class B>
double dot_of_block(int b, const Waves<A>& a, const Waves<B>& with) {
    return block_dot(a.block(b), with.block(b), a.components() * a.slab().sites,
                     a.slab().weights(b).data());
}

/// Returns sum_r a.b of the fields of two sets of waves. Collective.
template <class A, class B>
double dot(const Waves<A>& a, const Waves<B>& with) {
    OrderedSums sums(a.slab(), OrderedSums::Over::blocks, 1);
#pragma omp parallel for schedule(static)
    for (int b = 0; b < a.blocks(); ++b)
        *sums.part(b) = dot_of_block(b, a, with);
    return sums.total()[0];
}

/// Sets to <- a from + b to.
template <class From, class To>
void combine(double a, const Waves<From>& from, double b, Waves<To>& to) {
#pragma omp parallel for schedule(static)
    for (int i = 0; i < from.blocks(); ++i)
        combine_row(a, from.block(i), b, to.block(i), static_cast<int>(from.length()));
}

} // namespace asperity
