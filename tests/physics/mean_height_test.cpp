// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Paths at a held mean height against their laws: flat on flat is the wall's own F(z) through the
// whole well, however soft the block; F is minus the slope of the relaxed energy; what is not lost
// is the state's energy both ways; the state is the one that a held top plane leads to; levels and
// waves agree.
#include "engine/phases.hpp"
#include "engine/statics/relaxation.hpp"
#include "engine/units.hpp"
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

using namespace asperity;
using test::energy;
using test::follow;
using test::OneDimension;
using Solids = test::PathCase;

namespace {

test::KeptPath path_of(Solids& c, double tolerance, double load = 0.0) {
    return c.path(tolerance, 0.25, load, Constraint::Of::mean_height);
}

/// What the energy of an instability is not known by: the path knows its place to one step.
double uncertain(const Instability& fall) {
    return 0.5 * std::abs((fall.force_after - fall.force_before) *
                          (fall.height_after - fall.height_before));
}

/// Every instability of a with more than this energy is one of b too.
void expect_in(const Dissipation& a, const Dissipation& b, double least, double late) {
    int found = 0;
    for (const Instability& x : a.jumps) {
        if (x.energy < least) continue;
        ++found;
        const auto same = [&](const Instability& y) {
            const double place = std::abs(x.height_before - x.height_after) +
                                 std::abs(y.height_before - y.height_after) + late;
            return x.segment == y.segment && std::abs(x.height_after - y.height_after) <= place &&
                   std::abs(x.energy - y.energy) <=
                       uncertain(x) + uncertain(y) +
                           late * std::abs(x.force_after - x.force_before);
        };
        EXPECT_TRUE(std::any_of(b.jumps.begin(), b.jumps.end(), same))
            << x.energy << " eV at " << x.height_after << " Å";
    }
    EXPECT_GE(found, 1);
}

/// Without a path: relaxed at a mean displacement, from where the block is.
RelaxedState relax_at(Solids& c, double z, double tolerance) {
    RelaxOptions how;
    how.max_iterations = 20000;
    const RelaxedState s = c.relax(Constraint::mean_height(z), tolerance, how);
    EXPECT_NEAR(s.mean_height, z, 1e-12);
    return s;
}

} // namespace

TEST(MeanHeight, StaysWhereItIsHeldWhileItRelaxes) {
    // Far from equilibrium: sites are cut to the largest move, and what is cut off has a mean.
    Solids c(test::paper_block(32, 200, 0), test::reference_surface("c3_N32_T32_rms1.5"));
    const double z = -9.0;
    int looks = 0; // at every tenth iteration
    double drift = 0.0;
    RelaxOptions how;
    how.report = [&](long long, double) {
        ++looks;
        drift = std::max(drift, std::abs(c.block.mean_height() - z));
        return false;
    };
    c.relax(Constraint::mean_height(z), 1e-4, how);
    EXPECT_GE(looks, 2);
    EXPECT_LT(drift, 1e-5); // directions are in single precision
}

TEST(MeanHeight, FlatOnFlatIsTheWallThroughTheWholeWell) {
    // Under a held top plane these blocks fall in and off (quasistatic_test).
    for (const int thickness : {40, 200, 512})
        for (double tolerance : {1e-3, 1e-4, 1e-5}) {
            Solids c(test::paper_block(10, thickness, 0), test::flat_surface(10));
            const OneDimension one{c};
            test::KeptPath path = path_of(c, tolerance);
            path.start();
            const auto in = follow(path, Segment::approach);
            const double state = -energy(path.now()), way = -path.now().top;
            const auto out = follow(path, Segment::pull_off);
            // Where pairs of a flat layer leave the cutoff together F jumps, and what a polynomial
            // misses there may be taken for a fall.
            EXPECT_LT(path.dissipation().total, 0.1 * tolerance * c.sites() * way);
            EXPECT_NEAR(-path.work(Segment::approach), state, tolerance * c.sites() * way);
            EXPECT_NEAR(path.work(Segment::pull_off), state, tolerance * c.sites() * way);
            int unstable = 0;
            for (const auto* branch : {&in, &out})
                for (const StepRecord& r : *branch) {
                    const double jump = one.jump(r.mean_height);
                    EXPECT_NEAR(r.force, one.force(r.mean_height), 1e-9 * c.sites() + jump);
                    EXPECT_NEAR(r[Term::interface], one.potential(r.mean_height),
                                1e-9 * c.sites() + 1e-3 * jump);
                    EXPECT_NEAR(r[Term::elastic], 0.0, 1e-9 * c.sites());
                    EXPECT_EQ(r.top_force, r.force);
                    constexpr double h = 1e-4;
                    unstable += one.force(r.mean_height + h) - one.force(r.mean_height - h) >
                                2.0 * h * c.stretch_stiffness();
                }
            EXPECT_GT(unstable, thickness > 40 ? 10 : 0)
                << "points where a block on its spring cannot stand";
        }
}

