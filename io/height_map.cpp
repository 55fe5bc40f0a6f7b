// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/height_map.hpp"

#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/result.hpp"
#include "io/units.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace asperity::io {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(std::string where, std::string what, std::string why, std::string fix) {
    throw SceneError(Problem{std::move(where), std::move(what), std::move(why), std::move(fix)});
}

bool is_text_name(const fs::path& path) {
    const std::string ending = path.extension().string();
    return ending == ".txt" || ending == ".dat" || ending == ".csv" || ending == ".asc" ||
           ending == ".xyz";
}

/// Å per unit of the file.
double unit_factor(const std::string& unit, const std::string& where) {
    const std::optional<double> factor = conversion(unit, "Å");
    if (!factor)
        refuse(where, fmt::format("heights in '{}' cannot be read", unit),
               "that is no unit of length", "say which it is: file_unit = \"nm\"");
    return *factor;
}

struct Matrix {
    std::size_t rows = 0, columns = 0;
    std::vector<double> values;
};

Matrix read_text(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        refuse(file, "the height map cannot be opened", std::strerror(errno),
               "check its permissions");
    Matrix matrix;
    std::size_t line_number = 0, first_line = 0;
    for (std::string line; std::getline(stream, line);) {
        ++line_number;
        if (const std::size_t hash = line.find('#'); hash != std::string::npos) line.resize(hash);
        std::size_t columns = 0;
        const char* at = line.data();
        const char* const end = at + line.size();
        while (true) {
            while (at != end && std::strchr(" \t\r,;", *at))
                ++at;
            if (at == end) break;
            const char* stop = at;
            while (stop != end && !std::strchr(" \t\r,;", *stop))
                ++stop;
            double value = 0.0;
            const char* const begin = *at == '+' ? at + 1 : at;
            const auto parsed = std::from_chars(begin, stop, value);
            const std::string where =
                fmt::format("{}:{}:{}", file, line_number, at - line.data() + 1);
            if (parsed.ec != std::errc() || parsed.ptr != stop)
                refuse(where, fmt::format("'{}' is no height", std::string_view(at, stop)),
                       "a map is a matrix of numbers, one row a line",
                       "take headings out of the file, or put a # before them");
            if (!std::isfinite(value))
                refuse(where,
                       fmt::format("the height in row {}, column {} is {}", matrix.rows + 1,
                                   columns + 1, std::string_view(at, stop)),
                       "an atom needs a place", "fill the holes of the map before");
            matrix.values.push_back(value);
            ++columns;
            at = stop;
        }
        if (columns == 0) continue;
        if (matrix.rows == 0) {
            matrix.columns = columns;
            first_line = line_number;
        }
        if (columns != matrix.columns)
            refuse(fmt::format("{}:{}:1", file, line_number),
                   "the rows of the map are not of one length",
                   fmt::format("this line has {} numbers, line {} has {}", columns, first_line,
                               matrix.columns),
                   "give every row as many numbers");
        ++matrix.rows;
    }
    if (stream.bad())
        refuse(file, "the height map cannot be read to its end", std::strerror(errno), "");
    return matrix;
}

/// The data set to take: the one named, else the only one with two dimensions, at the root or one
/// group below.
std::string find_dataset(const Hdf5File& file, const std::string& named) {
    if (!named.empty()) {
        if (!file.is_dataset(named))
            refuse(file.path(), "has no data set " + named,
                   "the file was opened and searched for it", "`h5ls -r FILE` lists what it has");
        return named;
    }
    std::vector<std::string> found;
    const auto look = [&](const std::string& path) {
        if (file.is_dataset(path) && file.shape(path).size() == 2) found.push_back(path);
    };
    for (const std::string& name : file.members("/")) {
        look("/" + name);
        if (!file.is_dataset("/" + name))
            for (const std::string& member : file.members("/" + name))
                look("/" + name + "/" + member);
    }
    if (found.empty())
        refuse(file.path(), "holds no height map", "none of its data sets has two dimensions",
               "name a file that has one");
    if (found.size() > 1)
        refuse(file.path(), "holds more than one height map",
               fmt::format("{} and {} both have two dimensions", found[0], found[1]),
               fmt::format("say which: file = \"{}:{}\"", file.path(), found[0]));
    return found.front();
}

