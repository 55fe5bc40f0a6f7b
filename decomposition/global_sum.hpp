// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sums over all ranks, bitwise identical on any number of ranks: bins of exact sums are added,
// which rounds nothing, and rounded once at the end.
#pragma once

#include "decomposition/communicator.hpp"
#include "kernels/exact_sum.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

namespace detail {

/// Sets values to the sums of `mine` over the ranks. bins: workspace for the bins of all sums.
inline void global_sums(const Communicator& ranks, std::span<const ExactSum> mine,
                        std::span<double> bins, std::span<double> values) {
    for (std::size_t i = 0; i < mine.size(); ++i) {
        ExactSum sum = mine[i];
        sum.carry();
        std::copy_n(sum.bin, ExactSum::bins, &bins[ExactSum::bins * i]);
    }
    ranks.sum(bins);
    for (std::size_t i = 0; i < mine.size(); ++i) {
        ExactSum sum;
        std::copy_n(&bins[ExactSum::bins * i], ExactSum::bins, sum.bin);
        values[i] = sum.value();
    }
}

} // namespace detail

/// Returns the sums over all ranks with one reduction. Collective.
template <std::size_t n>
std::array<double, n> global_sums(const Communicator& ranks, const std::array<ExactSum, n>& mine) {
    std::array<double, ExactSum::bins * n> bins;
    std::array<double, n> values;
    detail::global_sums(ranks, mine, bins, values);
    return values;
}

/// Returns the sums over all ranks with one reduction, for a number of sums known at run time.
/// Collective.
inline std::vector<double> global_sums(const Communicator& ranks,
                                       const std::vector<ExactSum>& mine) {
    std::vector<double> bins(ExactSum::bins * mine.size()), values(mine.size());
    detail::global_sums(ranks, mine, bins, values);
    return values;
}

/// Returns the sum over all ranks. Collective.
inline double global_sum(const Communicator& ranks, const ExactSum& mine) {
    return global_sums(ranks, std::array{mine})[0];
}

} // namespace asperity
