// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Scenes whose substrate is a file of atoms: a surface written out as atoms gives the run of the
// surface, boxes are compared, and what does not go together is refused.
#include "engine/case/case.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/run_result.hpp"
#include "io/error.hpp"
#include "io/json.hpp"

#include "support/atoms.hpp"
#include "support/cases.hpp"
#include "support/message.hpp"
#include "support/scratch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace asperity {
namespace {

constexpr const char* atoms_scene = "[surface]\nsites = 16\nrms = 0.8\n[block]\nthickness = 16\n"
                                    "layers_per_level = 3\n[drive]\nvelocity = 100\n";

Case case_of(const std::vector<std::string>& overrides) {
    return read_case_text(atoms_scene, "test.toml", overrides);
}
/// Of atoms in a file; the rms of the text above is left out.
Case case_over(const std::string& file, std::vector<std::string> overrides = {}) {
    overrides.insert(overrides.begin(), {"surface.kind=atoms", "surface.file=" + file});
    std::string text = atoms_scene;
    text.erase(text.find("rms = 0.8\n"), 10);
    return read_case_text(text, "test.toml", overrides);
}

/// The surface's atoms, raised by `up`; from the last to the first, for their order does not
/// matter.
io::AtomsFile as_atoms(const Surface& surface, double up = 0.0) {
    const double b = surface.length / surface.sites;
    io::AtomsFile atoms{{"Au"}, {}, surface.length, surface.length, {}, {}, {}};
    for (int i = surface.sites * surface.sites - 1; i >= 0; --i) {
        atoms.x.push_back(b * (i % surface.sites));
        atoms.y.push_back(b * (i / surface.sites));
        atoms.z.push_back(surface.height[static_cast<std::size_t>(i)] + up);
        atoms.type.push_back(0);
    }
    return atoms;
}

void add(io::AtomsFile& atoms, double x, double y, double z) {
    atoms.x.push_back(x);
    atoms.y.push_back(y);
    atoms.z.push_back(z);
    atoms.type.push_back(0);
}

/// Force, energies and heights of every step of a fast approach that turns on contact.
std::vector<double> path_over(const Case& c, const Surface& surface) {
    test::Driven s(c.simulation, surface, Communicator(), c.grid(0));
    s.start(9.0);
    std::vector<double> numbers;
    for (int n = 0; n < 900; ++n) {
        const StepRecord& now = s.step(n % 10 == 0);
        s.drive().observe({now.time, now.force, 0.0, false});
        numbers.insert(numbers.end(), {now.force, now.mean_height});
        if (now.observed)
            numbers.insert(numbers.end(), {now[Term::interface], now[Term::elastic],
                                           static_cast<double>(now.in_contact)});
    }
    return numbers;
}

TEST(AtomsScene, OfASurfaceWrittenOutIsTheRunOfThatSurface) {
    const io::Scratch scratch;
    for (const char* ratio : {"surface.lattice_ratio=1", "surface.lattice_ratio=1.618"}) {
        const Case made = case_of({ratio});
        Surface surface = surface_of(made);
        const Case read = case_over(write_atoms(scratch / "rough.h5", as_atoms(surface, 3.0)));
        const Surface atoms = surface_of(read);
        ASSERT_EQ(atoms.atoms.size(), surface.height.size());
        // The last atom of the file is the first height.
        const double shift = atoms.atoms.z.back() - surface.height.front();
        for (double& h : surface.height)
            h += shift;
        const std::vector<double> one = path_over(made, surface), other = path_over(read, atoms);
        ASSERT_EQ(one.size(), other.size());
        for (std::size_t i = 0; i < one.size(); ++i)
            ASSERT_NEAR(one[i], other[i], 1e-7 * (1.0 + std::abs(one[i]))) << ratio << " " << i;
        EXPECT_GT(*std::max_element(one.begin(), one.end()), 100.0)
            << "the scene must touch, or nothing is tested";
    }
}

TEST(AtomsScene, HasTheHeightsOfItsTopmostAtoms) {
    const io::Scratch scratch;
    const Surface surface = surface_of(case_of({}));
    const io::AtomsFile atoms = as_atoms(surface, 5.0);
    const Surface found = surface_of(case_over(write_atoms(scratch / "a.h5", atoms)));
    for (std::size_t i = 0; i < surface.height.size(); ++i)
        ASSERT_NEAR(found.height[i], surface.height[i], 1e-12);
    EXPECT_NEAR(found.statistics.rms, surface.statistics.rms, 1e-12);
    EXPECT_EQ(*std::max_element(found.height.begin(), found.height.end()),
              *std::max_element(found.atoms.z.begin(), found.atoms.z.end()));
    // An atom below another is no height; a site without one is filled.
    io::AtomsFile deeper = atoms, fewer = atoms;
    add(deeper, 0.3, 0.2, -4.0);
    const Surface with_more = surface_of(case_over(write_atoms(scratch / "b.h5", deeper)));
    EXPECT_EQ(with_more.height, found.height);
    EXPECT_EQ(with_more.atoms.size(), 257u);
    for (auto* axis : {&fewer.x, &fewer.y, &fewer.z})
        axis->pop_back();
    fewer.type.pop_back();
    const Surface with_hole = surface_of(case_over(write_atoms(scratch / "c.h5", fewer)));
    EXPECT_TRUE(std::isfinite(with_hole.height[0]));
    EXPECT_NE(with_hole.notes.back().find("1 of 256 sites"), std::string::npos)
        << with_hole.notes.back();
    // Atoms half way between points, to the digits of a file: each point has the topmost of four.
    io::AtomsFile between = atoms;
    for (auto* axis : {&between.x, &between.y})
        for (double& at : *axis)
            at = std::round(1e3 * (at + 0.5 * surface.length / 16)) / 1e3;
    const Surface above = surface_of(case_over(write_atoms(scratch / "d.h5", between)));
    EXPECT_EQ(above.notes.back().find("no atom nearest"), std::string::npos);
    const auto height = [&](const Surface& s, int x, int y) {
        return s.height[static_cast<std::size_t>((y + 16) % 16 * 16 + (x + 16) % 16)];
    };
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const double topmost =
                std::max({height(surface, x, y), height(surface, x - 1, y),
                          height(surface, x, y - 1), height(surface, x - 1, y - 1)});
            EXPECT_NEAR(height(above, x, y) - height(above, 0, 0),
                        topmost - std::max({height(surface, 0, 0), height(surface, -1, 0),
                                            height(surface, 0, -1), height(surface, -1, -1)}),
                        1e-9);
        }
}

