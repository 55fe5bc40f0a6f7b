// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// One site's sum over the substrate in the reference order, for host and device: the reference
// sweep, and the sites that no table covers.
#pragma once

#include "kernels/interface_sweep.hpp"
#include "kernels/variant.hpp"

#include <cmath>

namespace asperity::ASPERITY_VARIANT {

ASPERITY_HOST_DEVICE inline int fold(long i, int n) {
    const long r = i % n;
    return static_cast<int>(r < 0 ? r + n : r);
}

ASPERITY_HOST_DEVICE inline void add_pair(const LennardJones& potential, double dx, double dy,
                                          double dz, PairSum& sum) {
    const double r2 = dx * dx + dy * dy + dz * dz;
    if (r2 >= potential.r2_cut()) return;
    const double f = potential.force_over_distance(r2);
    sum.force[0] += f * dx;
    sum.force[1] += f * dy;
    sum.force[2] += f * dz;
    sum.energy += potential.energy(r2);
    if (r2 < sum.nearest_r2) sum.nearest_r2 = r2;
}

/// pair_sum() of interface_sweep.hpp.
ASPERITY_HOST_DEVICE inline PairSum
sum_of_pairs(const SubstrateMap& map, const LennardJones& potential, double x, double y, double z) {
    PairSum sum;
    // Farther out than this (in atoms) no index is formed; a site there has long left the model.
    constexpr double farthest_index = 1e9;
    const double b = map.spacing;
    const bool somewhere = std::fabs(x / b) < farthest_index && std::fabs(y / b) < farthest_index &&
                           std::fabs(z) <= 1e308;
    if (!somewhere) {
        const double nan = __builtin_nan("");
        sum.force[0] = sum.force[1] = sum.force[2] = sum.energy = nan;
        return sum;
    }
    const double reach = potential.cutoff;
    const long j_first = static_cast<long>(std::floor((y - reach) / b));
    const long j_last = static_cast<long>(std::ceil((y + reach) / b));
    const long i_first = static_cast<long>(std::floor((x - reach) / b));
    const long i_last = static_cast<long>(std::ceil((x + reach) / b));
    for (long j = j_first; j <= j_last; ++j) {
        const double dy = y - static_cast<double>(j) * b;
        const double* row =
            map.height + static_cast<std::ptrdiff_t>(fold(j, map.sites)) * map.sites;
        for (long i = i_first; i <= i_last; ++i) {
            const double dx = x - static_cast<double>(i) * b;
            add_pair(potential, dx, dy, z - row[fold(i, map.sites)], sum);
        }
    }
    return sum;
}

} // namespace asperity::ASPERITY_VARIANT
