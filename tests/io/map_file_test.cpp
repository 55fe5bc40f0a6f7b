// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The formats of height maps: the same heights, size and unit from each, and what is refused.
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/hdf5_numbers.hpp"
#include "io/height_map.hpp"
#include "io/machine.hpp"

#include "support/scratch.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <functional>
#include <new>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

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

void expect_the_map(const HeightMap& map, const char* what, double tolerance = 1e-9) {
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

/// The map as HDF5, times `scale`, with the attributes that fill() adds.
std::string hdf5(const Scratch& scratch, double scale, const std::function<void(Hdf5File&)>& fill) {
    std::vector<double> heights;
    for (int i = 0; i < n * n; ++i)
        heights.push_back(scale * height(i % n, i / n));
    Hdf5File file(scratch / "map.h5", Hdf5File::Mode::create);
    file.write<double>("/heights", {n, n}, heights);
    fill(file);
    file.close();
    return scratch / "map.h5";
}

TEST(MapFile, SameMapInEveryFormat) {
    const Scratch scratch;
    const auto expect_sized = [&](const std::string& file, const std::string& unit = "auto") {
        const HeightMap map = read_map_file(file, {unit});
        expect_the_map(map, "HDF5");
        EXPECT_EQ(map.format, "HDF5");
        EXPECT_NEAR(map.width.value_or(0.0), 10.0 * pixel_nm * n, 1e-9);
        EXPECT_NEAR(map.height.value_or(0.0), 10.0 * pixel_nm * n, 1e-9);
        EXPECT_FALSE(map.unit_assumed);
        return map;
    };
    const auto set = [](Hdf5File& file, const char* name, auto value) {
        file.write_attribute("/heights", name, value);
    };
    // Size in the unit of the heights, or in one of its own.
    expect_sized(hdf5(scratch, 1.0, [&](Hdf5File& file) {
        set(file, "unit", "nm");
        set(file, "size_x", pixel_nm * n);
    }));
    const HeightMap scaled = expect_sized(hdf5(scratch, 2.0, [&](Hdf5File& file) {
        set(file, "unit", "nm");
        set(file, "scale", 0.5);
        set(file, "size_x", 10.0 * pixel_nm * n);
        set(file, "size_y", 10.0 * pixel_nm * n);
        set(file, "size_unit", "Å");
    }));
    EXPECT_EQ(scaled.unit, "0.5 nm");
    // The scene knows better, for the heights: of a size in their unit as well, where they have
    // none.
    const std::string bare =
        hdf5(scratch, 1.0, [&](Hdf5File& file) { set(file, "size_x", pixel_nm * n); });
    expect_sized(bare, "nm");
    EXPECT_EQ(refused(bare).fix, "say which it is: surface.file_unit = \"nm\"");
    EXPECT_EQ(
        read_map_file(hdf5(scratch, 1.0, [&](Hdf5File& file) { set(file, "unit", "m"); }), {"nm"})
            .heights[0],
        10.0 * height(0, 0));
    EXPECT_EQ(refused(hdf5(scratch, 1.0, [&](Hdf5File& file) { set(file, "unit", "V"); })).what,
              "heights in 'V' cannot be read");

    for (const char* type : {"<f8", ">f8"})
        for (const bool columns_first : {false, true})
            expect_the_map(
                read_map_file(scratch.write("m.npy", numpy<double>(type, columns_first)), {"nm"}),
                type);
    expect_the_map(read_map_file(scratch.write("m.npy", numpy<float>(">f4", false)), {"nm"}), "f4",
                   1e-5);
    expect_the_map(
        read_map_file(scratch.write("m.npy", numpy<std::int32_t>("<i4", true, 1e6)), {"fm"}), "i4",
        1e-4);
    for (const char* separator : {" ", "\t", " \t "})
        expect_the_map(read_map_file(scratch.write("m.txt", "\xef\xbb\xbf# rms: 3\n" +
                                                                matrix(nanometres, separator)),
                                     {"nm"}),
                       separator);
    const HeightMap map = read_height_map(scratch / "m.txt");
    ASSERT_EQ(map.notes.size(), 1u);
    EXPECT_EQ(map.notes[0], "the file does not say the unit of its heights: taken as Å");
}

TEST(MapFile, OtherFormatsAreToldTheCommandThatConvertsThem) {
    const Scratch scratch;
    const std::string data = matrix(nanometres, " ");
    const std::pair<const char*, std::string> files[] = {
        {"gwyddion.txt", "# Width: 15 nm\n" + data},
        {"gwyddion2.txt", "# Value units: m\n" + data},
        {"spip.asc", "# Bit2nm = 0.5\n" + data},
        {"spip2.asc", "# x-pixels = 6\n" + data},
        {"edge.txt", data + "#  Edge : 41.6 Å\n"},
        {"german.txt", "# Breite: 15 nm\n# Wert-Einheiten: nm\n" + data},
        {"points.txt", "0 0 1\n0 1 2\n1 0 3\n1 1 4\n"},
        {"esri.asc", "ncols 6\nnrows 6\ncellsize 2.5\n" + data},
        {"m.xyz", "0 0 1\n0 1 2\n1 0 3\n1 1 4\n"},
        {"comma.csv", matrix(nanometres, ",")},
        {"semicolon.csv", matrix(nanometres, ";")},
        {"m.gwy", std::string("GWYP\0\0\0", 7)},
        {"m.sdf", "aISO-1.0\nManufacID = test\n"},
        {"m.x3p", "PK\x03\x04"},
        {"void.txt", "1 2\n3 void\n"}};
    for (const auto& [name, text] : files)
        EXPECT_EQ(refused(scratch.write(name, text)).fix,
                  fmt::format("convert it first: asperity convert {} {}.h5", scratch / name,
                              std::string(name).substr(0, std::string(name).find('.'))));
    // Names that a shell would take apart.
    EXPECT_TRUE(
        refused(scratch.write("my map.gwy", "GWYP")).fix.ends_with("my map.gwy' 'my map.h5'"));
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
    for (const char* hole :
         {"nan", "NaN", "inf", "1e999", "1.7976931348623157e308", "-3.4e38", "1.70141e38"}) {
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
    const std::vector<double> counted = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const auto wide = [&](double size_y) {
        Hdf5File file(scratch / "m.h5", Hdf5File::Mode::create);
        file.write<double>("/heights", {2, 8}, counted);
        file.write_attribute("/heights", "unit", "nm");
        file.write_attribute("/heights", "size_x", 8.0);
        file.write_attribute("/heights", "size_y", size_y);
        file.close();
        return scratch / "m.h5";
    };
    EXPECT_EQ(refused(wide(2.0)).what, "the height map is not square");
    const HeightMap map = read_height_map(scratch / "m.h5", {"Å", false, true});
    EXPECT_EQ(map.rows, 2u);
    EXPECT_EQ(map.columns, 2u);
    EXPECT_EQ(map.heights, (std::vector<double>{3, 4, 11, 12}));
    EXPECT_EQ(map.width, 20.0);
    EXPECT_EQ(refused(wide(1.0), {"Å", false, true}).why,
              "its pixels of 10 x 5 Å are not square, and the periodic box is");
}

TEST(MapFile, HeightsThatNoSurfaceHas) {
    const Scratch scratch;
    const Problem p = refused(scratch.write("m.txt", "1e20 -1e20\n-1e20 1e20\n"));
    EXPECT_EQ(p.what, "a height of the map is 1e+20 Å");
    EXPECT_EQ(refused(scratch.write("m.txt", "1e5 2\n3 4\n"), {"m"}).what,
              "a height of the map is 1e+15 Å");
    EXPECT_EQ(refused(scratch.write("m.txt", std::string("1 2\n3\0 4\n", 9))).what,
              "the height map is no text");
}

/// What the scene says of unit and size holds; a note names what the file says, if that differs.
TEST(MapFile, TheSceneHoldsOverTheFileAndANoteSaysSo) {
    const Scratch scratch;
    const auto file = [&](const char* unit, double size, double scale) {
        return hdf5(scratch, 1.0, [&](Hdf5File& opened) {
            opened.write_attribute("/heights", "unit", unit);
            opened.write_attribute("/heights", "size_x", size);
            opened.write_attribute("/heights", "scale", scale);
        });
    };
    const std::string agreeing = file("nm", 15.0, 0.5);
    for (const MapOptions& said :
         {MapOptions{}, MapOptions{"nm"}, MapOptions{"nm", false, false, 150.0}}) {
        const HeightMap map = read_map_file(agreeing, said);
        EXPECT_EQ(map.heights[0], 5.0 * height(0, 0)); // the scale belongs to the numbers
        EXPECT_EQ(map.width, 150.0);
        EXPECT_TRUE(map.doubts.empty()) << map.doubts[0];
    }
    const HeightMap other = read_map_file(agreeing, {"pm", false, false, 300.0});
    EXPECT_EQ(other.heights[0], 0.005 * height(0, 0));
    EXPECT_EQ(other.width, 300.0);
    ASSERT_EQ(other.doubts.size(), 2u);
    EXPECT_EQ(other.doubts[0],
              "the file says that the map is 150 Å wide, and 300 Å are taken (surface.file_size)");
    EXPECT_EQ(other.doubts[1],
              "the file says that its heights are in nm, and pm is taken (surface.file_unit)");
    // What the file says is not needed, and not refused: a size of 0, a unit that is no length.
    EXPECT_EQ(read_map_file(file("nm", 0.0, 1.0), {"auto", false, false, 300.0}).width, 300.0);
    EXPECT_EQ(refused(file("nm", 0.0, 1.0)).fix,
              "say it: surface.file_size = \"100 nm\", its edge");
    EXPECT_EQ(read_map_file(file("V", 15.0, 1.0), {"nm"}).width, 150.0);
    EXPECT_EQ(refused(file("V", 15.0, 1.0), {"auto", false, false, 300.0}).fix,
              "say which it is: surface.file_unit = \"nm\"");
    // UTF-8 read as Latin-1, as files of SUR have it.
    EXPECT_EQ(read_map_file(file("\xc3\x82\xc2\xb5m", 15.0, 1.0)).width, 150000.0);
    for (const double scale : {0.0, -1.0, std::nan(""), HUGE_VAL})
        for (const char* unit : {"auto", "nm"})
            EXPECT_NE(refused(file("nm", 15.0, scale), {unit}).what.find("is no factor"),
                      std::string::npos);
}

TEST(MapFile, DoubtsOnTheFile) {
    const Scratch scratch;
    const auto doubts = [&](const std::function<double(int, int)>& at, int columns, int rows,
                            double size = 0.0) {
        std::string text;
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x)
                text += fmt::format("{}{}", at(x, y), x + 1 < columns ? " " : "\n");
        MapOptions said{"Å"};
        if (size > 0.0) said.size = size;
        const std::vector<std::string> found =
            read_map_file(scratch.write("m.txt", text), said).doubts;
        return found.empty() ? "" : found.size() > 1 ? "several" : found[0];
    };
    const auto wavy = [](int x, int y) {
        return std::sin(0.5 * x + 0.3 * y) + std::cos(0.2 * x * y);
    };
    EXPECT_EQ(doubts(wavy, 32, 32), "");
    EXPECT_EQ(doubts([](int, int) { return 1.0; }, 32, 32), "");
    EXPECT_EQ(doubts([](int x, int y) { return x == 3 && y < 2 ? 8.0 : 0.0; }, 32, 32),
              "");                                                                  // a spike
    EXPECT_EQ(doubts([](int x, int) { return x < 16 ? 0.0 : 300.0; }, 32, 32), ""); // a step
    for (const double hole : {-9999.0, -32768.0, 99999.0}) {
        const std::string said =
            doubts([&](int x, int y) { return x == 3 && y < 2 ? hole : wavy(x, y); }, 32, 32);
        EXPECT_TRUE(said.starts_with(fmt::format("2 points have the height {:.6g} Å", hole)))
            << said;
    }
    for (const int parts : {2, 3, 4}) {
        const int of_each = 48 / parts;
        const std::string said = doubts(
            [&](int x, int y) {
                return wavy(x, y) * (y / of_each % 2 ? 0.1 : 1.0) + 60.0 * (y / of_each);
            },
            48, 48);
        EXPECT_NE(said.find(fmt::format("may hold {} maps on top of one another", parts)),
                  std::string::npos)
            << said;
    }
    for (const double wrong : {0.5, 160e10})
        EXPECT_NE(doubts(wavy, 32, 32, wrong).find("check the unit of its size"),
                  std::string::npos);
}

TEST(MapFile, BlocksOfATextAreNoMap) {
    const Scratch scratch;
    const std::string block = matrix(nanometres, " ");
    for (const char* between : {"\n", "\n\n", "# Phase\n", "# ----\n\n"}) {
        const std::string file = scratch.write("m.txt", block + between + block);
        EXPECT_EQ(refused(file).what, "holds 2 blocks of 6 rows");
        EXPECT_TRUE(refused(file).fix.starts_with("convert it first: asperity convert " + file))
            << refused(file).fix;
    }
    // One map, however it is spaced.
    std::string spaced = "# a map\n\n";
    for (const char c : block)
        spaced += c == '\n' ? std::string("\n\n") : std::string(1, c);
    expect_the_map(read_map_file(scratch.write("m.txt", spaced), {"nm"}), "spaced");
    expect_the_map(read_map_file(scratch.write("m.txt", block + "\n# end\n"), {"nm"}), "end");
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
    EXPECT_EQ(with("(6, 6), ", "(6, 6, 99999999999999999999), ").why, "its shape is no shape");
    EXPECT_EQ(with("(6, 6), ", "(9000000000000000000, 0), ").what, "the height map is empty");
    EXPECT_EQ(with("<f8", "<c8").why,
              "its numbers are of type '<c8', and integers or floats are needed");
}

TEST(MapFile, Hdf5ThatIsHostile) {
    const Scratch scratch;
    const auto nothing = [](Hdf5File&) {};
    const std::string whole = contents(hdf5(scratch, 1.0, nothing));
    // One that has a digest, of which a byte is another.
    std::string bytes = whole;
    bytes[100] ^= 1;
    EXPECT_EQ(refused(scratch.write("map.h5", bytes)).what, "is damaged");
    // Of another program: without a digest it is read. Cut short or with bytes changed it is a map
    // or refused with a reason; a crash of the library is not ours.
    const std::string plain = whole.substr(0, whole.size() - 32);
    EXPECT_EQ(read_map_file(scratch.write("map.h5", plain)).heights.size(), 36u);
    for (std::size_t size = 8; size < plain.size(); size += 211)
        EXPECT_NE(refused(scratch.write("map.h5", plain.substr(0, size))).why, "") << size;
    std::minstd_rand random(36);
    int maps = 0, others = 0;
    for (int i = 0; i < 60; ++i) {
        bytes = plain;
        for (int change = 0; change < 8; ++change)
            bytes[8 + random() % (bytes.size() - 8)] = static_cast<char>(random());
        try {
            maps += !read_map_file(scratch.write("map.h5", bytes)).heights.empty();
        } catch (const SceneError& error) {
            EXPECT_NE(error.problems().front().why, "");
            ++others;
        }
    }
    EXPECT_GT(maps, 0);
    EXPECT_GT(others, 0);
    // Written by us, and no map.
    const auto made = [&](const std::function<void(Hdf5File&)>& fill) {
        Hdf5File file(scratch / "m.h5", Hdf5File::Mode::create);
        fill(file);
        file.close();
        return refused(scratch / "m.h5");
    };
    EXPECT_EQ(made(nothing).what, "has no data set /heights");
    EXPECT_EQ(made([](Hdf5File& f) {
                  f.make_dataset<double>("/heights", {0, 100000});
              }).what,
              "the height map is empty");
    // Declared and never written: no bytes in the file, 40 TB in memory.
    EXPECT_EQ(made([](Hdf5File& f) {
                  f.make_dataset<float>("/heights", {1000000, 5000000});
              }).what,
              "the height map is larger than the memory");
    EXPECT_EQ(made([](Hdf5File& f) { f.make_dataset<double>("/heights", {}); }).what,
              "is no height map");
    // Sizes that are no numbers, units that are no text.
    EXPECT_EQ(made([](Hdf5File& f) {
                  f.write<double>("/heights", {1, 1}, std::vector<double>{1.0});
                  f.write_attribute("/heights", "size_x", std::nan(""));
              }).what,
              "the file does not say the unit of its sizes and heights");
    EXPECT_EQ(made([](Hdf5File& f) {
                  f.write<double>("/heights", {1, 1}, std::vector<double>{1.0});
                  f.write_attribute("/heights", "size_x", std::nan(""));
                  f.write_attribute("/heights", "unit", "nm");
              }).what,
              "the map has no size");
    EXPECT_NE(made([](Hdf5File& f) {
                  f.write<double>("/heights", {1, 1}, std::vector<double>{1.0});
                  f.write_attribute("/heights", "unit", 1.0);
              }).what.find("unit that is not one string"),
              std::string::npos);
}

TEST(MapFile, Hdf5OfAnotherProgram) {
    const Scratch scratch;
    const auto write = [&](const std::function<void(Hdf5File&)>& fill) {
        Hdf5File file(scratch / "m.h5", Hdf5File::Mode::create);
        file.write<float>("/scan/topography", {2, 2}, std::vector<float>{1, 2, 3, 4});
        file.write<double>("/scan/line", {2}, std::vector<double>{1, 2});
        fill(file);
        file.close();
        const std::string whole = contents(scratch / "m.h5");
        return scratch.write("m.h5", whole.substr(0, whole.size() - 32)); // without the digest
    };
    // The only data set of two dimensions; what it does not say itself the file says.
    const HeightMap map = read_map_file(write([](Hdf5File& file) {
        file.write_attribute("/", "units", "nm");
        file.write_attribute("/", "size_x", std::int64_t{6});
    }));
    EXPECT_EQ(map.heights, (std::vector<double>{10, 20, 30, 40}));
    EXPECT_EQ(map.width, 60.0);
    EXPECT_TRUE(map.source.ends_with("m.h5:/scan/topography")) << map.source;
    EXPECT_EQ(read_map_file(write([](Hdf5File&) {}), {"nm"}).heights[0], 10.0);
    const std::string two = write([](Hdf5File& file) {
        file.write<double>("/error", {1, 1}, std::vector<double>{1.0});
    });
    const Problem p = refused(two);
    EXPECT_EQ(p.what, "holds more than one map");
    EXPECT_EQ(p.fix, fmt::format("name one: file = \"{}:/error\"", two));
    // Numbers of instruments mean nothing without what stands beside them.
    for (const char* sign : {"/Measurement_000/Channel_000/Height", "/pixel_to_nm_scaling"}) {
        const std::string jpk =
            write([&](Hdf5File& file) { file.write<double>(sign, {1}, std::vector<double>{1.0}); });
        EXPECT_TRUE(refused(jpk).fix.starts_with("convert it first: asperity convert ")) << sign;
    }
    const std::string frames = write([](Hdf5File& file) {
        file.write<double>("/heights", {2, 2, 2}, std::vector<double>(8));
    });
    EXPECT_TRUE(refused(frames).fix.ends_with(" --channel 1")) << refused(frames).fix;
    EXPECT_EQ(read_map_file(two + ":/scan/topography").rows, 2u);
}

/// A crash or an endless loop in the reading process, and an allocation of any size, end in a
/// message; the child process leaves nothing behind.
TEST(Hdf5Numbers, WhatHappensInTheChildStaysThere) {
    const Scratch scratch;
    const std::string file = hdf5(scratch, 1.0, [](Hdf5File&) {});
    const auto why = [&](const std::function<void()>& happens) {
        try {
            read_numbers(file, {"the map",
                                [&](const Hdf5File&) {
                                    happens();
                                    return std::vector<std::string>{"/heights"};
                                },
                                {},
                                {}});
        } catch (const SceneError& error) {
            return error.problems().front().why;
        }
        return std::string("read");
    };
    EXPECT_EQ(why([] {}), "read");
    EXPECT_EQ(why([] { std::raise(SIGSEGV); }),
              "the HDF5 library crashed on it (Segmentation fault)");
    EXPECT_EQ(why([] { std::raise(SIGXCPU); }), "the HDF5 library finds no end in it");
    EXPECT_EQ(why([] { throw std::bad_alloc(); }), "the memory does not suffice for it");
    EXPECT_EQ(why([] { throw 1; }), "the HDF5 library could not hand it over");
    EXPECT_EQ(why([] { throw FileError("a", "b", "of the file", "d"); }), "of the file");
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
}

TEST(HeightMap, RowsAreYAndColumnsAreX) {
    const Scratch scratch;
    for (const char* text : {"1 2 3\n4 5 6\n7 8 9\n", "1\t2  3\n4 5 6\n7 8 9",
                             "# a map\n\n1\t2 3 # first\r\n4 5 6\r\n+7 8.0 9e0\r\n"}) {
        const HeightMap map = read_height_map(scratch.write("m.txt", text));
        EXPECT_EQ(map.rows, 3u);
        EXPECT_EQ(map.heights, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
        EXPECT_FALSE(map.width.has_value());
    }
    EXPECT_EQ(read_height_map(scratch.write("m.txt", "1 2\n3 4\n"), {"nm"}).heights.back(), 40.0);
}

TEST(HeightMap, RoundTripsAreExact) {
    const Scratch scratch;
    HeightMap map;
    map.rows = map.columns = 4;
    map.width = map.height = 41.6;
    map.origin = "somebody's, CC BY 4.0";
    std::string text;
    for (int i = 0; i < 16; ++i) {
        map.heights.push_back(std::sin(1.0 + i) * 1e-3);
        text += fmt::format("{}{}", map.heights.back(), i % 4 < 3 ? ' ' : '\n');
    }
    write_height_map(scratch / "m.h5", map);
    for (const std::string& file : {scratch / "m.h5", scratch.write("m.txt", text)}) {
        const HeightMap back = read_height_map(file);
        EXPECT_EQ(back.rows, 4u) << file;
        EXPECT_EQ(back.heights, map.heights) << file;
    }
    EXPECT_EQ(read_height_map(scratch / "m.h5").width, map.width);
    EXPECT_EQ(read_height_map(scratch / "m.h5").origin, map.origin);
    EXPECT_FALSE(std::filesystem::exists(scratch / "m.h5.tmp"));
    EXPECT_THROW(write_height_map(scratch / "no/dir.h5", map), FileError);
}

TEST(HeightMap, Hdf5Mistakes) {
    const Scratch scratch;
    const auto map = [&](const std::vector<double>& data, double y = 1.0) {
        Hdf5File file(scratch / "m.h5", Hdf5File::Mode::create);
        file.write<double>("/heights", {2, 2}, data);
        file.write_attribute("/heights", "size_x", 1.0);
        file.write_attribute("/heights", "size_y", y);
        file.write_attribute("/heights", "unit", "nm");
        file.write<double>("/group/other", {2, 2}, std::vector<double>{1, 2, 3, 4});
        file.write<double>("/line", {2}, std::vector<double>{1, 2}); // one dimension: no map
        file.close();
        return scratch / "m.h5";
    };
    const Problem p = refused(map({0, 0, std::nan(""), 0}));
    EXPECT_TRUE(p.where.ends_with("m.h5:/heights[1, 0]")) << p.where;
    EXPECT_EQ(p.what, "the height in row 2, column 1 is nan");
    EXPECT_EQ(refused(map({0, 0, 0, 0}, 2.0)).what, "is 10 x 20 Å wide");
    EXPECT_EQ(read_height_map((scratch / "m.h5") + ":/group/other").heights.back(), 4.0);
    EXPECT_EQ(refused((scratch / "m.h5") + ":/group").what, "has no data set /group");
    EXPECT_EQ(refused((scratch / "m.h5") + ":/line").why,
              "a map is numbers of 2 dimensions, it has 1");
    EXPECT_EQ(refused(scratch.write("text.h5", "1 2\n3 4\n")).why, "it is not an HDF5 file");
    // The scene knows better than the file, for the heights.
    const HeightMap other = read_height_map(map({0.0, 0.5, 1.0, -1.0}), {"Å"});
    EXPECT_EQ(other.heights[1], 0.5);
    EXPECT_EQ(other.width, 10.0);
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
    EXPECT_EQ(refused(scratch.write("m.txt", "1 2\n3 4\n5 6\n")).fix,
              "it is a line scan, and a surface needs a map: measure or export an area");
    EXPECT_EQ(refused(scratch / "none.txt").why, "there is no such file");
    EXPECT_EQ(refused(scratch / "").why, "it is no file");
    EXPECT_EQ(refused(scratch.write("m.txt", "1\n"), {"GPa"}).what,
              "heights in 'GPa' cannot be read");
}

TEST(AvailableMemory, IsLessThanTheMachineHas) {
    const AvailableMemory memory = available_memory();
    EXPECT_GT(memory.bytes, 1e6);
    EXPECT_LT(memory.bytes, 1e15);
    EXPECT_FALSE(memory.because.empty());
}

} // namespace
} // namespace asperity::io
