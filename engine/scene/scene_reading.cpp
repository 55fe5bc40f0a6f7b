// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A scene from its file and the overrides: keys, then what follows from several of them, then the
// checks; all that is wrong is said at once.
#include "engine/scene/scene.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace asperity {

namespace {

/// The file of kind = "file" or "atoms": beside the scene, then in the working directory (the other
/// way round if it was named on the command line).
void find_map(Scene& scene, io::Problems& problems) {
    namespace fs = std::filesystem;
    const bool atoms = scene.surface.kind == SurfaceKind::atoms;
    std::string file = scene.surface.file, dataset;
    if (const std::size_t colon = file.find(":/"); colon != std::string::npos && !atoms) {
        dataset = file.substr(colon);
        file.resize(colon);
    }
    std::vector<fs::path> places = {fs::path(scene.file).parent_path() / file, fs::path(file)};
    if (scene.positions.where("surface.file").starts_with("--set")) std::swap(places[0], places[1]);
    std::error_code error;
    for (const fs::path& place : places)
        if (fs::is_regular_file(place, error)) {
            scene.surface.map = fs::absolute(place).lexically_normal().string() + dataset;
            return;
        }
    std::string looked = places[0].string();
    if (places[1] != places[0]) looked += " and " + places[1].string();
    const bool named = scene.positions.is_set("surface.file");
    problems.add(named ? "surface.file" : "surface.kind",
                 named ? fmt::format("= \"{}\": there is no such file", scene.surface.file)
                       : fmt::format("= \"{}\" needs surface.file", atoms ? "atoms" : "file"),
                 "looked for " + looked,
                 fmt::format("give the path of a {}, relative to the scene or to the working "
                             "directory",
                             atoms ? "file of atoms" : "height map"));
}

} // namespace

Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides) {
    Scene scene;
    scene.file = file;
    scene.name = std::filesystem::path(file).stem().string();
    if (scene.name.empty()) scene.name = "scene";

    io::Problems wrong;
    bind(scene).read(text, file, overrides, scene.positions, wrong);
    scene.surface.rms_given = scene.positions.is_set("surface.rms");
    if (!scene.positions.is_set("block.thickness")) scene.block.thickness = scene.surface.sites;
    if (scene.interface.kind == InterfaceKind::wall &&
        !scene.positions.is_set("interface.frictionless"))
        scene.interface.frictionless = true;

    // Keys that could not be read still have their defaults, so the checks between keys can go on;
    // what they find about such a key is left out, it has been complained about already.
    io::Problems contradictions = scene.problems();
    if (scene.surface.reads_file()) find_map(scene, contradictions);
    check_scene(scene, contradictions);
    for (const io::Problem& problem : contradictions.list()) {
        const bool told =
            std::any_of(wrong.list().begin(), wrong.list().end(),
                        [&](const io::Problem& p) { return p.where == problem.where; });
        if (!told) wrong.add(problem);
    }
    wrong.throw_if_any();
    return scene;
}

Scene read_scene(const std::string& file, const std::vector<std::string>& overrides) {
    return read_scene_text(io::read_scene_file(file), file == io::standard_input ? "stdin" : file,
                           overrides);
}

} // namespace asperity