TEST(MeanHeight, ForceIsMinusTheSlopeOfTheRelaxedEnergy) {
    // By five points, h^4, in and out of a rough contact.
    for (const int thickness : {8, 60}) {
        Solids c(test::paper_block(16, thickness, 0), test::reference_surface("c1_N16_T16_rms0.5"));
        constexpr double h = 0.02;
        double strongest = 0.0;
        for (double z : {-8.0, -9.0, -9.5, -10.0, -10.4}) {
            std::array<double, 5> u{};
            double force = 0.0;
            for (int i = -2; i <= 2; ++i) {
                const RelaxedState s = relax_at(c, z + i * h, 1e-7);
                u[static_cast<std::size_t>(i + 2)] = energy(s);
                if (i == 0) force = s.top_force;
            }
            const double slope = (8.0 * (u[3] - u[1]) - (u[4] - u[0])) / (12.0 * h);
            strongest = std::max(strongest, std::abs(force));
            EXPECT_NEAR(force, -slope, 1e-3 + 2e-5 * std::abs(force)) << z << " " << thickness;
        }
        EXPECT_GT(strongest, 5.0);
    }
}

TEST(MeanHeight, SmoothContactLosesNothingAndIsTheStateOfAHeldTop) {
    // Soft and gently rough: under a held top plane it snaps as a whole.
    constexpr double tolerance = 1e-4;
    Solids c(test::paper_block(16, 60, 0), test::reference_surface("c1_N16_T16_rms0.5"));
    test::KeptPath path = path_of(c, tolerance);
    path.start();
    const auto in = follow(path, Segment::approach);
    const RelaxedState state = c.relax({}, 1e-6);
    path.put_back();
    const auto out = follow(path, Segment::pull_off);
    const double bound = -energy(state);
    const double allowed = tolerance * c.sites() * (in.front().top - in.back().top);
    EXPECT_EQ(path.dissipation().events, 0);
    EXPECT_LE(path.dissipation().total, allowed);
    EXPECT_NEAR(-path.work(Segment::approach), bound, allowed);
    EXPECT_NEAR(path.work(Segment::pull_off), bound, allowed);

    Solids d(test::paper_block(16, 60, 0), test::reference_surface("c1_N16_T16_rms0.5"));
    test::KeptPath falling = d.path(tolerance);
    falling.start();
    follow(falling, Segment::approach);
    const RelaxedState same = d.relax({}, 1e-6);
    EXPECT_GT(falling.dissipation().total, 0.1 * bound);
    EXPECT_NEAR(energy(state), energy(same), 1e-6 * bound);
    EXPECT_NEAR(state.mean_height, same.mean_height, 1e-4);
    EXPECT_EQ(state.in_contact, same.in_contact);
}

TEST(MeanHeight, SurfaceFallsWhereItsLongestWaveGetsUnstable) {
    // Without friction, a flat surface is unstable where the wall's force gets as steep, for a
    // site, as the longest wave of the surface is stiff. A little of that wave on the substrate
    // makes a fold of it, which lies further out by the 2/3rd power of the amplitude.
    constexpr double tolerance = 1e-5, least = 1e-3;
    std::vector<double> early;
    for (double amplitude : {8e-4, 1e-4}) {
        std::vector<Dissipation> lost;
        for (double step : {0.25, 0.1}) {
            Solids c(test::paper_block(32, 32, 0), test::wave(32, amplitude),
                     test::Friction::without);
            const OneDimension one{c};
            const double stiffness =
                SpectralBlock(c.options, Communicator(), true).acting_stiffness(1, 0).zz;
            const auto slope = [&](double z) {
                constexpr double h = 1e-3;
                return (one.force(z + h) - one.force(z - h)) / (2.0 * h * c.sites());
            };
            double inner = 4.2, outer = 9.0;
            ASSERT_GT(slope(inner), stiffness);
            for (int i = 0; i < 50; ++i)
                (slope(0.5 * (inner + outer)) > stiffness ? inner : outer) = 0.5 * (inner + outer);

            test::KeptPath path = c.path(tolerance, step, 0.0, Constraint::Of::mean_height);
            path.start();
            const auto [before, fall] = test::first_fall(path, least);
            EXPECT_GT(fall.height_before, inner);
            if (step == 0.1) early.push_back(fall.height_before - inner);
            // What was lost is the difference of the two branches, here both at the last point
            // before: no integral of the force.
            const RelaxedState back = relax_at(c, before.top, 1e-6);
            const double difference = energy(before) - energy(back);
            EXPECT_NEAR(fall.energy, difference, 2.0 * uncertain(fall));
            EXPECT_LT(uncertain(fall), 0.01 * fall.energy);
            lost.push_back(path.dissipation());
        }
        expect_in(lost[0], lost[1], least, 1e-4);
    }
    EXPECT_NEAR(early[0] / early[1], 4.0, 0.6);
}

