// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Quasi-static paths against their laws: flat on flat is a problem in one dimension, solved here on
// its own (force, snap-in, snap-off, energies lost); work = energy + loss and loop area = loss on
// rough surfaces. (Slow motion approaches the path: works_test.)
#include "engine/statics/quasistatic.hpp"
#include "engine/units.hpp"
#include "support/nodes.hpp"
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

using namespace asperity;
using test::energy;
using test::follow;
using test::OneDimension;
using Solids = test::PathCase;

namespace {

const WallLaw smeared = SmearedWall(LennardJones{0.1, 3.28, 13.12}, 1.0 / (2.6 * 2.6), false);
/// An attraction over a repulsion of hundreds of times the block's stiffness.
const WallLaw hard = ExponentialWall(0.7, 1.3, 1000.0);

struct Cycle {
    const char* name;
    const char* map; ///< nullptr: flat
    int sites, thickness;
    Constraint::Of along = Constraint::Of::top;
    const WallLaw* wall = nullptr;
    double factor = 1.0;   ///< of the heights
    double pressure = 0.0; ///< GPa, at which the approach ends
    double lost = 0.0;     ///< of the state's energy, at least
    double tolerance = 1e-4;
    double step = 0.25;

    Solids solids() const {
        const BlockOptions block = test::paper_block(sites, thickness, 0);
        const Surface s = map ? test::reference_surface(map, factor) : test::flat_surface(sites);
        return wall ? Solids(block, s, *wall) : Solids(block, s);
    }
};
void PrintTo(const Cycle& c, std::ostream* out) { *out << c.name; }

constexpr const char *rough_32 = "c3_N32_T32_rms1.5", *rough_64 = "c7_N64_T64_rms2";
using test::held::top, test::held::height;
const Cycle cycles[] = {
    {"atoms", rough_32, 32, 200, top, nullptr, 1.0, 0.0, 0.1},
    {"smeared wall", rough_32, 32, 200, top, &smeared, 1.0, 0.0, 0.1},
    {"smeared wall, height", rough_32, 32, 200, height, &smeared},
    {"hard wall", rough_32, 32, 200, top, &hard, 1.0, 0.0, 0.1},
    {"hard wall, height", rough_32, 32, 200, height, &hard},
    // Gently rough and wide, the surface snaps in patches; rougher or narrower it hardly does.
    {"gentle, height", rough_64, 64, 64, height, nullptr, 0.25, 0.0, 0.01, 5e-4},
    {"gentle and narrow, height", rough_32, 32, 32, height, nullptr, 0.15, 0.0, 0.0, 5e-4},
    {"rough, height", rough_32, 32, 32, height, nullptr, 1.0, 0.0, 0.0, 5e-4},
    // Flat on flat without a snap: what the top plane takes up is the interface's energy less what
    // stretches or compresses the block.
    {"pressed", nullptr, 10, 3, top, nullptr, 1.0, 2.0, 0.0, 1e-5},
    {"pulled", nullptr, 10, 3, top, nullptr, 1.0, -2.0, 0.0, 1e-5}};

class CycleBalance : public testing::TestWithParam<Cycle> {};

} // namespace

/// What the work brings is stored or lost, on each branch and step by step.
TEST_P(CycleBalance, WorkIsEnergyPlusLoss) {
    const Cycle& cycle = GetParam();
    Solids c = cycle.solids();
    const double load = cycle.pressure * units::gigapascal * 6.76 * c.sites();
    test::KeptPath path = c.path(cycle.tolerance, cycle.step, load, cycle.along);
    path.start();
    const auto in = follow(path, Segment::approach);
    const double state = -energy(path.now());
    const auto out = follow(path, Segment::pull_off);
    const Dissipation& lost = path.dissipation();
    const double way = in.front().top - in.back().top, back = out.back().top - out.front().top;
    const double allowed = std::min(1e-4, cycle.tolerance) * c.sites();
    if (cycle.pressure != 0.0) {
        EXPECT_EQ(lost.events, 0);
        EXPECT_LE(lost.total, allowed * (way + back));
        ASSERT_GT(in.back()[Term::elastic], 20.0 * allowed * way) << "the case must tell it";
    }
    EXPECT_GE(lost.total, cycle.lost * state);
    const bool snaps = cycle.lost > 0.05;
    if (snaps) {
        ASSERT_GT(path.lost(Segment::approach), 1.0);
        ASSERT_GT(path.lost(Segment::pull_off), 1.0);
    }
    EXPECT_NEAR(-path.work(Segment::approach) + path.lost(Segment::approach), state,
                allowed * (way + 1.0));
    EXPECT_NEAR(path.work(Segment::pull_off) - path.lost(Segment::pull_off), state,
                allowed * (back + 1.0));
    EXPECT_NEAR(path.work(Segment::approach) + path.work(Segment::pull_off), lost.total,
                allowed * (way + back + 2.0));
    EXPECT_NEAR(energy(path.now()), 0.0, 1e-3 * state + 1e-3);
    // The loop of F over the mean height encloses what was lost: by trapezia of the points,
    // which the falls are exact for.
    double loop = 0.0;
    for (const auto* branch : {&in, &out})
        for (std::size_t i = 1; i < branch->size(); ++i)
            loop -= 0.5 * ((*branch)[i].force + (*branch)[i - 1].force) *
                    ((*branch)[i].mean_height - (*branch)[i - 1].mean_height);
    EXPECT_NEAR(loop, lost.total, 0.02 * (snaps ? lost.total : state));
    EXPECT_LT(std::abs(path.now().residual) * state, allowed * (way + back));
    // Each branch only loses, and no step gains more energy than its work brings, but for what
    // the work of the longest may be wrong by.
    double before = 0.0, books = 0.0;
    for (const auto* branch : {&in, &out})
        for (const StepRecord& r : *branch) {
            EXPECT_GE(r[Term::lost], before);
            before = r[Term::lost];
            const double unearned = energy(r) + r[Term::lost] - r[Term::work];
            EXPECT_LT(unearned - books, cycle.tolerance * c.sites() * cycle.step) << r.step;
            books = unearned;
        }
}