/// All that a scene is refused for.
std::string refusal(const std::function<void()>& work) {
    return test::message_of<io::SceneError>(work);
}

TEST(AtomsScene, RefusesWhatDoesNotGoTogether) {
    const io::Scratch scratch;
    const std::string file = write_atoms(scratch / "a.h5", as_atoms(surface_of(case_of({}))));
    const std::vector<std::pair<std::string, std::string>> refused = {
        {"surface.rms=1", "surface.rms = 1"},
        {"surface.radius=1000", "surface.radius = 1000"},
        {"surface.lattice_ratio=1.618", "surface.lattice_ratio = 1.618"},
        {"surface.file_size=41.6", "surface.file_size = 41.6"},
        {"surface.file_unit=nm", "surface.file_unit = \"nm\""},
        {"surface.detrend=plane", "surface.detrend = \"plane\""},
        {"surface.resample=band-limited", "surface.resample = \"band-limited\""},
        {"interface.tail=true", "interface.tail = true"},
        {"numerics.device=emulated", "numerics.device"}};
    for (const auto& [key, said] : refused) {
        const std::string what = refusal([&, k = key] { case_over(file, {k}); });
        EXPECT_NE(what.find(said), std::string::npos) << key << "\n" << what;
    }
    const std::string wall = refusal([&] {
        case_over(file, {"interface.kind=wall", "drive.path=relax"});
    });
    EXPECT_NE(wall.find("interface.kind"), std::string::npos) << wall;
    const std::string none = refusal([&] { case_over("no-such-file.h5"); });
    EXPECT_NE(none.find("there is no such file"), std::string::npos) << none;
    EXPECT_EQ(refusal([&] { examine(case_over(file)); }), "");
}

