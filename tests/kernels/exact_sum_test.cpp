// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Sums that do not know the order of their terms: on which "the same bits on any number of ranks"
// rests.
#include "kernels/exact_sum.hpp"
#include "kernels/kick.hpp"
#include "kernels/lane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using namespace asperity;

namespace {

/// Terms over twenty decades, both signs.
std::vector<double> many_terms(std::size_t count, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0), exponent(-40.0, 24.0);
    std::vector<double> terms(count);
    for (double& t : terms)
        t = mantissa(random) * std::exp2(exponent(random));
    return terms;
}

double sum_of(const std::vector<double>& terms) {
    ExactSum sum;
    for (double t : terms)
        sum.add(t);
    return sum.value();
}

} // namespace

TEST(ExactSum, EveryOrderAndEveryGroupingGivesTheSameBits) {
    auto terms = many_terms(20000, 1);
    const auto expected = std::bit_cast<std::uint64_t>(sum_of(terms));
    std::mt19937_64 random(2);
    double plain_least = 1e300, plain_most = -1e300;
    for (int round = 0; round < 20; ++round) {
        std::shuffle(terms.begin(), terms.end(), random);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(sum_of(terms)), expected);
        double plain = 0.0;
        for (double t : terms)
            plain += t;
        plain_least = std::min(plain_least, plain), plain_most = std::max(plain_most, plain);
        // As ranks and threads would have it: parts of uneven length, merged.
        ExactSum whole;
        for (std::size_t at = 0; at < terms.size();) {
            const std::size_t end = std::min(terms.size(), at + 1 + random() % 5000);
            ExactSum part;
            for (; at < end; ++at)
                part.add(terms[at]);
            whole.merge(part);
        }
        EXPECT_EQ(std::bit_cast<std::uint64_t>(whole.value()), expected);
    }
    EXPECT_LT(plain_least, plain_most) << "terms too tame: a plain sum would have passed";
}

TEST(ExactSum, IsTheSumUpToTheStatedQuantum) {
    // Against a sum in 128-bit integers of 2^-80: the terms' own bits, no rounding.
    for (unsigned seed : {3u, 4u, 5u}) {
        auto terms = many_terms(5000, seed);
        for (double& t : terms)
            t = std::ldexp(std::round(std::ldexp(t, 80 - 12)), 12 - 80);
        __extension__ typedef __int128 Wide;
        Wide exact = 0;
        for (double t : terms) {
            int e = 0;
            const double m = std::frexp(t, &e);
            const auto digits = static_cast<Wide>(std::ldexp(m, 53));
            const int shift = e - 53 + 80;
            exact += shift >= 0 ? digits * (static_cast<Wide>(1) << shift) : digits >> -shift;
        }
        const long double expected = std::ldexp(static_cast<long double>(exact), -80);
        // Left out: 2^-51 a term; and the last rounding to a double.
        const double allowed = 5000 * 0x1p-51 + std::abs(static_cast<double>(expected)) * 0x1p-52;
        EXPECT_NEAR(static_cast<double>(static_cast<long double>(sum_of(terms)) - expected), 0.0,
                    allowed);
    }
}

TEST(ExactSum, HoldsTheRangeItPromises) {
    // The largest terms, with a small one that must not be lost beneath them.
    ExactSum sum;
    for (int i = 0; i < 3; ++i)
        sum.add(0x1p29 - 0.75);
    sum.add(0x1p-50);
    EXPECT_EQ(sum.value(), 3 * (0x1p29 - 0.75));
    for (int i = 0; i < 3; ++i)
        sum.add(-(0x1p29 - 0.75));
    EXPECT_EQ(sum.value(), 0x1p-50);
}

namespace {

/// 2^doublings equal terms, by merging.
ExactSum many_equal(double term, int doublings) {
    ExactSum sum;
    sum.add(term);
    for (int i = 0; i < doublings; ++i) {
        const ExactSum half = sum;
        sum.merge(half);
    }
    return sum;
}

ExactSum sum_of_sums(const std::vector<ExactSum>& parts) {
    ExactSum sum;
    for (const ExactSum& part : parts)
        sum.merge(part);
    return sum;
}

} // namespace

