// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A work of adhesion for each site over a wall: formulas, files, and what such a wall does.
#include "engine/case/case.hpp"
#include "engine/units.hpp"
#include "io/error.hpp"
#include "support/path_case.hpp"
#include "support/run_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using namespace asperity;

namespace {

using test::paper::a;
constexpr double area = a * a;
const ExponentialWall law(0.7, 1.3, 24.0);
constexpr int sites = 16;

/// A wall with this law, and works of adhesion that are so many times the law's.
InterfaceOptions with_field(const WallLaw& wall, const std::vector<double>& part) {
    InterfaceOptions o = test::over(wall);
    auto field = std::make_shared<SiteMap>();
    field->name = "adhesion";
    field->sites = static_cast<int>(std::lround(std::sqrt(static_cast<double>(part.size()))));
    field->largest = 1.0;
    field->values = part;
    o.maps[SiteMapOf::adhesion] = field;
    o.find_mean_law_factors();
    return o;
}

std::vector<double> random_parts(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<double> part(sites * sites);
    for (double& p : part)
        p = std::uniform_real_distribution(0.0, 1.0)(random);
    part[7] = 0.0;
    part[100] = 1.0;
    return part;
}

Case case_of(const std::vector<std::string>& keys) {
    std::vector<std::string> all = {"interface.kind=wall", "drive.path=relax"};
    all.insert(all.end(), keys.begin(), keys.end());
    return read_case_text("[surface]\nsites = 32\nkind = \"flat\"\n", "field.toml", all);
}
const SiteMap& field_of(const Case& c) { return *c.simulation.interface.maps[SiteMapOf::adhesion]; }

/// Returns the text of the problems of a scene; empty if it has none.
std::string problems_of(const std::vector<std::string>& keys) {
    try {
        case_of(keys).require_runnable();
        return "";
    } catch (const io::SceneError& error) {
        std::string text;
        for (const io::Problem& p : error.problems())
            text += p.what + " " + p.why + " " + p.fix + "\n";
        return text;
    }
}

std::string file_of(const io::Scratch& scratch, const std::string& name, int rows, int columns,
                    const std::string& each) {
    std::string text;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x)
            text += (x + y == 5 ? each : std::string("40")) + " ";
        text += "\n";
    }
    std::ofstream(scratch / name) << text;
    return scratch / name;
}

} // namespace

/// A uniform field is one law, bit for bit, along a path that jumps.
TEST(AdhesionField, UniformIsTheScalar) {
    const Surface surface = test::self_affine(sites, 1.0);
    test::PathCase one(test::paper_block(sites, sites, 0), surface, law),
        field(test::paper_block(sites, sites, 0), surface,
              with_field(law, std::vector<double>(sites * sites, 1.0)));
    ASSERT_GT(field.interface.bytes(), one.interface.bytes());
    const auto cycle = [](test::PathCase& c) {
        test::KeptPath path = c.path(1e-3);
        path.start();
        std::vector<std::array<double, 5>> rows;
        for (const Segment::Kind kind : {Segment::approach, Segment::pull_off})
            for (const StepRecord& r : test::follow(path, kind))
                rows.push_back({r.top, r.force, r[Term::interface], r[Term::elastic], r.residual});
        return rows;
    };
    EXPECT_EQ(cycle(one), cycle(field));
    const FlatReference flat = flat_reference(one.interface.options(), a, sites, sites),
                        mean = flat_reference(field.interface.options(), a, sites, sites);
    EXPECT_EQ(flat.work_of_adhesion, mean.work_of_adhesion);
    EXPECT_EQ(flat.largest_tension, mean.largest_tension);
    // Through a scene, too.
    const Case scalar = case_of({"interface.adhesion=37.3"}),
               uniform = case_of({"interface.adhesion=rings 37.3 0 20"});
    EXPECT_EQ(scalar.flat.work_of_adhesion, uniform.flat.work_of_adhesion);
    EXPECT_EQ(scalar.tolerance, uniform.tolerance);
    EXPECT_EQ(scalar.longest_step, uniform.longest_step);
    EXPECT_EQ(uniform.scene.interface.adhesion, 37.3);
}

