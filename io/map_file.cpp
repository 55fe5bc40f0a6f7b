// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Reading of the formats; what their numbers mean is in map_meaning.cpp, what a scene makes of a
// map in height_map.cpp.
#include "io/height_map.hpp"

#include "io/hdf5_numbers.hpp"
#include "io/map_meaning.hpp"
#include "io/scene_file.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace asperity::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_edge = 1u << 17;

/// Returns the data set that is named, else that of the quantity (/heights), else the only one that
/// can be a map.
std::string map_in(const Hdf5File& file, const std::string& named, const MapQuantity& quantity) {
    std::string name = named.empty() ? fmt::format("/{}", quantity.all) : named;
    if (named.empty() && !file.exists(name)) {
        const std::vector<std::string> maps = file.datasets(2);
        if (maps.size() > 1)
            refuse(
                file.path(), "holds more than one map",
                fmt::format("{} data sets of numbers have 2 dimensions: {}{}", maps.size(),
                            fmt::join(maps.begin(),
                                      maps.begin() + std::min<std::ptrdiff_t>(std::ssize(maps), 8),
                                      ", "),
                            maps.size() > 8 ? ", ..." : ""),
                fmt::format("name one: file = \"{}:{}\"", file.path(), maps[0]));
        if (maps.size() == 1) name = maps[0];
    }
    if (!file.is_dataset(name))
        refuse(file.path(), "has no data set " + name, "the file was opened and searched for it",
               "`h5ls -r FILE` lists what it has; name one: file = \"FILE:/NAME\"");
    const std::size_t dimensions = file.shape(name).size();
    if (dimensions != 2 || !file.holds_numbers(name))
        refuse(file.path() + ":" + name, "is no height map",
               fmt::format("a map is numbers of 2 dimensions, it has {}", dimensions),
               dimensions == 3 ? convert_first(file.path()) + " --channel 1"
                               : "name another data set");
    return name;
}

template <class T>
std::optional<T> find(const std::map<std::string, T>& attributes, const char* name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::nullopt : std::optional(found->second);
}

HeightMap read_map_hdf5(const std::string& file, const std::string& named,
                        const MapQuantity& quantity, MapUnits& units) {
    auto sets = read_numbers(
        file, {"the height map",
               [&](const Hdf5File& opened) {
                   for (const char* sign : {"/Measurement_000", "/pixel_to_nm_scaling"})
                       if (opened.exists(sign))
                           refuse(file, "is a file of an instrument's program",
                                  fmt::format("its {} says what its numbers stand for", sign + 1),
                                  convert_first(file));
                   return std::vector{map_in(opened, named, quantity)};
               },
               {"unit", "units", "size_unit", "origin"},
               {"scale", "size_x", "size_y"}});
    const NumberSet whole = std::move(sets.extract("/").mapped());
    NumberSet& set = sets.begin()->second;
    HeightMap map;
    map.format = "HDF5";
    map.source = file + ":" + sets.begin()->first;
    map.rows = set.shape.at(0);
    map.columns = set.shape.at(1);
    map.heights = std::move(set.values);
    // The file may say once what holds of all that is in it.
    set.texts.insert(whole.texts.begin(), whole.texts.end());
    set.numbers.insert(whole.numbers.begin(), whole.numbers.end());
    map.origin = find(set.texts, "origin").value_or("");
    units.unit = find(set.texts, "unit");
    if (!units.unit) units.unit = find(set.texts, "units");
    units.scale = find(set.numbers, "scale").value_or(1.0);
    if (!(units.scale > 0.0) || !std::isfinite(units.scale))
        refuse(map.source, fmt::format("its attribute scale = {:g} is no factor", units.scale),
               "a number of the map stands for so many units",
               "correct the attribute, or remove it");
    map.width = find(set.numbers, "size_x");
    if (map.width) map.height = find(set.numbers, "size_y").value_or(*map.width);
    units.of_sizes = find(set.texts, "size_unit");
    return map;
}

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

