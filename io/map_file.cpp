// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/map_file.hpp"

#include "io/available_memory.hpp"
#include "io/error.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace asperity::io {

namespace {

namespace fs = std::filesystem;

/// Heights beyond are no surface of atoms (10 cm), and sums of their squares lose all digits.
constexpr double largest_height = 1e9; // Å
constexpr std::size_t longest_edge = 1u << 17;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Å per unit, refused if it is no length.
double length_unit(const std::string& unit, const std::string& where) {
    const std::optional<double> factor = conversion(unit, "Å");
    if (!factor || !std::isfinite(*factor) || !(*factor > 0.0))
        refuse(where, fmt::format("heights in '{}' cannot be read", unit.substr(0, 40)),
               "that is no unit of length", "say which it is: file_unit = \"nm\"");
    return *factor;
}

/// The map of an HDF5 file of Asperity, as `asperity convert` and `asperity surface` write them.
MapFile read_map_hdf5(const std::string& path, const std::string& named) {
    const Hdf5File file = open_hdf5(path);
    const std::string dataset = named.empty() ? "/heights" : named;
    MapFile map;
    map.format = "HDF5";
    map.source = path + ":" + dataset;
    if (!file.is_dataset(dataset))
        refuse(path, "has no data set " + dataset, "the file was opened and searched for it",
               "`h5ls -r FILE` lists what it has; name one: file = \"FILE:/NAME\"");
    const Hdf5File::Shape shape = file.shape(dataset);
    if (shape.size() != 2 || !file.holds_numbers(dataset))
        refuse(map.source, "is no height map",
               fmt::format("a map is numbers of 2 dimensions, it has {}", shape.size()),
               "name another data set");
    map.rows = shape[0];
    map.columns = shape[1];
    require_memory(map.source, "the height map",
                   24.0 * static_cast<double>(map.rows) * static_cast<double>(map.columns));
    map.heights = file.read<double>(dataset);
    const auto text = [&](const std::string& object,
                          const char* name) -> std::optional<std::string> {
        if (!file.has_attribute(object, name)) return std::nullopt;
        return file.read_text_attribute(object, name);
    };
    const auto number = [&](const char* name, double otherwise) {
        return file.has_attribute(dataset, name) ? file.read_attribute<double>(dataset, name)
                                                 : otherwise;
    };
    map.origin = text(dataset, "origin").value_or(text("/", "origin").value_or(""));
    map.file_unit = text(dataset, "unit");
    map.file_scale = number("scale", 1.0);
    if (!file.has_attribute(dataset, "size_x")) return map;
    map.width = number("size_x", nan);
    map.height = number("size_y", *map.width);
    // Sizes are in the file's own unit, whatever the scene says of the heights.
    const std::optional<std::string> unit =
        file.has_attribute(dataset, "size_unit") ? text(dataset, "size_unit") : map.file_unit;
    map.size_in_unit = !unit;
    const double factor = unit ? length_unit(*unit, map.source) : 1.0;
    *map.width *= factor;
    *map.height *= factor;
    return map;
}

/// The bytes of a file that a scene names.
std::string file_contents(const std::string& file) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (!stream || error)
        refuse(file, "the height map cannot be opened",
               error ? error.message() : std::strerror(errno), "check its permissions");
    // A number takes two bytes of text at least, and eight here. Small files are not worth a look.
    constexpr std::uintmax_t small = 16u << 20;
    if (size > small) require_memory(file, "the height map", 6.0 * static_cast<double>(size));
    std::string text(size, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad() || static_cast<std::size_t>(stream.gcount()) != text.size())
        refuse(file, "the height map cannot be read to its end", std::strerror(errno), "");
    return text;
}

MapFile read_raw(const std::string& file, const std::string& dataset) {
    const fs::path name(file);
    if (is_hdf5(file)) return read_map_hdf5(file, dataset);
    if (!dataset.empty() || name.extension() == ".h5")
        refuse(file, "the height map cannot be read", "it is not an HDF5 file",
               "name another file; a text matrix must not be called .h5");
    if (name.extension() == ".xyz")
        refuse(file, "the height map cannot be read", "it is a list of points",
               convert_first(file));
    const std::string bytes = file_contents(file);
    return bytes.starts_with("\x93NUMPY") ? read_map_numpy(bytes, file)
                                          : read_map_text(bytes, file);
}

/// Heights in Å, missing points counted, sizes in Å.
void complete(MapFile& map, const std::string& unit_wanted) {
    const bool given = unit_wanted != "auto";
    if (!given && !map.file_unit && map.size_in_unit)
        refuse(map.source, "the file does not say the unit of its sizes and heights",
               "in an unknown unit they may be anything",
               "say which it is: surface.file_unit = \"nm\"");
    map.unit_assumed = !given && !map.file_unit;
    const std::string unit = given ? unit_wanted : map.file_unit.value_or("Å");
    const double scale = given ? 1.0 : map.file_scale;
    map.unit = scale == 1.0 ? unit : fmt::format("{:g} {}", scale, unit);
    const double factor = scale * length_unit(unit, map.source);
    if (map.size_in_unit) {
        *map.width *= factor;
        *map.height *= factor;
    }
    for (const double size : {map.width.value_or(1.0), map.height.value_or(1.0)})
        if (!(size > 0.0) || !std::isfinite(size))
            refuse(map.source, "the map has no size", fmt::format("{} Å", size),
                   "set surface.file_unit and surface.file_size");
    double largest = 0.0;
    for (std::size_t i = 0; i < map.heights.size(); ++i) {
        double& height = map.heights[i];
        if (!std::isfinite(height)) {
            if (map.first_missing.empty()) {
                map.first_missing =
                    fmt::format("{}[{}, {}]", map.source, i / map.columns, i % map.columns);
                map.first_missing_text = fmt::format("{}", height);
            }
            height = nan;
            ++map.missing;
            continue;
        }
        height *= factor;
        largest = std::max(largest, std::abs(height));
    }
    if (!(largest <= largest_height))
        refuse(map.source, fmt::format("a height of the map is {:g} Å", largest),
               fmt::format("that is more than {:g} Å (10 cm)", largest_height),
               fmt::format("the heights are read in {}: set surface.file_unit, or mark points "
                           "without a height as nan",
                           map.unit));
}

