// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A wall in place of atoms: its laws, the states over it, and problems with closed forms.
#include "engine/case/case.hpp"
#include "engine/case/wall_shape.hpp"
#include "engine/statics/quasistatic.hpp"
#include "engine/statics/zero_load.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "support/cases.hpp"
#include "support/path_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

using namespace asperity;
using test::over;

namespace {

using std::numbers::pi;
using test::paper::a;
const LennardJones pair{0.1, 3.28, 13.12};

const WallShape power = WallShape::power(3.0), nine_three = WallShape::nine_three(),
                eight_two = WallShape::eight_two();

std::vector<WallLaw> laws() {
    return {SmearedWall(pair, 1.0 / (a * a), false),
            SmearedWall(pair, 1.0 / (a * a), true),
            SmearedWall(Morse(), 1.0 / (a * a), false),
            SmearedWall(Morse(), 1.0 / (a * a), true),
            ExponentialWall(0.7, 1.3, 24.0),
            ExponentialWall(0.0, 1.0, 24.0),
            ShapedWall(power.shape(), 0.7, 3.9, 24.0),
            ShapedWall(nine_three.shape(), 0.7, 2.3, 0.0),
            ShapedWall(eight_two.shape(), 0.7, 2.3, 0.0)};
}

BlockOptions paper_block_of(int sites, double spacing) {
    BlockOptions o = test::paper_block(sites, sites, 0);
    o.spacing = spacing;
    return o;
}

/// A frictionless block over a wall, at its strongest attraction.
struct AtWall : test::PathCase {
    double height, tolerance = 1e-6;

    AtWall(const Surface& s, double spacing, const WallLaw& law)
        : AtWall(s, paper_block_of(s.sites, spacing), law) {}
    AtWall(const Surface& s, const BlockOptions& o, const WallLaw& law)
        : PathCase(o, s, law),
          height(height_of_strongest_attraction(block, interface, s.statistics.lowest,
                                                test::paper_scales().length)) {
        block.set_uniform(height - interface.start_height());
    }
    RelaxedState relax(const Constraint& constraint, const RelaxOptions& how = {}) {
        return PathCase::relax(constraint, tolerance, how);
    }
};

template <class Law>
double at_rest(const Law& law, double gap, double target, double spring) {
    return typename Law::template Terms<double>(law).equilibrium(gap, target, spring);
}

double modulus() { return test::paper_block(8, 8, 0).contact_modulus(); }

} // namespace

TEST(WallLaw, ForceIsTheSlopeOfItsEnergy) {
    for (const WallLaw& any : laws())
        std::visit(
            [](const auto& law) {
                const double h = 1e-5;
                for (double g = -0.4; g < 15.0; g += 0.0371) {
                    if (std::abs(g) < 2 * h || std::abs(g - 13.12) < 2 * h) continue;
                    const double slope = (law.energy(g - h) - law.energy(g + h)) / (2 * h);
                    EXPECT_NEAR(law.force(g), slope, 1e-7 * (1.0 + std::abs(slope))) << g;
                    EXPECT_GE((law.force(g - h) - law.force(g + h)) / (2 * h),
                              law.softest() - 1e-5);
                }
                if (std::isfinite(law.reach())) {
                    EXPECT_EQ(law.force(law.reach() + 1.0), 0.0);
                }
                EXPECT_TRUE(std::isnan(law.force(std::nan(""))));
            },
            any);
}

/// The smeared layer is what many atoms with as little energy each make.
TEST(WallLaw, SmearedLayerIsTheLimitOfManyAtoms) {
    const double level = 0.0, fine = 0.1, fraction = fine * fine / (a * a);
    const SmearedWall law(pair, 1.0 / (a * a), false);
    for (double g : {2.5, 3.28, 4.0, 7.0, 12.0}) {
        const PairSum sum = pair_sum({&level, 1, fine, 0, 1}, pair, 0.5 * fine, 0.5 * fine, g);
        EXPECT_NEAR(law.energy(g), fraction * sum.energy, 2e-4 * std::abs(law.energy(g))) << g;
        EXPECT_NEAR(law.force(g), fraction * sum.force[2], 2e-3 * std::abs(law.force(g)) + 1e-5)
            << g;
    }
}

