// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sums whose value does not depend on the order of their terms.
//
// Each term is split into three parts, each a multiple of a fixed quantum (2^q0 > 2^q1 > 2^q2), by
// adding and subtracting a large constant (the splitting of Demmel and Nguyen, "Fast reproducible
// floating-point summation", ARITH 21, 2013, with the quanta fixed beforehand). Sums of multiples of
// one quantum are exact in double as long as they stay below 2^53 quanta, so they may be formed in
// any order, by any number of ranks and threads, and merged by plain addition.
//
// Range: |term| <= 2^32, at most 2^26 terms. What is left out is below 2^-52 absolute (units of
// the term) for each term. Nine flops a term, no branch; needs round-to-nearest and no re-association by
// the compiler (this project never sets -ffast-math).
#pragma once

#include "kernels/annotations.hpp"

namespace asperity {

/// The splitting constants: 1.5 * 2^(52 + quantum exponent).
struct ExactSumQuanta {
    static constexpr int exponent[3] = {5, -23, -51};
    static constexpr double shifter[3] = {0x1.8p57, 0x1.8p29, 0x1.8p1};
};

/// Order-independent sum of values of type V: double, or a SIMD pack summing lane by lane.
template <class V> struct BasicExactSum {
    V bin[3] = {V(0.0), V(0.0), V(0.0)};

    ASPERITY_INLINE void add(V term) {
        for (int k = 0; k < 3; ++k) {
            const V shifter(ExactSumQuanta::shifter[k]);
            const V part = (term + shifter) - shifter;
            bin[k] = bin[k] + part;
            term = term - part;
        }
    }
    ASPERITY_INLINE void merge(const BasicExactSum& other) {
        for (int k = 0; k < 3; ++k) bin[k] = bin[k] + other.bin[k];
    }
    /// The sum, rounded once the bins have met.
    ASPERITY_INLINE V value() const { return (bin[2] + bin[1]) + bin[0]; }
};

using ExactSum = BasicExactSum<double>;

} // namespace asperity