/// Each site has the law of its own work of adhesion, as deep as it, over one repulsion.
TEST(AdhesionField, EachSiteHasItsLaw) {
    const std::vector<double> part = random_parts(1);
    test::PathCase c(test::paper_block(sites, sites, 0), test::self_affine(sites, 0.5),
                     with_field(law, part));
    c.block.set_uniform(0.0);
    const double height = 0.4;
    const auto force = c.block.interface_force();
    c.interface.set_reference_height(height);
    const InterfaceSums sums = c.interface.sweep(c.block.lowest_layer(), force, {.observe = true});
    double energy = 0.0;
    for (int y = 0; y < sites; ++y)
        for (int x = 0; x < sites; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * sites + x);
            const ExponentialWall alone(0.7 * part[i], 1.3, 24.0);
            const double gap = height - c.surface.height[i];
            EXPECT_NEAR(force.z(x, y), alone.force(gap), 1e-14) << x << " " << y;
            EXPECT_NEAR(c.interface.wall()->stiffness_at(x, y, gap), alone.stiffness_at(gap),
                        1e-12);
            energy += alone.energy(gap);
        }
    EXPECT_NEAR(sums.energy.value(), energy, 1e-9);
    const InterfaceMaps maps = c.interface.maps(c.block.lowest_layer());
    ASSERT_EQ(maps.of_sites.size(), 1u);
    EXPECT_EQ(maps.of_sites[0].second, part);
}

/// Flat rigid surfaces: the mean of the works, and no more.
TEST(AdhesionField, RigidSurfacesHaveTheMean) {
    const ExponentialWall hard(0.7, 1.3, 1e6);
    const std::vector<double> part = random_parts(2);
    const double mean = std::accumulate(part.begin(), part.end(), 0.0) / (sites * sites);
    const FlatReference flat = flat_reference(with_field(hard, part), a, sites, sites);
    EXPECT_NEAR(flat.work_of_adhesion, 1e3 * 0.7 * mean / area, 1e-6 * flat.work_of_adhesion);
    EXPECT_NEAR(flat.largest_tension, 0.7 * mean / 1.3 / area / units::gigapascal,
                1e-6 * flat.largest_tension);
    const Case stripes = case_of({"interface.adhesion=stripes 10 30 41.6"});
    EXPECT_NEAR(stripes.flat.work_of_adhesion, 20.0, 1e-3);
}

/// The energies of a block over a field change by the work of the forces, at a relaxed state.
TEST(AdhesionField, ForceIsTheGradient) {
    test::PathCase c(test::paper_block(sites, sites, 0), test::self_affine(sites, 1.0),
                     with_field(law, random_parts(3)));
    c.block.set_uniform(-c.interface.start_height());
    const auto at = [&](double top) {
        return c.relax(Constraint::top(top - c.interface.start_height()), 1e-9);
    };
    const double h = 1e-4;
    const RelaxedState below = at(1.0 - h), here = at(1.0), above = at(1.0 + h);
    EXPECT_NEAR((test::energy(above) - test::energy(below)) / (2.0 * h), -here.top_force,
                1e-4 * std::abs(here.top_force));
    EXPECT_NEAR(here.top_force, here.force, 1e-6 * sites * sites);
}

