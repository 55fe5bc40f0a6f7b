// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Height maps in HDF5. libhdf5 trusts its files: a damaged one can end the process inside it. A map
// comes from elsewhere, so it is read in a child process, which sends back what it found.
#include "io/available_memory.hpp"
#include "io/child_process.hpp"
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"
#include "io/map_formats.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

namespace asperity::io {

namespace {

/// No filter of HDF5 makes a map smaller by more.
constexpr std::uint64_t largest_compression = 1100;
constexpr std::uint64_t largest_header = 1u << 20; ///< of what the child sends
constexpr std::size_t most_members = 10000;        ///< of a group, that are looked at

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
    std::size_t looked = 0;
    const auto look = [&](const std::string& path) {
        if (++looked > most_members)
            refuse(file.path(), "holds too many data sets to look through", "",
                   fmt::format("say which is the map: file = \"{}:/NAME\"", file.path()));
        if (!file.is_dataset(path)) return false;
        if (file.shape(path).size() == 2) found.push_back(path);
        return true;
    };
    for (const std::string& name : file.members("/")) {
        if (look("/" + name) || !file.is_group("/" + name)) continue;
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

/// Sizes and type, before anything is allocated.
void check_dataset(const Hdf5File& file, const std::string& dataset, const std::string& source,
                   const Hdf5File::Shape& shape) {
    if (shape.size() != 2)
        refuse(source, "is no height map",
               fmt::format("it has {} dimensions, a map has 2", shape.size()),
               "name another data set");
    if (shape[0] == 0 || shape[1] == 0) return; // "is empty"
    if (!file.holds_numbers(dataset))
        refuse(source, "is no height map", "its values are no numbers", "name another data set");
    const std::uint64_t stored = file.stored_bytes(dataset);
    if (stored == 0 || shape[0] / largest_compression > stored / shape[1])
        refuse(source, "the height map is not whole",
               fmt::format("{} x {} values are declared, and {} bytes are stored", shape[0],
                           shape[1], stored),
               "write it again");
    const double needed = 3.0 * 8.0 * static_cast<double>(shape[0]) * static_cast<double>(shape[1]);
    if (needed > available_memory().bytes)
        refuse(source, "the height map is larger than the memory",
               fmt::format("{} x {} values need {:.3g} GB, and {:.3g} GB are free", shape[0],
                           shape[1], needed / 1e9, available_memory().bytes / 1e9),
               "cut a piece out of it before");
}

Json header_of(const RawMap& map) {
    Json header = {{"rows", map.rows},
                   {"columns", map.columns},
                   {"source", map.source},
                   {"origin", map.origin}};
    if (map.width) header["width"] = *map.width;
    if (map.height) header["height"] = *map.height;
    if (map.file_unit) header["unit"] = *map.file_unit;
    return header;
}

Json header_of(const Problem& problem) {
    return {{"where", problem.where},
            {"what", problem.what},
            {"why", problem.why},
            {"fix", problem.fix}};
}

bool send(int pipe, const Json& header) {
    const std::string text = json_text(header);
    const std::uint64_t size = text.size();
    return write_all(pipe, &size, sizeof size) && write_all(pipe, text.data(), text.size());
}

} // namespace

RawMap read_map_hdf5_here(const std::string& path, const std::string& named) {
    RawMap map;
    map.format = "HDF5";
    const Hdf5File file(path, Hdf5File::Mode::read);
    const std::string dataset = find_dataset(file, named);
    map.source = path + ":" + dataset;
    const Hdf5File::Shape shape = file.shape(dataset);
    check_dataset(file, dataset, map.source, shape);
    map.rows = shape[0];
    map.columns = shape[1];
    map.heights = file.read<double>(dataset);
    for (const std::string& place : {std::string("/"), dataset})
        if (file.has_attribute(place, "origin"))
            map.origin = file.read_text_attribute(place, "origin");
    if (file.has_attribute(dataset, "unit"))
        map.file_unit = file.read_text_attribute(dataset, "unit");
    if (file.has_attribute(dataset, "size_x")) {
        // Sizes are in the file's own unit, whatever the scene says of the heights.
        const double x = file.read_attribute<double>(dataset, "size_x");
        const double y = file.has_attribute(dataset, "size_y")
                             ? file.read_attribute<double>(dataset, "size_y")
                             : x;
        if (!(x > 0.0) || !(y > 0.0) || !std::isfinite(x) || !std::isfinite(y))
            refuse(map.source, fmt::format("is {} x {} wide", x, y),
                   "a size is a number above zero", "correct its attributes size_x and size_y");
        map.width = x;
        map.height = y;
        map.size_in_unit = !map.file_unit;
        if (map.file_unit) {
            const double factor = length_unit(*map.file_unit, map.source);
            *map.width *= factor;
            *map.height *= factor;
        }
    }
    return map;
}

RawMap read_map_hdf5(const std::string& file, const std::string& dataset) {
    std::error_code error;
    const double megabytes = static_cast<double>(std::filesystem::file_size(file, error)) / 1e6;
    const auto seconds = static_cast<unsigned>(60.0 + megabytes);
    const auto work = [&](int pipe) {
        try {
            const RawMap map = read_map_hdf5_here(file, dataset);
            if (send(pipe, header_of(map)))
                write_all(pipe, map.heights.data(), map.heights.size() * sizeof(double));
        } catch (const Error& refused) {
            send(pipe, header_of(refused.problems().front()));
        }
    };
    RawMap map;
    bool whole = false;
    Problem refused;
    const auto take = [&](int pipe) {
        std::uint64_t size = 0;
        if (!read_all(pipe, &size, sizeof size) || size > largest_header) return;
        std::string text(size, '\0');
        if (!read_all(pipe, text.data(), text.size())) return;
        const Json header = parse_json(text, file);
        if (header.contains("what")) {
            refused = {header["where"], header["what"], header["why"], header["fix"]};
            return;
        }
        map.format = "HDF5";
        map.source = header["source"].get<std::string>();
        map.origin = header["origin"].get<std::string>();
        map.rows = header["rows"];
        map.columns = header["columns"];
        if (header.contains("unit")) map.file_unit = header["unit"].get<std::string>();
        if (header.contains("width")) {
            map.width = header["width"].get<double>();
            map.height = header["height"].get<double>();
            map.size_in_unit = !map.file_unit;
        }
        map.heights.resize(map.rows * map.columns);
        whole = read_all(pipe, map.heights.data(), map.heights.size() * sizeof(double));
    };
    const std::string ended = in_child_process(seconds, work, take);
    if (!refused.what.empty()) throw SceneError(refused);
    if (!ended.empty() || !whole)
        refuse(file, "the height map cannot be read",
               "the HDF5 library ended " + (ended.empty() ? "early" : ended) +
                   " while it read the file, which must be damaged",
               "write the map again, for example as text or .npy");
    return map;
}

} // namespace asperity::io
