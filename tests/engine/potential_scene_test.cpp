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
#include <cstdint>
#include <functional>
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

/// Lennard-Jones: the energy at a distance, eV.
double lennard_jones(double r) {
    const double s6 = std::pow(3.28 / r, 6);
    return 0.4 * s6 * (s6 - 1.0);
}

/// The same at so many distances, as a file.
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
            std::vector<std::string> keys = {std::string("interface.potential=") + potential,
                                             ratio};
            if (keys.front().ends_with("table")) keys.push_back(file);
            const Case c = case_of(keys);
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
        {{"interface.potential=table", file, "interface.cutoff=3"},
         "take a cutoff beyond the well"},
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
    const Case milli =
        case_of({"interface.potential=table", "interface.table=" + table(scratch, 300, 100.0)});
    EXPECT_NE(fmt::format("{}", fmt::join(milli.notes, "\n")).find("100 eV deep"),
              std::string::npos);
    EXPECT_NE(refusal({"interface.morse_a=2"}).find("morse_a = 2 1/Å has no effect"),
              std::string::npos);
}

/// Of rows with this text made of the distance, from 2.4 to 13.2 Å.
template <class Row>
std::string rows(const io::Scratch& scratch, int count, const std::string& above, const Row& row) {
    std::string text = above;
    for (int i = 0; i < count; ++i)
        text += row(i, 2.4 + 10.8 * i / (count - 1)) + "\n";
    return scratch.write(fmt::format("rows{}.txt", std::hash<std::string>()(text)), text);
}

std::string refusal_of_table(const std::string& file, std::vector<std::string> keys = {}) {
    keys.insert(keys.end(), {"interface.potential=table", "interface.table=" + file});
    return refusal(keys);
}

/// Tables that are too coarse are refused, and the number of rows that the message names is enough.
TEST(PotentialOfAScene, ACoarseTableIsRefusedAndItsRemedyIsEnough) {
    const io::Scratch scratch;
    const double exact = case_of({}).flat.work_of_adhesion;
    const auto made = [&](int count) {
        return rows(scratch, count, "", [](int, double r) {
            return fmt::format("{:.17g} {:.17g}", r, lennard_jones(r));
        });
    };
    int coarse = 0;
    for (const int count : {8, 10, 12, 16, 24, 30, 40, 48, 60, 80, 150}) {
        const std::string said = refusal_of_table(made(count));
        if (said.empty()) {
            const Case c = case_of({"interface.potential=table", "interface.table=" + made(count)});
            const double error = std::abs(c.flat.work_of_adhesion / exact - 1.0);
            EXPECT_LE(error, *c.table_error) << count;
            EXPECT_LE(*c.table_error, 0.01) << count;
            continue;
        }
        ++coarse;
        const std::size_t about = said.find("give about ");
        ASSERT_NE(about, std::string::npos) << count << ": " << said;
        EXPECT_EQ(refusal_of_table(made(std::stoi(said.substr(about + 11)))), "") << said;
    }
    EXPECT_GE(coarse, 5);
}

/// Energies that scatter, by noise or by few digits, are refused, with a cutoff that helps.
TEST(PotentialOfAScene, NoiseInATableIsFound) {
    const io::Scratch scratch;
    const auto noisy = [&](double noise) {
        std::uint32_t state = 1;
        return rows(scratch, 300, "", [&](int, double r) {
            state = state * 1664525u + 1013904223u;
            return fmt::format("{:.17g} {:.17g}", r,
                               lennard_jones(r) + noise * (state / 2147483648.0 - 1.0));
        });
    };
    const auto rounded = [&](int digits) {
        return rows(scratch, 300, "", [&](int, double r) {
            return fmt::format("{:.6f} {:.{}f}", r, lennard_jones(r), digits);
        });
    };
    EXPECT_NE(refusal_of_table(noisy(2e-3)).find("do not determine a curve"), std::string::npos);
    EXPECT_EQ(refusal_of_table(noisy(1e-8)), "");
    EXPECT_EQ(refusal_of_table(rounded(7)), "");
    const std::string said = refusal_of_table(rounded(5));
    EXPECT_NE(said.find("repels again beyond its well"), std::string::npos) << said;
    const std::size_t at = said.find("interface.cutoff = ");
    ASSERT_NE(at, std::string::npos) << said;
    const std::string key = fmt::format("interface.cutoff={}", std::stod(said.substr(at + 19)));
    EXPECT_EQ(refusal_of_table(rounded(5), {key}), "");
    // A barrier that the rows resolve is a property of the potential: a note.
    const std::string barrier = rows(scratch, 300, "", [](int, double r) {
        return fmt::format("{:.17g} {:.17g}", r,
                           lennard_jones(r) + 0.02 * std::exp(-(r - 6.0) * (r - 6.0)));
    });
    EXPECT_EQ(refusal_of_table(barrier), "");
    const Case c = case_of({"interface.potential=table", "interface.table=" + barrier});
    EXPECT_NE(fmt::format("{}", fmt::join(c.notes, "\n")).find("on the way in a pair climbs"),
              std::string::npos);
}

