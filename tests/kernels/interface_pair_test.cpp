// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The reference loop against numbers worked by hand: one atom, one site.
#include "kernels/interface_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace asperity {
namespace {

const LennardJones gold; // 100 meV, 3.28 Å, cutoff 13.12 Å
const double ground = 0.0;
const SubstrateMap lone_atom{&ground, 1, 1000.0, 0, 1};

TEST(InterfacePair, AtTheZeroCrossing) {
    // V(r0) - V(r_c): V(4 r0) = 0.4 (4^-12 - 4^-6) = -9.76324e-5 eV.
    const PairSum p = pair_sum(lone_atom, gold, 0.0, 0.0, 3.28);
    EXPECT_NEAR(p.energy, 9.763240814208984e-5, 1e-16);
    EXPECT_NEAR(p.force[2], 24.0 * 0.1 / 3.28, 1e-14); // 0.7317 eV/Å
    EXPECT_EQ(p.force[0], 0.0);
    EXPECT_NEAR(p.nearest_r2, 3.28 * 3.28, 1e-14);
}

TEST(InterfacePair, PointsAlongThePair) {
    // (2, 3, 6) has length 7: s6 = (3.28/7)^6, f = 2.4 s6 (2 s6 - 1) / 49 per Å.
    const PairSum p = pair_sum(lone_atom, gold, 2.0, -3.0, 6.0);
    const double s6 = 0.010584121634291012;
    const double f = 2.4 * s6 * (2.0 * s6 - 1.0) / 49.0;
    EXPECT_NEAR(p.force[0], 2.0 * f, 1e-12);
    EXPECT_NEAR(p.force[1], -3.0 * f, 1e-12);
    EXPECT_NEAR(p.force[2], 6.0 * f, 1e-12);
}

TEST(InterfacePair, EndsAtTheCutoff) {
    EXPECT_LT(pair_sum(lone_atom, gold, 0.0, 0.0, 13.1199).force[2], 0.0);
    const PairSum outside = pair_sum(lone_atom, gold, 0.0, 0.0, 13.1201);
    EXPECT_EQ(outside.force[2], 0.0);
    EXPECT_EQ(outside.energy, 0.0);
    EXPECT_EQ(outside.nearest_r2, no_pair);
    EXPECT_NEAR(pair_sum(lone_atom, gold, 0.0, 0.0, 13.12 - 1e-9).energy, 0.0, 1e-13);
}

TEST(InterfacePair, SeesPeriodicImages) {
    // A box of 20 Å with one atom at its corner: at (19, 1, 3) the nearest image is the one at (20,
    // 0).
    const SubstrateMap box{&ground, 1, 20.0, 0, 1};
    const PairSum p = pair_sum(box, gold, 19.0, 1.0, 3.0);
    EXPECT_NEAR(p.energy, Pair(gold).energy(11.0), 1e-15);
    EXPECT_NEAR(p.force[0], -Pair(gold).force_over_distance(11.0), 1e-14);
    EXPECT_NEAR(p.force[1], Pair(gold).force_over_distance(11.0), 1e-14);
    // Folding the site back changes nothing.
    const PairSum folded = pair_sum(box, gold, 19.0 - 60.0, 1.0 + 40.0, 3.0);
    EXPECT_NEAR(folded.force[2], p.force[2], 1e-13);
}

TEST(InterfacePair, HandsNotANumberOn) {
    for (double bad : {std::nan(""), HUGE_VAL, 1e300}) {
        EXPECT_TRUE(std::isnan(pair_sum(lone_atom, gold, bad, 0.0, 3.0).force[2]));
        EXPECT_TRUE(std::isnan(pair_sum(lone_atom, gold, 0.0, bad, 3.0).energy));
    }
    EXPECT_TRUE(std::isnan(pair_sum(lone_atom, gold, 0.0, 0.0, std::nan("")).force[2]));
}

TEST(InterfaceTail, IsTheForceOfThePlaneBeyondTheCutoff) {
    // Sum rings of the plane by the midpoint rule and compare.
    const Tail tail(gold, 1.0 / 6.76);
    for (double gap : {-2.0, 1.0, 3.11, 8.0, 12.0, 14.0, 25.0}) {
        double force = 0.0;
        const double from2 = std::max(0.0, 13.12 * 13.12 - gap * gap);
        // In w = 1/(rho^2 + gap^2) the far end is finite.
        const double w_far = 1.0 / (from2 + gap * gap);
        const int steps = 20000;
        for (int k = 0; k < steps; ++k) {
            const double r2 = steps / (w_far * (k + 0.5));
            const double s6 = std::pow(3.28 * 3.28 / r2, 3.0);
            const double f = 2.4 * s6 * (2.0 * s6 - 1.0) / r2 * gap;
            force += f * std::numbers::pi / 6.76 * r2 * r2 * w_far / steps;
        }
        EXPECT_NEAR(tail.force(gap), force, 1e-7 * std::abs(force)) << gap;
    }
}

TEST(InterfaceTail, ForceIsMinusTheGradient) {
    const Tail tail(gold, 0.15);
    for (double gap : {-3.0, 0.5, 3.0, 13.0, 13.3, 30.0}) {
        const double h = 1e-4;
        const double slope = (tail.energy(gap + h) - tail.energy(gap - h)) / (2.0 * h);
        EXPECT_NEAR(tail.force(gap), -slope, 1e-10) << gap;
    }
    EXPECT_NEAR(tail.force(13.12 - 1e-9), tail.force(13.12 + 1e-9), 1e-11);
    EXPECT_NEAR(tail.energy(13.12 - 1e-9), tail.energy(13.12 + 1e-9), 1e-11);
}

} // namespace
} // namespace asperity