TEST(WallLaw, SiteComesToRestUnderItsSpring) {
    for (const WallLaw& any : laws())
        std::visit(
            [](const auto& law) {
                const double spring = 4.0 - 2.0 * law.softest();
                for (double target = -1.0; target < 9.0; target += 0.217) {
                    double g = std::max(target, 2.0);
                    for (int i = 0; i < 20; ++i)
                        g = at_rest(law, g, target, spring);
                    EXPECT_NEAR(spring * (target - g) + law.force(g), 0.0, 1e-9)
                        << target << " " << g;
                }
            },
            any);
}

/// Held by less than the attraction's steepest, a site may rest at two places: it stays on its side
/// of what lies between them. The place downhill of a start, by a walk in short steps.
TEST(WallLaw, SiteGoesDownhillToTheNearestRest) {
    for (const WallLaw& any : laws())
        std::visit(
            [](const auto& law) {
                if (law.softest() == 0.0) return; // does not attract
                const double spring = -0.05 * law.softest();
                for (double target = -1.0; target < 12.0; target += 0.593)
                    for (double from = 3.0; from < 9.0; from += 0.371) {
                        const auto pull = [&](double g) {
                            return spring * (target - g) + law.force(g);
                        };
                        const double way = pull(from) > 0.0 ? 1e-3 : -1e-3;
                        double rest = from;
                        while (pull(rest + way) * way > 0.0)
                            rest += way;
                        double g = from;
                        for (int i = 0; i < 2000; ++i)
                            g = at_rest(law, g, target, spring);
                        EXPECT_NEAR(g, rest, 2e-3) << target << " from " << from;
                    }
            },
            any);
}

/// The well of the exponential law is as deep as it says, however soft the repulsion.
TEST(WallLaw, DeepestByItsWorkOfAdhesion) {
    for (const double stiffness : {1e5, 24.0, 1.0, 0.05}) {
        const ExponentialWall law(0.7, 1.3, stiffness);
        double least = 0.0, at = 0.0;
        for (double g = -20.0; g < 1.0; g += 1e-3)
            if (law.energy(g) < least) least = law.energy(g), at = g;
        EXPECT_NEAR(law.force(-law.tension() / stiffness), 0.0, 1e-12);
        EXPECT_NEAR(at, -law.tension() / stiffness, 1.1e-3);
        EXPECT_NEAR(law.energy(-law.tension() / stiffness), -0.7, 1e-12) << stiffness;
        EXPECT_LE(-least, 0.7 + 1e-12);
    }
}

/// Two flat solids: closed forms.
TEST(Wall, FlatOnFlat) {
    const auto flat = [](const WallLaw& law) { return flat_reference(over(law), a, 64, 64); };
    // 6/5 π ε r0² / a⁴ at g = r0, without a cutoff.
    const FlatReference smeared = flat(laws()[1]);
    EXPECT_NEAR(smeared.work_of_adhesion, 1e3 * 1.2 * pi * 0.1 * 3.28 * 3.28 / std::pow(a, 4),
                1e-6);
    EXPECT_NEAR(smeared.separation, 3.28, 1e-9);
    const ExponentialWall law(0.7, 1.3, 24.0);
    const FlatReference found = flat(law);
    // Of the attraction A and its work A + A²/(2 ρ² K).
    const double area = a * a, hard = 1.3 * 1.3 * 24.0;
    const double attraction = hard * (std::sqrt(1.0 + 2.0 * 0.7 / hard) - 1.0);
    EXPECT_NEAR(found.separation, -attraction / 1.3 / 24.0, 1e-12);
    EXPECT_NEAR(found.work_of_adhesion, 1e3 * 0.7 / area, 1e-9);
    EXPECT_NEAR(found.largest_tension, attraction / 1.3 / area / units::gigapascal, 1e-9);
    // A block over a flat wall ends there.
    AtWall state(test::flat_surface(16), a, law);
    const RelaxedState s = state.relax(Constraint::load(0.0));
    EXPECT_NEAR(-1e3 * test::energy(s) / (256 * area), found.work_of_adhesion, 1e-6);
    EXPECT_EQ(s.in_contact, 256);
}

/// Δγ of a scene is its interface.adhesion, with a block as soft as rubber and one as hard as gold.
TEST(Wall, WorkOfAdhesionIsTheScenes) {
    for (const char* young : {"2 MPa", "77 GPa"})
        for (const char* range : {"2.5 Å", "10 Å"}) {
            const std::vector<std::string> keys = {
                "interface.kind=wall", "drive.path=relax", "interface.adhesion=3.12",
                std::string("interface.range=") + range, std::string("block.young=") + young};
            const Scene scene =
                read_scene_text("[surface]\nsites = 32\nspacing = \"39 Å\"\n", "wall.toml", keys);
            EXPECT_NEAR(resolve(scene).flat.work_of_adhesion, 3.12, 3.12e-9)
                << young << " " << range;
        }
}