/// Returns true if a comment of a matrix is a header of Gwyddion or SPIP. Gwyddion writes the names
/// in the language of its user, and always the unit of the heights: "# Wert-Einheiten: nm".
bool is_header(std::string_view comment) {
    std::string name(comment.substr(0, comment.find_first_of(":=")));
    if (name.size() == comment.size()) return false;
    std::string_view value = comment.substr(name.size() + 1);
    if (const std::string_view word = take_word(value); take_word(value).empty() && word != "A")
        if (conversion(word, "Å")) return true;
    std::erase_if(name, [](char c) { return c == ' ' || c == '\t' || c == '#'; });
    for (char& c : name)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const char* known :
         {"width", "height", "edge", "valueunits", "fileformat", "bit2nm", "x-pixels", "y-pixels",
          "x-length", "y-length", "x-unit", "y-unit", "z-unit"})
        if (name == known) return true;
    return false;
}

HeightMap read_map_text(std::string_view text, const std::string& file) {
    HeightMap map;
    map.format = "text matrix";
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    std::size_t first_line = 0;
    std::vector<std::size_t> blocks; // rows of each, between lines without numbers
    bool between = true;
    for (std::size_t line = 1, at = 0; at < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view left = text.substr(at, end - at);
        at = end + 1;
        const char* const start = left.data();
        const auto place = [&](const char* word) {
            return fmt::format("{}:{}:{}", file, line, word - start + 1);
        };
        if (const std::size_t hash = left.find('#'); hash != std::string_view::npos) {
            if (is_header(left.substr(hash)))
                refuse(place(start + hash), "the matrix has a header",
                       fmt::format("'{}', and of a plain matrix the numbers alone are read",
                                   left.substr(hash, 60)),
                       convert_first(file));
            left = left.substr(0, hash);
        }
        std::size_t columns = 0;
        for (std::string_view word = take_word(left); !word.empty(); word = take_word(left)) {
            const std::optional<double> value = number_of(word);
            if (!value)
                refuse(
                    place(word.data()),
                    word.find('\0') != std::string_view::npos
                        ? "the height map is no text"
                        : fmt::format("'{}' is no height", word.substr(0, 40)),
                    "a map is HDF5, .npy, or a plain matrix: numbers separated by blanks, one row "
                    "a line",
                    convert_first(file));
            if (!(std::abs(*value) < no_height) && map.first_missing.empty()) {
                map.first_missing = place(word.data());
                map.first_missing_text = word.substr(0, 40);
            }
            map.heights.push_back(*value);
            ++columns;
        }
        if (columns == 0) {
            between = true;
            continue;
        }
        if (std::exchange(between, false)) blocks.push_back(0);
        ++blocks.back();
        if (map.rows++ == 0) map.columns = columns, first_line = line;
        if (columns != map.columns)
            refuse(place(start), "the rows of the map are not of one length",
                   fmt::format("this line has {} numbers, line {} has {}", columns, first_line,
                               map.columns),
                   "give every row as many numbers");
    }
    if (blocks.size() > 1 && blocks[0] > 1 &&
        std::ranges::count(blocks, blocks[0]) == std::ssize(blocks))
        refuse(file, fmt::format("holds {} blocks of {} rows", blocks.size(), blocks[0]),
               "lines without numbers separate them: they may be several maps",
               convert_first(file) + " --channel 1; or take those lines out if it is one map");
    if (map.columns == 3 && map.rows > 3)
        refuse(file, "has three numbers a line",
               "they are points x, y and height rather than the rows of a map",
               convert_first(file));
    return map;
}

// NumPy's .npy (numpy.lib.format, versions 1 to 3): magic, a dictionary of three keys as text, the
// values. Numbers of the usual kinds, rows or columns first.

/// Returns the text behind 'key': in the header, up to the next comma outside of parentheses.
std::string_view entry(std::string_view header, std::string_view key) {
    std::size_t at = header.find(key);
    if (at == std::string_view::npos) return {};
    at = header.find(':', at + key.size());
    if (at == std::string_view::npos) return {};
    at = header.find_first_not_of(' ', at + 1);
    if (at == std::string_view::npos) return {};
    const char end = header[at] == '(' ? ')' : ',';
    return header.substr(at, header.find(end, at) - at);
}

template <class T>
double value_at(const char* from, bool swap) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, from, sizeof(T));
    if (swap) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
}

/// Readers of the types, such as "f8".
constexpr std::pair<std::string_view, double (*)(const char*, bool)> readers[] = {
    {"f8", value_at<double>},        {"f4", value_at<float>},
    {"i1", value_at<std::int8_t>},   {"i2", value_at<std::int16_t>},
    {"i4", value_at<std::int32_t>},  {"i8", value_at<std::int64_t>},
    {"u1", value_at<std::uint8_t>},  {"u2", value_at<std::uint16_t>},
    {"u4", value_at<std::uint32_t>}, {"u8", value_at<std::uint64_t>},
};

