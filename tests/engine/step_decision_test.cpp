// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// What becomes of a step of a quasi-static path, without a path: trails, energies and limits made
// by hand. A spring of stiffness 2 is led from 0; its force is 2 x and its energy x^2.
#include "engine/statics/load_aim.hpp"
#include "engine/statics/step_decision.hpp"
#include "engine/statics/work_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

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
    EXPECT_NEAR(d.lost, 0.0, 1e-12);
    EXPECT_TRUE(d.smooth);
    EXPECT_EQ(d.growth, 2.0); // as much as a step may grow
}

TEST(StepDecision, EnergyThatIsMissingWhereTheForceIsSmoothWasDissipated) {
    const StepDecision d = decide(spring(1.0), after_jump(1.1, 1e-4, 0.0), trail_to(1.0), limits);
    EXPECT_EQ(d.verdict, StepDecision::jump);
    EXPECT_TRUE(d.smooth);
    EXPECT_NEAR(d.lost, 1e-4, 1e-12);
    EXPECT_LT(d.sigma, 1e-6);
}

/// A patch that is small beside the box loses less than a step may miss: no instability, and lost.
TEST(StepDecision, WhatASmallPatchLosesIsLost) {
    for (const double lost : {1e-7, -1e-7}) { // below zero: an error of the work
        const StepDecision d =
            decide(spring(1.0), after_jump(1.1, lost, 0.0), trail_to(1.0), limits);
        EXPECT_EQ(d.verdict, StepDecision::accept);
        EXPECT_NEAR(d.lost, lost, 1e-12);
        EXPECT_NEAR(d.work, after_jump(1.1, lost, 0.0).energy - spring(1.0).energy + d.lost, 1e-12);
    }
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
    EXPECT_NEAR(d.lost, lost, 0.5 * step * fall + 1e-12);
}

TEST(StepDecision, EnergyThatTheWorkCannotHaveBroughtIsNoStep) {
    const PathPoint more = after_jump(1.1, -1e-3, 0.0);
    const StepDecision d = decide(spring(1.0), more, trail_to(1.0), limits);
    EXPECT_EQ(d.verdict, StepDecision::halve);
    EXPECT_TRUE(d.excess);
    StepLimits last = limits;
    last.last_try = true;
    const StepDecision end = decide(spring(1.0), more, trail_to(1.0), last);
    EXPECT_EQ(end.verdict, StepDecision::accept);
    EXPECT_NEAR(end.lost, -1e-3, 1e-12); // which is counted as an error
}

TEST(StepDecision, TheShortestStepIsAcceptedAsItIs) {
    StepLimits last = limits;
    last.last_try = true;
    const StepDecision d = decide(spring(1.0), after_jump(1.1, 0.1, 0.5), trail_to(1.0), last);
    EXPECT_EQ(d.verdict, StepDecision::jump);
    EXPECT_NEAR(d.work - (after_jump(1.1, 0.1, 0.5).energy - 1.0), d.lost, 1e-12);
}

} // namespace

/// Where nothing can be dissipated, the work is what the energy gains, however coarse the step.
TEST(StepDecision, AReversibleStepIsTakenWhateverItsLength) {
    const StepDecision d = reversible_step(spring(1.0), spring(3.0), 1e-9);
    EXPECT_EQ(d.verdict, StepDecision::accept);
    EXPECT_DOUBLE_EQ(d.work, 8.0);
    EXPECT_EQ(d.lost, 0.0);
    EXPECT_EQ(d.gap, 1e-9);
}

namespace {

/// Returns the steps, those that go too far among them, in which a force that grows inwards is
/// brought to each of some loads, to 1e-5 of it.
int steps_to(const std::vector<double>& loads, const std::function<double(double)>& force,
             bool smooth) {
    int tries = 0;
    double length = 0.25;
    ForceTrail trail;
    trail.begin(0.0, force(0.0));
    for (const double load : loads) {
        LoadAim aim;
        for (bool there = false; !there && tries < 1000;) {
            const double from = trail.last().x;
            length = aim.cut(length, -1.0, trail, load, smooth);
            const double x = from - length, f = force(x);
            aim.count();
            ++tries;
            if (f > load * (1.0 + 1e-5)) {
                aim.pass({x, f}, from);
                continue;
            }
            there = aim.take_was_cut() && f >= load * (1.0 - 1e-5);
            trail.add(x, f);
            length = there ? std::max(length, aim.uncut()) : std::min(0.25, 2.0 * length);
        }
        EXPECT_NEAR(trail.last().f, load, 1e-5 * load);
    }
    return tries;
}

} // namespace

/// Between loads of four decades there are 33 steps of the largest length; each load takes two
/// more.
TEST(LoadAim, MeetsLoadsInFewSteps) {
    const auto force = [](double x) { return 0.01 * std::exp(-x / 0.9); };
    for (const bool smooth : {false, true})
        EXPECT_LE(steps_to({0.1, 1.0, 10.0, 100.0}, force, smooth), 45) << smooth;
    // A force that is no exponential, and one that jumps across the load.
    const auto hertz = [](double x) { return x < 0.0 ? std::pow(-x, 1.5) : 0.0; };
    EXPECT_LE(steps_to({0.5, 1.0}, hertz, true), 12);
    LoadAim aim;
    ForceTrail trail;
    trail.begin(0.0, 0.0);
    trail.add(-0.1, 0.1);
    aim.pass({-0.35, 2.0}, -0.1);
    double beyond = -0.35;
    int tries = 0;
    for (; std::abs(beyond - trail.last().x) > 1e-9 && tries < 200; ++tries) {
        const double x = trail.last().x - aim.cut(0.25, -1.0, trail, 1.0, false);
        aim.count();
        if (x < -0.25)
            aim.pass({beyond = x, 2.0 - x}, trail.last().x);
        else
            trail.add(x, -x);
    }
    EXPECT_LT(tries, 160);
}

