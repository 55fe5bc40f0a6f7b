// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The formats of height maps: the same heights, size and unit from each, and what is refused.
#include "io/available_memory.hpp"
#include "io/child_process.hpp"
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/height_map.hpp"
#include "io/map_file.hpp"

#include "support/scratch.hpp"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace asperity::io {
namespace {

constexpr int n = 6;
constexpr double pixel_nm = 2.5;

/// Heights in nm, not symmetric in x and y.
double height(int x, int y) {
    return std::round(1e4 * std::sin(1.0 + 2.0 * x + 0.7 * y * y)) / 1e4;
}

/// A line for each row; cell(x, y): what stands for a number.
std::string matrix(const std::function<std::string(int, int)>& cell, const char* separator,
                   int columns = n) {
    std::string text;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < columns; ++x)
            text += cell(x, y) + (x + 1 < columns ? separator : "\n");
    return text;
}
std::string nanometres(int x, int y) { return fmt::format("{}", height(x, y)); }
std::string metres(int x, int y) { return fmt::format("{}e-9", height(x, y)); }
std::string with_comma(int x, int y) {
    std::string text = nanometres(x, y);
    if (const std::size_t point = text.find('.'); point != std::string::npos) text[point] = ',';
    return text;
}

template <class T>
std::string numpy(const std::string& type, bool columns_first, double scale = 1.0) {
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}, {}), }}",
                                     type, columns_first ? "True" : "False", n, n);
    header.resize(117, ' ');
    header += '\n';
    std::string bytes = "\x93NUMPY";
    bytes += '\x01';
    bytes += '\0';
    bytes += static_cast<char>(header.size());
    bytes += '\0';
    bytes += header;
    for (int i = 0; i < n * n; ++i) {
        const int x = columns_first ? i / n : i % n, y = columns_first ? i % n : i / n;
        const T value = static_cast<T>(scale * height(x, y));
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (type[0] == '>') std::reverse(raw, raw + sizeof(T));
        bytes.append(raw, sizeof(T));
    }
    return bytes;
}

void expect_the_map(const MapFile& map, const char* what, double tolerance = 1e-9) {
    ASSERT_EQ(map.rows, static_cast<std::size_t>(n)) << what;
    ASSERT_EQ(map.columns, static_cast<std::size_t>(n)) << what;
    EXPECT_EQ(map.missing, 0u) << what;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            EXPECT_NEAR(map.heights[static_cast<std::size_t>(y * n + x)], 10.0 * height(x, y),
                        tolerance)
                << what << " " << x << " " << y;
}

Problem refused(const std::string& file, const MapOptions& options = {}) {
    try {
        read_height_map(file, options);
    } catch (const SceneError& error) {
        return error.problems().front();
    }
    ADD_FAILURE() << file << " was read";
    return {};
}

TEST(MapFile, SameMapInEveryFormat) {
    const Scratch scratch;
    const auto expect_sized = [&](const std::string& file, const char* format,
                                  const std::string& unit = "auto") {
        const MapFile map = read_map_file(file, unit);
        expect_the_map(map, format);
        EXPECT_EQ(map.format, format);
        ASSERT_TRUE(map.width && map.height) << format;
        EXPECT_NEAR(*map.width, 10.0 * pixel_nm * n, 1e-6) << format;
        EXPECT_NEAR(*map.height, 10.0 * pixel_nm * n, 1e-6) << format;
        EXPECT_FALSE(map.unit_assumed);
    };
    expect_sized(scratch.write("gwyddion.txt", "# Channel: Z\n# Width: 0.015 µm\n# Height: 15 nm\n"
                                               "# Value units: m\n" +
                                                   matrix(metres, "\t")),
                 "Gwyddion text");
    expect_sized(
        scratch.write(
            "spip.asc",
            "# File Format = ASCII\n# Created by SPIP 6.7\n"
            "# x-pixels = 6\n# y-pixels = 6\n# x-length = 15\n"
            "# y-length = 15\n# Bit2nm = 0.5\n# Start of Data:\n" +
                matrix([](int x, int y) { return fmt::format("{}", 2.0 * height(x, y)); }, "\t")),
        "SPIP text");
    expect_sized(scratch.write("esri.asc", "ncols 6\nnrows 6\nxllcorner 100\nyllcorner 7\n"
                                           "cellsize 2.5\nNODATA_value -9999\n" +
                                               matrix(nanometres, " ")),
                 "ESRI grid", "nm");
    std::string points; // columns from the right, so the order does not matter
    for (int x = n - 1; x >= 0; --x)
        for (int y = 0; y < n; ++y)
            points += fmt::format("{} {} {}\n", 100.0 + pixel_nm * x, pixel_nm * y, height(x, y));
    expect_sized(scratch.write("points.xyz", points), "XYZ", "nm");
    {
        Hdf5File file(scratch / "map.h5", Hdf5File::Mode::create);
        std::vector<double> heights;
        for (int i = 0; i < n * n; ++i)
            heights.push_back(height(i % n, i / n));
        file.write<double>("/h", {n, n}, heights);
        file.write_attribute("/h", "unit", "nm");
        file.write_attribute("/h", "size_x", pixel_nm * n);
        file.close();
    }
    expect_sized(scratch / "map.h5", "HDF5");

    // Without sizes.
    for (const char* type : {"<f8", ">f8"})
        for (const bool columns_first : {false, true})
            expect_the_map(
                read_map_file(scratch.write("m.npy", numpy<double>(type, columns_first)), "nm"),
                type);
    expect_the_map(read_map_file(scratch.write("m.npy", numpy<float>(">f4", false)), "nm"), "f4",
                   1e-5);
    expect_the_map(
        read_map_file(scratch.write("m.npy", numpy<std::int32_t>("<i4", true, 1e6)), "fm"), "i4",
        1e-4);
    for (const char* separator : {"\t", ";", " ; ", "\t "})
        expect_the_map(
            read_map_file(scratch.write("comma.txt", matrix(with_comma, separator)), "nm"),
            separator);
    expect_the_map(
        read_map_file(scratch.write("bom.txt", "\xef\xbb\xbf" + matrix(nanometres, ", ")), "nm"),
        "byte order mark");
}