HeightMap read_map_numpy(std::string_view bytes, const std::string& file) {
    const auto damaged = [&](const std::string& why) {
        refuse(file, "the height map cannot be read", why,
               "save it again: numpy.save(\"heights.npy\", heights)");
    };
    if (bytes.size() < 12) damaged("the file is cut short");
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    const bool wide = byte(6) >= 2; // length of the header in 4 bytes rather than 2
    std::size_t length = byte(8) + 256u * byte(9), start = 10;
    if (wide)
        length += 65536u * byte(10) + 16777216u * static_cast<std::size_t>(byte(11)), start = 12;
    if (length > bytes.size() - start) damaged("its header is cut short");
    const std::string_view header = bytes.substr(start, length),
                           data = bytes.substr(start + length);

    const std::string_view type = entry(header, "'descr'");
    const auto* const reader = std::find_if(std::begin(readers), std::end(readers), [&](auto& r) {
        return type.size() == 5 && r.first == type.substr(2, 2);
    });
    if (reader == std::end(readers))
        damaged(fmt::format("its numbers are of type {}, and integers or floats are needed",
                            type.substr(0, 40)));
    const bool swap = (type[1] == '>') == (std::endian::native == std::endian::little);
    const bool columns_first = entry(header, "'fortran_order'").starts_with("True");

    std::vector<std::size_t> extent;
    std::string digits(entry(header, "'shape'")); // "(6, 6"
    std::replace_if(
        digits.begin(), digits.end(), [](char c) { return c < '0' || c > '9'; }, ' ');
    std::istringstream shape(digits);
    std::size_t value = 0;
    while (shape >> value)
        extent.push_back(value);
    if (value == std::numeric_limits<std::size_t>::max()) // read from a number of more than 64 bits
        damaged("its shape is no shape");
    if (extent.size() != 2)
        refuse(file, "is no height map",
               fmt::format("it has {} dimensions, a map has 2", extent.size()),
               extent.size() == 3 ? convert_first(file) + " --channel 1" : "name another file");
    const std::size_t size = static_cast<std::size_t>(type[3] - '0');
    HeightMap map;
    map.format = "NumPy";
    if (extent[0] == 0 || extent[1] == 0) return map; // empty, for any other extent
    if (extent[0] > data.size() / size / extent[1])
        damaged(fmt::format("{} x {} numbers of {} bytes are declared, and {} bytes are there",
                            extent[0], extent[1], size, data.size()));
    map.rows = extent[0];
    map.columns = extent[1];
    map.heights.resize(map.rows * map.columns);
    for (std::size_t r = 0; r < map.rows; ++r)
        for (std::size_t c = 0; c < map.columns; ++c)
            map.heights[r * map.columns + c] = reader->second(
                data.data() + size * (columns_first ? c * map.rows + r : r * map.columns + c),
                swap);
    return map;
}

HeightMap read_raw(const std::string& file, const std::string& dataset, const MapQuantity& quantity,
                   MapUnits& units) {
    const fs::path name(file);
    if (is_hdf5(file)) return read_map_hdf5(file, dataset, quantity, units);
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

} // namespace

HeightMap read_map_file(const std::string& name, const MapOptions& said) {
    std::string file = name, dataset;
    if (const std::size_t colon = file.find(":/"); colon != std::string::npos) {
        dataset = file.substr(colon + 1);
        file.resize(colon);
    }
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        refuse(file, "the height map cannot be opened",
               fs::exists(file, error) ? "it is no file" : "there is no such file",
               fmt::format("check {}", said.quantity.key));
    MapUnits units;
    HeightMap map = read_raw(file, dataset, said.quantity, units);
    if (map.source.empty()) map.source = file;
    if (map.rows == 0 || map.columns == 0)
        refuse(map.source, "the height map is empty", "it holds no numbers",
               "export the heights again, or name another file");
    if (map.rows > longest_edge || map.columns > longest_edge)
        refuse(map.source, "the height map is too long",
               fmt::format("{} x {} points, {} along an edge at most", map.rows, map.columns,
                           longest_edge),
               "cut a piece out of it before");
    complete(map, units, said);
    if (said.quantity.unit == MapQuantity().unit) note_doubts(map, said.quantity.key);
    return map;
}

} // namespace asperity::io