/// Heights, and what the attributes say of unit and edge.
Matrix read_hdf5(const std::string& path, const std::string& named, HeightMap& map,
                 std::string& unit) {
    const Hdf5File file(path, Hdf5File::Mode::read);
    const std::string dataset = find_dataset(file, named);
    map.source = path + ":" + dataset;
    const Hdf5File::Shape shape = file.shape(dataset);
    if (shape.size() != 2)
        refuse(map.source, "is no height map",
               fmt::format("it has {} dimensions, a map has 2", shape.size()),
               "name another data set");
    Matrix matrix{shape[0], shape[1], file.read<double>(dataset)};
    for (std::size_t i = 0; i < matrix.values.size(); ++i)
        if (!std::isfinite(matrix.values[i]))
            refuse(fmt::format("{}[{}, {}]", map.source, i / matrix.columns, i % matrix.columns),
                   fmt::format("the height in row {}, column {} is {}", i / matrix.columns + 1,
                               i % matrix.columns + 1, matrix.values[i]),
                   "an atom needs a place", "fill the holes of the map before");
    for (const std::string& place : {std::string("/"), dataset})
        if (file.has_attribute(place, "origin"))
            map.origin = file.read_text_attribute(place, "origin");
    if (unit == "auto")
        unit =
            file.has_attribute(dataset, "unit") ? file.read_text_attribute(dataset, "unit") : "Å";
    if (file.has_attribute(dataset, "size_x")) {
        const double x = file.read_number_attribute(dataset, "size_x");
        const double y = file.has_attribute(dataset, "size_y")
                             ? file.read_number_attribute(dataset, "size_y")
                             : x;
        // Sizes are in the file's own unit, whatever the scene says of the heights.
        const std::string own =
            file.has_attribute(dataset, "unit") ? file.read_text_attribute(dataset, "unit") : unit;
        if (!(x > 0.0) || std::abs(x - y) > 1e-6 * x)
            refuse(map.source, fmt::format("is {} x {} {} wide", x, y, own),
                   "the periodic box is square", "cut a square out of the map before");
        map.size = x * unit_factor(own, map.source);
    }
    return matrix;
}

} // namespace

HeightMap read_height_map(const std::string& name, const std::string& unit_wanted) {
    std::string file = name, dataset;
    if (const std::size_t colon = file.find(":/"); colon != std::string::npos) {
        dataset = file.substr(colon + 1);
        file.resize(colon);
    }
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        refuse(file, "the height map cannot be opened",
               fs::exists(file, error) ? "it is no file" : "there is no such file",
               "check surface.file");

    HeightMap map;
    map.source = file;
    std::string unit = unit_wanted;
    std::ifstream stream(file, std::ios::binary);
    char head[8] = {};
    stream.read(head, sizeof head);
    const bool hdf5 = std::memcmp(head, "\x89HDF\r\n\x1a\n", 8) == 0;
    stream.close();
    if (!hdf5 && (!dataset.empty() || fs::path(file).extension() == ".h5"))
        refuse(file, "the height map cannot be read", "it is not an HDF5 file",
               "name another file; a text matrix must not be called .h5");
    Matrix matrix;
    try {
        matrix = hdf5 ? read_hdf5(file, dataset, map, unit) : read_text(file);
    } catch (const FileError&
                 damaged) { // an input that the scene names: exit 2, like its other mistakes
        throw SceneError(damaged.problems());
    }
    if (matrix.rows == 0) refuse(map.source, "the height map is empty", "it holds no numbers", "");
    if (matrix.rows != matrix.columns)
        refuse(map.source, "the height map is not square",
               fmt::format("it has {} rows and {} columns, and the periodic box is square",
                           matrix.rows, matrix.columns),
               "cut a square out of it before");
    if (unit == "auto") unit = "Å";
    map.unit = unit;
    map.sites = static_cast<int>(matrix.rows);
    map.heights = std::move(matrix.values);
    const double factor = unit_factor(unit, map.source);
    if (factor != 1.0)
        for (double& height : map.heights)
            height *= factor;
    return map;
}

void write_height_map(const std::string& file, const HeightMap& map) {
    const auto sites = static_cast<std::size_t>(map.sites);
    if (is_text_name(file)) {
        std::string text =
            fmt::format("# {} x {} heights in Å, one row (y) a line\n", sites, sites);
        if (map.size) text += fmt::format("# edge: {} Å\n", *map.size);
        for (std::size_t y = 0; y < sites; ++y)
            for (std::size_t x = 0; x < sites; ++x)
                text += fmt::format("{}{}", map.heights[y * sites + x], x + 1 < sites ? ' ' : '\n');
        return write_whole(file, text);
    }
    const std::string temporary = file + ".tmp";
    {
        Hdf5File out(temporary, Hdf5File::Mode::create);
        out.write<double>("/heights", {sites, sites}, map.heights);
        out.write_attribute("/heights", "unit", "Å");
        if (!map.origin.empty()) out.write_attribute("/heights", "origin", map.origin);
        if (map.size) {
            out.write_attribute("/heights", "size_x", *map.size);
            out.write_attribute("/heights", "size_y", *map.size);
        }
        out.close();
    }
    std::error_code error;
    fs::rename(temporary, file, error);
    if (error)
        throw FileError(file, "cannot be put in its place", error.message(),
                        "check the permissions of its directory");
}

} // namespace asperity::io
