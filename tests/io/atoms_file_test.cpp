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
    for (const char* name : {"solid.data", "solid.xyz", "solid.h5"}) {
        const std::string file = scratch.write(name, "a title\n\n3 atoms\n"),
                          command =
                              fmt::format("convert it first: asperity convert {} solid", file);
        EXPECT_NE(refusal(file).find(command), std::string::npos) << refusal(file);
    }
    // HDF5 of another program, or cut short.
    const std::string whole = contents(write_atoms(scratch / "a.h5", three()));
    for (std::size_t size = 8; size < whole.size(); size += 41)
        EXPECT_NE(refusal(scratch.write("b.h5", whole.substr(0, size))).find("asperity convert"),
                  std::string::npos);
}

} // namespace
} // namespace asperity::io
