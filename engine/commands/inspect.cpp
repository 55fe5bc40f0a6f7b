// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/commands.hpp"

#include "decomposition/communicator.hpp"
#include "engine/case/contact_estimate.hpp"
#include "engine/case/site_field.hpp"
#include "engine/commands/command_line.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/run_result.hpp"
#include "engine/run/series.hpp"
#include "engine/scene/map_statistics.hpp"
#include "engine/theory/theory_case.hpp"
#include "io/directory_lock.hpp"
#include "io/error.hpp"
#include "io/height_map.hpp"
#include "io/json.hpp"
#include "io/machine.hpp"
#include "io/result.hpp"
#include "io/result_directory.hpp"
#include "io/terminal.hpp"
#include "kernels/device/device.hpp"
#include "kernels/variant.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fftw3.h>
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

namespace asperity {

namespace {

/// Returns the check of a scene for programs: a sweep calls it before it varies the scene, so that
/// the problems of a run of the scene itself are listed, not thrown.
io::Json check_json(const Case& c, const Communicator& world) {
    const Scene& scene = c.scene;
    io::Json all;
    all["name"] = scene.name;
    all["scene"] = scene_json(scene);
    all["sweep"] = io::Json::array();
    for (const io::Variation& variation : scene.sweep) {
        all["sweep"].push_back(
            {{"key", variation.key}, {"values", variation.values}, {"where", variation.where}});
    }
    all["effects"] = effects_json(c.effects);
    all["theory_needs_surface"] = theory_needs_surface(c);
    if (const auto beyond = beyond_edges(c))
        all["beyond_edges"] = {{"part", beyond->part}, {"width", beyond->width}};
    all["notes"] = io::Json::array();
    all["problems"] = io::Json::array();
    try {
        const std::vector<std::string> notes = examine(c, world);
        all["longest_timestep"] = c.longest_timestep;
        all["edge_pinning"] = c.edge_pinning;
        all["box_softness"] = c.box_jumps() ? c.softness : 0.0;
        all["notes"] = notes;
    } catch (const io::SceneError& error) {
        all["problems"] = io::problems_json(error.problems());
    }
    return all;
}

/// Returns the scene of `asperity init`: the keys that a beginner changes first, and every other
/// key with its default behind a "#".
std::string starting_scene(const std::string& file) {
    constexpr std::array shown = {
        "surface.kind",   "surface.sites",  "surface.rms",   "surface.hurst",    "surface.seed",
        "block.model",    "block.young",    "block.poisson", "interface.r0",     "drive.path",
        "drive.velocity", "drive.timestep", "theory.beta",   "interface.epsilon"};
    Scene scene;
    scene.surface.sites = scene.block.thickness = 128;
    scene.surface.rms = 1.5;
    scene.drive.timestep = 20.0;
    std::string text =
        fmt::format("# A scene of Asperity to start from.\n"
                    "#\n"
                    "#     asperity check {0}     # look for mistakes\n"
                    "#     asperity plan {0}      # memory and time\n"
                    "#     asperity run {0}\n"
                    "#\n"
                    "# Lines behind a # have the defaults. A quantity is a number in the "
                    "unit named, or a text with a unit: \"0.3 nm\".\n\n",
                    file);
    std::istringstream lines(scene_toml(scene));
    std::string line, section;
    while (std::getline(lines, line)) {
        if (line.starts_with("[")) section = line.substr(1, line.find(']') - 1) + ".";
        const std::size_t equals = line.find(" = ");
        const bool key = !line.starts_with("#") && equals != std::string::npos;
        const bool kept = key && std::find(shown.begin(), shown.end(),
                                           section + line.substr(0, equals)) != shown.end();
        text += (key && !kept ? "# " : "") + line + "\n";
    }
    return text;
}

} // namespace

int init_command(const Arguments& given, const Communicator& world) {
    std::vector<std::string> asked = given.words;
    if (!given.out.empty()) asked.push_back(given.out);
    if (asked.size() > 1)
        throw io::SceneError(io::Problem{"command line", "more than one file is given",
                                         fmt::format("{} and {}", asked[0], asked[1]),
                                         "name one: asperity init NAME.toml"});
    const std::string file = asked.empty() ? "scene.toml" : asked.front();
    world.on_root([&] {
        std::FILE* made = std::fopen(file.c_str(), "wx"); // never over a file
        if (!made && errno == EEXIST)
            throw io::SceneError(io::Problem{file, "is there already",
                                             "a file is never written over",
                                             "name another: asperity init NAME.toml"});
        const std::string text = starting_scene(file);
        const bool written = made && std::fwrite(text.data(), 1, text.size(), made) == text.size();
        const int error = errno;
        if (!made || std::fclose(made) != 0 || !written)
            throw io::FileError(file, "cannot be written", std::strerror(made ? errno : error),
                                "name another place");
        if (given.json)
            fmt::print("{}\n", io::json_text({{"file", file}}));
        else if (!given.quiet)
            io::print_text(stdout, "{0}: made. Next: asperity check {0}\n", file);
    });
    return io::exit_code::done;
}

int check_command(const Case& c, const Arguments& given, const Communicator& world) {
    if (given.json) {
        const io::Json all = check_json(c, world);
        if (world.root()) fmt::print("{}\n", io::json_text(all));
        return all["problems"].empty() ? io::exit_code::done : io::exit_code::scene;
    }
    const std::vector<std::string> notes = examine(c, world);
    if (!world.root() || given.quiet) return io::exit_code::done;
    io::print_text(stdout, "{}: nothing wrong\n", c.scene.file);
    io::print_text(stdout, "  {}; {}\n", c.box_in_words(), c.block_in_words());
    if (c.effects.dynamic)
        fmt::print("  time step {:.4g} fs, usable up to {:.2g} fs\n", c.simulation.dt,
                   usable_timestep(c.longest_timestep));
    for (const std::string& note : notes)
        io::print_text(stdout, "  note: {}\n", note);
    return io::exit_code::done;
}

int plan_command(const Case& c, const Arguments& given, const Communicator& world) {
    double node = 0.0;
    if (!given.memory_per_node.empty()) {
        const std::optional<double> said = io::parse_memory(given.memory_per_node);
        if (!said)
            throw io::SceneError(
                io::Problem{"--memory-per-node " + given.memory_per_node, "is no size of memory",
                            "a number and its unit are needed", "for example 256GB or 62.5GiB"});
        node = *said;
    }
    const std::vector<std::string> notes = examine(c, world);
    const int cores = omp_get_max_threads() * world.size();
    world.on_root([&] {
        const int threads = std::max(1, cores / c.ranks);
        if (given.json) {
            io::Json all = plan_json(c, threads, make_plan(c, threads), node);
            all["notes"] = notes;
            fmt::print("{}\n", io::json_text(all));
            return;
        }
        print_plan(stdout, c, threads, make_plan(c, threads), node);
        for (const std::string& note : notes)
            if (!given.quiet) io::print_text(stdout, "note: {}\n", note);
    });
    return io::exit_code::done;
}

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

} // namespace