/// From the second instability on, what another within the step may take along counts; the less,
/// the shorter the step.
TEST(WorkErrors, CountWhatAnInstabilityMayTakeAlong) {
    const auto total = [](double step) {
        WorkErrors errors;
        for (int i = 0; i < 5; ++i) {
            errors.add_bracketed(1e-4);
            errors.add_instability(0.5 * i, step, 2.0);
        }
        return errors.total();
    };
    WorkErrors one;
    one.add_gap(-1e-3);
    one.add_bracketed(3e-4);
    one.add_instability(3.0, 0.01, 2.0);
    EXPECT_NEAR(one.total(), 1e-3 + 3e-4, 1e-12);
    // One every 0.5 Å before the fifth, counted from the first: p = 0.01 i / (0.5 i).
    EXPECT_NEAR(total(0.01), std::sqrt(5 * 1e-8 + 4 * (0.01 / 0.5) * 4.0 / 3.0), 1e-9);
    EXPECT_LT(total(1e-4), 0.15 * total(0.01));
}

/// Patches that lose energy at random places of the steps: the sum of the missing energies is off
/// by as many standard errors as a normal number is, whatever their number.
TEST(WorkErrors, OfManySmallPatchesAreStandardErrors) {
    const double step = 0.1, fall = 1e-4, loss = 3e-4;
    std::mt19937 draw(7);
    std::uniform_real_distribution<double> within(0.0, 1.0);
    for (const int patches : {10, 100, 1000}) {
        double squares = 0.0, mean = 0.0;
        constexpr int paths = 400;
        for (int path = 0; path < paths; ++path) {
            // Each patch that jumps takes `fall` off the force of a spring, and `loss` off its
            // energy, for good.
            std::vector<double> jumps;
            for (int i = 0; i < patches; ++i)
                jumps.push_back(0.5 + 9.0 * within(draw));
            const auto at = [&](double x) {
                PathPoint p = spring(x);
                for (const double jump : jumps)
                    if (x > jump) {
                        p.force += fall;
                        p.energy -= loss + fall * (x - jump);
                    }
                return p;
            };
            WorkErrors errors;
            ForceTrail trail = trail_to(0.0);
            PathPoint last = at(0.0);
            double lost = 0.0;
            for (int i = 1; i <= 100; ++i) {
                const PathPoint next = at(step * i);
                const StepDecision d =
                    decide(last, next, trail, {.missing = 1.0, .uncertain = 1.0});
                ASSERT_EQ(d.verdict, StepDecision::accept);
                lost += d.lost;
                errors.add_smooth(d.sigma, d.lost);
                trail.add(next.at, next.force);
                last = next;
            }
            const double off = (lost - patches * loss) / errors.total();
            mean += off / paths;
            squares += off * off / paths;
        }
        EXPECT_NEAR(mean, 0.0, 0.15) << patches;
        EXPECT_GT(squares, 0.5) << patches;
        EXPECT_LT(squares, 1.2) << patches;
    }
}

/// Without patches the error is no larger than what the steps miss, and covers it.
TEST(WorkErrors, OfASmoothForceAreWhatItsStepsMiss) {
    const auto wave = [](double x) { return PathPoint{x, std::sin(x), std::cos(x)}; };
    WorkErrors errors;
    ForceTrail trail;
    trail.begin(-0.4, wave(-0.4).force);
    trail.add(-0.2, wave(-0.2).force);
    trail.add(0.0, wave(0.0).force);
    double missing = 0.0, largest = 0.0;
    for (int i = 0; i < 40; ++i) {
        const PathPoint last = wave(0.2 * i), next = wave(0.2 * (i + 1));
        const StepDecision d = decide(last, next, trail, {.missing = 1.0, .uncertain = 1.0});
        errors.add_smooth(d.sigma, d.lost);
        missing += d.lost;
        largest += std::abs(d.lost);
        trail.add(next.at, next.force);
    }
    EXPECT_LE(errors.total(), largest);
    EXPECT_GE(errors.total(), std::abs(missing));
    EXPECT_GT(largest, 0.0);
}

/// Where nothing is lost the works of steps are differences of energies: only the ends count, and
/// the end of a segment is the beginning of the next.
TEST(WorkErrors, OfAReversiblePathAreThoseOfItsEnds) {
    WorkErrors errors;
    errors.begin();
    for (double error : {3.0, 50.0, 0.2, 1e-3})
        errors.end_at(error);
    EXPECT_DOUBLE_EQ(errors.total(), 1e-3);
    errors.begin();
    for (double error : {7.0, 2e-4})
        errors.end_at(error);
    EXPECT_DOUBLE_EQ(errors.total(), 1e-3 + 2e-4);
}
