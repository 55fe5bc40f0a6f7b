// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Persson's theory with a cap on the pressure: limits, and the walk of which it is the solution.
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "theory/capped_pressure.hpp"
#include "theory/error.hpp"

namespace asperity::theory {
namespace {

/// A hardness that is not reached leaves the elastic contact, erf(P/√(2V)).
TEST(CappedPressure, IsElasticFarBelowTheHardness) {
    for (const double p : {1e-4, 0.01, 0.3, 2.0})
        for (const double hardness : {20.0, 1e6}) {
            const CappedContact c = capped_contact(p, hardness, 1.0);
            EXPECT_NEAR(c.area(), std::erf(p / std::numbers::sqrt2), 1e-12);
            EXPECT_NEAR(c.yielding, 0.0, 1e-12);
        }
}

/// Under roughness without an end each point of the contact is at the hardness: the area is P/H.
TEST(CappedPressure, IsFullyPlasticOnSteepRoughness) {
    for (const double p : {0.01, 0.5, 0.99}) {
        const CappedContact c = capped_contact(p, 1.0, 20.0);
        EXPECT_NEAR(c.area(), p, 1e-12);
        EXPECT_NEAR(c.elastic, 0.0, 1e-12);
    }
    const CappedContact smooth = capped_contact(0.4, 1.0, 0.0);
    EXPECT_EQ(smooth.area(), 1.0);
    EXPECT_EQ(smooth.yielding, 0.0);
    EXPECT_EQ(capped_contact(0.0, 1.0, 0.0).area(), 0.0);
}

/// A random walk between two ends that hold what reaches them. No step changes the mean pressure.
TEST(CappedPressure, IsAWalkBetweenTwoEnds) {
    constexpr int n = 200; // steps of 1/n
    for (const double p : {0.1, 0.5, 0.85})
        for (const double variance : {0.002, 0.02, 0.1, 0.2, 0.3, 0.6}) {
            std::vector<double> at(n + 1, 0.0), next;
            at[static_cast<std::size_t>(std::lround(p * n))] = 1.0;
            const long steps = std::lround(variance * n * n * 1.5); // each of a variance 2/(3 n²)
            for (long k = 0; k < steps; ++k) {
                next.assign(n + 1, 0.0);
                next[0] = at[0], next[n] = at[n];
                for (std::size_t i = 1; i < n; ++i)
                    for (const std::size_t to : {i - 1, i, i + 1})
                        next[to] += at[i] / 3.0;
                at.swap(next);
            }
            const CappedContact c = capped_contact(p, 1.0, variance);
            EXPECT_NEAR(c.yielding, at[n], 2e-4) << p << " " << variance;
            EXPECT_NEAR(1.0 - c.area(), at[0], 2e-4) << p << " " << variance;
            double mean = 0.0, elastic = 0.0;
            for (std::size_t i = 1; i < n; ++i)
                mean += at[i] * static_cast<double>(i) / n, elastic += at[i];
            EXPECT_NEAR(mean + c.yielding, p, 2e-4) << p << " " << variance;
            EXPECT_NEAR(c.elastic, elastic, 4e-4) << p << " " << variance;
        }
}

/// Images and series are one function where one takes over from the other.
TEST(CappedPressure, BothSumsMeet) {
    for (const double p : {1e-6, 0.2, 0.7, 0.999}) {
        const CappedContact images = capped_contact(p, 1.0, 0.25 * (1 - 1e-14)),
                            series = capped_contact(p, 1.0, 0.25);
        EXPECT_NEAR(images.yielding, series.yielding, 1e-13);
        EXPECT_NEAR(images.elastic, series.elastic, 1e-13);
    }
}

/// Numbers that were computed by other means for an rms slope of 0.08.
TEST(CappedPressure, IsThatOfAnotherSeries) {
    struct Row {
        double hardness, part, area, yielding; ///< hardness over E*, pressure over hardness
    };
    for (const Row& row : {Row{0.02, 0.5, 0.5, 0.5}, Row{0.05, 0.1, 0.1084, 0.0916},
                           Row{0.05, 0.5, 0.5271, 0.4729}, Row{0.1, 0.3, 0.5468, 0.0790},
                           Row{0.1, 0.7, 0.9210, 0.4532}, Row{0.1, 0.99, 0.9982, 0.9801}}) {
        const CappedContact c = capped_contact(row.part * row.hardness, row.hardness, 0.0016);
        EXPECT_NEAR(c.area(), row.area, 6e-5);
        EXPECT_NEAR(c.yielding, row.yielding, 6e-5);
    }
}

TEST(CappedPressure, RefusesWhatIsNoContact) {
    for (const auto& [p, hardness, variance] : {std::tuple{1.0, 1.0, 0.1},
                                                {-0.1, 1.0, 0.1},
                                                {0.1, 0.0, 0.1},
                                                {0.1, 1.0, -0.1},
                                                {std::nan(""), 1.0, 0.1}})
        EXPECT_THROW((void)capped_contact(p, hardness, variance), InvalidInput);
}

} // namespace
} // namespace asperity::theory