int surface_command(const Case& c, const Arguments& given, const Communicator& world) {
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

int defaults_command(bool markdown, bool plain, bool results, const Communicator& world) {
    if (!world.root()) return io::exit_code::done;
    fmt::print("{}", results    ? io::result_markdown(series_quantities())
                     : markdown ? scene_markdown()
                                : scene_toml(Scene{}, !plain));
    return io::exit_code::done;
}

int schema_command(bool results, const Communicator& world) {
    if (!world.root()) return io::exit_code::done;
    io::Json all;
    if (results) {
        for (const io::Quantity& q : io::result_quantities())
            all[std::string(q.name)] = {{"unit", q.unit}, {"per", q.per}, {"meaning", q.meaning}};
    } else {
        Scene defaults;
        const io::Schema schema = bind(defaults);
        for (const io::Schema::Key& key : schema.keys()) {
            io::Json& one = all[key.path()];
            one["kind"] = key.kind();
            one["unit"] = key.unit;
            one["default"] = key.load();
            one["doc"] = key.doc;
            if (!key.word.empty()) one["word"] = key.word;
            if (!key.choices.empty()) one["choices"] = key.choices;
        }
    }
    fmt::print("{}\n", io::json_text(all));
    return io::exit_code::done;
}

int hold_command(const std::string& directory) {
    const int owner = io::process_behind(STDIN_FILENO);
    io::DirectoryLock(io::Directory(directory), owner).hand_over(STDIN_FILENO);
    return io::exit_code::done;
}

int info_command(bool json, const Communicator& world) {
    if (!world.root()) return io::exit_code::done;
    const io::BuildInfo build = io::build_info();
    if (json) {
        const io::Json all = {{"version", build.version},
                              {"git", build.git},
                              {"compiler", build.compiler},
                              {"flags", build.flags},
                              {"mpi", ParallelSession::library()},
                              {"hdf5", build.hdf5},
                              {"fftw", std::string(fftw_version)},
                              {"ranks", world.size()},
                              {"threads", omp_get_max_threads()},
                              {"cuda", static_cast<bool>(cuda_device())},
                              {"processor", name(processor_level())}};
        fmt::print("{}\n", io::json_text(all));
        return io::exit_code::done;
    }
    io::Table table({"", ""}, "<<");
    table.row({"version", build.version});
    table.row({"git", build.git});
    table.row({"compiler", build.compiler});
    table.row({"flags", build.flags});
    table.row({"MPI", ParallelSession::library()});
    table.row({"HDF5", build.hdf5});
    table.row({"FFTW", fftw_version});
    table.row({"ranks", std::to_string(world.size())});
    table.row({"threads", fmt::format("{} a rank", omp_get_max_threads())});
    table.row({"devices", cuda_device()
                              ? fmt::format("CUDA ({} found), emulated", cuda_device_count())
                              : std::string("emulated; built without CUDA")});
    table.row({"processor", fmt::format("kernels for {}", name(processor_level()))});
    fmt::print("asperity {}\n", build.version);
    table.print(stdout);
    return io::exit_code::done;
}

} // namespace asperity