/// Where the relaxation starts: the strongest attraction of all heights, by a scan of its own.
TEST(Wall, StartsWhereTheAttractionIsStrongest) {
    const Surface s = test::self_affine(16, 2.0);
    for (const WallLaw& law : laws()) {
        const AtWall at(s, a, law);
        const auto force = [&](double height) {
            double sum = 0.0;
            for (const double below : s.height)
                sum += std::visit([&](const auto& l) { return l.force(height - below); }, law);
            return sum;
        };
        double strongest = 0.0, where = at.interface.attraction_grows_down_to();
        for (double height = 15.0; height > -8.0; height -= 0.02)
            if (const double now = force(height); now < strongest) strongest = now, where = height;
        EXPECT_NEAR(at.height, where, 0.11); // found in steps of 0.1 Å
    }
}

/// The closest distance is the least gap, and nothing where a site is pressed in; so are the maps.
TEST(Wall, ClosestIsTheLeastGap) {
    const Surface s = test::self_affine(32, 1.0);
    const double highest = s.statistics.highest;
    for (const WallLaw& law : laws()) {
        AtWall at(s, a, law);
        at.block.set_uniform(0.0);
        for (const double gap : {2.0, 0.25, -0.25}) {
            at.interface.set_reference_height(highest + gap);
            const InterfaceSums sums = at.interface.sweep(
                at.block.lowest_layer(), at.block.interface_force(), {.observe = true});
            EXPECT_NEAR(count_contacts(sums, Communicator()).closest, std::max(gap, 0.0), 1e-12);
            const InterfaceMaps maps = at.interface.maps(at.block.lowest_layer());
            for (std::size_t i = 0; i < s.height.size(); ++i)
                EXPECT_NEAR(maps.distance[i], std::max(highest + gap - s.height[i], 0.0), 1e-12);
        }
    }
}

/// A block of this modulus over a wall as rough as a scene says.
struct SoftOverRough {
    Scene scene;
    Case setup;
    AtWall at;
    explicit SoftOverRough(const std::vector<std::string>& keys)
        : scene(of(keys)), setup(resolve(scene)),
          at(surface_of(setup), setup.simulation.block, *setup.simulation.interface.wall) {}

private:
    static Scene of(const std::vector<std::string>& keys) {
        return read_scene_text(R"(
[surface]
sites = 32
rolloff = 2
[block]
thickness = 32
poisson = 0.49
[interface]
kind = "wall"
[drive]
path = ["relax"]
)",
                               "wall.toml", keys);
    }
};

/// Rubber: its attraction is ten thousand times as steep as the block is stiff.
TEST(Wall, SoftAndRoughComesToRest) {
    for (const char* young : {"2 MPa", "100 MPa"})
        for (const char* range : {"2.5 Å", "10 Å"}) {
            SoftOverRough soft({std::string("block.young=") + young, "surface.spacing=39",
                                "surface.rms=100", "interface.adhesion=3.12",
                                std::string("interface.range=") + range});
            soft.at.tolerance = 1e-3;
            const RelaxedState s = soft.at.relax(Constraint::load(0.0));
            EXPECT_LT(s.iterations, 20000) << young << " " << range;
            EXPECT_NEAR(s.force, 0.0, 1e-2 * soft.at.sites() * 1e-3);
            EXPECT_LT(test::energy(s), 0.0);
        }
}

/// A relaxation from the strongest attraction and a slow approach with the top plane held are two
/// ways down. No site passes a barrier on either, and they end in one state.
TEST(Wall, RelaxationEndsWhereASlowApproachEnds) {
    for (const char* young : {"0.3", "1", "3"})
        for (const char* seed : {"1", "2"}) {
            SoftOverRough soft({"surface.sites=16", "surface.rms=3", "surface.spacing=2.6",
                                std::string("surface.seed=") + seed, "block.thickness=16",
                                std::string("block.young=") + young});
            soft.at.tolerance = 1e-4;
            const RelaxedState found = soft.at.relax(Constraint::load(0.0));
            test::KeptPath path = soft.at.approached(1e-3, 0.05);
            const double at_end = test::energy(path.now());
            EXPECT_LT(at_end, 0.0);
            EXPECT_NEAR(test::energy(found), at_end, 1e-4 * -at_end) << young << " " << seed;
        }
}