INSTANTIATE_TEST_SUITE_P(Quasistatic, CycleBalance, testing::ValuesIn(cycles));

TEST(ForceTrail, ErrorFallsWithTheFourthPowerOfTheStep) {
    const auto error = [](int steps) {
        ForceTrail trail;
        trail.begin(0.0, 0.0);
        double sum = 0.0;
        for (int i = 1; i <= steps; ++i) {
            const double x = 2.0 * i / steps, f = std::sin(x);
            const auto piece = trail.to(x, f);
            sum += piece.value;
            const double exact = std::cos(x - 2.0 / steps) - std::cos(x);
            EXPECT_LE(std::abs(piece.value - exact), piece.error) << i << " of " << steps;
            trail.add(x, f);
        }
        return std::abs(sum - (1.0 - std::cos(2.0)));
    };
    EXPECT_GT(error(20) / error(40), 12.0);
    EXPECT_GT(error(40) / error(80), 12.0);
}

TEST(Quasistatic, SnapsWhereTheInterfaceGetsStifferThanTheBlock) {
    for (const int thickness : {30, 40}) {
        Solids c(test::paper_block(10, thickness, 0), test::flat_surface(10));
        const OneDimension one{c};
        constexpr double tolerance = 1e-5, step = 0.25;
        test::KeptPath path = c.path(tolerance, step);
        path.start();
        const auto in = follow(path, Segment::approach);
        const auto out = follow(path, Segment::pull_off);
        // Every point is a point of the one-dimensional problem.
        for (const auto* branch : {&in, &out})
            for (const StepRecord& r : *branch) {
                EXPECT_NEAR(r.force, one.force(r.mean_height), 1e-9 * c.sites());
                EXPECT_NEAR(r.top, one.top(r.mean_height),
                            tolerance * c.sites() / c.stretch_stiffness());
            }
        EXPECT_NEAR(path.now().top, 0.0, step);

        // Two falls that count: where d F/dz = k, and as deep as it says.
        std::vector<Instability> falls;
        for (const Instability& jump : path.dissipation().jumps)
            if (jump.energy > 1e-3 * path.dissipation().total) falls.push_back(jump);
        ASSERT_EQ(falls.size(), 2u);
        const double peak = 3.62; // Å: between the turning points, near the largest tension
        const double outer = one.turning_point(peak, 9.0, 1.0);
        const double inner = one.turning_point(3.0, outer, -1.0);
        const double lowest = one.top(outer), highest = one.top(inner);
        const double landing_in = one.other(lowest, 2.9, inner);
        const double landing_out = one.other(highest, outer, 14.0);
        const double lost_in = one.total(outer, lowest) - one.total(landing_in, lowest);
        const double lost_out = one.total(inner, highest) - one.total(landing_out, highest);
        // What the work may be wrong by, and a force of a quarter of the tolerance that holds the
        // block up a little beyond the turning point, along the fall.
        const auto allowed = [&](double from, double to) {
            return tolerance * c.sites() * (step + 0.25 * std::abs(to - from));
        };
        EXPECT_NEAR(falls[0].energy, lost_in, allowed(outer, landing_in));
        EXPECT_NEAR(falls[1].energy, lost_out, allowed(inner, landing_out));
        EXPECT_NEAR(falls[0].top, lowest, 2e-3);
        EXPECT_NEAR(falls[1].top, highest, 2e-3);
        EXPECT_NEAR(falls[0].height_after, landing_in, 2e-3);
        EXPECT_EQ(falls[0].contact_before, 0.0);
        EXPECT_EQ(falls[0].contact_after, c.sites());
        EXPECT_EQ(falls[1].sites_moved, c.sites());
    }
}