TEST(AtomsScene, RefusesAnotherBoxAndAtomsThatStandTwice) {
    const io::Scratch scratch;
    const Surface surface = surface_of(case_of({}));
    const io::AtomsFile atoms = as_atoms(surface);
    const std::string file = write_atoms(scratch / "a.h5", atoms);
    const std::string box = refusal([&] { examine(case_over(file, {"surface.sites=32"})); });
    EXPECT_NE(box.find("is 41.6 x 41.6 Å, and the block's 83.2 x 83.2 Å"), std::string::npos)
        << box;
    EXPECT_NE(box.find("surface.sites = 16"), std::string::npos) << box;
    // On the box's far edge, and a hundredth of an ångström from its image across the corner.
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {41.595, 41.595}, {41.59, 0.01}}) {
        io::AtomsFile twice = atoms;
        add(twice, x, y, surface.height[0]);
        const std::string what =
            refusal([&] { examine(case_over(write_atoms(scratch / "b.h5", twice))); });
        EXPECT_NE(what.find("atoms 256 and 257"), std::string::npos) << x << " " << y << what;
    }
}

/// The surface's atoms, those at even places of another type.
io::AtomsFile as_atoms_of_two(const Surface& surface) {
    io::AtomsFile atoms = as_atoms(surface);
    atoms.types = {"C", "Au"};
    for (std::size_t i = 1; i < atoms.type.size(); i += 2)
        atoms.type[i] = 1;
    return atoms;
}

TEST(AtomsScene, HasPairsByType) {
    const io::Scratch scratch;
    const Surface made = surface_of(case_of({}));
    const std::string two = write_atoms(scratch / "two.h5", as_atoms_of_two(made));
    const auto over_two = [&](const std::string& pairs) {
        return case_over(two, {"interface.cutoff=12", "interface.pairs=" + pairs});
    };
    const Case c = over_two("['Au 0.1 3.28 13', 'Zn 1 3.3', 'C 20 meV 0.3 nm']");
    std::vector<LennardJones> table;
    for (const PairPotential& p : c.simulation.interface.by_type)
        table.push_back(std::get<LennardJones>(p));
    ASSERT_EQ(table.size(), 3u);
    EXPECT_EQ(table[0].cutoff, 13.0);
    EXPECT_EQ(table[2].epsilon, 0.02);
    EXPECT_EQ(table[2].r0, 3.0);
    EXPECT_EQ(table[2].cutoff, 12.0);
    const Surface surface = surface_of(c);
    ASSERT_EQ(surface.atoms.type.size(), 256u);
    for (std::size_t i = 0; i < 256; ++i)
        ASSERT_EQ(surface.atoms.type[i], i % 2 == 0 ? 2 : 0);
    EXPECT_NE(surface.notes[0].find("2 types: C (128 atoms), Au (128)"), std::string::npos)
        << surface.notes[0];
    // The strongest of the flat layers bounds the time step: that of zinc, of no atom, too.
    const auto weak = over_two("['Au 0.1 3.28', 'C 0.02 3']");
    EXPECT_GT(c.scales.stiffness, 5.0 * weak.scales.stiffness);
    EXPECT_LT(c.longest_timestep, weak.longest_timestep);
    EXPECT_EQ(c.flat.stiffness, weak.flat.stiffness) << "a unit of measure";
    EXPECT_EQ(refusal([&] { examine(c); }), "");

    for (const auto& [pairs, said] : std::vector<std::pair<std::string, std::string>>{
             {"[]", "are of 2 types: C (128 atoms), Au (128)"},
             {"['Au 0.1 3.28']", "has no type 'C'"},
             {"['Au 0.1 3.28', 'Ca 0.1 3.28']", "has no type 'C'"},
             {"['Au 0.1 3.28', 'C 0.1 3.28', 'Au 0.2 3']", "stands there already"},
             {"['Au 0.1', 'C 0.1 3.28']", "2 to 3 numbers are needed, and 1"},
             {"['Au morse 0.1 3.28', 'C 0.1 3.28']", "type morse D a r_min"},
             {"['Au morsel 0.1 3.28', 'C 0.1 3.28']", "a potential 'morsel'"},
             {"['Au table no.txt', 'C 0.1 3.28']", "there is no such file"},
             {"['Au morse 0.1 1.5 -3', 'C 0.1 3.28']", "whose r_min is '-3'"},
             {"['Au 0.1 3.28 13 1', 'C 0.1 3.28']", "and 4"},
             {"['']", "is no pair"},
             {"['Au -0.1 3.28', 'C 0.1 3.28']", "whose epsilon is '-0.1'"},
             {"['Au 0.1 0', 'C 0.1 3.28']", "whose r0 is '0'"},
             {"['Au 0.1 nan', 'C 0.1 3.28']", "\"Au 0.1 nan\""},
             {"['Au 0.1 nm 3.28', 'C 0.1 3.28']", "whose epsilon is '0.1 nm'"},
             {"['Au 0.1 3.28 21', 'C 0.1 3.28']", "cutoff is above 20.8"},
             {"['Au 0.1 3.28 3.5', 'C 0.1 3 3.2']", "no attraction"},
             {"['Au morse 0.1 1.5 3.5 3.5', 'C morse 0.1 1.5 3.25 3.25']", "no attraction"}}) {
        const std::string what = refusal([&, p = pairs] { examine(over_two(p)); });
        EXPECT_NE(what.find(said), std::string::npos) << pairs << "\n" << what;
    }
    const std::string map = refusal([] { case_of({"interface.pairs=['Au 0.1 3.28']"}); });
    EXPECT_NE(map.find("interface.pairs"), std::string::npos) << map;
}