TEST(ExactSum, HoldsForATrillionTerms) {
    // The worst there is for the fine bin: all of a term, the last quantum too, is left to it. A
    // bin without carries is full after 2^26 of them, and forgets the next last quantum.
    // The other term has 53 bits, of which the bins keep all.
    const double worst = 0x1p-23 - 0x1p-50, longest = 0x1.fffffffffffffp2 + 0x1p-50;
    for (const auto& [term, doublings] : {std::pair{worst, 25},
                                          {worst, 26},
                                          {worst, 27},
                                          {worst, 30},
                                          {worst, 40},
                                          {longest, 26}}) {
        ExactSum sum = many_equal(term, doublings);
        EXPECT_EQ(sum.value(), std::ldexp(term, doublings)) << doublings;
        sum.add(0x1p-50);
        sum.merge(many_equal(-term, doublings));
        EXPECT_EQ(sum.value(), 0x1p-50) << doublings;
    }
    // 2^40 terms of several kinds in any order and grouping: the same bits.
    std::mt19937_64 random(7);
    std::vector<ExactSum> parts;
    for (const double term : {worst, 0x1.23456789abcdep-24, -0x1.fedcba9876543p-23, 0x1.8p-14,
                              -0x1.fffffffffffffp-13, 0x1p-50})
        for (const int doublings : {39, 33, 28, 27, 20, 3, 0})
            parts.push_back(many_equal(term, doublings));
    const auto expected = std::bit_cast<std::uint64_t>(sum_of_sums(parts).value());
    for (int round = 0; round < 50; ++round) {
        std::shuffle(parts.begin(), parts.end(), random);
        const auto cut = static_cast<std::ptrdiff_t>(random() % parts.size());
        ExactSum sum = sum_of_sums({parts.begin(), parts.begin() + cut});
        sum.merge(sum_of_sums({parts.begin() + cut, parts.end()}));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(sum.value()), expected);
    }
}

TEST(ExactSum, TheLongestRunIsExact) {
    // One by one, without a carry, behind a carry that left all it can; and two of them merged.
    const double worst = 0x1p-23 - 0x1p-50;
    ExactSum run;
    run.add(worst);
    run.carry();
    for (long long i = 0; i < ExactSum::longest_run; ++i)
        run.add(worst);
    EXPECT_EQ(run.value(), (0x1p24 + 1) * worst);
    ExactSum both = run;
    both.merge(run);
    both.add(0x1p-50);
    both.merge(many_equal(-worst, 25));
    both.add(-worst);
    both.add(-worst);
    EXPECT_EQ(both.value(), 0x1p-50);
}

TEST(ExactSum, ACarryChangesNoValue) {
    for (double term : many_terms(2000, 8)) {
        term *= 0x1p-24; // of the size of fine bins
        ExactSum sum;
        for (int i = 0; i < 100; ++i)
            sum.add(term);
        const double before = sum.value();
        sum.carry();
        EXPECT_EQ(sum.value(), before);
        EXPECT_LE(std::abs(sum.bin[1]), 0x1p-23);
    }
}

TEST(ExactSum, ProductsMayComeInAnyOrderToo) {
    // Terms halfway between two coarse quanta and between two fine ones among them: where a bin
    // that holds something decides which way they go.
    using Number = ASPERITY_VARIANT::Lane<double>;
    std::mt19937_64 random(9);
    std::vector<std::pair<double, double>> factors;
    const auto whole = [&](int bits) {
        return static_cast<double>(random() % (1ULL << bits)) - std::ldexp(0.5, bits);
    };
    for (int i = 0; i < 3000; ++i) {
        factors.push_back({whole(20) + 0.5, 0x1p-22});
        factors.push_back({whole(30) + 0.5, 0x1p-50});
        factors.push_back({whole(53) * 0x1p-53, whole(26) * 0x1p-26});
    }
    ExactSum first;
    for (int round = 0; round < 30; ++round) {
        ASPERITY_VARIANT::ProductSum<Number> lane;
        for (std::size_t i = 0; i < factors.size(); ++i) {
            lane.add(factors[i].first, factors[i].second);
            if (random() % 1000 == 0) lane.close();
        }
        lane.close();
        ExactSum sum;
        ASPERITY_VARIANT::collect(lane.sum(), sum);
        if (round == 0) first = sum;
        // To the last quantum, which the sum's value no longer shows.
        sum.merge({{-first.bin[0], -first.bin[1]}});
        EXPECT_EQ(sum.value(), 0.0);
        std::shuffle(factors.begin(), factors.end(), random);
    }
    ExactSum apart; // term by term
    for (const auto& [a, b] : factors)
        apart.add(a * b);
    apart.merge({{-first.bin[0], -first.bin[1]}});
    EXPECT_NEAR(apart.value(), 0.0, 2 * 9000 * 0x1p-51);
}
