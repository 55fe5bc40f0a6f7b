// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The surface of a case: made from its spectrum, or from the map or the atoms of its file.
#include "engine/case/case.hpp"
#include "engine/case/memory.hpp"
#include "engine/case/site_field.hpp"
#include "engine/case/spacing_limits.hpp"
#include "engine/surface/pair.hpp"

#include "io/atoms_file.hpp"
#include "io/error.hpp"
#include "io/files.hpp"
#include "io/height_map.hpp"
#include "io/json.hpp"
#include "io/scene_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>

namespace asperity {

namespace {

std::string shown(const std::string& type) {
    return type.size() <= 20 ? type : type.substr(0, 20) + "...";
}

/// Returns the types of a file in words: "2 types: Au (300 atoms), C (255)".
std::string types_of(const io::AtomsFile& file) {
    std::vector<std::size_t> count(file.types.size(), 0);
    for (const std::int32_t type : file.type)
        ++count[static_cast<std::size_t>(type)];
    std::string text = fmt::format("{} types: ", count.size());
    for (std::size_t t = 0; t < count.size(); ++t)
        text += fmt::format("{}{} ({}{})", t ? ", " : "", shown(file.types[t]), count[t],
                            t ? "" : " atoms");
    return text;
}

/// Returns the row of interface.pairs of each type of the file.
std::vector<std::int32_t> rows_of(const Case& c, const io::AtomsFile& file) {
    std::vector<std::int32_t> rows;
    for (const std::string& type : file.types) {
        const auto row = std::find(c.types.begin(), c.types.end(), type);
        if (row == c.types.end())
            throw std::invalid_argument(
                c.types.empty()
                    ? fmt::format("the atoms in {} are of {}; give each type its potential, for "
                                  "example interface.pairs = [\"{} 0.1 3.28\", \"{} 0.05 3\"] with "
                                  "epsilon in eV and r0 in Å, or one type to all",
                                  c.scene.surface.file, types_of(file), shown(file.types[0]),
                                  shown(file.types[1]))
                    : fmt::format("interface.pairs has no type '{}', and the atoms in {} are of "
                                  "{}; give it a potential there",
                                  shown(type), c.scene.surface.file, types_of(file)));
        rows.push_back(static_cast<std::int32_t>(row - c.types.begin()));
    }
    return rows;
}

/// Returns the atoms of the scene's file, whose periodic box must be the block's.
Surface atoms_of_file(const Case& c, const SurfaceOptions& options, const Communicator& world) {
    const auto& s = c.scene.surface;
    io::AtomsFile file = io::read_atoms_file(c.file);
    const double edge = options.length;
    // Files have six digits and more.
    const auto differs = [&](double width) { return std::abs(width - edge) > 1e-6 * edge; };
    if (differs(file.width_x) || differs(file.width_y)) {
        const double sites = std::round(file.width_x / s.spacing);
        const bool square = std::abs(file.width_x - file.width_y) <= 1e-6 * file.width_x;
        throw std::invalid_argument(fmt::format(
            "the periodic box of the atoms in {} is {:.8g} x {:.8g} Å, and the block's {:.8g} x "
            "{:.8g} Å ({} sites of {:.6g} Å); {}",
            s.file, file.width_x, file.width_y, edge, edge, s.sites, s.spacing,
            square && sites >= 4.0 && sites <= 32768.0
                ? fmt::format("take surface.sites = {0:.0f} and surface.spacing = {1:.10g}, or "
                              "repeat or cut the atoms",
                              sites, file.width_x / sites)
                : std::string("repeat or cut the atoms to the block's square box")));
    }
    const std::size_t count = file.x.size();
    std::vector<std::int32_t> type;
    if (file.types.size() > 1 || !c.types.empty()) {
        const std::vector<std::int32_t> rows = rows_of(c, file);
        for (const std::int32_t t : file.type)
            type.push_back(rows[static_cast<std::size_t>(t)]);
    }
    std::uint32_t digest = 0;
    for (const auto* values : {&file.x, &file.y, &file.z})
        digest = io::digest_of(std::as_bytes(std::span(*values)), digest);
    digest = io::digest_of(std::as_bytes(std::span(std::as_const(type))), digest);
    Surface surface = surface_from_atoms(
        options, {std::move(file.x), std::move(file.y), std::move(file.z), std::move(type)}, world);
    surface.notes.insert(
        surface.notes.begin(),
        fmt::format("{}: {} atoms of {}", std::filesystem::path(s.file).filename().string(), count,
                    file.types.size() > 1 ? types_of(file) : "type " + shown(file.types[0])));
    surface.file_digest = digest;
    return surface;
}

/// Checks the memory of the ranks before anything is allocated: for their bands of the heights, and
/// of the waves that make_surface() and measure() need. Throws io::SceneError. Collective.
void require_memory_for_heights(const Case& c, const Communicator& world) {
    const double n = c.substrate();
    const double for_site = 8.0 + (c.surface.kind == SurfaceKind::flat ? 16.0 : 48.0);
    const auto lacks = memory_shortage(world, for_site * n * n / world.size());
    if (!lacks) return;
    io::Problems problems = c.scene.problems();
    problems.add("surface.sites",
                 fmt::format("= {}: its surface does not fit into memory", c.scene.surface.sites),
                 lacks->text(), "take fewer sites, or more machines");
    problems.throw_if_any();
}

} // namespace

namespace {

/// Calls make(). Adds its std::invalid_argument to the problems of a key.
template <class Make>
Surface with_key(const Case& c, const char* key, const Make& make) {
    try {
        return make();
    } catch (const std::invalid_argument& e) {
        io::Problems problems = c.scene.problems();
        problems.add(key, std::string(": ") + e.what());
        problems.throw_if_any();
        throw;
    }
}

/// Checks the memory of the ranks for what is made of a map of a file. bytes: those of this rank.
/// Throws io::SceneError. Collective.
void require_memory_for(const FieldFile& field, const char* what, double bytes,
                        const Communicator& world) {
    if (const auto lacks = memory_shortage(world, bytes))
        throw io::SceneError({field.name, fmt::format("{} is larger than the memory", what),
                              lacks->text(), "cut a piece out of it before"});
}

/// Returns the surface of a map in the box. whole: true returns that of the whole map, with the
/// spacing of the box.
Surface surface_of_map(const Case& c, const FieldFile& field, SurfaceOptions options, bool whole,
                       const Communicator& world) {
    const std::string key(field.how.quantity.key);
    FieldMap read = read_field(field, world);
    io::HeightMap& map = read.map;
    options.map_edge = map.width.value_or(0.0);
    const int points = static_cast<int>(map.rows), covered = sites_of_map(options);
    if (points != covered && c.scene.surface.resample == Resample::none)
        throw std::invalid_argument(fmt::format(
            "the map in {} has {} x {} values, but covers {} x {} {}; give a map of that size, "
            "set surface.sites = {}, or let it be resampled with surface.resample = "
            "\"band-limited\"",
            field.name, points, points, covered, covered,
            c.surface.counter ? "sites" : "atoms of the substrate", points));
    // The resampled map and its waves, before the box is cut out of it.
    if (points != covered)
        require_memory_for(field, "the resampled map",
                           32.0 * covered * static_cast<double>(covered) / world.size(), world);
    const double edge = options.map_edge > 0.0 ? options.map_edge : options.length;
    if (options.map_edge <= 0.0)
        map.notes.push_back(fmt::format("the file does not say how wide the map is: taken as wide "
                                        "as the box, {:.6g} Å ({}_size)",
                                        edge, key));
    if (whole && covered != options.sites) {
        options.length *= static_cast<double>(covered) / options.sites;
        options.sites = covered;
        options.periodic = options.repeats = false; // the box is cut out of it
    }
    Surface surface = surface_from_heights(options, std::move(map.heights), points, points, world);
    surface.doubts.insert(surface.doubts.begin(), map.doubts.begin(), map.doubts.end());
    surface.notes.insert(surface.notes.begin(), surface.doubts.begin(), surface.doubts.end());
    surface.origin = std::move(map.origin);
    surface.file_digest = read.digest;
    surface.notes.insert(surface.notes.begin(),
                         fmt::format("{}: {} x {} points of {:.4g} Å, {:.6g} Å wide, heights in {}",
                                     std::filesystem::path(field.name).filename().string(), points,
                                     points, edge / points, edge, map.unit));
    surface.notes.insert(surface.notes.begin() + 1, map.notes.begin(), map.notes.end());
    if (surface.statistics.rms > surface.length)
        throw std::invalid_argument(fmt::format(
            "the heights of the map, {:.4g} Å rms in {}, are larger than the box, {:.6g} Å; {}",
            surface.statistics.rms, map.unit, surface.length,
            surface.doubts.empty()
                ? fmt::format("correct the unit of the file ({}_unit), or its size", key)
                : fmt::format("{}", fmt::join(surface.doubts, "; "))));
    return surface;
}

/// Returns the surface of the second solid in the box.
Surface counter_of(const Case& c, const Communicator& world) {
    const Scene::Surface::Counter& keys = c.scene.surface.counter;
    SurfaceOptions box = c.surface;
    box.kind = SurfaceKind::file;
    box.rms = box.radius = 0.0;
    box.holes = false;
    const FieldFile field = counter_heights_of(c);
    const Surface whole = surface_of_map(c, field, box, true, world);
    const CounterPlace place{keys.turn, keys.shift_x, keys.shift_y};
    if (whole.sites > box.sites && keys.crop == MapCrop::none)
        throw std::invalid_argument(fmt::format(
            "the map is {:.6g} Å wide, and the box {:.6g} Å; take "
            "surface.counter_crop = \"middle\" to cut the box out of it, or stretch the "
            "map on purpose with surface.counter_size = {:.6g}",
            whole.length, box.length, box.length));
    if (!place.is_quarter())
        require_memory_for(
            field, "the turned map",
            world.root() ? 400.0 * whole.sites * static_cast<double>(whole.sites) : 0.0, world);
    return counter_in_box(box, whole, place);
}

/// Returns the surface of the block, or of the substrate of a case without a second solid.
Surface own_surface(const Case& c, const SurfaceOptions& options, const Communicator& world) {
    if (options.kind == SurfaceKind::atoms) return atoms_of_file(c, options, world);
    if (options.kind == SurfaceKind::file)
        return surface_of_map(c, heights_of(c), options, false, world);
    return make_surface(options, world);
}

} // namespace

Surface surface_of(const Case& c, const Communicator& world) {
    require_memory_for_heights(c, world);
    SurfaceOptions own = c.surface;
    if (own.counter) own.radius = 0.0; // the pair has it
    Surface surface = with_key(c, c.scene.surface.reads_file() ? "surface.file" : "surface.kind",
                               [&] { return own_surface(c, own, world); });
    if (own.counter)
        surface = with_key(c, "surface.counter", [&] {
            return pair_of(c.surface, std::move(surface), counter_of(c, world));
        });
    if (own.kind != SurfaceKind::file && !own.counter) return surface;
    for (std::string& note :
         notes_on_roughness(surface.statistics.rms, surface.statistics.rms_slope, surface.length))
        surface.notes.push_back(std::move(note));
    const double softness = lattice_softness(c.simulation.block, surface.statistics);
    if (softness < 0.97)
        surface.notes.push_back(fmt::format(
            "the roughness has waves of a few spacings, for which a lattice is softer than a "
            "continuum: to flatten this map takes {:.0f} % less energy than q E*/2 for each wave; "
            "resample it on more sites (surface.resample) for a continuum's numbers",
            100.0 * (1.0 - softness)));
    return surface;
}

std::vector<std::string> notes_of(const Case& c, const Surface& surface) {
    std::vector<std::string> notes = c.notes;
    notes.insert(notes.end(), surface.notes.begin(), surface.notes.end());
    return notes;
}

std::vector<std::string> examine(const Case& c, const Communicator& world) {
    std::vector<std::string> notes = c.notes;
    io::Problems problems = c.scene.problems();
    for (const io::Problem& problem : c.refused)
        problems.add(problem);
    if (c.surface.reads_file()) {
        try {
            notes = notes_of(c, surface_of(c, world));
        } catch (const io::SceneError& error) {
            for (const io::Problem& problem : error.problems())
                problems.add(problem);
        } catch (const RootFailure& error) { // whose reason the root has
            problems.add("surface.file", std::string(": ") + error.what());
        }
    }
    problems.throw_if_any();
    return notes;
}

} // namespace asperity
