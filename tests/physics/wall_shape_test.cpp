// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Shapes of the law of a wall: against their formulas, against themselves, and as keys of a scene.
#include "engine/case/case.hpp"
#include "engine/case/wall_shape.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "support/path_case.hpp"
#include "support/scratch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

using namespace asperity;

namespace {

struct Known {
    const char* name;
    WallShape shape;
    std::function<double(double)> f; ///< over the depth and the range
};

/// Returns factors that leave a law as it is but for its attraction.
LawFactors<double> attracting(double factor) {
    LawFactors<double> factors = no_factors;
    factors[LawFactor::attraction] = factor;
    return factors;
}

const std::vector<Known>& known() {
    static const std::vector<Known> all = [] {
        std::vector<Known> list;
        list.push_back({"dugdale", WallShape::dugdale(), [](double x) {
                            const double ramp = std::max(0.0, x - 0.9);
                            return x - 1.0 - 2.5 * ramp * ramp;
                        }});
        for (const double n : {1.5, 3.0, 8.0})
            list.push_back(
                {"power", WallShape::power(n), [n](double x) { return -std::pow(1.0 + x, -n); }});
        list.push_back({"9-3", WallShape::nine_three(),
                        [](double x) { return 0.5 * (std::pow(x, -9) - 3.0 * std::pow(x, -3)); }});
        list.push_back({"8-2", WallShape::eight_two(),
                        [](double x) { return (std::pow(x, -8) - 4.0 * std::pow(x, -2)) / 3.0; }});
        std::vector<double> gap, energy; // a Morse law of a depth of 7
        for (int i = 0; i <= 400; ++i) {
            gap.push_back(0.5 + 0.05 * i);
            const double e = std::exp(-1.7 * (gap.back() - 2.0));
            energy.push_back(7.0 * (e * e - 2.0 * e));
        }
        WallShape table(gap, energy);
        const double length = table.length();
        list.push_back({"table", std::move(table), [length](double x) {
                            const double e = std::exp(-1.7 * (length * x - 2.0));
                            return e * e - 2.0 * e;
                        }});
        return list;
    }();
    return all;
}

constexpr double law_work = 0.7, law_range = 1.3, law_stiffness = 40.0;

ShapedWall law_of(const Known& k) { return {k.shape.shape(), law_work, law_range, law_stiffness}; }

double at_rest(const ShapedWall& law, double gap, double target, double spring) {
    return ShapedWall::Terms<double>(law).equilibrium(gap, target, spring);
}

} // namespace

/// What is cut off at 32 ranges is the only difference, but for straight lines in place of curves.
TEST(WallShape, FollowsItsFormula) {
    for (const Known& k : known()) {
        const ShapedWall law = law_of(k);
        const ShapedWall::Shape shape = k.shape.shape();
        // Of a law over a linear repulsion A is a little less than the work.
        const double depth = shape.repels ? law_work : -law.energy(0.0);
        const double tail = k.f(shape.last), whole = shape.repels ? -k.f(shape.minimum) : -k.f(0.0);
        for (double x = std::max(shape.first, 0.6); x < std::min(shape.last, 20.0); x *= 1.013) {
            if (x == 0.0) x = 1e-3;
            const double wanted = (k.f(x) - tail) / (whole + tail);
            EXPECT_NEAR(law.energy(law_range * x) / depth, wanted, 2e-4 * (1.0 + std::abs(wanted)))
                << k.name << " " << x;
        }
        EXPECT_EQ(law.energy(law_range * shape.last * 1.001), 0.0);
        EXPECT_EQ(law.force(law_range * shape.last * 1.001), 0.0);
    }
}

