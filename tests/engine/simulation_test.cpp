// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Decisions of the drive; the sums and the energy balance of a simulation.
#include "engine/case/flat_reference.hpp"
#include "engine/path/state_numbers.hpp"
#include "support/cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace asperity;

namespace {

DriveOptions both_ways() {
    DriveOptions o;
    o.velocity = 5e-5;
    o.ramp = 1000.0;
    return o;
}

} // namespace

TEST(Drive, AnApproachEndsWhereTheForceComesToItsLoad) {
    const struct {
        const char* what;
        double load;
        std::vector<double> forces; ///< the last one ends it
    } cases[] = {{"back to zero; out of reach is not contact", 0.0, {0.0, -1.0, -9.0, -0.01, 0.02}},
                 {"through zero, but not at the load", 2.0, {-1.0, 1.0, 2.5}},
                 {"without attraction", 2.0, {1.0, 2.5}},
                 // What a warm block does: the first attraction is gone a few steps later.
                 {"a tip that leaves the reach again", -2.0, {-5.0, 0.0, -5.0, 2.5}},
                 {"a tip that leaves the reach again", 0.0, {-5.0, 0.0, -5.0, 2.5}},
                 {"a tip that leaves the reach again", 2.0, {-5.0, 0.0, -5.0, 2.5}},
                 {"a pull, from beyond it", -2.0, {0.0, -1.0, -5.0, -2.5, -1.5}}};
    for (const auto& c : cases)
        for (const bool out : {false, true}) { // nothing ends an approach but the force
            SCOPED_TRACE(c.what);
            DriveOptions options = both_ways();
            options.load_force = c.load;
            Drive drive(options);
            EXPECT_EQ(drive.now().kind, Segment::approach);
            EXPECT_EQ(drive.motion(0.0).z, -5e-5);
            double time = 0.0;
            for (const double& force : c.forces)
                EXPECT_EQ(drive.observe({time++, force, 0.0, out}), &force == &c.forces.back())
                    << force;
            EXPECT_EQ(drive.now().kind, Segment::pull_off);
            EXPECT_FALSE(drive.observe({time, 3.0, 0.0, false})) << "a segment ends once";
        }
}

TEST(Drive, APullThatIsNowhereMetIsRefused) {
    DriveOptions options = both_ways();
    options.load_force = -2.0;
    Drive drive(options);
    EXPECT_FALSE(drive.observe({0.0, -1.0, 0.0, false}));
    EXPECT_THROW(drive.observe({1.0, 0.5, 0.0, false}), io::PhysicsError);
}

TEST(Drive, TurnsSmoothly) {
    Drive drive(both_ways());
    drive.observe({100.0, -1.0, 0.0, false});
    drive.observe({200.0, 1.0, 0.0, false});
    EXPECT_NEAR(drive.motion(200.0).z, -5e-5, 1e-18);
    EXPECT_NEAR(drive.motion(700.0).z, 0.0, 1e-18) << "half way through the ramp";
    EXPECT_EQ(drive.motion(1200.0).z, 5e-5);
    EXPECT_EQ(drive.motion(1e9).z, 5e-5);
    // Monotonic, and its steepest change is that of a half cosine, pi/2 times the mean: no sudden
    // kick.
    double before = drive.motion(200.0).z;
    for (double t = 201.0; t <= 1200.0; t += 1.0) {
        const double now = drive.motion(t).z;
        EXPECT_GE(now, before);
        EXPECT_LE(now - before, 1.0001 * 1e-4 / 1000.0 * 1.5707963268);
        before = now;
    }
    // It starts and ends without acceleration: a hundredth of the ramp changes the velocity by
    // sin^2(pi / 200) of the whole change.
    const double little = 1e-4 * std::pow(std::sin(std::numbers::pi / 200.0), 2);
    EXPECT_NEAR(drive.motion(210.0).z - drive.motion(200.0).z, little, 1e-4 * little);
    EXPECT_NEAR(drive.motion(1200.0).z - drive.motion(1190.0).z, little, 1e-4 * little);
}

TEST(Drive, PullOffEndsOutOfReach) {
    Drive drive(both_ways());
    drive.observe({0.0, -1.0, 0.0, false});
    drive.observe({1.0, 1.0, 0.0, false});
    EXPECT_FALSE(drive.observe({2.0, -5.0, 0.0, false}));
    EXPECT_FALSE(drive.observe({3.0, 0.0, 0.0, false})) << "a zero of the force is not the end";
    EXPECT_TRUE(drive.observe({4.0, 0.0, 0.0, true}));
    EXPECT_TRUE(drive.done());
}

TEST(Drive, ApartIsBeyondTheRangeAndWithoutForce) {
    EXPECT_FALSE(are_apart(false, 0.0, 9.0)) << "the force passes through zero on the way";
    EXPECT_TRUE(are_apart(true, 0.0, 9.0));
    EXPECT_TRUE(are_apart(true, -8.9e-6, 9.0));
    EXPECT_FALSE(are_apart(true, -9.1e-6, 9.0));
    EXPECT_FALSE(are_apart(true, 9.1e-6, 9.0));
}