/// No point takes thousands of iterations, whatever is held. (Sites that move no further than a
/// part of the range in an iteration, or a uniform wave with momentum, oscillate for ever at some.)
TEST(Wall, HeldPathsEnd) {
    for (const Constraint::Of along : {Constraint::Of::top, Constraint::Of::mean_height}) {
        SoftOverRough at({"surface.seed=471837", "surface.hurst=0.729", "surface.rolloff=3",
                          "surface.rms=0.838", "surface.spacing=2.6", "block.young=61.1",
                          "block.poisson=0.303", "block.thickness=48", "interface.law=exponential",
                          "interface.adhesion=102.5", "interface.range=1.04"});
        test::KeptPath path = at.at.path(1e-3, PathOptions().step, 0.0, along);
        path.start();
        for (const Segment::Kind branch : {Segment::approach, Segment::pull_off})
            test::follow(path, branch);
        EXPECT_LT(path.iterations(), 20000);
    }
}

/// An attraction that fades within two spacings of a contact's edge is named, and a tolerance that
/// is coarse beside the forces of a soft block.
TEST(Wall, NarrowAttractionsAndCoarseTolerancesAreNoted) {
    const auto noted = [](const std::vector<std::string>& keys, const char* words) {
        const auto notes = SoftOverRough(keys).setup.notes;
        return std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
            return note.find(words) != std::string::npos;
        });
    };
    // E* = 77 / (1 - 0.49²) GPa, 100 meV/Å²: two spacings at 0.907 Å.
    for (const auto& [range, narrow] : {std::pair{"0.89", true}, {"0.92", false}})
        EXPECT_EQ(noted({"block.young=77", "surface.spacing=2.6",
                         std::string("interface.range=") + range},
                        "single rows of sites hold the edge"),
                  narrow);
    for (const auto& [young, coarse] : {std::pair{"0.0001", true}, {"77", false}})
        EXPECT_EQ(noted({std::string("block.young=") + young, "drive.tolerance=0.02"},
                        "is coarse for this block"),
                  coarse);
}

/// Newton's method finds the state that a relaxation from the plane finds, in as many products
/// whatever the number of sites: without the response of the block in its preconditioner
/// (wall_newton.hpp) they grow as the root of it.
TEST(Wall, NextPointTakesAFewProductsAtAnySize) {
    using Of = Constraint::Of;
    for (const Of of : {Of::top, Of::mean_height, Of::load}) {
        double last = 1000.0;
        for (const int sites : {64, 256}) {
            SurfaceOptions rough;
            rough.sites = sites;
            rough.length = a * sites;
            rough.rms = 1.0;
            rough.rolloff = sites / 32.0; // the same roughness
            const auto at_rest = [&rough] {
                return AtWall(make_surface(rough), a, ExponentialWall(0.05, 1.3, 24.0));
            };
            AtWall at = at_rest(), fresh = at_rest();
            const double load = 1e-3 * at.sites() * a * a, more = 1.05 * load;
            const RelaxedState pressed = at.relax(Constraint::load(load));
            Constraint next = Constraint::load(more);
            if (of == Of::top) next = Constraint::top(at.block.top() - 0.02);
            if (of == Of::mean_height) next = Constraint::mean_height(pressed.mean_height - 0.02);
            RelaxOptions near;
            near.start = Start::near;
            const RelaxedState point = at.relax(next, near);
            EXPECT_LE(point.iterations, 25) << sites << " sites, " << static_cast<int>(of);
            EXPECT_LE(static_cast<double>(point.iterations), 1.5 * last);
            last = static_cast<double>(point.iterations);
            const RelaxedState anew = fresh.relax(next);
            EXPECT_NEAR(point.force, anew.force, 1e-4 * load);
            EXPECT_NEAR(test::energy(point), test::energy(anew), 1e-6 * -test::energy(anew));
            EXPECT_EQ(point.in_contact, anew.in_contact);
        }
    }
}

/// Residuals of the sites, each within the tolerance, do not add up to a force on the top plane:
/// a soft spring would take it for a part of the pull.
TEST(Wall, NextPointIsInBalanceAtAnyTolerance) {
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
        AtWall at(test::self_affine(64, 1.0), a, ExponentialWall(0.05, 1.3, 24.0));
        at.tolerance = 1e-8;
        at.relax(Constraint::load(1e-3 * at.sites() * a * a));
        at.tolerance = tolerance;
        RelaxOptions near;
        near.start = Start::near;
        for (int i = 1; i < 6; ++i) {
            const RelaxedState point = at.relax(Constraint::top(at.block.top() - 0.01 * i), near);
            EXPECT_NEAR(point.force, point.top_force, 1.01e-3 * tolerance * at.sites())
                << tolerance << ", " << i;
        }
    }
}