TEST(MeanHeight, SameInstabilitiesWithAnotherStep) {
    // Without friction: with lateral forces a surface may end in another state where it falls.
    constexpr double tolerance = 2e-4;
    std::vector<Dissipation> lost;
    for (double step : {0.25, 0.1}) {
        Solids c(test::paper_block(64, 64, 0), test::reference_surface("c7_N64_T64_rms2", 0.25),
                 test::Friction::without);
        test::KeptPath path = c.approached(tolerance, step, 0.0, Constraint::Of::mean_height);
        lost.push_back(path.dissipation());
        EXPECT_NEAR(-path.work(Segment::approach) + path.dissipation().total, -energy(path.now()),
                    path.uncertainty(Segment::approach));
        for (const Instability& fall : path.dissipation().jumps)
            EXPECT_GT(fall.energy, 0.0);
    }
    constexpr double least = 2.0; // eV; the smallest are counted or not, whatever the step
    expect_in(lost[0], lost[1], least, 5e-3);
    expect_in(lost[1], lost[0], least, 5e-3);
}

TEST(MeanHeight, FallsThatTakeTheForceTooFarAreGivenUp) {
    // A relaxation that ends far from the force expected is given up before its end; one whose
    // force is only near the edge of its window for its first moves is not.
    Solids c(test::paper_block(64, 64, 0), test::reference_surface("c7_N64_T64_rms2", 0.25));
    test::KeptPath path = path_of(c, 2e-4);
    path.start();
    const StepRecord before = test::first_fall(path).before;
    const double after = path.now().top;
    const auto fall = [&](const ForceWindow& window) {
        c.block.set_uniform(before.top);
        relax_at(c, before.top, 1e-6);
        RelaxOptions o;
        o.start = Start::near;
        o.tolerance = 1e-4;
        o.scales = test::paper_scales();
        o.force_window = window;
        Phases phases;
        return relax(c.block, c.interface, {Constraint::Of::mean_height, after}, o, phases);
    };
    const RelaxedState whole = fall({});
    ASSERT_TRUE(whole.converged);
    const double jump = std::abs(whole.force - before.force);
    ASSERT_GT(jump, 1.0);
    const RelaxedState wide = fall({before.force, 1.5 * jump});
    EXPECT_TRUE(wide.converged);
    EXPECT_FALSE(wide.jumped);
    EXPECT_EQ(wide.force, whole.force);
    EXPECT_EQ(wide.iterations, whole.iterations);
    const RelaxedState narrow = fall({before.force, 0.2 * jump});
    EXPECT_TRUE(narrow.jumped);
    EXPECT_FALSE(narrow.converged);
    EXPECT_LT(narrow.iterations, whole.iterations);
    EXPECT_GT(std::abs(narrow.force - before.force), 0.2 * jump);
}

TEST(MeanHeight, WorkIsThatOfATighterPath) {
    // In nearly full contact a relaxation from too far before an instability ends in a state that
    // the path does not reach, and the path misses instabilities on the way. On this surface the
    // pull-off loses 17.8 eV in one of them.
    std::vector<std::array<double, 4>> works;
    for (double tolerance : {1e-4, 2e-5}) {
        Solids c(test::paper_block(64, 64, 0), test::self_affine(64, 0.5, 7));
        test::KeptPath path = c.approached(tolerance, 0.25, 0.0, Constraint::Of::mean_height);
        follow(path, Segment::pull_off);
        works.push_back({-path.work(Segment::approach), path.uncertainty(Segment::approach),
                         -path.work(Segment::pull_off), path.uncertainty(Segment::pull_off)});
    }
    EXPECT_NEAR(works[0][0], works[1][0], works[0][1] + works[1][1]);
    EXPECT_NEAR(works[0][2], works[1][2], works[0][3] + works[1][3]);
    // What is not known of the work is less than what the instability loses.
    EXPECT_LT(works[0][3], 8.0);
}