TEST(AtomsScene, OfOneTypeWithItsPairIsTheSameRun) {
    const io::Scratch scratch;
    const std::string file = write_atoms(scratch / "a.h5", as_atoms(surface_of(case_of({}))));
    const Case keys = case_over(file, {"interface.epsilon=0.08", "interface.r0=3.1"});
    const Case pairs = case_over(
        file, {"interface.epsilon=0.08", "interface.r0=3.1", "interface.pairs=['Au 0.08 3.1']"});
    EXPECT_EQ(path_over(keys, surface_of(keys)), path_over(pairs, surface_of(pairs)));
    // The type decides, not the keys.
    const Case others = case_over(file, {"interface.pairs=['Au 0.08 3.1']"});
    EXPECT_EQ(path_over(keys, surface_of(keys)), path_over(others, surface_of(others)));
    const std::string two =
        write_atoms(scratch / "two.h5", as_atoms_of_two(surface_of(case_of({}))));
    const Case mixed = case_over(two, {"interface.pairs=['Au 0.08 3.1', 'C 0.02 3']"});
    EXPECT_NE(path_over(keys, surface_of(keys)), path_over(mixed, surface_of(mixed)));
}

TEST(AtomsScene, CountsItsMemoryAndHasNoTheory) {
    const io::Scratch scratch;
    for (const char* ratio : {"surface.lattice_ratio=1", "surface.lattice_ratio=2.3"})
        for (const char* precision : {"numerics.precision=double", "numerics.precision=mixed"}) {
            const Surface made = surface_of(case_of({ratio, "surface.sites=48"}));
            const bool typed = precision == std::string("numerics.precision=mixed");
            const Case c = case_over(
                write_atoms(scratch / "a.h5", typed ? as_atoms_of_two(made) : as_atoms(made)),
                {"surface.sites=48", precision,
                 typed ? "interface.pairs=['C 0.1 3.28', 'Au 0.1 3']" : "interface.pairs=[]"});
            const Surface surface = surface_of(c);
            const Interface interface(surface, c.grid(0).tile(0), 2.6, c.simulation.interface);
            // As large as the case: what is rehearsed is what it takes, whatever the heights.
            const double tables = make_plan(c, 0).bytes[Piece::interface];
            EXPECT_GE(tables, 0.8 * static_cast<double>(interface.bytes())) << ratio;
            EXPECT_LE(tables, 2.0 * static_cast<double>(interface.bytes())) << ratio;
            EXPECT_FALSE(c.effects.theory);
            const io::Json result = run_result(c, surface, {}).json();
            EXPECT_EQ(result["surface"]["atoms"], surface.atoms.size());
            EXPECT_TRUE(result["theory"]["persson"].contains("note"));
            EXPECT_FALSE(result["theory"]["persson"].contains("gamma_eff"));
        }
}

} // namespace
} // namespace asperity