TEST(AdhesionField, Formulas) {
    const double edge = 32 * a;
    const auto count = [](const SiteMap& map, double value) {
        return std::count(map.values.begin(), map.values.end(), value);
    };
    const Case stripes = case_of({"interface.adhesion=stripes 10 mJ/m^2 50 mJ/m^2 2.08 nm"});
    const SiteMap& s = field_of(stripes);
    EXPECT_EQ(s.sites, 32);
    EXPECT_NEAR(s.largest, 50.0 / 16.02176634, 1e-9);
    EXPECT_EQ(count(s, s.largest), 512);
    for (int x = 0; x < 32; ++x)
        EXPECT_EQ(s.at(x, 5), s.at(x % 8 < 4 ? 0 : 4, 0)) << x;
    EXPECT_EQ(stripes.scene.interface.adhesion, s.largest);
    EXPECT_TRUE(stripes.notes.empty());

    const SiteMap discs = field_of(case_of({"interface.adhesion=discs 1 2 10 41.6"}));
    EXPECT_NEAR(static_cast<double>(count(discs, 2.0)), 4 * std::numbers::pi * 100 / area, 12.0);
    EXPECT_EQ(discs.at(8, 8), 2.0);
    EXPECT_EQ(discs.at(0, 0), 1.0);

    const SiteMap rings = field_of(case_of({"interface.adhesion=rings 10 0.4 20"}));
    EXPECT_DOUBLE_EQ(rings.at(16, 16), 14.0);
    for (const int x : {3, 19, 30}) {
        const double r = std::hypot(x - 16, 9 - 16) * a;
        EXPECT_NEAR(rings.at(x, 9), 10 * (1 + 0.4 * std::cos(2 * std::numbers::pi * r / 20)), 1e-9);
    }

    const std::vector<std::string> patches = {"surface.sites=128",
                                              "interface.adhesion=patches 1 3 15 7"};
    const SiteMap random = field_of(case_of(patches));
    EXPECT_EQ(count(random, 3.0), 128 * 64);
    EXPECT_EQ(random.values, field_of(case_of(patches)).values);
    EXPECT_NE(
        random.values,
        field_of(case_of({"surface.sites=128", "interface.adhesion=patches 1 3 15 8"})).values);
    // Signs of a Gaussian field are correlated by (2/pi) asin C.
    for (const int lag : {2, 5}) {
        double sum = 0.0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x)
                sum += (random.at(x, y) - 2.0) * (random.at((x + lag) % 128, y) - 2.0);
        const double c = std::exp(-std::pow(lag * a / 15.0, 2));
        EXPECT_NEAR(sum / (128 * 128), 2.0 / std::numbers::pi * std::asin(c), 0.06) << lag;
    }
    EXPECT_LT(edge, 100.0);
    // A period that does not fit is rounded, and said to be.
    const auto notes = case_of({"interface.adhesion=stripes 1 2 30"}).notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("27.7333 Å, of which 3 fit"), std::string::npos) << notes[0];
}

/// Each map is told what is wrong with it, and one that is 0 somewhere is refused where nothing
/// would press or repel there.
TEST(AdhesionField, EachMapIsTold) {
    const std::string both =
        problems_of({"interface.adhesion=none.txt", "interface.hardness=stripes 0 1 20",
                     "drive.path=[\"approach\"]", "drive.mode=quasistatic"});
    EXPECT_NE(both.find("neither a file nor a formula"), std::string::npos) << both;
    EXPECT_NE(both.find("a hardness above 0 at each site"), std::string::npos) << both;
    const std::string field = "interface.adhesion=stripes 0 10 20";
    EXPECT_EQ(problems_of({field}), "");
    const std::string repels = problems_of({field, "interface.law=9-3", "interface.range=3"});
    EXPECT_NE(repels.find("nothing would repel there"), std::string::npos) << repels;
}

/// A pattern that the sites do not resolve is refused, one whose mean they miss is noted, and a
/// seed is a whole number: 32 sites, 2.6 Å apart.
TEST(AdhesionField, FormulasAreResolvedBySites) {
    struct Row {
        const char *formula, *words; ///< words of the refusal or the note; "": neither
    };
    const Row refused[] = {{"stripes 1 5 2.6", "has a period of 2.6 Å"},
                           {"stripes 0 2 5.19", "surface.spacing = 2.595"},
                           {"rings 50 0.5 0.4 nm", "take a period of 5.2 Å at least"},
                           {"discs 1 9 2 20", "has a diameter of 4 Å"},
                           {"discs 1 9 3 5", "has a distance of 5 Å"},
                           {"patches 2 3 1e-10 7", "has a correlation length of 1e-10 Å"},
                           {"patches 2 3 10 1.5", "has a seed of 1.5"},
                           {"patches 2 3 10 1e300", "a seed is a whole number"}};
    for (const Row& row : refused) {
        const std::string key = std::string("interface.adhesion=") + row.formula;
        const std::string text = problems_of({key});
        EXPECT_NE(text.find(row.words), std::string::npos) << row.formula << "\n" << text;
    }
    const Row made[] = {{"stripes 1 5 5.2", ""},
                        {"stripes 3 1 0.52 nm", ""},
                        {"stripes 1 5 27.8", ""},
                        {"discs 1 3 10 41.6", ""},
                        {"discs 1 9 3 10.4", "mean over the sites"},
                        {"discs 1 9 12 20", ""}, // they overlap
                        {"rings 10 0.05 20", ""},
                        {"rings 10 0.4 20", "is 10.12 meV/Å^2, and that of"},
                        {"rings 10 0.9 150", "that of \"rings\" without an end 10 meV/Å^2"},
                        {"patches 1 3 5.2 0", ""},
                        {"patches 1 3 15 9007199254740992", ""}};
    for (const Row& row : made) {
        const Case c = case_of({std::string("interface.adhesion=") + row.formula});
        std::string notes;
        for (const std::string& note : c.notes)
            if (note.find("the mean over") != std::string::npos) notes += note;
        EXPECT_EQ(notes.empty(), std::string(row.words).empty()) << row.formula << notes;
        EXPECT_NE(notes.find(row.words), std::string::npos) << row.formula << notes;
    }
}

