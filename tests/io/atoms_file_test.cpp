// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Atoms and trajectories in the formats of others, read back by small strict readers.
#include "io/atoms_file.hpp"
#include "io/error.hpp"
#include "io/h5md.hpp"
#include "io/xdmf.hpp"

#include "support/scratch.hpp"

#include <fstream>
#include <sstream>

namespace asperity::io {
namespace {

AtomFrame two_atoms(std::int64_t step) {
    AtomFrame f;
    f.step = step;
    f.time = 0.5;
    f.edges = {10.0, 10.0, 4.0};
    f.lowest = -1.5;
    f.type = {1, 2};
    f.position = {0.0, 0.0, -0.5, 1.25, 2.5, 1.0 / 3.0};
    f.columns = {{"displacement", 3, false, {0, 0, 0, 0.1, -0.2, 0.3}},
                 {"contact", 1, true, {0, 1}}};
    return f;
}

std::vector<std::string> lines_of(const std::string& path) {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);)
        lines.push_back(line);
    return lines;
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(line);
    return {std::istream_iterator<std::string>(in), {}};
}

TEST(AtomsFile, ExtendedXyz) {
    const Scratch scratch;
    AtomsFile file(scratch / "a.xyz", AtomFormat::extended_xyz);
    file.append(two_atoms(0));
    file.append(two_atoms(7));
    EXPECT_FALSE(std::filesystem::exists(scratch / "a.xyz")); // whole or not at all
    file.close();
    const auto lines = lines_of(scratch / "a.xyz");
    ASSERT_EQ(lines.size(), 8u);
    for (const std::size_t frame : {0u, 4u}) {
        EXPECT_EQ(lines[frame], "2");
        EXPECT_NE(lines[frame + 1].find("Lattice=\"10 0 0 0 10 0 0 0 4\""), std::string::npos);
        EXPECT_NE(lines[frame + 1].find(
                      "Properties=species:S:1:pos:R:3:type:I:1:displacement:R:3:contact:I:1 "),
                  std::string::npos);
        const auto atom = words_of(lines[frame + 3]);
        ASSERT_EQ(atom.size(), 9u); // as many as Properties tells
        EXPECT_NEAR(std::stod(atom[3]), 1.0 / 3.0, 1e-8);
        EXPECT_EQ(atom[4], "2");
        EXPECT_EQ(atom[6], "-0.2");
        EXPECT_EQ(atom[8], "1");
    }
    EXPECT_NE(lines[5].find("step=7 time=0.5"), std::string::npos);
}

TEST(AtomsFile, LammpsDump) {
    const Scratch scratch;
    AtomsFile file(scratch / "a.dump", AtomFormat::lammps_dump);
    file.append(two_atoms(42));
    file.close();
    const auto lines = lines_of(scratch / "a.dump");
    ASSERT_EQ(lines.size(), 11u);
    EXPECT_EQ(lines[1], "42");
    EXPECT_EQ(lines[3], "2");
    EXPECT_EQ(lines[4], "ITEM: BOX BOUNDS pp pp ff");
    EXPECT_EQ(lines[7], "-1.5 2.5");
    EXPECT_EQ(words_of(lines[8]).size() - 2, words_of(lines[9]).size());
    EXPECT_EQ(lines[10], "2 2 1.25 2.5 0.33333333 0.1 -0.2 0.3 1");
}

TEST(AtomsFile, LeavesNothingBehind) {
    const Scratch scratch;
    { AtomsFile given_up(scratch / "a.xyz", AtomFormat::extended_xyz); }
    EXPECT_TRUE(std::filesystem::is_empty(scratch / ""));
    EXPECT_THROW(AtomsFile(scratch / "gone/a.xyz", AtomFormat::extended_xyz), FileError);
}

TEST(H5mdTrajectory, FramesAfterTheStepAreCutOff) {
    const Scratch scratch;
    Hdf5File file(scratch / "run.h5", Hdf5File::Mode::create);
    const std::string group = H5mdTrajectory::group;
    const std::vector<float> v(6, 2.0F);
    {
        H5mdTrajectory frames(file, 2, {10.0, 10.0, 4.0}, true, 0);
        for (int i = 0; i < 4; ++i) {
            const std::vector<float> p = {0, 0, 0, 1, 2, static_cast<float>(i)};
            frames.append(10 * i, 0.1 * i, p, v);
        }
    }
    EXPECT_EQ(file.shape(group + "/position/value"), (Hdf5File::Shape{4, 2, 3}));
    EXPECT_EQ(file.read<float>(group + "/box/edges/value")[8], 4.0F);
    H5mdTrajectory frames(file, 2, {10.0, 10.0, 4.0}, true, 20); // the frame of step 20 comes again
    for (const char* name : {"position", "velocity", "box/edges"})
        for (const char* part : {"value", "step", "time"})
            EXPECT_EQ(file.shape(group + "/" + name + "/" + part)[0], 2u) << name;
    EXPECT_EQ(file.read<std::int64_t>(group + "/position/step"),
              (std::vector<std::int64_t>{0, 10}));
    EXPECT_EQ(file.read_text_attribute(group + "/position/value", "unit"), "Angstrom");
    EXPECT_THROW(H5mdTrajectory(file, 3, {10.0, 10.0, 4.0}, true, 20), FileError);
    EXPECT_THROW(H5mdTrajectory(file, 2, {10.0, 10.0, 4.0}, false, 20), FileError);
}

TEST(Xdmf, SaysWhereTheNumbersAre) {
    const std::string text =
        xdmf("run.h5", {{"state", 8, 2.6, 1.3, {{"gap (Å)", "/fields/state/gap"}}}},
             {"layer", "frames.h5", 64, {0.0, 1.5}, {"/0", "/1"}});
    EXPECT_NE(text.find("Dimensions=\"1 8 8\""), std::string::npos);
    EXPECT_NE(text.find(">0 1.3 1.3<"), std::string::npos); // slowest index, z, first
    EXPECT_NE(text.find(">run.h5:/fields/state/gap<"), std::string::npos);
    EXPECT_NE(text.find("<Time Value=\"1.5\"/>"), std::string::npos);
    EXPECT_NE(
        text.find("\"64 3\" NumberType=\"Float\" Precision=\"4\" Format=\"HDF\">frames.h5:/1<"),
        std::string::npos);
    EXPECT_EQ(xdmf("run.h5", {}, {}).find("Grid"), std::string::npos);
}

} // namespace
} // namespace asperity::io
