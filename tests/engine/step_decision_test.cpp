// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What becomes of a step of a quasi-static path, without a path: trails, energies and limits made
// by hand. A spring of stiffness 2 is led from 0; its force is 2 x and its energy x^2.
#include "engine/statics/step_decision.hpp"

#include <gtest/gtest.h>

namespace {

using namespace asperity;

constexpr double stiffness = 2.0;

/// The force that leading it takes is minus its own.
PathPoint spring(double x) { return {x, -stiffness * x, 0.5 * stiffness * x * x}; }

ForceTrail trail_to(double x) {
    ForceTrail trail;
    trail.begin(x - 0.2, spring(x - 0.2).force);
    trail.add(x - 0.1, spring(x - 0.1).force);
    trail.add(x, spring(x).force);
    return trail;
}

/// Beyond an instability in which this much of the energy is lost and the force falls by so much.
PathPoint after_jump(double x, double lost, double fall) {
    PathPoint p = spring(x);
    p.energy -= lost;
    p.force += fall;
    return p;
}

constexpr StepLimits limits{.missing = 1e-6, .uncertain = 1e-3};

TEST(StepDecision, NothingIsMissingOfASpring) {
    const StepDecision d = decide(spring(1.0), spring(1.1), trail_to(1.0), limits);
    EXPECT_EQ(d.verdict, StepDecision::accept);
    EXPECT_NEAR(d.work, 0.21, 1e-12);
    EXPECT_NEAR(d.gap, 0.0, 1e-12);
    EXPECT_EQ(d.dissipated, 0.0);
    EXPECT_TRUE(d.smooth);
    EXPECT_EQ(d.growth, 2.0); // as much as a step may grow
}

TEST(StepDecision, EnergyThatIsMissingWhereTheForceIsSmoothWasDissipated) {
    const StepDecision d = decide(spring(1.0), after_jump(1.1, 1e-4, 0.0), trail_to(1.0), limits);
    EXPECT_EQ(d.verdict, StepDecision::jump);
    EXPECT_TRUE(d.smooth);
    EXPECT_NEAR(d.dissipated, 1e-4, 1e-12);
    EXPECT_NEAR(d.gap, 0.0, 1e-12);
}

/// After an instability the branch is followed for a while, until the next one takes the force back
/// to where it was: no force that stays the same.
TEST(StepDecision, ASecondInstabilityDoesNotHideBehindTheFirst) {
    ForceTrail trail = trail_to(1.0);
    trail.begin(1.0, spring(1.0).force);
    const double step = 0.1, fall = stiffness * step; // as much as the force has grown
    for (const double lost : {0.5 * step * fall, 0.5}) {
        const PathPoint next = after_jump(1.0 + step, lost, fall);
        EXPECT_DOUBLE_EQ(next.force, spring(1.0).force);
        const StepDecision d = decide(spring(1.0), next, trail, limits);
        EXPECT_EQ(d.verdict, StepDecision::halve) << lost;
    }
    // Without an instability the step is taken.
    EXPECT_EQ(decide(spring(1.0), spring(1.0 + step), trail, limits).verdict, StepDecision::accept);
}

/// Half of the step times the fall is what the work is not known by.
TEST(StepDecision, AJumpOfTheForceIsHalvedUntilItsWorkIsKnown) {
    const double lost = 0.05, fall = 0.5;
    for (const double step : {0.1, 0.01, 0.005}) {
        const StepDecision d =
            decide(spring(1.0), after_jump(1.0 + step, lost, fall), trail_to(1.0), limits);
        EXPECT_FALSE(d.smooth);
        EXPECT_EQ(d.verdict, StepDecision::halve) << step;
        EXPECT_EQ(d.growth, 0.5);
    }
    const double step = 0.003;
    const StepDecision d =
        decide(spring(1.0), after_jump(1.0 + step, lost, fall), trail_to(1.0), limits);
    EXPECT_EQ(d.verdict, StepDecision::jump);
    EXPECT_NEAR(d.uncertain, 0.5 * step * fall, 1e-12);
    EXPECT_NEAR(d.dissipated, lost, 0.5 * step * fall + 1e-12);
}

TEST(StepDecision, EnergyThatTheWorkCannotHaveBroughtIsNoStep) {
    const PathPoint more = after_jump(1.1, -1e-3, 0.0);
    const StepDecision d = decide(spring(1.0), more, trail_to(1.0), limits);
    EXPECT_EQ(d.verdict, StepDecision::halve);
    EXPECT_TRUE(d.excess);
    EXPECT_EQ(d.dissipated, 0.0);
    StepLimits last = limits;
    last.last_try = true;
    const StepDecision end = decide(spring(1.0), more, trail_to(1.0), last);
    EXPECT_EQ(end.verdict, StepDecision::accept);
    EXPECT_NEAR(end.gap, -1e-3, 1e-12); // which is counted as an error
}

TEST(StepDecision, TheShortestStepIsAcceptedAsItIs) {
    StepLimits last = limits;
    last.last_try = true;
    const StepDecision d = decide(spring(1.0), after_jump(1.1, 0.1, 0.5), trail_to(1.0), last);
    EXPECT_EQ(d.verdict, StepDecision::jump);
    EXPECT_NEAR(d.work - (after_jump(1.1, 0.1, 0.5).energy - 1.0) - d.dissipated, d.gap, 1e-12);
}

} // namespace
