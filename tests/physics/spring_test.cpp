// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A spring that holds the top plane of a block at rest (drive.stiffness): the block and the spring
// in series, and jumps into contact, whose force has a closed form.
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace asperity;

namespace {

constexpr double range = 1.3;    ///< of the wall's attraction, Å
constexpr double adhesion = 0.7; ///< eV for each site

/// Returns the options of a block whose top plane a spring holds; 0: none.
BlockOptions on_spring(BlockOptions block, double spring) {
    block.top_spring.stiffness = spring;
    return block;
}

/// A block over a wall without curvature or roughness, which stays flat; spring 0: none.
struct Flat : test::PathCase {
    explicit Flat(double spring = 0.0)
        : PathCase(on_spring(test::paper_block(4, 4, 0), spring), test::flat_surface(4),
                   ExponentialWall(adhesion, range, 24.0)) {}
};

/// Returns the stiffness of springs in series.
double in_series(double one, double other) { return one * other / (one + other); }

} // namespace

TEST(Spring, IsInSeriesWithTheBlock) {
    const Flat c;
    const double block = c.stretch_stiffness();
    for (const double spring : {1e-3 * block, block, 50.0 * block}) {
        Flat held(spring);
        SpectralBlock& b = held.block;
        const double k = in_series(block, spring), drive = 0.3;
        b.set_uniform(0.0);
        b.hold(Constraint::top(drive));
        EXPECT_NEAR(b.top_force(), -k * drive, 1e-12 * k);
        EXPECT_NEAR(spring * (drive - b.top()), -b.top_force(), 1e-10 * k) << "balance of the top";
        const StepEnergies e = b.energies();
        EXPECT_NEAR(e[Term::spring], 0.5 * k * k / spring * drive * drive, 1e-12 * k);
        EXPECT_NEAR(e[Term::elastic], 0.5 * k * drive * drive, 1e-12 * k);
        EXPECT_EQ(b.drive(), drive);
        const double load = 0.1 * block; // by which both are compressed
        b.hold(Constraint::load(load));
        EXPECT_NEAR(b.top(), -load / block, 1e-10);
        EXPECT_NEAR(b.drive(), -load / k, 1e-8 * load / k);
    }
}

TEST(Spring, ThatIsRigidIsNone) {
    Flat none, rigid(1e12);
    for (Flat* c : {&none, &rigid}) {
        c->block.set_uniform(0.2);
        c->block.hold(Constraint::top(-0.4));
    }
    EXPECT_NEAR(none.block.top_force(), rigid.block.top_force(), 1e-7);
    EXPECT_EQ(none.block.top(), -0.4);
    EXPECT_EQ(none.block.energies()[Term::spring], 0.0);
}

TEST(Spring, LetsTheBlockJumpInAtItsStiffnessTimesTheRange) {
    // An exponential attraction A exp(-g/rho) of each site is as stiff as what holds it, k, where
    // its force is k rho: at the gap g = rho ln(N^2 A/(k rho^2)), the drive at g + rho. The block
    // stays if the drive is a little above, with the force k rho (1 - sqrt(2 d/rho)) to first
    // order in its distance d, and falls if it is a little below.
    const double A = -ExponentialWall(adhesion, range, 24.0).energy(0.0);
    const Flat c;
    for (const double share : {0.003, 0.03, 0.3}) {
        const double spring = share * c.stretch_stiffness(),
                     k = in_series(spring, c.stretch_stiffness());
        Flat held(spring);
        SpectralBlock& block = held.block;
        const double top = held.interface.start_height(), d = 1e-4 * range;
        const double gap = range * std::log(c.sites() * A / (k * range * range));
        RelaxOptions near;
        near.start = Start::near;
        block.set_uniform(gap + 0.1 * range - top);
        const RelaxedState stays = held.relax(Constraint::top(gap + range + d - top), 1e-8, near);
        EXPECT_NEAR(-stays.force, k * range * (1.0 - std::sqrt(2.0 * d / range)), 1e-3 * k * range)
            << "share " << share;
        EXPECT_NEAR(spring * (gap + range + d - top - block.top()), -stays.force, 1e-6 * k);
        const RelaxedState falls =
            held.relax(Constraint::top(gap + range - 10.0 * d - top), 1e-8, near);
        EXPECT_LT(falls.mean_height + top, 0.3 * range) << "share " << share;
    }
}

TEST(Spring, LosesMoreTheSofterItIs) {
    double last = 0.0;
    for (const double share : {1e9, 0.1}) {
        Flat held(share * Flat().stretch_stiffness());
        test::KeptPath path = held.path(2e-6, 1.0);
        path.start();
        const auto in = test::follow(path, Segment::approach);
        const auto out = test::follow(path, Segment::pull_off);
        const double lost = path.lost(Segment::approach) + path.lost(Segment::pull_off);
        EXPECT_GE(lost, last) << share;
        // What the drive puts in is lost: at the end the spring is relaxed.
        EXPECT_NEAR(path.work(Segment::approach) + path.work(Segment::pull_off), lost,
                    path.uncertainty(Segment::approach) + path.uncertainty(Segment::pull_off));
        EXPECT_NEAR(out.back()[Term::spring], 0.0, 1e-6 * (lost + 1.0));
        // The largest attraction is that of the law, whatever holds the block.
        EXPECT_NEAR(test::strongest_of(out), held.sites() * adhesion / range,
                    0.01 * held.sites() * adhesion / range);
        last = lost;
    }
}

TEST(Spring, InAStablePathOnlyMovesTheDrive) {
    // A block that is stiffer than the law never jumps: at the place D of the drive with spring the
    // state is that of a top plane at D + F/k.
    test::PathCase stiff(test::paper_block(8, 2, 0), test::wave(8, 0.8),
                         ExponentialWall(0.02, range, 24.0));
    test::PathCase soft(on_spring(stiff.options, 5.0 * stiff.sites() * 0.02 / (range * range)),
                        test::wave(8, 0.8), ExponentialWall(0.02, range, 24.0));
    test::KeptPath path = soft.path(1e-6);
    path.start();
    for (const StepRecord& point : test::follow(path, {Segment::height, -2.0 - 0.5, 0, ""})) {
        if (-point.force < 0.01) continue;
        stiff.block.set_uniform(0.0);
        const RelaxedState rigid = stiff.relax(Constraint::top(point.top), 1e-6);
        EXPECT_NEAR(rigid.force, point.force, 1e-4);
        EXPECT_NEAR(rigid[Term::elastic], point[Term::elastic] - point[Term::spring], 1e-4);
    }
}
