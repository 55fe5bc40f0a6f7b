// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sums whose value does not depend on the order of their terms.
//
// Each term is split into two parts, each a multiple of a fixed quantum (2^-22 and 2^-50), by
// adding and subtracting a large constant (the splitting of Demmel and Nguyen, "Fast reproducible
// floating-point summation", ARITH 21, 2013, with the quanta fixed beforehand). Sums of multiples
// of one quantum are exact in double as long as they stay below 2^53 quanta, so they may be formed
// in any order, by any number of ranks and threads, and merged by plain addition.
//
// Range: |term| <= 2^29, |sum| < 2^31 (2e9), at most 2^26 terms. What is left out is below 2^-51
// absolute (4e-16, in the unit of the term) for each term. Six flops a term, no branch; needs
// round-to-nearest and no re-association by the compiler (this project never sets -ffast-math).
#pragma once

#include "kernels/annotations.hpp"

namespace asperity {

/// Order-independent sum of values of type V: double, or a SIMD pack summing lane by lane.
template <class V>
struct BasicExactSum {
    static constexpr int bins = 2;
    /// 1.5 * 2^(52 + exponent of the quantum). A function, for device code has no constant arrays.
    ASPERITY_HOST_DEVICE static constexpr double shifter(int k) { return k ? 0x1.8p2 : 0x1.8p30; }

    V bin[bins] = {V(0.0), V(0.0)};

    ASPERITY_INLINE void add(V term) {
        for (int k = 0; k < bins; ++k) {
            const V part = (term + V(shifter(k))) - V(shifter(k));
            bin[k] = bin[k] + part;
            term = term - part;
        }
    }
    template <class Other>
    ASPERITY_INLINE void merge(const BasicExactSum<Other>& other) {
        for (int k = 0; k < bins; ++k)
            bin[k] = bin[k] + other.bin[k];
    }
    /// The sum, rounded once where the bins meet.
    ASPERITY_INLINE V value() const { return bin[1] + bin[0]; }
};

using ExactSum = BasicExactSum<double>;

} // namespace asperity