TEST(Quasistatic, EndsExactlyAtItsLoad) {
    // Where the force falls with the height, too; the largest tension is 9 GPa.
    for (const auto& [thickness, along, pressure] : {std::tuple{10, top, 0.0},
                                                     {10, top, 1.0},
                                                     {10, top, -0.5},
                                                     {200, height, 0.0},
                                                     {200, height, 1.0},
                                                     {200, height, -5.0}}) {
        Solids c(test::paper_block(10, thickness, 0), test::flat_surface(10));
        const double load = pressure * units::gigapascal * 6.76 * c.sites();
        test::KeptPath path = c.approached(1e-5, 0.25, load, along);
        EXPECT_NEAR(path.now().force, load, 0.25e-5 * c.sites());
        // On the inner branch, whatever the sign.
        EXPECT_LT(path.now().mean_height, along == top ? 3.2 : 3.4) << pressure;
    }
}

/// The spring's force is the interface's at every point: what is left has no sign along a branch,
/// and does no work of its own. (A block that is still on its way leaves some of the tolerance at
/// every site, all of one sign.)
TEST(Quasistatic, HeldTopOverAWallIsInBalance) {
    for (const double tolerance : {1e-3, 1e-4}) {
        BlockOptions o = test::paper_block(32, 24, 0);
        o.young = 90.5 * units::gigapascal;
        o.poisson = 0.275;
        const double site = o.spacing * o.spacing;
        Solids c(o, test::reference_surface("c3_N32_T32_rms1.5", 2.0),
                 ExponentialWall(0.0754 * site, 1.25, 50.0));
        test::KeptPath path = c.path(tolerance, 0.2);
        path.start();
        for (const Segment::Kind branch : {Segment::approach, Segment::pull_off}) {
            double sum = 0.0;
            const auto points = follow(path, branch);
            ASSERT_GT(points.size(), 20u);
            for (const StepRecord& r : points)
                sum += r.top_force - r.force;
            EXPECT_NEAR(sum / static_cast<double>(points.size()), 0.0,
                        1e-2 * tolerance * c.sites());
        }
    }
}

TEST(Quasistatic, AgainTheSameCycle) {
    // Apart, nothing is left of the contact: a second cycle is the first.
    Solids c(test::paper_block(10, 40, 0), test::flat_surface(10));
    test::KeptPath path = c.path(1e-5);
    path.start();
    double in[2], out[2], lost[2], lost_in[2];
    for (int n = 0; n < 2; ++n) {
        follow(path, Segment::approach);
        in[n] = -path.work(Segment::approach);
        follow(path, Segment::pull_off);
        out[n] = -path.work(Segment::pull_off);
        lost[n] = path.dissipation().total;
        lost_in[n] = path.lost(Segment::approach);
    }
    const double allowed = 1e-5 * c.sites() * 12.0;
    EXPECT_NEAR(in[0], in[1], allowed);
    EXPECT_NEAR(out[0], out[1], allowed);
    EXPECT_NEAR(lost[1], 2.0 * lost[0], allowed);
    EXPECT_GT(lost_in[0], 10.0 * allowed);
    EXPECT_NEAR(lost_in[1], lost_in[0], allowed);
}

TEST(Dissipation, SaysWhichSitesMovedAndHowFar) {
    Solids c(test::paper_block(16, 90, 0), test::self_affine(16, 0.7));
    test::KeptPath path = c.path(1e-5);
    path.start();
    auto before = test::values_of(c.block.lowest_layer());
    while (path.dissipation().events == 0) {
        before = test::values_of(c.block.lowest_layer());
        ASSERT_EQ(path.advance(Segment::approach), QuasistaticPath::Outcome::point);
    }
    const auto after = test::values_of(c.block.lowest_layer());
    std::vector<double> moved(256);
    for (std::size_t site = 0; site < moved.size(); ++site)
        moved[site] = std::hypot(after[site] - before[site], after[256 + site] - before[256 + site],
                                 after[512 + site] - before[512 + site]);
    const auto most = std::max_element(moved.begin(), moved.end());
    const Instability& jump = path.dissipation().jumps.back();
    EXPECT_NEAR(jump.largest_move, *most, 1e-12);
    EXPECT_EQ(jump.site_y * 16 + jump.site_x, most - moved.begin());
    EXPECT_EQ(jump.sites_moved,
              std::count_if(moved.begin(), moved.end(), [&](double m) { return m > 0.5 * *most; }));
}

TEST(Dissipation, KeepsTheStrongestInstabilitiesInTheOrderOfThePath) {
    Dissipation lost;
    for (int i = 0; i < 30; ++i) {
        Instability jump;
        jump.energy = (7 * i) % 30 + 1.0; // 1 to 30, each once
        jump.segment = i < 15 ? 0 : 1;
        jump.top = -i;
        lost.add(jump);
    }
    EXPECT_EQ(lost.events, 30);
    ASSERT_EQ(lost.jumps.size(), 20u);
    for (std::size_t i = 0; i < lost.jumps.size(); ++i) {
        EXPECT_GT(lost.jumps[i].energy, 10.0);
    }
    for (std::size_t i = 1; i < lost.jumps.size(); ++i)
        EXPECT_LT(lost.jumps[i].top, lost.jumps[i - 1].top);
}
