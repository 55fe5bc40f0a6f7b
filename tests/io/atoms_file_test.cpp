// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Files of substrate atoms: what is read, and what is refused.
#include "io/atoms_file.hpp"
#include "io/error.hpp"

#include "support/atoms.hpp"
#include "support/scratch.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace asperity::io {
namespace {

AtomsFile three() {
    return {{"Au", "2"},      {0, 1, 0},       10.0, 12.0, {0.5, 9.75, 0.0},
            {1.0, 11.0, 0.0}, {5.25, 6.0, 7.0}};
}

/// What a file is refused for; "" if it was read.
std::string refusal(const std::string& file) {
    try {
        read_atoms_file(file);
    } catch (const SceneError& error) {
        return format(error.problems().front());
    }
    return "";
}

TEST(AtomsFile, IsReadToTheBit) {
    const Scratch scratch;
    const AtomsFile written = three(),
                    read = read_atoms_file(write_atoms(scratch / "a.h5", written));
    EXPECT_EQ(read.types, written.types);
    EXPECT_EQ(read.type, written.type);
    EXPECT_EQ(read.width_x, 10.0);
    EXPECT_EQ(read.width_y, 12.0);
    EXPECT_EQ(read.x, written.x);
    EXPECT_EQ(read.y, written.y);
    EXPECT_EQ(read.z, written.z);
    EXPECT_EQ(atoms_announced(scratch / "a.h5"), 3u);
    EXPECT_EQ(atoms_announced(scratch.write("b.h5", "no")), 0u);
    EXPECT_EQ(atoms_announced(scratch / "none"), 0u);
}

TEST(AtomsFile, RefusesWhatCouldBecomeAWrongNumber) {
    const Scratch scratch;
    const auto expect = [&](const std::function<void(AtomsFile&)>& change, const char* said) {
        AtomsFile atoms = three();
        change(atoms);
        const std::string what = refusal(write_atoms(scratch / "a.h5", atoms));
        EXPECT_NE(what.find(said), std::string::npos) << said << "\n" << what;
    };
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, -1e-300, 10.0, 12.0})
        expect([&](AtomsFile& a) { a.x[1] = bad; }, "atom 2 is not in the box");
    expect([](AtomsFile& a) { a.y[2] = 12.0; }, "atom 3 is not in the box");
    expect([](AtomsFile& a) { a.z[0] = -1.1e7; }, "atom 1 is not in the box");
    expect([](AtomsFile& a) { a.z[0] = std::nan(""); }, "atom 1 is not in the box");
    for (const double bad : {std::nan(""), HUGE_VAL, 0.0, -10.0, 1e8})
        expect([&](AtomsFile& a) { a.width_x = bad; }, "the box of the atoms has no size");
    for (const std::int32_t bad : {-1, 2})
        expect([&](AtomsFile& a) { a.type[1] = bad; }, "atom 2 has no type");
    expect([](AtomsFile& a) { a.types.clear(); }, "there are 0 of them");
    expect([](AtomsFile& a) { a.types.assign(65, "Au"); }, "there are 65 of them");
    expect([](AtomsFile& a) { a.type.pop_back(); }, "/type [2]");
    expect([](AtomsFile& a) { a = {{"Au"}, {}, 10.0, 12.0, {}, {}, {}}; }, "holds no substrate");
    {
        Hdf5File map(scratch / "map.h5", Hdf5File::Mode::create);
        map.write<double>("/heights", {1, 1}, std::vector<double>{1.0});
        map.close();
    }
    EXPECT_NE(refusal(scratch / "map.h5").find("holds no substrate"), std::string::npos);
}

TEST(AtomsFile, OtherFormatsAreToldTheCommandThatConvertsThem) {
    const Scratch scratch;
    for (const char* name : {"solid.data", "solid.xyz"}) {
        const std::string file = scratch.write(name, "a title\n\n3 atoms\n"),
                          command =
                              fmt::format("convert it first: asperity convert {} solid", file);
        EXPECT_NE(refusal(file).find(command), std::string::npos) << refusal(file);
    }
}

TEST(AtomsFile, Hdf5OfAnotherProgram) {
    const Scratch scratch;
    const auto changed = [&](const std::function<void(Hdf5File&)>& change) {
        Hdf5File out(scratch / "b.h5", Hdf5File::Mode::create);
        out.write<double>("/position", {1, 3}, std::vector<double>{0.1, 0.2, 0.3});
        out.write<double>("/box", {2}, std::vector<double>{1.0, 1.5});
        change(out);
        out.close();
        const std::string whole = contents(scratch / "b.h5");
        return scratch.write("b.h5", whole.substr(0, whole.size() - 32)); // without the digest
    };
    const AtomsFile atoms = read_atoms_file(changed([](Hdf5File& out) {
        out.write<std::int64_t>("/type", {1}, std::vector<std::int64_t>{0});
        out.write_attribute("/type", "names", "Au");
        out.write_attribute("/position", "units", "nm");
        out.write_attribute("/box", "unit", "nm");
    }));
    EXPECT_EQ(atoms.x[0], 1.0);
    EXPECT_EQ(atoms.width_y, 15.0);
    EXPECT_NE(refusal(changed([](Hdf5File& out) {
                  out.write<double>("/type", {1}, std::vector<double>{0.5});
                  out.write_attribute("/type", "names", "Au");
              })).find("atom 1 has no type"),
              std::string::npos);
    EXPECT_NE(refusal(changed([](Hdf5File& out) {
                  out.write<double>("/type", {1}, std::vector<double>{0.0});
                  out.write_attribute("/position", "unit", "eV");
              })).find("is no unit of length"),
              std::string::npos);
    // Cut short: the library says why it does not take it.
    const std::string whole = contents(write_atoms(scratch / "a.h5", three()));
    for (std::size_t size = 8; size + 32 < whole.size(); size += 211)
        EXPECT_NE(refusal(scratch.write("b.h5", whole.substr(0, size))).find("cannot be opened"),
                  std::string::npos);
}

} // namespace
} // namespace asperity::io
