// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/case/site_field.hpp"
#include "engine/run/run_result.hpp"
#include "engine/scene/map_statistics.hpp"
#include "io/error.hpp"
#include "io/height_map.hpp"
#include "io/json.hpp"
#include "io/result.hpp"
#include "io/result_directory.hpp"
#include "io/scene_reader.hpp"
#include "io/terminal.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace asperity {

namespace {

/// Prints the contents of the file of a measured surface, before the scene uses them.
void print_map_file(const Case& c) {
    const FieldFile field = heights_of(c);
    const io::HeightMap map =
        io::read_map_file(field.file, {.unit = field.how.unit, .size = field.how.size});
    const std::optional<double>&width = map.width, &height = map.height;
    const double dx = width.value_or(0.0) / static_cast<double>(map.columns),
                 dy = height.value_or(0.0) / static_cast<double>(map.rows);
    const MapStatistics s = map_statistics(
        map.heights, {Communicator(), static_cast<int>(map.columns), static_cast<int>(map.rows)},
        dx, dy, false);
    const auto if_sized = [&](double value, const char* format) {
        return width ? fmt::format(fmt::runtime(format), value) : std::string("?");
    };
    io::Table table({"the file", "", ""}, "<<<");
    table.row({"name", std::filesystem::path(field.name).filename().string(), map.format});
    table.row({"points", fmt::format("{} x {}", map.columns, map.rows),
               map.missing > 0 ? fmt::format("{} without a height", map.missing) : ""});
    table.row({"size", width ? fmt::format("{:.6g} x {:.6g} Å", *width, *height) : "?",
               field.how.size ? "surface.file_size"
               : width        ? ""
                              : "the file does not say"});
    table.row({"pixel", width ? fmt::format("{:.5g} x {:.5g} Å", dx, dy) : "?", ""});
    table.row({"heights in", map.unit,
               field.how.unit != "auto" ? "surface.file_unit"
               : map.unit_assumed       ? "assumed: the file does not say"
                                        : ""});
    table.row({"rms height", fmt::format("{:.8g} Å", s.rms_height), "about the mean"});
    table.row({"rms slope", if_sized(s.rms_slope, "{:.8g}"), "differences of neighbours"});
    table.row({"rms curvature", if_sized(s.rms_curvature, "{:.8g} 1/Å"), "second differences"});
    table.row({"lowest", fmt::format("{:.8g} Å", s.lowest), ""});
    table.row({"highest", fmt::format("{:.8g} Å", s.highest), ""});
    table.print(stdout);
    fmt::print("\n");
}

/// Writes the files of a surface. Returns lines to print.
std::vector<std::string> write_surface(const Case& c, const Surface& surface,
                                       const std::string& out) {
    const Scene& scene = c.scene;
    const io::ResultDirectory place(
        {out, scene.name + "-surface", false, false, {"heights.h5", "result.json"}, c.inputs()});

    const std::string file = place.directory() / "heights.h5";
    io::HeightMap map;
    map.rows = map.columns = static_cast<std::size_t>(surface.sites);
    map.heights = surface.height;
    map.width = map.height = surface.length;
    map.origin = surface.origin;
    std::vector<double> q, realised, target;
    for (const SpectrumBin& bin : surface.statistics.spectrum) {
        q.push_back(bin.q);
        realised.push_back(bin.realised);
        target.push_back(bin.target);
    }
    const LineStatistics lines = line_statistics(surface.height, surface.sites, surface.length);
    io::write_height_map(file, map,
                         {{"/spectrum/q", "1/Å", q},
                          {"/spectrum/realised", "Å^4", realised},
                          {"/spectrum/target", "Å^4", target},
                          {"/spectrum/line_q", "1/Å", lines.q},
                          {"/spectrum/c1d", "Å^3", lines.c1d},
                          {"/spectrum/line_r", "Å", lines.r},
                          {"/spectrum/autocorrelation", "Å^2", lines.acf},
                          {"/spectrum/scale_dependent_slope", "1", lines.slope}});

    io::write_result(place.directory(), surface_result(c, surface));
    std::vector<std::string> said;
    for (const std::string& note : place.notes())
        said.push_back("note: " + note);
    said.push_back("heights and spectrum in " + file);
    return said;
}

void print_surface(const Surface& surface) {
    const SurfaceStatistics& statistics = surface.statistics;
    io::Table table({"the surface made", "", ""}, "<><");
    if (surface.atoms.size() > 0) table.row({"atoms", fmt::format("{}", surface.atoms.size()), ""});
    table.row({surface.atoms.size() > 0 ? "sites" : "atoms",
               fmt::format("{0} x {0}", surface.sites),
               surface.atoms.size() > 0 ? "heights of the topmost atoms" : ""});
    table.row({"edge", io::cell(surface.length, 6), "Å"});
    table.row({"pixel", io::cell(surface.length / surface.sites), "Å"});
    table.row({"rms height", io::cell(statistics.rms), "Å"});
    table.row({"rms slope", io::cell(statistics.rms_slope), "spectral"});
    table.row({"rms curvature", io::cell(statistics.rms_curvature), "1/Å, spectral"});
    if (surface.radius == 0.0) {
        const double pixel = surface.length / surface.sites;
        const MapStatistics s = map_statistics(surface.height, surface.bands(), pixel, pixel, true);
        table.row({"rms slope", io::cell(s.rms_slope), "differences of neighbours"});
        table.row({"rms curvature", io::cell(s.rms_curvature), "1/Å, second differences"});
    }
    table.row({"lowest", io::cell(statistics.lowest), "Å"});
    table.row({"highest", io::cell(statistics.highest), "Å"});
    if (surface.pair) {
        const SurfacePair& pair = *surface.pair;
        table.row({"first solid", io::cell(pair.own.rms), "Å, rms height"});
        table.row({"", io::cell(pair.own.rms_slope), "rms slope"});
        table.row({"second solid", io::cell(pair.counter.rms), "Å, rms height"});
        table.row({"", io::cell(pair.counter.rms_slope), "rms slope"});
        table.row({"correlation", io::cell(pair.correlation), "of the heights"});
        table.row({"overlap", io::cell(pair.band_overlap), "of the spectra"});
    }
    table.print(stdout);
}

/// Reads the case like case_of(), but ignores mistakes in keys that the surface does not need.
/// Throws io::SceneError.
Case surface_case_of(const Arguments& given, int ranks) {
    std::vector<std::string> overrides;
    const std::string file = scene_file(given, overrides);
    io::Problems found;
    const Scene scene = read_scene_text(
        io::read_scene_file(file), file == io::standard_input ? "stdin" : file, overrides, found);
    found.throw_if_any();
    Case c = resolve(scene, ranks, found);
    std::vector<io::Problem> of_surface;
    for (const io::Problem& problem : found.list()) // messages that begin with the name of the key
        if (problem.what.starts_with("surface.")) of_surface.push_back(problem);
    if (!of_surface.empty()) throw io::SceneError(of_surface);
    return c;
}

int make_surface(const Arguments& given, const Communicator& world) {
    const Case c = surface_case_of(given, world.size());
    const std::string& out = given.out;
    if (given.json) {
        const Surface surface = whole(surface_of(c, world));
        const double pixel = surface.length / surface.sites;
        const io::Json all = {
            {"rms", surface.statistics.rms},
            {"slope_of_neighbours",
             map_statistics(surface.height, surface.bands(), pixel, pixel, true).rms_slope},
            {"doubts", surface.doubts},
            {"notes", notes_of(c, surface)}};
        world.on_root([&] {
            if (!out.empty()) write_surface(c, surface, out);
            fmt::print("{}\n", io::json_text(all));
        });
        return io::exit_code::done;
    }
    if (c.surface.kind == SurfaceKind::file) world.on_root([&] { print_map_file(c); });
    const Surface surface = whole(surface_of(c, world));
    world.on_root([&] {
        const std::vector<std::string> lines = write_surface(c, surface, out);
        print_surface(surface);
        if (given.quiet) return;
        for (const std::string& note : notes_of(c, surface))
            io::print_text(stdout, "note: {}\n", note);
        for (const std::string& line : lines)
            io::print_text(stdout, "{}\n", line);
    });
    return io::exit_code::done;
}

} // namespace

Command surface_command() {
    const auto given = std::make_shared<Arguments>();
    return {.options = {takes::scene(*given), takes::set(*given),
                        takes::out(*given, "results/<scene>-surface; with --json no files"),
                        takes::quiet(*given), takes::json(*given)},
            .act = [given](const Communicator& world) { return make_surface(*given, world); }};
}

} // namespace asperity