/// As deep as the work of adhesion at the gap of no force, with each factor of a site, and nowhere
/// deeper.
TEST(WallShape, IsAsDeepAsItSays) {
    for (const Known& k : known())
        for (const double part : {1.0, 0.3}) {
            const ShapedWall law = law_of(k).scaled(attracting(law_of(k).factor_of(part)));
            EXPECT_NEAR(law.energy(law.deepest()), -part * law_work, 1e-12) << k.name;
            EXPECT_NEAR(law.force(law.deepest()), 0.0, 1e-9) << k.name;
            double least = 0.0, strongest = 0.0;
            for (double g = -1.0; g < 20.0; g += 1e-3) {
                least = std::min(least, law.energy(g));
                strongest = std::max(strongest, -law.force(g));
            }
            EXPECT_NEAR(least, -part * law_work, 1e-5) << k.name;
            EXPECT_LE(strongest, law.largest_tension() * (1.0 + 1e-12)) << k.name;
            EXPECT_NEAR(strongest, law.largest_tension(), 1e-4 * strongest) << k.name;
        }
}

/// Parameter-free: the force is the slope of the energy, and the stiffness that of the force, to
/// rounding between the ends of a line.
TEST(WallShape, DerivativesAreItsOwn) {
    for (const Known& k : known()) {
        const ShapedWall law = law_of(k);
        const ShapedWall::Shape shape = k.shape.shape();
        for (int row = 0; row + 1 < ShapedWall::rows; row += 7) {
            const double from = law_range * shape.force[4 * row],
                         to = law_range * shape.force[4 * row + 4];
            const double g = 0.5 * (from + to), h = 0.25 * (to - from);
            const double slope = (law.energy(g - h) - law.energy(g + h)) / (2.0 * h);
            const double size = std::abs(law.energy(g)) / h;
            EXPECT_NEAR(law.force(g), slope, 1e-13 * size + 1e-15) << k.name << " " << g;
            EXPECT_NEAR(law.stiffness_at(g), (law.force(g - h) - law.force(g + h)) / (2.0 * h),
                        1e-13 * std::abs(law.force(g)) / h + 1e-14)
                << k.name << " " << g;
            EXPECT_GE(law.stiffness_at(g), law.softest() - 1e-12);
        }
    }
}

/// A law with a factor is the derivative of its own energy too, also below a shape that begins at
/// the wall, where the pull of the shape goes with the factor and the repulsion does not.
TEST(WallShape, WithAFactorItsForceIsItsSlope) {
    for (const Known& k : known()) {
        const ShapedWall law = law_of(k);
        const auto part = ShapedWall::Terms<double>(law).scaled(attracting(0.4));
        const double h = 1e-7 * law_range;
        for (const double g :
             {-0.01 * law_range, -0.0003 * law_range, 0.613 * law_range, 1.501 * law_range}) {
            if (k.shape.shape().repels && g < 0.0) continue;
            const double slope = (part.energy(g - h) - part.energy(g + h)) / (2.0 * h);
            EXPECT_NEAR(part.force(g), slope, 1e-5 * std::abs(slope) + 1e-8) << k.name << " " << g;
        }
    }
}

/// The force is one that falls and one that rises, and both end in none.
TEST(WallShape, IsConvexAndConcave) {
    for (const Known& k : known()) {
        const ShapedWall::Shape shape = k.shape.shape();
        double falls = 0.0, rises = 0.0;
        for (int row = 0; row + 1 < ShapedWall::rows; ++row) {
            const double *here = shape.force + 4 * row, *convex = shape.convex + 4 * row;
            const double step = convex[5] - convex[1];
            falls = std::max(falls, step);
            rises = std::min(rises, here[5] - here[1] - step);
            EXPECT_EQ(here[0], convex[0]);
        }
        EXPECT_LE(falls, 0.0) << k.name;
        EXPECT_GE(rises, -1e-12) << k.name;
        EXPECT_EQ(shape.convex[4 * (ShapedWall::rows - 1) + 1], 0.0) << k.name;
        EXPECT_EQ(shape.force[4 * (ShapedWall::rows - 1) + 1], 0.0) << k.name;
    }
}

