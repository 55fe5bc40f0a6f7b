// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Files of substrate atoms: the same atoms from each format, and what is refused.
#include "io/atoms_file.hpp"
#include "io/error.hpp"

#include "support/scratch.hpp"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace asperity::io {
namespace {

/// Three atoms in a box of 10 x 12 Å with its corner at (1, -2, 5); the last one on its far edge.
constexpr double places[3][3] = {{1.5, -1.0, 5.25}, {10.75, 9.0, 6.0}, {11.0, -2.0, 7.0}};

std::string lammps(const std::string& style, const std::string& before, const std::string& between,
                   const std::string& after = "") {
    std::string text = "any title\n\n3 atoms\n1 atom types\n1 11 xlo xhi\n-2 10 ylo yhi\n"
                       "5 8 zlo zhi\n\nMasses\n\n1 197.0 # Au\n\nAtoms" +
                       style + "\n\n";
    for (int i = 0; i < 3; ++i)
        text += fmt::format("{}{}{}{} {} {}{}\n", i + 1, before, i == 1 ? "" : "", between,
                            places[i][0], fmt::format("{} {}", places[i][1], places[i][2]), after);
    return text + "\nVelocities\n\n1 0 0 0\n2 0 0 0\n3 0 0 0\n";
}

std::string xyz(const std::string& second, const std::string& before = "Au ",
                const std::string& after = "") {
    std::string text = "3\n" + second + "\n";
    for (const auto& p : places)
        text += fmt::format("{}{} {} {}{}\n", before, p[0], p[1], p[2], after);
    return text;
}
constexpr const char* lattice = "Lattice=\"10 0 0 0 12 0 0 0 3\" Origin=\"1 -2 5\"";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

void expect_the_atoms(const std::string& text, const std::string& file) {
    SCOPED_TRACE(text);
    const AtomsFile atoms = read_atoms_text(text, file);
    EXPECT_EQ(atoms.width_x, 10.0);
    EXPECT_EQ(atoms.width_y, 12.0);
    EXPECT_EQ(atoms.x, (std::vector<double>{0.5, 9.75, 0.0})); // folded back
    EXPECT_EQ(atoms.y, (std::vector<double>{1.0, 11.0, 0.0}));
    EXPECT_EQ(atoms.z, (std::vector<double>{5.25, 6.0, 7.0}));
}

TEST(AtomsFile, ReadsEveryAtomStyle) {
    const struct {
        const char *style, *before, *after;
    } cases[] = {{" # atomic", " 1", ""},
                 {"", " 1", ""},
                 {"", " 1", " 0 0 -1"},
                 {" # charge", " 1 -0.5", ""},
                 {" # molecular", " 7 1", ""},
                 {" # bond", " 7 1", " 0 0 0"},
                 {" # full", " 7 1 0.25", ""},
                 {"", " 7 1 0.25", ""},
                 {"", " 7 1 0.25", " 0 0 0"},
                 {" # full", " 7 Au 0", ""},
                 {"  # atomic  ", "\t1", " # Au"},
                 {" # atomic", " 1", "\r"}};
    for (const auto& c : cases)
        expect_the_atoms(lammps(c.style, c.before, "", c.after), "solid.data");
    EXPECT_EQ(read_atoms_text(lammps(" # full", " 7 Au 0", ""), "solid.data").types,
              std::vector<std::string>{"Au"});
    EXPECT_EQ(read_atoms_text(lammps("", " 1", ""), "solid.data").format, "LAMMPS data (atomic)");
}

TEST(AtomsFile, ReadsExtendedXyz) {
    expect_the_atoms(xyz(lattice), "solid.xyz");
    expect_the_atoms(xyz(std::string(lattice) + " Properties=species:S:1:pos:R:3 pbc=\"T T F\""),
                     "solid.extxyz");
    expect_the_atoms(
        xyz(std::string(lattice) + " comment=\"a = b\" Properties=id:I:1:pos:R:3:q:R:1", "7 ",
            " 0.5"),
        "solid.xyz");
    expect_the_atoms(xyz(std::string("a {word} energy=-1.0 ") + lattice) + "\n\n", "solid.XYZ");
}

TEST(AtomsFile, KeepsTypesAsTheyAreNamed) {
    const auto types = [](const std::string& text, const char* file) {
        const AtomsFile atoms = read_atoms_text(text, file);
        return std::pair(atoms.types, atoms.type);
    };
    using Types = std::pair<std::vector<std::string>, std::vector<std::int32_t>>;
    const std::string data = replaced(lammps("", " 2", ""), "\n2 2 10.75", "\n2 1 10.75");
    EXPECT_EQ(types(data, "solid.data"), (Types{{"2", "1"}, {0, 1, 0}}));
    const std::string frame = replaced(xyz(lattice), "Au 11", "C 11");
    EXPECT_EQ(types(frame, "solid.xyz"), (Types{{"Au", "C"}, {0, 0, 1}}));
    EXPECT_EQ(types(xyz(std::string(lattice) + " Properties=pos:R:3", ""), "solid.xyz"),
              (Types{{""}, {0, 0, 0}}));
    std::string many = "65\nLattice=\"10 0 0 0 12 0 0 0 3\"\n";
    for (int i = 0; i < 65; ++i)
        many += fmt::format("X{} 0 0 0\n", i);
    try {
        read_atoms_text(many, "solid.xyz");
        ADD_FAILURE() << "65 types";
    } catch (const SceneError& error) {
        EXPECT_NE(format(error.problems().front()).find("too many types"), std::string::npos);
    }
}

TEST(AtomsFile, SaysWhatItFoldedBack) {
    const std::string far = replaced(xyz(lattice), "Au 1.5", "Au -8.5");
    const AtomsFile atoms = read_atoms_text(far, "solid.xyz");
    EXPECT_EQ(atoms.x, (std::vector<double>{0.5, 9.75, 0.0}));
    ASSERT_EQ(atoms.notes.size(), 1u);
    EXPECT_NE(atoms.notes[0].find("1 coordinates"), std::string::npos) << atoms.notes[0];
    EXPECT_TRUE(read_atoms_text(xyz(lattice), "solid.xyz").notes.empty());
}

/// What a bad text is refused for; "" if it was read.
std::string refusal(const std::string& text, const std::string& file) {
    try {
        read_atoms_text(text, file);
    } catch (const SceneError& error) {
        return format(error.problems().front());
    }
    return "";
}

TEST(AtomsFile, RefusesWhatCouldBecomeAWrongNumber) {
    const std::string good = lammps("", " 1", ""), frame = xyz(lattice);
    const auto expect = [&](const std::string& text, const char* file, const char* said) {
        const std::string what = refusal(text, file);
        EXPECT_NE(what.find(said), std::string::npos) << said << "\n" << what << "\n" << text;
        EXPECT_LT(what.size(), 1000u);
    };
    const auto data = [&](const char* from, const std::string& to, const char* said) {
        expect(replaced(good, from, to), "solid.data", said);
    };
    const auto extended = [&](const char* from, const std::string& to, const char* said) {
        expect(replaced(frame, from, to), "solid.xyz", said);
    };
    for (const char* number :
         {"nan", "inf", "-inf", "1e999", "1e-999", "0x10", "1,5", "--1", "1.5e"}) {
        data("1.5 -1", std::string(number) + " -1", "is no coordinate");
        extended("1.5 -1", std::string(number) + " -1", "is no coordinate");
    }
    data("1.5 -1", "1e8 -1", "too large");
    data("1.5 -1", "-9.5 -1", "more than a box away");
    data("-1 5.25", "-1 -5.25", "more than a box away");
    extended("5.25", "-5.25", "more than a box away");
    data("3 atoms", "4 atoms", "announces 4 atoms, and 3 are there");
    data("3 atoms", "2 atoms", "announces 2 atoms, and 3 are there");
    data("3 atoms", "99999999999999999999 atoms", "is no number of atoms");
    data("3 atoms", "-3 atoms", "a substrate of -3 atoms");
    data("3 atoms", "3", "holds no atoms");
    data("\nAtoms", "\nAtomz", "holds no atoms");
    data("1 11 xlo xhi", "", "the box of the atoms is not known");
    data("-2 10 ylo yhi", "10 ylo yhi", "is not whole");
    data("1 11 xlo xhi", "11 1 xlo xhi", "is -10 Å wide");
    data("1 11 xlo xhi", "1 11 xlo xhi\n0.5 0 0 xy xz yz", "not orthogonal");
    data("1 11 xlo xhi", "10 0 0 avec", "not orthogonal");
    data("any title", "title, units = lj", "units of style 'lj'");
    data("any title", "ITEM: TIMESTEP", "LAMMPS dump");
    data("\n2 1 10.75", "\n1 1 10.75", "atom 1 stands twice");
    data("\n2 1 10.75", "\n2 1.5 10.75", "is no type of an atom");
    data("\n2 1 10.75", "\n2.5 1 10.75", "is no number of an atom");
    data("\n2 1 10.75", "\n2 1 0 10.75", "has 6 columns");
    data("Velocities", "Atoms", "two sections");
    expect(lammps("", " 1 0", ""), "solid.data", "may be of several atom styles");
    expect(lammps(" # sphere", " 1 0", ""), "solid.data", "style sphere");
    expect(lammps(" # full", " 1", ""), "solid.data", "atoms of style full have 7");
    expect(lammps("", " 1", "", " 0 0 0.5"), "solid.data", "is no image flag");
    extended("3\n", "4\n", "announces 4 atoms, and 3 are there");
    extended("3\n", "2\n", "goes on behind its last atom");
    extended("3\n", "3 atoms\n", "is no number of atoms");
    expect(frame + frame, "solid.xyz", "goes on behind");
    extended("Lattice=\"10 0", "Lattice=\"10 1", "not orthogonal");
    extended("Lattice=\"10 0", "Lattice=\"10", "has 8 numbers");
    extended("Lattice=\"10 0", "Lattice=\"-10 0", "is -10 Å wide");
    extended(lattice, "Lattice=\"10 0 0", "has no end");
    extended(lattice, "a film of gold", "has no Lattice");
    extended(lattice, std::string(lattice) + " " + lattice, "stands twice");
    extended(lattice, std::string(lattice) + " pbc=\"T F T\"", "is not periodic");
    extended(lattice, std::string(lattice) + " Properties=species:S:1", "no pos:R:3");
    extended(lattice, std::string(lattice) + " Properties=species:S:1:pos:R:x", "is no number");
    extended(lattice, std::string(lattice) + " Properties=pos:R:3:pos:R:3", "pos:R:3 twice");
    std::string many = lattice;
    for (int i = 0; i < 100; ++i)
        many += fmt::format(" key{}=1", i);
    extended(lattice, many, "too many properties");
    extended("Au 10.75", "10.75", "has 3 columns");
    for (const char* file : {"solid.data", "solid.xyz"}) {
        EXPECT_NE(refusal("", file), "") << file;
        EXPECT_NE(refusal(std::string("3\n\0\n", 4), file), "") << file;
        EXPECT_NE(refusal(std::string(1 << 20, 'a') + "\n", file), "") << file;
        EXPECT_NE(refusal("3\n" + std::string(1 << 20, ' ') + "Lattice=\n", file), "") << file;
    }
    EXPECT_EQ(refusal(good, "solid.data") + refusal(frame, "solid.xyz"), "");
    // Cut anywhere.
    for (std::size_t end = 0; end < frame.size(); ++end)
        EXPECT_NE(refusal(frame.substr(0, end), "solid.xyz"), "") << end;
    const std::size_t last = good.find("\nVelocities") - 1;
    for (std::size_t end = 0; end < last; ++end)
        EXPECT_NE(refusal(good.substr(0, end), "solid.data"), "") << end;
}

TEST(AtomsFile, OfAnyBytesIsRefusedOrWhole) {
    std::mt19937_64 random(3);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const std::string inserted = "0123456789.-+eE \t\n#\"=:{}[]nanifxyzR\0\xff";
    int read = 0;
    for (const char* file : {"solid.data", "solid.xyz"}) {
        const std::string good =
            file == std::string("solid.data")
                ? lammps(" # full", " 7 1 0.25", "", " 0 0 0")
                : xyz(std::string(lattice) + " Properties=species:S:1:pos:R:3");
        for (int n = 0; n < 20000; ++n) {
            std::string text = good;
            for (std::size_t change = 1 + below(3); change > 0; --change) {
                const std::size_t at = below(text.size());
                const char c = inserted[below(inserted.size())];
                if (const std::size_t kind = below(4); kind == 0)
                    text.insert(at, 1, c);
                else if (kind == 1)
                    text.erase(at, 1 + below(8));
                else if (kind == 2)
                    text.insert(at, text.substr(below(text.size()), below(40)));
                else
                    text[at] = c;
            }
            try {
                const AtomsFile atoms = read_atoms_text(text, file);
                ++read;
                const std::size_t count = atoms.x.size();
                ASSERT_GT(count, 0u);
                ASSERT_EQ(atoms.y.size(), count);
                ASSERT_EQ(atoms.z.size(), count);
                ASSERT_EQ(atoms.type.size(), count);
                for (const std::int32_t type : atoms.type)
                    ASSERT_LT(static_cast<std::size_t>(type), atoms.types.size()) << text;
                ASSERT_TRUE(atoms.width_x > 0.0 && atoms.width_y > 0.0) << text;
                for (std::size_t i = 0; i < count; ++i) {
                    ASSERT_TRUE(atoms.x[i] >= 0.0 && atoms.x[i] < atoms.width_x) << text;
                    ASSERT_TRUE(atoms.y[i] >= 0.0 && atoms.y[i] < atoms.width_y) << text;
                    ASSERT_LE(std::abs(atoms.z[i]), 1e7) << text;
                }
            } catch (const SceneError&) { // anything else is a failure
            }
        }
    }
    EXPECT_GT(read, 1000) << "changes that the format allows";
}

TEST(AtomsFile, AnnouncesItsNumberOfAtoms) {
    const Scratch scratch;
    const auto announced = [&](const std::string& name, const std::string& text) {
        return atoms_announced(scratch.write(name, text));
    };
    EXPECT_EQ(announced("a.data", lammps("", " 1", "")), 3u);
    EXPECT_EQ(announced("a.xyz", xyz(lattice)), 3u);
    EXPECT_EQ(announced("b.xyz", "-3\n"), 0u);
    EXPECT_EQ(announced("b.data", std::string(1 << 20, 'a')), 0u);
    EXPECT_EQ(atoms_announced(scratch / "none"), 0u);
}

} // namespace
} // namespace asperity::io
