// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sums over all ranks whose value is the same bits whatever the number of ranks: bins of exact sums
// are added, which rounds nothing, and rounded once at the end.
#pragma once

#include "decomposition/communicator.hpp"
#include "kernels/exact_sum.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace asperity {

/// Collective: one reduction for all of them.
template <std::size_t n>
std::array<double, n> global_sums(const Communicator& ranks, const std::array<ExactSum, n>& mine) {
    constexpr std::size_t bins = ExactSum::bins;
    std::array<double, bins * n> all;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < bins; ++k)
            all[bins * i + k] = mine[i].bin[k];
    ranks.sum(all);
    std::array<double, n> values;
    for (std::size_t i = 0; i < n; ++i) {
        ExactSum sum;
        for (std::size_t k = 0; k < bins; ++k)
            sum.bin[k] = all[bins * i + k];
        values[i] = sum.value();
    }
    return values;
}

/// The same for a number of sums known only when run.
inline std::vector<double> global_sums(const Communicator& ranks,
                                       const std::vector<ExactSum>& mine) {
    constexpr std::size_t bins = ExactSum::bins;
    std::vector<double> all;
    for (const ExactSum& sum : mine)
        all.insert(all.end(), sum.bin, sum.bin + bins);
    ranks.sum(all);
    std::vector<double> values;
    for (std::size_t i = 0; i < mine.size(); ++i) {
        ExactSum sum;
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(bins * i), bins, sum.bin);
        values.push_back(sum.value());
    }
    return values;
}

inline double global_sum(const Communicator& ranks, const ExactSum& mine) {
    return global_sums(ranks, std::array{mine})[0];
}

} // namespace asperity