/// A site that goes to its rest loses energy, whatever holds it, and comes to where no force is
/// left.
TEST(WallShape, SitesGoDownhill) {
    std::mt19937 random(5);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    for (const Known& k : known())
        for (int i = 0; i < 3000; ++i) {
            const ShapedWall law = law_of(k).scaled(attracting(between(0.01, 1.0)));
            const double spring = std::pow(10.0, between(-3.0, 4.0)), target = between(-3.0, 12.0);
            const auto energy = [&](double g) {
                return law.energy(g) + 0.5 * spring * (g - target) * (g - target);
            };
            double g = between(-0.5, 8.0);
            for (int step = 0; step < 30; ++step) {
                const double next = at_rest(law, g, target, spring);
                ASSERT_LE(energy(next), energy(g) + 1e-12 * (1.0 + std::abs(energy(g))))
                    << k.name << " " << spring << " " << target << " " << g;
                g = next;
            }
            if (spring < -3.0 * law.softest()) continue;
            ASSERT_NEAR(spring * (target - g) + law.force(g), 0.0,
                        1e-6 * (1.0 + std::abs(spring * target)))
                << k.name << " " << spring << " " << target;
        }
}

/// All values of a register are one number's.
TEST(WallShape, WithManyRangesItIsAnExponential) {
    const WallShape shape = WallShape::power(100.0);
    const ShapedWall law(shape.shape(), law_work, 100.0 * law_range, law_stiffness);
    const ExponentialWall limit(law_work, law_range, law_stiffness);
    for (double g = -0.5; g < 6.0; g += 0.1) {
        EXPECT_NEAR(law.energy(g), limit.energy(g), 0.01 * law_work) << g;
        EXPECT_NEAR(law.force(g), limit.force(g), 0.02 * law_work / law_range) << g;
    }
}

