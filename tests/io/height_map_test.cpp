// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/height_map.hpp"

#include "support/scratch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace asperity::io {
namespace {

Problem refused(const std::string& file, const std::string& unit = "auto") {
    try {
        read_height_map(file, {unit});
    } catch (const SceneError& error) {
        EXPECT_EQ(error.code(), 2);
        return error.problems().front();
    }
    ADD_FAILURE() << file << " was read";
    return {};
}

TEST(HeightMap, RowsAreYAndColumnsAreX) {
    const Scratch scratch;
    for (const char* text : {"1 2 3\n4 5 6\n7 8 9\n", "1\t2  3\n4 5 6\n7 8 9",
                             "# a map\n\n1\t2 3 # first\r\n4 5 6\r\n+7 8.0 9e0\r\n"}) {
        const HeightMap map = read_height_map(scratch.write("m.txt", text));
        EXPECT_EQ(map.sites, 3);
        EXPECT_EQ(map.heights, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
        EXPECT_FALSE(map.size.has_value());
    }
    EXPECT_EQ(read_height_map(scratch.write("m.txt", "1 2\n3 4\n"), {"nm"}).heights.back(), 40.0);
}

TEST(HeightMap, RoundTripsAreExact) {
    const Scratch scratch;
    HeightMap map{4, {}, 41.6, "Å", "somebody's, CC BY 4.0"};
    std::string text;
    for (int i = 0; i < 16; ++i) {
        map.heights.push_back(std::sin(1.0 + i) * 1e-3);
        text += fmt::format("{}{}", map.heights.back(), i % 4 < 3 ? ' ' : '\n');
    }
    write_height_map(scratch / "m.h5", map);
    for (const std::string& file : {scratch / "m.h5", scratch.write("m.txt", text)}) {
        const HeightMap back = read_height_map(file);
        EXPECT_EQ(back.sites, 4) << file;
        EXPECT_EQ(back.heights, map.heights) << file;
    }
    EXPECT_EQ(read_height_map(scratch / "m.h5").size, map.size);
    EXPECT_EQ(read_height_map(scratch / "m.h5").origin, map.origin);
    EXPECT_FALSE(std::filesystem::exists(scratch / "m.h5.tmp"));
    EXPECT_THROW(write_height_map(scratch / "no/dir.h5", map), FileError);
}

TEST(HeightMap, Hdf5UnitsAndSizes) {
    const Scratch scratch;
    {
        Hdf5File file(scratch / "afm.h5", Hdf5File::Mode::create);
        file.write<float>("/heights", {2, 2}, std::vector<float>{0.0f, 0.5f, 1.0f, -1.0f});
        file.write_attribute("/heights", "unit", "nm");
        file.write_attribute("/heights", "size_x", 100.0);
        file.write_attribute("/heights", "size_y", 100.0);
        file.write<double>("/line", {2}, std::vector<double>{1, 2}); // one dimension: no map
        file.close();
    }
    HeightMap map = read_height_map(scratch / "afm.h5");
    EXPECT_EQ(map.heights, (std::vector<double>{0.0, 5.0, 10.0, -10.0}));
    EXPECT_EQ(map.size, 1000.0);
    EXPECT_EQ(map.unit, "nm");
    map = read_height_map(scratch / "afm.h5", {"Å"}); // the scene knows better, for the heights
    EXPECT_EQ(map.heights[1], 0.5);
    EXPECT_EQ(map.size, 1000.0);
    {
        Hdf5File file(scratch / "two.h5", Hdf5File::Mode::create);
        file.write<double>("/surface", {2, 2}, std::vector<double>{0, 1, 2, 3});
        file.write<double>("/group/other", {2, 2}, std::vector<double>{1, 2, 3, 4});
        file.write<double>("/line", {2}, std::vector<double>{1, 2}); // one dimension: no map
        file.close();
    }
    EXPECT_EQ(refused(scratch / "two.h5").what, "has no data set /heights");
    EXPECT_EQ(read_height_map((scratch / "two.h5") + ":/group/other").heights.back(), 4.0);
    EXPECT_EQ(refused((scratch / "two.h5") + ":/group").what, "has no data set /group");
    EXPECT_EQ(refused((scratch / "two.h5") + ":/line").why,
              "a map is numbers of 2 dimensions, it has 1");
}

TEST(HeightMap, Hdf5Mistakes) {
    const Scratch scratch;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto map = [&](const Hdf5File::Shape& shape, const std::vector<double>& data,
                         double y = 1.0, const char* unit = "nm") {
        Hdf5File file(scratch / "m.h5", Hdf5File::Mode::create);
        file.write<double>("/heights", shape, data);
        file.write_attribute("/heights", "size_x", 1.0);
        file.write_attribute("/heights", "size_y", y);
        file.write_attribute("/heights", "unit", unit);
        file.close();
        return scratch / "m.h5";
    };
    Problem p = refused(map({2, 2}, {0, 0, nan, 0}));
    EXPECT_TRUE(p.where.ends_with("m.h5:/heights[1, 0]")) << p.where;
    EXPECT_EQ(p.what, "the height in row 2, column 1 is nan");
    EXPECT_EQ(refused(map({1, 4}, {0, 0, 0, 0})).what, "the height map is not square");
    EXPECT_EQ(refused(map({2, 2}, {0, 0, 0, 0}, 2.0)).what, "is 10 x 20 Å wide");
    EXPECT_EQ(refused(map({2, 2}, {0, 0, 0, 0}, 1.0, "eV")).what, "heights in 'eV' cannot be read");
    Hdf5File(scratch / "empty.h5", Hdf5File::Mode::create).close();
    EXPECT_EQ(refused(scratch / "empty.h5").what, "has no data set /heights");
    EXPECT_EQ(refused(scratch.write("text.h5", "1 2\n3 4\n")).why, "it is not an HDF5 file");
    // Cut short: the head is right, the rest is gone.
    const std::string whole = contents(map({2, 2}, {0, 0, 0, 0}));
    refused(scratch.write("cut.h5", whole.substr(0, 100)));
}

TEST(HeightMap, TextMistakes) {
    const Scratch scratch;
    Problem p = refused(scratch.write("m.txt", "# x\n1 2\n3 NaN\n"));
    EXPECT_TRUE(p.where.ends_with("m.txt:3:3")) << p.where;
    EXPECT_EQ(p.what, "the height in row 2, column 2 is NaN");
    EXPECT_EQ(refused(scratch.write("m.txt", "1 inf\n3 4\n")).what,
              "the height in row 1, column 2 is inf");
    p = refused(scratch.write("m.txt", "x y\n1 2\n"));
    EXPECT_TRUE(p.where.ends_with("m.txt:1:1")) << p.where;
    EXPECT_EQ(p.what, "'x' is no height");
    p = refused(scratch.write("m.txt", "1 2\n3\n"));
    EXPECT_TRUE(p.where.ends_with("m.txt:2:1")) << p.where;
    EXPECT_EQ(p.why, "this line has 1 numbers, line 1 has 2");
    EXPECT_EQ(refused(scratch.write("m.txt", "1 2 3\n4 5 6\n")).why,
              "it has 2 rows and 3 columns, and the periodic box is square");
    EXPECT_EQ(refused(scratch.write("m.txt", "# nothing\n")).what, "the height map is empty");
    EXPECT_EQ(refused(scratch / "none.txt").why, "there is no such file");
    EXPECT_EQ(refused(scratch / "").why, "it is no file");
    EXPECT_EQ(refused(scratch.write("m.txt", "1\n"), "GPa").what,
              "heights in 'GPa' cannot be read");
}

} // namespace
} // namespace asperity::io
