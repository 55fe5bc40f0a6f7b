// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Maps in bands: of a periodic map of rows x columns values each rank holds a band of whole rows,
// and no rank holds the map. Values lie row by row, value[(y - first()) * columns() + x].
//
// Sums run through the bands one after the other, in the order of the rows, so that they have the
// bits of a loop over the whole map. Waves are transformed in blocks of a fixed number of rows and
// of columns, by plans made by estimate for one thread: a map is bitwise identical on any number of
// ranks and threads.
#pragma once

#include "decomposition/communicator.hpp"

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

/// The division of a map into bands, one for each rank.
class Bands {
public:
    /// Makes bands of rows x columns values; with fewer rows than ranks some bands are
    /// empty.
    Bands(const Communicator& ranks, int columns, int rows);
    /// Makes bands of n x n values.
    Bands(const Communicator& ranks, int n) : Bands(ranks, n, n) {}
    /// Returns bands of which this rank's has `held` rows. Collective.
    static Bands of_rows(const Communicator& ranks, int columns, int held);

    const Communicator& ranks() const { return ranks_; }
    int columns() const { return columns_; }
    int rows() const { return first_.back(); }
    /// Returns the first row of a rank's band; that of rank ranks().size() is rows().
    int first(int rank) const { return first_[static_cast<std::size_t>(rank)]; }
    int first() const { return first(ranks_.rank()); }
    /// Returns the number of rows of this rank's band.
    int held() const { return first(ranks_.rank() + 1) - first(); }
    /// Returns the number of values in this rank's band.
    std::size_t size() const {
        return static_cast<std::size_t>(held()) * static_cast<std::size_t>(columns_);
    }
    /// Returns the place of a value of the band; y counts from the first row of the map.
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y - first()) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(x);
    }

    /// Calls add() on one rank after the other. add() continues sums that the ranks before have
    /// begun; afterwards every rank has the sums of all. Collective.
    template <class Add>
    void in_order(std::span<double> sums, const Add& add) const {
        for (int r = 0; r < ranks_.size(); ++r) {
            if (r == ranks_.rank()) add();
            if (ranks_.size() > 1) pass_on(sums);
        }
        if (ranks_.size() > 1) ranks_.broadcast(sums);
    }
    /// Returns rows [from, from + count) of the periodic map from its bands; each rank may ask for
    /// other rows, or none. Collective.
    template <class T>
    std::vector<T> fetch(const std::vector<T>& band, int from, int count) const {
        constexpr std::size_t numbers = sizeof(T) / sizeof(double);
        std::vector<T> rows(static_cast<std::size_t>(count) * static_cast<std::size_t>(columns_));
        fetch({reinterpret_cast<const double*>(band.data()), numbers * band.size()},
              numbers * static_cast<std::size_t>(columns_), from, count,
              {reinterpret_cast<double*>(rows.data()), numbers * rows.size()});
        return rows;
    }
    /// Returns this rank's band of a map that the root holds whole; other ranks pass nothing.
    /// Collective.
    std::vector<double> spread(std::vector<double> whole) const;
    /// Transforms the waves or the values of a map in two dimensions in place, with FFTW's sign and
    /// no scaling. Collective. Throws std::runtime_error.
    void transform(std::vector<std::complex<double>>& band, int sign) const;

private:
    /// Returns where the part of a rank begins, of `all` lines.
    int share(int all, int rank) const {
        return static_cast<int>(static_cast<long long>(all) * rank / ranks_.size());
    }
    void pass_on(std::span<double> sums) const;
    void fetch(std::span<const double> band, std::size_t length, int from, int count,
               std::span<double> rows) const;
    void transpose(std::vector<std::complex<double>>& band,
                   std::vector<std::complex<double>>& strip, bool back) const;

    Communicator ranks_;
    int columns_;
    std::vector<int> first_; ///< first row of each rank, and the number of all rows
};

} // namespace asperity