TEST(MapFile, HeadersThatCannotBeMeant) {
    const Scratch scratch;
    const std::string data = matrix(nanometres, " ");
    // A bare size is in the unit of the heights, and in no unit if those have none.
    EXPECT_EQ(
        read_map_file(scratch.write("m.txt", "# Width: 15\n# Value units: nm\n" + data)).width,
        150.0);
    EXPECT_EQ(refused(scratch.write("m.txt", "# Width: 15\n" + data)).what,
              "the header 'width: 15' has no unit");
    EXPECT_EQ(refused(scratch.write("m.txt", "# Width: 15 nM\n" + data)).what,
              "heights in 'nM' cannot be read");
    EXPECT_EQ(refused(scratch.write("m.txt", "# Width: -1 nm\n" + data)).why,
              "it is not above zero");
    EXPECT_EQ(refused(scratch.write("m.txt", "# Value units: V\n" + data)).what,
              "heights in 'V' cannot be read");
    EXPECT_EQ(refused(scratch.write("m.txt", "# x-pixels = 7\n" + data)).what,
              "the height map is not whole");
    EXPECT_EQ(refused(scratch.write("m.txt", "# Bit2nm = 0\n" + data)).what,
              "the header 'Bit2nm = 0' is no factor");
    EXPECT_FALSE(read_map_file(scratch.write("m.txt", "# Width: see the paper\n" + data)).width);
    // The scene knows better, for the heights.
    EXPECT_NEAR(read_map_file(scratch.write("m.txt", "# Bit2nm = 0.5\n" + data), "nm").heights[0],
                10.0 * height(0, 0), 1e-9);
    // Assumptions are told.
    const HeightMap map = read_height_map(scratch.write("m.txt", data));
    ASSERT_EQ(map.notes.size(), 1u);
    EXPECT_EQ(map.notes[0], "the file does not say the unit of its heights: taken as Å");
    for (const char* name : {"m.xyz", "m.asc"})
        EXPECT_EQ(
            refused(scratch.write(name, name[2] == 'x' ? "0 0 1\n0 1 2\n1 0 3\n1 1 4\n"
                                                       : "ncols 2\nnrows 1\ncellsize 1\n1 2\n"))
                .fix,
            "say which it is: surface.file_unit = \"nm\"");
}

