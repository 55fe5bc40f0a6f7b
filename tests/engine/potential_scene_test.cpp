// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// interface.potential through a whole run: the same laws for every potential, and a table of
// Lennard-Jones as Lennard-Jones.
#include "engine/theory/rough_interface.hpp"
#include "engine/theory/theory_case.hpp"
#include "support/message.hpp"
#include "support/run_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace asperity;
using test::number;

namespace {

Case case_of(const std::vector<std::string>& keys) {
    std::vector<std::string> all = {"surface.sites=16", "surface.rms=0.6", "block.thickness=16",
                                    "drive.mode=quasistatic", "drive.tolerance=1e-6"};
    all.insert(all.end(), keys.begin(), keys.end());
    return read_case_text("", "scene.toml", all);
}

/// Lennard-Jones at so many distances, as a file.
std::string table(const io::Scratch& scratch, int points, double depth = 0.1) {
    std::string text = "# r, Å   V, eV\n\n";
    for (int i = 0; i < points; ++i) {
        const double r = 1.6 + 12.4 * i / (points - 1), s6 = std::pow(3.28 / r, 6);
        text += fmt::format("{:.12f} {:.17g}   # row {}\n", r, 4.0 * depth * s6 * (s6 - 1.0), i);
    }
    return scratch.write("table.txt", text);
}

std::string refusal(const std::vector<std::string>& keys) {
    return test::message_of<io::SceneError>([&] { case_of(keys).require_runnable(); });
}

TEST(PotentialOfAScene, TableOfLennardJonesIsLennardJones) {
    const io::Scratch scratch;
    const io::Json exact = test::run_scene(case_of({}), scratch / "exact");
    const io::Json made = test::run_scene(
        case_of({"interface.potential=table", "interface.table=" + table(scratch, 1500)}),
        scratch / "made");
    for (const char* name : {"delta_gamma", "binding_energy", "contact_fraction"})
        EXPECT_NEAR(number(made, name) / number(exact, name), 1.0, 1e-6) << name;
    // A path with instabilities is known to what it states.
    const std::string work = "work_of_drive.";
    for (const std::string part : {"approach", "pull_off"})
        EXPECT_NEAR(number(made, work + part), number(exact, work + part),
                    number(exact, work + "uncertainty." + part) +
                        number(made, work + "uncertainty." + part));
    EXPECT_TRUE(made["interface"]["table_digest"].is_string());
    EXPECT_FALSE(exact["interface"].contains("table_digest"));
}

TEST(PotentialOfAScene, EnergiesOfAPathBalanceForEveryPotential) {
    const io::Scratch scratch;
    for (const std::vector<std::string>& keys : std::vector<std::vector<std::string>>{
             {"interface.potential=morse"},
             {"interface.potential=morse", "interface.kind=wall", "interface.law=smeared"},
             {"interface.potential=table", "interface.table=" + table(scratch, 300, 0.07)}}) {
        const io::Json r = test::run_scene(case_of(keys), scratch / keys.back().substr(10, 6));
        const double state = number(r, "binding_energy");
        EXPECT_GT(state, 10.0);
        for (const auto& [part, sign] : {std::pair{"approach", 1.0}, {"pull_off", -1.0}})
            EXPECT_NEAR(sign * (number(r, fmt::format("lost.{}", part)) -
                                number(r, fmt::format("work_of_drive.{}", part))),
                        state, 1e-3 * state)
                << keys[0] << part;
        EXPECT_LT(std::abs(number(r, "energy.balance_error")), 1e-3);
    }
}

/// The flat reference sums site by site; the theory, ring by ring.
TEST(PotentialOfAScene, FlatReferenceAndTheoryAgree) {
    const io::Scratch scratch;
    const std::string file = "interface.table=" + table(scratch, 300, 0.2);
    for (const char* potential : {"lennard-jones", "morse", "table"})
        for (const char* ratio : {"surface.lattice_ratio=1", "surface.lattice_ratio=1.6"}) {
            const Case c = case_of({std::string("interface.potential=") + potential, file, ratio});
            const theory::FlatInterface flat = flat_interface(c);
            // Of another spacing: all registries in the theory, eight along an axis in the box.
            const double tolerance = c.substrate() == 16 ? 1e-9 : 1e-5;
            const double u = c.flat.separation;
            EXPECT_NEAR(-1e3 * flat.energy(u) / c.flat.work_of_adhesion, 1.0, tolerance);
            EXPECT_LT(flat.energy(u), flat.energy(u - 1e-3));
            EXPECT_LT(flat.energy(u), flat.energy(u + 1e-3));
        }
}

TEST(PotentialOfAScene, RefusesByName) {
    const io::Scratch scratch;
    const std::string file = "interface.table=" + table(scratch, 300);
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"interface.potential=table"}, "there is no such file"},
        {{"interface.potential=table", file, "interface.tail=true"}, "interface.tail = true"},
        {{"interface.potential=table", file, "interface.kind=wall", "interface.law=smeared"},
         "with a wall"},
        {{"interface.potential=table", file, "interface.cutoff=15"}, "beyond the table"},
        {{"interface.potential=table", file, "interface.cutoff=3"}, "leaves no attraction"},
        {{"interface.potential=morse", "interface.morse_a=0.1"}, "attractive down to r = 0"},
        {{"interface.law=lennard-jones"}, "smeared"},
        {{"interface.potential=table",
          "interface.table=" + scratch.write("short.txt", "1 2\n2 1\n3\n")},
         "short.txt:3 has fewer than 2 numbers"},
        {{"interface.potential=table", "interface.table=" + scratch.write("no.txt", "1 2\nx 1\n")},
         "no.txt:2 'x' is no finite number"},
        {{"interface.potential=table",
          "interface.table=" + scratch.write("inf.txt", "1 2\n2 inf\n")},
         "inf.txt:2 'inf' is no finite number"}};
    for (const auto& [keys, said] : cases)
        EXPECT_NE(refusal(keys).find(said), std::string::npos) << said << "\n" << refusal(keys);
    EXPECT_EQ(refusal({"interface.potential=table", file}), "");
    // Twelve rows of Lennard-Jones, and one in meV.
    std::string coarse;
    for (int i = 0; i < 12; ++i) {
        const double r = 2.4 + 10.8 * i / 11, s6 = std::pow(3.28 / r, 6);
        coarse += fmt::format("{} {}\n", r, 0.4 * s6 * (s6 - 1.0));
    }
    EXPECT_NE(refusal({"interface.potential=table",
                       "interface.table=" + scratch.write("coarse.txt", coarse)})
                  .find("its 12 rows are too far apart"),
              std::string::npos);
    const Case milli =
        case_of({"interface.potential=table", "interface.table=" + table(scratch, 300, 100.0)});
    EXPECT_NE(fmt::format("{}", fmt::join(milli.notes, "\n")).find("100 eV deep"),
              std::string::npos);
    const Case idle = case_of({"interface.morse_a=2"});
    EXPECT_NE(fmt::format("{}", fmt::join(idle.notes, "\n")).find("morse_a has no effect"),
              std::string::npos);
}

} // namespace