TEST(AdhesionField, Files) {
    const io::Scratch scratch;
    const auto keys = [&](const std::string& file, std::vector<std::string> more = {}) {
        more.push_back("interface.adhesion=" + file);
        return more;
    };
    const std::string map = file_of(scratch, "w.txt", 32, 32, "10");
    const Case plain = case_of(keys(map));
    EXPECT_EQ(field_of(plain).at(2, 3), 10.0);
    EXPECT_EQ(field_of(plain).at(2, 4), 40.0);
    EXPECT_EQ(plain.inputs().back(), map);
    ASSERT_TRUE(field_of(plain).digest);
    const SiteMap joule = field_of(case_of(keys(map, {"interface.adhesion_unit=mJ/m^2"})));
    EXPECT_NEAR(joule.at(0, 0), 40.0 / 16.02176634, 1e-9);
    // The middle of a wider map, and of one that is not square.
    const std::string wide = file_of(scratch, "wide.txt", 64, 64, "10");
    const SiteMap middle = field_of(case_of(keys(wide, {"interface.adhesion_size=166.4"})));
    EXPECT_EQ(middle.values, std::vector<double>(32 * 32, 40.0));
    const std::string high = file_of(scratch, "high.txt", 34, 32, "10");
    EXPECT_NE(problems_of(keys(high)).find("interface.adhesion_crop = \"middle\""),
              std::string::npos);
    EXPECT_EQ(field_of(case_of(keys(high, {"interface.adhesion_crop=middle"}))).at(2, 2), 10.0);
    const std::string hole = file_of(scratch, "hole.txt", 32, 32, "nan");
    EXPECT_NE(problems_of(keys(hole)).find("the work of adhesion in row"), std::string::npos);
    EXPECT_NEAR(field_of(case_of(keys(hole, {"interface.adhesion_missing=fill"}))).at(2, 3), 40.0,
                1e-6);

    const auto refused = [&](const std::vector<std::string>& with, const char* words) {
        const std::string text = problems_of(with);
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    };
    refused(keys(wide), "has 64 x 64 values");
    refused(keys(file_of(scratch, "minus.txt", 32, 32, "-1")), "has a value of -1");
    refused(keys(map, {"interface.adhesion_unit=nN"}), "no unit of energy per area");
    refused(keys(map, {"interface.adhesion_size=10"}), "stretch the map on purpose");
    refused(keys("nothing.npy"), "is neither a file nor a formula");
    refused(keys("stripes 1 2"), "has 2 numbers");
    refused(keys("stripes 1 -2 10"), "zero or more");
    refused(keys("stripes 1 2 1 ps"), "has '1 ps'");
    refused(keys("stripes 1 2 500"), "a period of 500");
    refused(keys("rings 1 1.5 10"), "would be negative");
    refused(keys(map, {"interface.law=smeared"}), "there is no wall with a law of its own");
    refused(keys(map, {"interface.kind=atoms"}), "there is no wall with a law of its own");
    refused(keys("stripes 0 2 10", {"interface.law=9-3"}), "is 0 at some sites");
    refused({"interface.adhesion=0", "interface.law=8-2"}, "repels by itself");
}