TEST(MapFile, Commas) {
    const Scratch scratch;
    EXPECT_EQ(refused(scratch.write("m.txt", "1,5 2,5\n3,5 4,5\n")).what,
              "the commas may be decimal points or separate numbers");
    EXPECT_EQ(refused(scratch.write("m.txt", "1.5\t2,5\n3,5\t4,5\n")).what,
              "the commas may be decimal points or separate numbers");
    EXPECT_EQ(read_map_file(scratch.write("m.csv", "1,2\n3,4\n")).heights,
              (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(read_map_file(scratch.write("m.csv", "1,5\t-2\n3\t4,25\n")).heights,
              (std::vector<double>{1.5, -2, 3, 4.25}));
}

TEST(MapFile, MissingPoints) {
    const Scratch scratch;
    // Laplace's equation gives a plane back.
    const auto plane = [](int x, int y) { return 3.0 * x - 2.0 * y; };
    const auto holed = [&](const char* hole) {
        return matrix(
            [&](int x, int y) {
                return x > 0 && x < 4 && y == 2 ? std::string(hole)
                                                : fmt::format("{}", plane(x, y));
            },
            " ");
    };
    for (const char* hole : {"nan", "NaN", "inf", "bad", "1e999"}) {
        const std::string file = scratch.write("m.txt", holed(hole));
        const Problem p = refused(file);
        EXPECT_TRUE(p.where.ends_with("m.txt:3:4")) << p.where;
        EXPECT_EQ(p.what, fmt::format("the height in row 3, column 2 is {}", hole));
        const HeightMap map = read_height_map(file, {"Å", true});
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                EXPECT_NEAR(map.heights[static_cast<std::size_t>(y * n + x)], plane(x, y), 1e-7);
        EXPECT_EQ(map.notes.back(),
                  "3 points of the map (8.3 %) had no height: filled by Laplace's equation");
    }
    const std::string esri = "ncols 6\nnrows 6\ncellsize 1\nNODATA_value -9999\n" + holed("-9999");
    EXPECT_EQ(refused(scratch.write("m.asc", esri), {"Å"}).what,
              "the height in row 3, column 2 is nodata (-9999)");
    EXPECT_NEAR(read_height_map(scratch / "m.asc", {"Å", true}).heights[14], plane(2, 2), 1e-7);
    EXPECT_EQ(refused(scratch.write("m.xyz", "0 0 1\n0 1 2\n1 0 3\n"), {"nm"}).what,
              "the height in row 2, column 2 is not given (x = 1, y = 1)");
    EXPECT_EQ(refused(scratch.write("m.txt", "1 nan\nnan nan\n"), {"Å", true}).what,
              "most of the height map is missing");
    // A hole at the edge has fewer neighbours.
    std::vector<double> row = {std::nan(""), 2.0, std::nan(""), 4.0};
    fill_missing(row, 1, 4);
    EXPECT_NEAR(row[0], 2.0, 1e-9);
    EXPECT_NEAR(row[2], 3.0, 1e-9);
}

TEST(MapFile, MapsThatAreNotSquare) {
    const Scratch scratch;
    const std::string wide =
        "# Width: 8 nm\n# Height: 2 nm\n0 1 2 3 4 5 6 7\n8 9 10 11 12 13 14 15\n";
    EXPECT_EQ(refused(scratch.write("m.txt", wide)).what, "the height map is not square");
    const HeightMap map = read_height_map(scratch / "m.txt", {"Å", false, true});
    EXPECT_EQ(map.sites, 2);
    EXPECT_EQ(map.heights, (std::vector<double>{3, 4, 11, 12}));
    EXPECT_EQ(map.size, 20.0);
    EXPECT_EQ(
        refused(scratch.write("m.txt", "# Width: 8 nm\n# Height: 1 nm\n1 2\n3 4\n"), {"Å"}).why,
        "its pixels of 40 x 5 Å are not square, and the periodic box is");
}

TEST(MapFile, HeightsThatNoSurfaceHas) {
    const Scratch scratch;
    const Problem p = refused(scratch.write("m.txt", "1e200 -1e200\n-1e200 1e200\n"));
    EXPECT_EQ(p.what, "a height of the map is 1e+200 Å");
    EXPECT_EQ(refused(scratch.write("m.txt", "1e5 2\n3 4\n"), {"m"}).what,
              "a height of the map is 1e+15 Å");
    EXPECT_EQ(refused(scratch.write("m.txt", std::string("1 2\n3\0 4\n", 9))).what,
              "the height map is no text");
    EXPECT_EQ(refused(scratch.write("m.gwy", "GWYP....")).why, "it is a Gwyddion file (.gwy)");
    EXPECT_EQ(
        refused(scratch.write("m.xyz", "0 0 1\n1 0 2\n3 0 4\n0 1 1\n1 1 1\n3 1 1\n"), {"nm"}).what,
        "the points of the map are on no grid");
    std::string cloud;
    for (int i = 0; i < 3000; ++i) // would be a grid of 9 million
        cloud += fmt::format("{} {} 1\n", i, i);
    EXPECT_EQ(refused(scratch.write("m.xyz", cloud), {"nm"}).what,
              "the points of the map are on no grid");
    EXPECT_EQ(refused(scratch.write("m.xyz", "0 0 1\n0 1 2\n1 0 3\n1 1 4\n1 1 5\n"), {"nm"}).what,
              "the point is in the map already");
}

TEST(MapFile, NumpyThatIsDamaged) {
    const Scratch scratch;
    const std::string whole = numpy<double>("<f8", false);
    for (std::size_t size = 6; size < whole.size(); size += 7)
        refused(scratch.write("m.npy", whole.substr(0, size)));
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        text.replace(text.find(from), from.size(), to);
        return refused(scratch.write("m.npy", text));
    };
    EXPECT_EQ(with("(6, 6)", "(9, 9)").why,
              "9 x 9 numbers of 8 bytes are declared, and 288 bytes are there");
    EXPECT_EQ(with("(6, 6), ", "(3000000000, 3000000000), ").what, "the height map cannot be read");
    EXPECT_EQ(with("(6, 6)", "(6,6,1").what, "is no height map");
    EXPECT_EQ(with("(6, 6), ", "(9000000000000000000, 0), ").what, "the height map is empty");
    EXPECT_EQ(with("<f8", "<c8").why,
              "its numbers are of type '<c8', and integers or floats are needed");
}

TEST(MapFile, Hdf5ThatIsHostile) {
    const Scratch scratch;
    const auto made = [&](const std::function<void(Hdf5File&)>& fill) {
        Hdf5File file(scratch / "m.h5", Hdf5File::Mode::create);
        fill(file);
        file.close();
        return refused(scratch / "m.h5");
    };
    // Declared and never written: no bytes in the file, 80 GB in memory.
    EXPECT_EQ(made([](Hdf5File& f) { f.make_series<double>("/h", {100000}); }).what,
              "the height map is empty");
    EXPECT_EQ(made([](Hdf5File& f) {
                  f.make_dataset<float>("/h", {100000, 100000});
              }).why,
              "100000 x 100000 values are declared, and 0 bytes are stored");
    EXPECT_EQ(made([](Hdf5File& f) { f.make_dataset<double>("/h", {}); }).what,
              "holds no height map");
    // Sizes that are no numbers, units that are no text.
    EXPECT_EQ(made([](Hdf5File& f) {
                  f.write<double>("/h", {1, 1}, std::vector<double>{1.0});
                  f.write_attribute("/h", "size_x", std::nan(""));
              }).why,
              "a size is a number above zero");
    EXPECT_NE(made([](Hdf5File& f) {
                  f.write<double>("/h", {1, 1}, std::vector<double>{1.0});
                  f.write_attribute("/h", "unit", 1.0);
              }).what.find("unit that is not one string"),
              std::string::npos);
}

TEST(ChildProcess, CrashesAndHangsAreTold) {
    const auto nothing = [](int) {};
    EXPECT_EQ(in_child_process(10, nothing, nothing), "");
    EXPECT_EQ(in_child_process(
                  10, [](int) { std::raise(SIGSEGV); }, nothing),
              "by signal 11 (Segmentation fault)");
    EXPECT_EQ(in_child_process(
                  10, [](int) { throw 1; }, nothing),
              "with code 111");
    // A hang ends by the limit of processor time.
    const auto limited = [](int pipe) {
        rlimit time{};
        ::getrlimit(RLIMIT_CPU, &time);
        const std::uint64_t seconds = time.rlim_cur;
        write_all(pipe, &seconds, sizeof seconds);
        std::raise(SIGXCPU);
    };
    std::uint64_t seconds = 0;
    EXPECT_TRUE(in_child_process(7, limited, [&](int pipe) {
                    read_all(pipe, &seconds, sizeof seconds);
                }).starts_with("after 7 s"));
    EXPECT_EQ(seconds, 7u);
    // A reader that stops early, and one that throws, leave no child behind.
    const auto talk = [](int pipe) {
        const std::string text(1 << 20, 'x');
        write_all(pipe, text.data(), text.size());
    };
    EXPECT_EQ(in_child_process(10, talk, nothing), "by signal 13 (Broken pipe)");
    EXPECT_THROW(in_child_process(10, talk, [](int) { throw std::runtime_error("no"); }),
                 std::runtime_error);
    std::string got(1 << 20, ' ');
    EXPECT_EQ(in_child_process(10, talk, [&](int pipe) { read_all(pipe, got.data(), got.size()); }),
              "");
    EXPECT_EQ(got, std::string(1 << 20, 'x'));
}

TEST(AvailableMemory, IsLessThanTheMachineHas) {
    const AvailableMemory memory = available_memory();
    EXPECT_GT(memory.bytes, 1e6);
    EXPECT_LT(memory.bytes, 1e15);
    EXPECT_FALSE(memory.because.empty());
}

} // namespace
} // namespace asperity::io