/// Does a comment of a matrix say what Gwyddion and SPIP write into their headers?
bool is_header(std::string_view comment) {
    std::string name(comment.substr(0, comment.find_first_of(":=")));
    if (name.size() == comment.size()) return false;
    std::erase_if(name, [](char c) { return c == ' ' || c == '\t' || c == '#'; });
    for (char& c : name)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const char* known :
         {"width", "height", "edge", "valueunits", "fileformat", "bit2nm", "x-pixels", "y-pixels",
          "x-length", "y-length", "x-unit", "y-unit", "z-unit"})
        if (name == known) return true;
    return false;
}

/// A number, or NaN for what no double holds.
std::optional<double> number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) return nan;
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

} // namespace

MapFile read_map_text(std::string_view text, const std::string& file) {
    constexpr std::string_view blanks = " \t\r";
    MapFile map;
    map.format = "text matrix";
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    std::size_t first_line = 0;
    for (std::size_t line = 1, at = 0; at < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view rest = text.substr(at, end - at);
        at = end + 1;
        const char* const start = rest.data();
        const auto place = [&](const char* word) {
            return fmt::format("{}:{}:{}", file, line, word - start + 1);
        };
        if (const std::size_t hash = rest.find('#'); hash != std::string_view::npos) {
            if (is_header(rest.substr(hash)))
                refuse(place(start + hash), "the matrix has a header",
                       fmt::format("'{}', and of a plain matrix the numbers alone are read",
                                   rest.substr(hash, 60)),
                       convert_first(file));
            rest = rest.substr(0, hash);
        }
        const auto next_word = [&] {
            rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
            const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
            rest.remove_prefix(word.size());
            return word;
        };
        std::size_t columns = 0;
        for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
            const std::optional<double> value = number(word);
            if (!value)
                refuse(
                    place(word.data()),
                    word.find('\0') != std::string_view::npos
                        ? "the height map is no text"
                        : fmt::format("'{}' is no height", word.substr(0, 40)),
                    "a map is HDF5, .npy, or a plain matrix: numbers separated by blanks, one row "
                    "a line",
                    convert_first(file));
            if (!std::isfinite(*value) && map.first_missing.empty()) {
                map.first_missing = place(word.data());
                map.first_missing_text = word.substr(0, 40);
            }
            map.heights.push_back(*value);
            ++columns;
        }
        if (columns == 0) continue;
        if (map.rows++ == 0) map.columns = columns, first_line = line;
        if (columns != map.columns)
            refuse(place(start), "the rows of the map are not of one length",
                   fmt::format("this line has {} numbers, line {} has {}", columns, first_line,
                               map.columns),
                   "give every row as many numbers");
    }
    return map;
}

void refuse(std::string where, std::string what, std::string why, std::string fix) {
    throw SceneError(Problem{std::move(where), std::move(what), std::move(why), std::move(fix)});
}

std::string convert_first(const std::string& file) {
    const auto quoted = [](const std::string& name) {
        return name.find_first_of(" '\"\\$&;()<>*?[]|`!#~") == std::string::npos ? name
                                                                                 : "'" + name + "'";
    };
    const fs::path path(file);
    const std::string out =
        path.stem().string() + (path.extension() == ".h5" ? "-converted.h5" : ".h5");
    return fmt::format("convert it first: asperity convert {} {}", quoted(file), quoted(out));
}

bool is_hdf5(const std::string& file) {
    char head[8] = {};
    std::ifstream(file, std::ios::binary).read(head, sizeof head);
    return std::memcmp(head, "\x89HDF\r\n\x1a\n", sizeof head) == 0;
}

Hdf5File open_hdf5(const std::string& file) {
    try {
        return {FilePlace(file), Hdf5File::Mode::read};
    } catch (const FileError& error) { // an input that the scene names: exit 2, like its other
        Problem problem = error.problems().front(); // mistakes
        problem.fix = convert_first(file);
        throw SceneError(problem);
    }
}

void require_memory(const std::string& where, const char* what, double bytes) {
    const AvailableMemory there = available_memory();
    if (bytes > there.bytes)
        refuse(where, fmt::format("{} is larger than the memory", what),
               fmt::format("it needs {:.3g} GB, and {:.3g} GB are free", bytes / 1e9,
                           there.bytes / 1e9),
               "cut a piece out of it before");
}

MapFile read_map_file(const std::string& name, const std::string& unit) {
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
    MapFile map = of_scene([&] { return read_raw(file, dataset); });
    if (map.source.empty()) map.source = file;
    if (map.rows == 0 || map.columns == 0)
        refuse(map.source, "the height map is empty", "it holds no numbers", "");
    if (map.rows > longest_edge || map.columns > longest_edge)
        refuse(map.source, "the height map is too long",
               fmt::format("{} x {} points, {} along an edge at most", map.rows, map.columns,
                           longest_edge),
               "cut a piece out of it before");
    complete(map, unit);
    return map;
}

} // namespace asperity::io
