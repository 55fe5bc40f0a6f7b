// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sums whose value does not depend on the order of their terms.
//
// Each term is split into two parts, each a multiple of a fixed quantum (2^-22 and 2^-50), by
// adding and subtracting a large constant (the splitting of Demmel and Nguyen, "Fast reproducible
// floating-point summation", ARITH 21, 2013, with the quanta fixed beforehand). Sums of multiples
// of one quantum are exact in double as long as they stay below 2^53 quanta, so they may be formed
// in any order, by any number of ranks and threads, and merged.
//
// Range: |term| <= 2^29, and every partial sum is below 2^31 (2e9); any number of terms. The error
// is below 2^-51 absolute (4e-16, in the unit of the term) for each term. Six flops a term, no
// branch; needs round-to-nearest and no re-association by the compiler (this project never sets
// -ffast-math).
//
// No operation rounds, for any number of terms:
// - The coarse bin holds multiples of 2^-22, and below 2^31 these are fewer than 2^53.
// - The fine part of a term is the rest after rounding to the coarse quantum: at most 2^-23, 2^27
// fine quanta. carry() leaves at most as much in the fine bin. After it, longest_run = 2^24 terms
// bring it to 2^24 2^27 + 2^27 fine quanta, less than 2^52.
// - merge() adds two such bins, below 2^53 fine quanta, and carries. So a sum is exact that is made
//   of runs of at most longest_run add()s between carries or merges, merged in any tree.
// - Bins of 2^26 sums behind a carry may be added without one (ranks of MPI, blocks of a device).
// - carry() moves a multiple of the coarse quantum from bin to bin, exactly. Which bin holds it
//   depends on the order, but the sum of both bins does not, and value() rounds that once.
#pragma once

#include "kernels/annotations.hpp"

namespace asperity {

/// Order-independent sum of values of type V: double, or a SIMD pack summing lane by lane.
template <class V>
struct BasicExactSum {
    static constexpr int bins = 2;
    /// Returns 1.5 * 2^(52 + exponent of the quantum). A function, because device code has no
    /// constant arrays.
    ASPERITY_HOST_DEVICE static constexpr double shifter(int k) { return k ? 0x1.8p2 : 0x1.8p30; }
    /// Largest number of add() calls between two calls of carry() or merge().
    static constexpr long long longest_run = 1LL << 24;

    V bin[bins] = {V(0.0), V(0.0)};

    /// Adds a term, |term| <= 2^29.
    ASPERITY_INLINE void add(V term) {
        for (int k = 0; k < bins; ++k) {
            const V part = (term + V(shifter(k))) - V(shifter(k));
            bin[k] = bin[k] + part;
            term = term - part;
        }
    }
    /// Moves whole coarse quanta from the fine bin to the coarse bin; value() does not change.
    ASPERITY_INLINE void carry() {
        const V whole = (bin[1] + V(shifter(0))) - V(shifter(0));
        bin[0] = bin[0] + whole;
        bin[1] = bin[1] - whole;
    }
    /// Adds another sum and carries.
    ASPERITY_INLINE void merge(const BasicExactSum& other) {
        for (int k = 0; k < bins; ++k)
            bin[k] = bin[k] + other.bin[k];
        carry();
    }
    /// Returns the sum, rounded once.
    ASPERITY_INLINE V value() const { return bin[1] + bin[0]; }
};

using ExactSum = BasicExactSum<double>;

} // namespace asperity