/// Each column is read as what its name says it is, or the table is refused with a remedy.
TEST(PotentialOfAScene, ColumnsOfATableAreReadByName) {
    const io::Scratch scratch;
    const double exact = case_of({}).flat.work_of_adhesion;
    const auto force = [](double r) {
        const double s6 = std::pow(3.28 / r, 6);
        return 2.4 / r * s6 * (2.0 * s6 - 1.0);
    };
    const auto three = [&](int, double r) {
        return fmt::format("{:.12g} {:.12g} {:.12g}", r, force(r), lennard_jones(r));
    };
    const auto four = [&](int i, double r) {
        return fmt::format("{} {:.12g} {:.12g} {:.12g}", i + 1, r, lennard_jones(r), force(r));
    };
    const auto nanometres = [&](int, double r) {
        return fmt::format("{:.12g} {:.12g}", 0.1 * r, 1e3 * lennard_jones(r));
    };
    const std::string lammps = "# DATE: 2026-01-01 UNITS: metal\n# Pair potential lj/cut for atom "
                               "types 1 1: i,r,energy,force\n\nLJ\nN 300 R 2.4 13.2\n\n";
    const std::string files[] = {
        rows(scratch, 300, "# r F V\n", three),
        rows(scratch, 300, "r, force, energy\n", three),
        rows(scratch, 300, "# r (Å)  F (eV/Å)  V (eV)\n", three),
        rows(scratch, 300, "# i r E F\n", four),
        rows(scratch, 300, lammps, four),
        rows(scratch, 300, "# r(nm) V(meV)\n", nanometres),
        rows(scratch, 300, "# r/nm, V/meV\n", nanometres),
        rows(scratch, 300, "# of the notebook, page 3\n",
             [](int, double r) { return fmt::format("{:.12g} {:.12g}", r, lennard_jones(r)); })};
    for (const std::string& file : files) {
        ASSERT_EQ(refusal_of_table(file), "") << file;
        const Case c = case_of({"interface.potential=table", "interface.table=" + file});
        EXPECT_NEAR(c.flat.work_of_adhesion / exact, 1.0, 1e-5) << file;
        const std::string notes = fmt::format("{}", fmt::join(c.notes, "\n"));
        const std::size_t columns =
            file == files[5] || file == files[6] || file == files[7] ? 2 : 3;
        EXPECT_EQ(notes.find("not read") != std::string::npos, columns > 2) << notes;
    }
    const auto says = [&](const std::string& file, const std::string& said) {
        const std::string found = refusal_of_table(file);
        EXPECT_NE(found.find(said), std::string::npos) << said << "\n" << found;
        EXPECT_NE(found.find("fix: "), std::string::npos) << found;
    };
    says(rows(scratch, 300, "", three), "has 3 columns");
    says(rows(scratch, 300, "", four), "has 4 columns");
    says(rows(scratch, 300, "# a b c\n", three), "do not tell one distance and one energy");
    says(rows(scratch, 300, "# r F\n", nanometres), "has the columns r and F");
    says(rows(scratch, 300, "# r V(kcal/mol)\n", nanometres), "1 kcal/mol is 0.0433641 eV");
    std::string real = lammps;
    real.replace(real.find("metal"), 5, "real");
    says(rows(scratch, 300, real, four), "units of style real");
    says(scratch.write("two.txt", lammps + "1 2 3 4\n2 3 4 5\nLJ2\nN 2\n"), "second table");
    says(scratch.write("ragged.txt", "1 2\n2 3 4\n"), "has more than 2 numbers");
}

} // namespace
