// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Which format a file has, and what all formats have in common: units, missing points, limits.
#include "io/map_file.hpp"

#include "io/available_memory.hpp"
#include "io/error.hpp"
#include "io/map_formats.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <cerrno>
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

/// Formats that the Python package can convert, by their first bytes.
struct Foreign {
    std::string_view magic;
    const char* name;
};
constexpr Foreign foreign[] = {{"GWYP", "a Gwyddion file (.gwy)"},
                               {"GWYO", "an old Gwyddion file (.gwy)"},
                               {"Gwyddion Simple Field", "a Gwyddion Simple Field (.gsf)"},
                               {"CDF\x01", "a netCDF file"},
                               {"CDF\x02", "a netCDF file"},
                               {"CDF\x05", "a netCDF file"},
                               {"PK\x03\x04", "an archive, such as X3P"},
                               {"aBCR-1.0", "a Surface Data File (.sdf)"},
                               {"bBCR-1.0", "a Surface Data File (.sdf)"},
                               {"aISO-1.0", "a Surface Data File (.sdf)"},
                               {"bISO-1.0", "a Surface Data File (.sdf)"}};

RawMap read_raw(const std::string& file, const std::string& dataset) {
    std::ifstream stream(file, std::ios::binary);
    char head[24] = {};
    stream.read(head, sizeof head);
    const std::string_view start(head, static_cast<std::size_t>(stream.gcount()));
    stream.close();
    const std::string ending = fs::path(file).extension().string();
    if (start.starts_with("\x89HDF\r\n\x1a\n")) return read_map_hdf5(file, dataset);
    if (!dataset.empty() || ending == ".h5")
        refuse(file, "the height map cannot be read", "it is not an HDF5 file",
               "name another file; a text matrix must not be called .h5");
    for (const auto& [magic, name] : foreign)
        if (start.starts_with(magic))
            refuse(file, "the height map cannot be read", fmt::format("it is {}", name),
                   fmt::format("convert it: python3 -m asperity.maps {} heights.h5; or export it "
                               "as text with a header, HDF5 or .npy",
                               file));
    if (start.starts_with("\x93NUMPY"))
        return read_map_numpy(file_contents(file, "the height map"), file);
    return read_map_text(file_contents(file, "the height map"), file, ending == ".xyz");
}

/// Heights in Å, missing points counted, sizes in Å.
void complete(RawMap& map, const std::string& unit_wanted) {
    const bool given = unit_wanted != "auto";
    if (!given && !map.file_unit && map.size_in_unit)
        refuse(map.source, fmt::format("the {} does not say its unit", map.format),
               "sizes and heights in an unknown unit may be anything",
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
            height = std::numeric_limits<double>::quiet_NaN();
            continue;
        }
        height *= factor;
        largest = std::max(largest, std::abs(height));
    }
    map.missing = static_cast<std::size_t>(
        std::count_if(map.heights.begin(), map.heights.end(), [](double h) { return h != h; }));
    if (!(largest <= largest_height))
        refuse(map.source, fmt::format("a height of the map is {:g} Å", largest),
               fmt::format("that is more than {:g} Å (10 cm)", largest_height),
               fmt::format("the heights are read in {}: set surface.file_unit, or mark points "
                           "without a height as nan",
                           map.unit));
}

} // namespace

void refuse(std::string where, std::string what, std::string why, std::string fix) {
    throw SceneError(Problem{std::move(where), std::move(what), std::move(why), std::move(fix)});
}

std::string file_contents(const std::string& file, const char* what) {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (!stream || error)
        refuse(file, fmt::format("{} cannot be opened", what),
               error ? error.message() : std::strerror(errno), "check its permissions");
    // A number takes two bytes of text at least, and eight here. Small files are not worth a look.
    constexpr std::uintmax_t small = 16u << 20;
    if (size > small && 6.0 * static_cast<double>(size) > available_memory().bytes)
        refuse(file, fmt::format("{} is larger than the memory", what),
               fmt::format("it has {:.3g} GB", static_cast<double>(size) / 1e9),
               "cut a piece out of it before");
    std::string text(size, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad() || static_cast<std::size_t>(stream.gcount()) != text.size())
        refuse(file, fmt::format("{} cannot be read to its end", what), std::strerror(errno), "");
    return text;
}

double length_unit(const std::string& unit, const std::string& where) {
    const std::optional<double> factor = conversion(unit, "Å");
    if (!factor || !std::isfinite(*factor) || !(*factor > 0.0))
        refuse(where, fmt::format("heights in '{}' cannot be read", unit.substr(0, 40)),
               "that is no unit of length", "say which it is: file_unit = \"nm\"");
    return *factor;
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
    RawMap map;
    try {
        map = read_raw(file, dataset);
    } catch (const FileError& damaged) { // an input that the scene names: exit 2, like its other
        throw SceneError(damaged.problems()); // mistakes
    }
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