TEST(MeanHeight, LandsWhereTheAttractionIsLostInTheTolerance) {
    // Under a prescribed top plane. Very rough: less attraction than a quarter of the tolerance for
    // each site.
    constexpr double tolerance = 2e-2;
    Solids c(test::paper_block(16, 16, 0), test::reference_surface("c1_N16_T16_rms0.5", 20.0));
    test::KeptPath path = c.path(tolerance);
    path.start();
    const auto in = follow(path, Segment::approach);
    const double strongest = test::strongest_of(in);
    EXPECT_GT(strongest, 0.01);
    EXPECT_LT(strongest, 0.25 * tolerance * c.sites());
    EXPECT_LT(std::abs(path.now().force), 0.26 * tolerance * c.sites());
}

TEST(MeanHeight, EndsInTheFirstStateHoweverWeaklyItBinds) {
    // Very rough: the attraction of a few summits, less than a quarter of the tolerance for each
    // site of the surface. The path ends where a relaxation without a path does.
    constexpr double tolerance = 1e-2;
    Solids c(test::paper_block(32, 32, 0), test::reference_surface("c3_N32_T32_rms1.5", 6.0));
    test::KeptPath path = path_of(c, tolerance);
    path.start();
    const auto in = follow(path, Segment::approach);
    const double strongest = test::strongest_of(in);
    EXPECT_LT(strongest, 0.25 * tolerance * c.sites());
    const double ended = energy(path.now()), force = path.now().force;
    const RelaxedState state = c.relax({}, 1e-6);
    const double least = energy(state);
    EXPECT_LT(least, 0.0);
    EXPECT_NEAR(ended, least, 0.02 * std::abs(least));
    EXPECT_LT(std::abs(force), 0.1 * strongest);
}

TEST(MeanHeight, PullsOffFromTheStateUnderALoad) {
    // Where a relaxation with the top plane free has ended, under a load and the block pressed
    // together by it, the path holds the layer where it is.
    Solids c(test::paper_block(16, 60, 0), test::reference_surface("c1_N16_T16_rms0.5"));
    c.block.set_uniform(-9.0);
    const RelaxedState pressed = c.relax(Constraint::load(20.0), 1e-6);
    test::KeptPath path = path_of(c, 1e-4);
    path.start_here({});
    EXPECT_NEAR(path.now().force, 20.0, 0.01);
    EXPECT_NEAR(path.now().mean_height, c.interface.start_height() + pressed.mean_height, 1e-9);
    const double bound = -energy(path.now());
    const auto out = follow(path, Segment::pull_off);
    const double allowed = 1e-4 * c.sites() * (out.back().top - out.front().top);
    EXPECT_EQ(path.dissipation().events, 0);
    EXPECT_LE(path.dissipation().total, allowed);
    EXPECT_NEAR(path.work(Segment::pull_off), bound, allowed);
}

/// A mean height is met to its rounding, in a few sweeps over the wall for each step of the
/// minimiser: also where the rounding is that of the height alone, or that of the displacements.
TEST(MeanHeight, IsMetInFewSweeps) {
    const ExponentialWall law(0.7, 1.3, 1e3);
    Solids c(test::paper_block(16, 16, 0), test::self_affine(16, 1.0), law);
    c.interface.set_reference_height(0.0);
    for (const double z : {0.0, 1e-14, 3.0}) {
        c.block.set_uniform(z);
        RelaxOptions how;
        how.tolerance = 1e-6;
        how.scales = test::paper_scales();
        Phases phases;
        const RelaxedState s = relax(c.block, c.interface, Constraint::mean_height(z), how, phases);
        EXPECT_TRUE(s.converged);
        EXPECT_NEAR(s.mean_height, z, 1e-13);
        const double sweeps = static_cast<double>(phases[Phase::interface].calls);
        EXPECT_LT(sweeps / static_cast<double>(s.iterations), 6.0) << z << " " << s.iterations;
    }
}