TEST(Drive, SegmentsThatWereNotAskedForAreLeftOut) {
    auto options = both_ways();
    options.path = {Segment{Segment::approach}};
    Drive in(options);
    in.observe({0.0, -1.0, 0.0, false});
    EXPECT_TRUE(in.observe({1.0, 0.5, 0.0, false}));
    EXPECT_TRUE(in.done());
    options = both_ways();
    options.path = {Segment{Segment::pull_off}};
    Drive out(options);
    EXPECT_EQ(out.now().kind, Segment::pull_off);
    EXPECT_EQ(out.motion(0.0).z, 0.0) << "from rest";
    EXPECT_NEAR(out.motion(500.0).z, 2.5e-5, 1e-18);
    EXPECT_EQ(out.motion(1000.0).z, 5e-5);
}

TEST(Simulation, TheForceAndHeightOfARigidBlockAreThoseOfTheFlatSum) {
    // First step, nothing displaced yet: N^2 times the force of one site over a flat substrate.
    const SimulationOptions options = test::free_contact(10.0, 0);
    test::Driven simulation = test::simulation(options, test::flat_surface(8));
    for (double gap : {3.0, 3.6, 5.0, 13.0}) {
        simulation.start(gap);
        const StepRecord& now = simulation.step(true);
        const PairSum site = flat_pair_sum(options.interface, 2.6, 8, 8, gap);
        EXPECT_NEAR(now.force, 64 * site.force[2], 1e-12 * (1.0 + std::abs(now.force)));
        EXPECT_NEAR(now[Term::interface], 64 * site.energy,
                    1e-12 * (1.0 + std::abs(now[Term::interface])));
        EXPECT_EQ(now.mean_height, gap);
        EXPECT_EQ(now[Term::elastic], 0.0);
        EXPECT_EQ(now.step, 0);
    }
}

TEST(Simulation, ASecondStartLeavesNothingOfTheFirst) {
    SimulationOptions options = test::free_contact(10.0);
    options.drive = both_ways();
    options.damping = 1e-3;
    options.interface.slides = true;
    options.temperature = 100.0;
    const auto numbers = [](const test::Driven& simulation) {
        CollectNumbers collect;
        collect("simulation", simulation);
        return collect.numbers;
    };
    const auto steps = [](test::Driven& simulation, int count) {
        for (int n = 0; n < count; ++n)
            simulation.step(n % 7 == 0);
    };
    test::Driven again = test::simulation(options, test::flat_surface(8)),
                 once = test::simulation(options, test::flat_surface(8));
    again.start(5.0);
    steps(again, 300);
    const StateNumbers before = numbers(again);
    EXPECT_EQ(numbers(again), before) << "collecting changes nothing";
    again.start(3.5);
    once.start(3.5);
    EXPECT_EQ(numbers(again), numbers(once));
    for (test::Driven* simulation : {&again, &once})
        steps(*simulation, 50);
    EXPECT_EQ(numbers(again), numbers(once));
    EXPECT_NE(once.now()[Term::work], 0.0);
}

TEST(Simulation, NothingHappensOutOfReach) {
    // The whole block comes down rigidly with the drive: no force, no strain, mean height v t.
    SimulationOptions options = test::free_contact(10.0);
    options.drive = both_ways();
    options.damping = 1e-3; // against a medium that moves along: no drag
    test::Driven simulation = test::simulation(options, test::flat_surface(8));
    simulation.start(20.0);
    for (int n = 0; n < 1000; ++n)
        simulation.step(true);
    const StepRecord& now = simulation.now();
    EXPECT_EQ(now.force, 0.0);
    EXPECT_NEAR(now.mean_height, 20.0 - 999 * 10.0 * 5e-5, 1e-12);
    EXPECT_NEAR(now[Term::elastic], 0.0, 1e-20);
    EXPECT_NEAR(simulation.balance().damped, 0.0, 1e-20);
    EXPECT_EQ(simulation.drive().now().kind, Segment::approach);
}

TEST(Simulation, TheTopMovesByTheIntegralOfItsVelocity) {
    // From rest along half a cosine: half the ramp at full velocity. The midpoint rule is exact,
    // for every step of the ramp has its mirror image.
    SimulationOptions options = test::free_contact(10.0, 0);
    options.drive = both_ways();
    options.drive.path = {Segment{Segment::pull_off}};
    options.drive.ramp = 40 * options.dt;
    test::Driven simulation = test::simulation(options, test::flat_surface(8));
    simulation.start(20.0);
    const double v = options.drive.velocity;
    for (int n = 0; n < 41; ++n)
        simulation.step(n == 40);
    EXPECT_NEAR(simulation.now().top, 20 * options.dt * v, 1e-12);
    for (int n = 0; n < 10; ++n)
        simulation.step(true);
    EXPECT_NEAR(simulation.now().top, 30 * options.dt * v, 1e-12);
    EXPECT_NEAR(simulation.block().top(), 31 * options.dt * v, 1e-12);
}