/// A state is one of equilibrium, whatever is held to get there; energies change by the work done.
TEST(Wall, OneStateUnderThreeConstraints) {
    for (const WallLaw& law : laws()) {
        AtWall at(test::self_affine(32, 1.0), a, law);
        const double load = 0.01 * at.sites() * a * a; // 1.6 GPa
        const RelaxedState pressed = at.relax(Constraint::load(load));
        EXPECT_NEAR(pressed.force, load, 1e-4 * load);
        const double top = at.block.top();
        const RelaxedState clamped = at.relax(Constraint::top(top));
        EXPECT_NEAR(clamped.top_force, load, 1e-3 * load);
        const RelaxedState held = at.relax(Constraint::mean_height(pressed.mean_height));
        EXPECT_NEAR(held.top_force, load, 1e-3 * load);
        EXPECT_NEAR(held.mean_height, pressed.mean_height, 1e-9);
        EXPECT_NEAR(held[Term::interface], pressed[Term::interface], 1e-4 * at.sites() * 1e-2);
        EXPECT_EQ(held.in_contact, pressed.in_contact);
        // Force is the slope of the energy along the held height.
        const double d = 1e-3;
        const auto energy = [&](double z) {
            return test::energy(at.relax(Constraint::mean_height(z)));
        };
        const double z = pressed.mean_height;
        EXPECT_NEAR((energy(z - d) - energy(z + d)) / (2 * d), held.top_force, 2e-3 * load);
    }
}

/// Westergaard, J. Appl. Mech. 6, A49 (1939): f = (2/π) asin √(p/p*), to a row of sites at each
/// edge of the contact.
TEST(Wall, WaveWithoutAdhesion) {
    const int n = 128;
    const double h = 2.0, peak = pi * modulus() * h / (n * a);
    for (double p : {0.05, 0.3, 0.6, 0.9}) {
        AtWall at(test::wave(n, h, a), a, ExponentialWall(0.0, 1.0, 24.0));
        const RelaxedState s = at.relax(Constraint::load(p * peak * at.sites() * a * a));
        EXPECT_NEAR(static_cast<double>(s.in_contact) / at.sites(),
                    2.0 / pi * std::asin(std::sqrt(p)), 2.0 / n)
            << p;
    }
}

/// Johnson, Int. J. Solids Struct. 32, 423 (1995), at zero load and α = 0.5: f = 0.5, γ = 0.3408 w.
/// What the range of the attraction adds falls with it, and extrapolates to nothing.
TEST(Wall, AdhesiveWaveAsTheRangeFalls) {
    const double box = 166.4, w = 0.1;
    const double h = std::sqrt(2.0 * w * box / (pi * pi * modulus())) / 0.5;
    std::vector<double> excess;
    for (int n : {32, 64, 128}) {
        const double spacing = box / n, range = 64.0 / n, site = spacing * spacing;
        const ExponentialWall law(w * site, range, 5.0 * pi * modulus() / spacing * site);
        AtWall at(test::wave(n, h, spacing), spacing, law);
        const RelaxedState s = at.relax(Constraint::load(0.0));
        const double flat = flat_reference(over(law), spacing, n, n).work_of_adhesion;
        excess.push_back(-1e3 * test::energy(s) / (box * box) / flat - 0.3408);
    }
    const double first = excess[0] - excess[1], second = excess[1] - excess[2];
    EXPECT_GT(second, 0.0);
    EXPECT_GT(first, 1.7 * second);
    EXPECT_NEAR(excess[2] - second * second / (first - second), 0.0, 0.01);
}

TEST(Wall, IsRefusedWhereItCannotBe) {
    const auto wrong = [](const std::vector<std::string>& keys) {
        std::vector<std::string> all = {"interface.kind=wall"};
        all.insert(all.end(), keys.begin(), keys.end());
        EXPECT_THROW(read_case_text("[surface]\nsites = 32\n", "wall.toml", all), io::SceneError);
    };
    wrong({});
    wrong({"drive.path=relax", "interface.frictionless=false"});
    wrong({"drive.path=relax", "surface.lattice_ratio=2"});
    const Scene scene = read_scene_text("[surface]\nsites = 32\n", "wall.toml",
                                        {"interface.kind=wall", "drive.path=relax"});
    EXPECT_TRUE(scene.interface.frictionless);
}