TEST(WallShape, Keys) {
    const io::Scratch scratch;
    std::string rows;
    for (int i = 0; i < 600; ++i) {
        const double g = 0.7 + 0.1 * i;
        rows += std::to_string(g) + " " +
                std::to_string(5.0 * (std::pow(2.0 / g, 9) - 3.0 * std::pow(2.0 / g, 3))) + "\n";
    }
    const std::string table = "interface.table=" + scratch.write("law.txt", rows);
    const auto resolved = [&](std::vector<std::string> keys) {
        keys.insert(keys.end(),
                    {"interface.kind=wall", "drive.path=relax", "interface.adhesion=31.2"});
        if (keys[0] != "interface.law=table") keys.push_back("interface.range=1.7");
        return read_case_text("[surface]\nsites = 32\nrms = 1\n", "shape.toml", keys);
    };
    const double area = 2.6 * 2.6, pressure = 31.2e-3 / 1.7 / units::gigapascal;
    const auto expect = [&](const std::vector<std::string>& keys, double tension) {
        const Case c = resolved(keys);
        EXPECT_NEAR(c.flat.work_of_adhesion, 31.2, 1e-9) << keys[0];
        EXPECT_NEAR(c.flat.largest_tension, tension * pressure, 0.02 * tension * pressure)
            << keys[0];
        EXPECT_GT(c.flat.stiffness * area, 0.0) << keys[0];
        EXPECT_TRUE(c.refused.empty()) << keys[0];
        return c;
    };
    expect({"interface.law=dugdale"}, 1.0);
    expect({"interface.law=power"}, 3.0);
    expect({"interface.law=power", "interface.exponent=2"}, 2.0);
    const double nine = 4.5 * (std::pow(2.5, -4.0 / 6.0) - std::pow(2.5, -10.0 / 6.0)),
                 eight = 8.0 / 3.0 * (std::pow(3.0, -0.5) - std::pow(3.0, -1.5));
    Scene scene; // the description of the key gives the tensions of both
    const std::string doc = bind(scene).find("interface.law")->doc;
    for (const double tension : {nine, eight})
        EXPECT_NE(doc.find(fmt::format("{:.3f} T", tension)), std::string::npos) << doc;
    EXPECT_NEAR(expect({"interface.law=9-3"}, nine).flat.separation, 1.7, 1e-5);
    EXPECT_NEAR(expect({"interface.law=8-2"}, eight).flat.separation, 1.7, 1e-5);
    const Case read = expect({"interface.law=table", table}, nine * 1.7 / 2.0);
    EXPECT_NEAR(read.flat.separation, 2.0, 0.02);
    EXPECT_EQ(read.table_files.size(), 1u);
    EXPECT_TRUE(read.table_digest);
    const auto refused = [&](const std::vector<std::string>& keys, const char* words) {
        try {
            resolved(keys);
            ADD_FAILURE() << words;
        } catch (const io::SceneError& error) {
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    refused({"interface.law=table", "interface.table=nothing.txt"}, "there is no such file");
    refused({"interface.law=table",
             "interface.table=" + scratch.write("up.txt", "1 -1\n2 -2\n3 -3\n4 -4\n5 -5\n6 -6\n"
                                                          "7 -7\n8 -8\n")},
            "no well and repulsion");
}

/// Without an attraction a law is its repulsion: the flat reference of each is that of the
/// exponential law, and a block comes to the same state, bit for bit.
TEST(WallShape, WithoutAttractionIsTheRepulsion) {
    const auto of = [](const std::string& law) {
        return read_case_text("[surface]\nsites = 16\nrms = 0.5\n[interface]\nkind = \"wall\"\n"
                              "adhesion = 0\nrange = 3\n[drive]\npath = [\"relax\"]\nload = 100\n",
                              "none.toml", {"interface.law=" + law});
    };
    const Case exponential = of("exponential");
    for (const char* law : {"dugdale", "power"}) {
        const Case c = of(law);
        EXPECT_EQ(c.flat.stiffness, exponential.flat.stiffness) << law;
        EXPECT_EQ(c.flat.work_of_adhesion, 0.0) << law;
        EXPECT_EQ(c.flat.largest_tension, 0.0) << law;
        EXPECT_EQ(c.tolerance, exponential.tolerance) << law;
        const auto state = [](const Case& scene) {
            test::PathCase solids(scene.simulation.block, surface_of(scene),
                                  scene.simulation.interface);
            return solids.relax(Constraint::load(scene.simulation.drive.load_force), 1e-6);
        };
        const RelaxedState one = state(c), other = state(exponential);
        EXPECT_EQ(one[Term::elastic], other[Term::elastic]) << law;
        EXPECT_EQ(one.in_contact, other.in_contact) << law;
        EXPECT_GT(one.in_contact, 0) << law;
    }
}

/// A rough block comes to one state over each shape, whatever is held, without energy that appears.
TEST(WallShape, StatesAreEquilibria) {
    for (const Known& k : known()) {
        test::PathCase c(test::paper_block(16, 16, 0), test::self_affine(16, 1.0), law_of(k));
        test::KeptPath path = c.approached(1e-3, 0.1);
        EXPECT_LT(test::energy(path.now()), 0.0) << k.name;
        const RelaxedState held = c.relax(Constraint::top(c.block.top()), 1e-5);
        EXPECT_NEAR(test::energy(held), test::energy(path.now()), 1e-3 * -test::energy(held))
            << k.name;
        const std::vector<StepRecord> out = test::follow(path, Segment::pull_off);
        // What the drive gave is what was lost.
        const double given = path.work(Segment::approach) + path.work(Segment::pull_off),
                     lost = path.lost(Segment::approach) + path.lost(Segment::pull_off);
        const double error =
            path.uncertainty(Segment::approach) + path.uncertainty(Segment::pull_off);
        EXPECT_NEAR(given, lost, error + 2e-3 * -test::energy(held)) << k.name;
    }
}
