// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sums over the pairs of one site by a direct loop, for the reference sweep and for sites that no
// table covers.
#pragma once

#include "kernels/interface_sites.hpp"
#include "kernels/pair_potential.hpp"
#include "kernels/substrates.hpp"
#include "kernels/variant.hpp"

#include <cmath>

namespace asperity {

/// Pair potentials by the type of the substrate's atom.
struct PairTable {
    const PairPotential* of = nullptr; ///< [type]
    int types = 0;                     ///< number of types
    double cutoff = 0.0;               ///< largest cutoff, Å
    double closest = 0.0;              ///< largest closest() of the potentials, Å

    PairTable(const PairPotential* table, int count) : of(table), types(count) {
        for (int t = 0; t < count; ++t) {
            cutoff = max(cutoff_of(table[t]), cutoff);
            closest = max(closest_of(table[t]), closest);
        }
    }
    PairTable(const PairPotential& of_all) : PairTable(&of_all, 1) {}
};

/// Force and energy of one site from a direct loop over its pairs.
struct PairSum {
    double force[3] = {0.0, 0.0, 0.0}; ///< eV/Å
    double energy = 0.0;               ///< eV
    double nearest_r2 = no_pair;       ///< Å^2
    bool in_contact = false;           ///< closer than contact_distance() to an atom
};

/// Returns the sum over all substrate atoms (periodic images included) within the cutoff of a site
/// at (x, y, z), Å, row by row. Returns NaN if the position is not finite, or if a row is not held.
PairSum pair_sum(const SubstrateMap& map, const PairPotential& potential, double x, double y,
                 double z);
/// Returns the sum over all substrate atoms, in their order, each with the potential of its type.
PairSum pair_sum(const SubstrateAtoms& atoms, const PairTable& pairs, double x, double y, double z);

} // namespace asperity

namespace asperity::ASPERITY_VARIANT {

ASPERITY_HOST_DEVICE inline int fold(long i, int n) {
    const long r = i % n;
    return static_cast<int>(r < 0 ? r + n : r);
}

template <class P>
ASPERITY_INLINE void add_pair(const Pair<P>& pair, double dx, double dy, double dz, PairSum& sum) {
    const double r2 = dx * dx + dy * dy + dz * dz;
    if (r2 >= pair.cutoff * pair.cutoff) return;
    const double f = pair.force_over_distance(r2);
    sum.force[0] += f * dx;
    sum.force[1] += f * dy;
    sum.force[2] += f * dz;
    sum.energy += pair.energy(r2);
    if (r2 < sum.nearest_r2) sum.nearest_r2 = r2;
}

/// Computes pair_sum() over a map, for host and device.
template <class P>
ASPERITY_HOST_DEVICE inline PairSum sum_of_pairs(const SubstrateMap& map, const Pair<P>& pair,
                                                 double x, double y, double z) {
    PairSum sum;
    // Largest index of an atom that is formed; a site farther out has long left the model.
    constexpr double farthest_index = 1e9;
    const double b = map.spacing;
    const bool somewhere = std::fabs(x / b) < farthest_index && std::fabs(y / b) < farthest_index &&
                           std::fabs(z) <= 1e308;
    const auto lost = [] {
        const double nan = __builtin_nan("");
        return PairSum{{nan, nan, nan}, nan};
    };
    if (!somewhere) return lost();
    const double reach = pair.cutoff;
    const long j_first = static_cast<long>(std::floor((y - reach) / b));
    const long j_last = static_cast<long>(std::ceil((y + reach) / b));
    const long i_first = static_cast<long>(std::floor((x - reach) / b));
    const long i_last = static_cast<long>(std::ceil((x + reach) / b));
    for (long j = j_first; j <= j_last; ++j) {
        const double dy = y - static_cast<double>(j) * b;
        const int held = fold(j - map.first, map.sites);
        if (held >= map.rows) return lost();
        const double* row = map.height + static_cast<std::ptrdiff_t>(held) * map.sites;
        for (long i = i_first; i <= i_last; ++i) {
            const double dx = x - static_cast<double>(i) * b;
            add_pair(pair, dx, dy, z - row[fold(i, map.sites)], sum);
        }
    }
    return sum;
}

} // namespace asperity::ASPERITY_VARIANT
