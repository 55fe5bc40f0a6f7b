// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/stored_run.hpp"

#include "io/error.hpp"
#include "io/h5md.hpp"
#include "io/hdf5_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace asperity {

namespace {

namespace fs = std::filesystem;

void read_series(const io::Hdf5File& file, StoredRun& run) {
    if (!file.exists("/series")) return;
    std::size_t rows = std::string::npos;
    for (const std::string& name : file.members("/series")) {
        run.series[name] = file.read<double>("/series/" + name);
        rows = std::min(rows, run.series[name].size());
    }
    for (auto& [name, column] : run.series)
        column.resize(rows);
}

void read_substrate(const io::Hdf5File& file, StoredRun& run) {
    if (!file.exists("/substrate/height")) return;
    run.substrate_sites = static_cast<int>(file.shape("/substrate/height").at(0));
    run.height = file.read<double>("/substrate/height");
    if (!file.exists("/substrate/spectrum_q")) return;
    run.spectrum_q = file.read<double>("/substrate/spectrum_q");
    run.spectrum = file.read<double>("/substrate/spectrum");
    run.spectrum_target = file.read<double>("/substrate/spectrum_target");
}

StoredState read_state(const io::Hdf5File& file, const std::string& name) {
    const std::string group = "/fields/" + name;
    StoredState state;
    state.name = name;
    if (file.has_attribute(group, "reference_height"))
        state.reference_height = file.read_number_attribute(group, "reference_height");
    for (const std::string& member : file.members(group)) {
        const std::string set = group + "/" + member;
        const io::Hdf5File::Shape shape = file.shape(set);
        if (shape.size() == 2 && shape[0] == shape[1]) {
            state.sites = static_cast<int>(shape[0]);
            state.maps[member] = file.read<double>(set);
        }
    }
    if (file.exists(group + "/gap_edges")) {
        state.gap_edges = file.read<double>(group + "/gap_edges");
        state.gap_density = file.read<double>(group + "/gap_density");
    }
    return state;
}

void read_hdf5(StoredRun& run) {
    const io::Hdf5File file(run.path("run.h5"), io::Hdf5File::Mode::read);
    read_series(file, run);
    read_substrate(file, run);
    if (file.exists("/fields"))
        for (const std::string& name : file.members("/fields"))
            run.states.push_back(read_state(file, name));
    const std::string steps = std::string(io::H5mdTrajectory::group) + "/position/step";
    if (file.exists(io::H5mdTrajectory::group)) run.frames = file.shape(steps).at(0);
}

} // namespace

std::string StoredRun::path(const std::string& file) const {
    return (fs::path(directory) / file).string();
}

std::optional<double> StoredRun::number(const std::string& key) const {
    const io::JsonValue* value = result.find(key);
    if (!value || !value->is_number()) return std::nullopt;
    return value->number();
}

std::string StoredRun::text(const std::string& key) const {
    const io::JsonValue* value = result.find(key);
    return value && value->is_text() ? value->text() : std::string();
}

int StoredRun::sites() const { return static_cast<int>(number("scene.surface.sites").value_or(0)); }

double StoredRun::edge() const { return sites() * number("scene.surface.spacing").value_or(0.0); }

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw io::FileError(path, "cannot be read", "there is no such file, or it may not be read",
                            "check the path and its permissions");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void expect_result(const std::string& directory, const std::vector<std::string>& any_of) {
    std::error_code error;
    if (!fs::is_directory(directory, error))
        throw io::FileError(directory, "is no result directory",
                            fs::exists(directory, error) ? "it is a file"
                                                         : "there is no such directory",
                            "name a directory that a run has written, for example "
                            "results/first-contact");
    for (const std::string& file : any_of)
        if (fs::exists(fs::path(directory) / file, error)) return;
    throw io::FileError(directory, "holds no result",
                        fmt::format("{} {} not in it", fmt::join(any_of, " and "),
                                    any_of.size() == 1 ? "is" : "are"),
                        "name a directory that a run has written, for example "
                        "results/first-contact; a run that was killed leaves no result.json before "
                        "it is resumed");
}

std::string directory_name(const std::string& directory) {
    const fs::path path = fs::absolute(directory).lexically_normal();
    return (path.has_filename() ? path : path.parent_path()).filename().string();
}

StoredRun read_run(const std::string& directory) {
    expect_result(directory, {"result.json"});
    StoredRun run;
    run.directory = directory;
    run.title = directory_name(directory);
    const std::string json = run.path("result.json");
    run.result = io::JsonValue::parse(read_text(json), json);
    if (const io::JsonValue* scene = run.result.find("scene"); scene && scene->is_object()) {
        run.toml = io::toml_of(*scene);
        try {
            run.scene = read_stored_scene(run.toml, json);
            run.scene->name = run.text("name");
            run.title = run.scene->title();
        } catch (const io::Error& error) {
            run.notes.push_back(
                fmt::format("The scene in result.json cannot be read any more: {}",
                            error.problems().empty() ? "" : error.problems().front().what));
        }
    }
    std::error_code error;
    if (fs::exists(run.path("run.h5"), error)) try {
            read_hdf5(run);
        } catch (const io::Error& damaged) {
            run.notes.push_back(fmt::format("run.h5 cannot be read to its end ({}).",
                                            damaged.problems().front().why));
        }
    return run;
}

} // namespace asperity
