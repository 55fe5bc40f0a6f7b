// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Reads and writes scenes as text.
#include "engine/scene/scene.hpp"

#include "engine/scene/scene_files.hpp"
#include "engine/units.hpp"
#include "io/json.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

namespace asperity {

namespace {

/// Computes the sites and layers that the scene gives as lengths, and the pressure that it gives as
/// a force.
void make_counts(Scene& scene, io::Problems& problems) {
    const auto count = [&](const char* key, const std::optional<double>& length, int low, int high,
                           int& into) {
        if (!length) return;
        const double whole = std::round(*length / scene.surface.spacing);
        if (whole >= low && whole <= high)
            into = static_cast<int>(whole);
        else
            problems.add(
                io::Problem{scene.positions.where(key),
                            fmt::format("{} = {:.6g} Å is {:.6g} spacings", key, *length, whole),
                            fmt::format("{} to {} are allowed, of {:.6g} Å each", low, high,
                                        scene.surface.spacing),
                            "give another length, or the number itself"});
    };
    count("surface.sites", scene.width, fewest_sites, most_sites, scene.surface.sites);
    count("block.thickness", scene.height, 1, most_layers, scene.block.thickness);
    if (scene.force)
        scene.drive.load =
            *scene.force * units::nanonewton / (units::megapascal * scene.edge() * scene.edge());
}

} // namespace

Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides, io::Problems& problems) {
    Scene scene;
    scene.file = file;
    scene.name = std::filesystem::path(file).stem().string();
    if (scene.name.empty()) scene.name = "scene";
    bind(scene).read(text, file, overrides, scene.positions, problems);
    if (!scene.fit.file.empty()) read_fit(scene, problems);
    make_counts(scene, problems);
    if (!scene.positions.is_set("block.thickness")) scene.block.thickness = scene.surface.sites;
    if (scene.interface.kind == InterfaceKind::wall &&
        !scene.positions.is_set("interface.frictionless"))
        scene.interface.frictionless = true;
    return scene;
}

Scene read_scene_text(const std::string& text, const std::string& file,
                      const std::vector<std::string>& overrides) {
    io::Problems problems;
    Scene scene = read_scene_text(text, file, overrides, problems);
    problems.throw_if_any();
    return scene;
}

Scene read_scene(const std::string& file, const std::vector<std::string>& overrides) {
    return read_scene_text(io::read_scene_file(file), file == io::standard_input ? "stdin" : file,
                           overrides);
}

std::string scene_toml(const Scene& scene, bool with_docs) {
    Scene copy = scene;
    return bind(copy).toml(with_docs);
}

io::Json scene_json(const Scene& scene) {
    Scene copy = scene;
    return bind(copy).json();
}

io::Json scene_units(const Scene& scene) {
    Scene copy = scene;
    return bind(copy).units();
}

std::string scene_markdown() {
    Scene defaults;
    return "# The scene file\n\n"
           "Written by `asperity defaults --markdown`; do not edit. A scene is a TOML file. A "
           "quantity is a "
           "number in the unit named, or a string with a unit of the same kind (\"0.3 nm\", \"100 "
           "meV\", "
           "\"5 m/s\", \"77.2 GPa\"). Every key may be left out. `--set section.key=value` "
           "overrides one. A key that has no effect in a scene is refused, with the key on which "
           "it "
           "depends; it is only noted if it has its default, belongs to another kind of path "
           "(drive.mode, drive.path), or if `--set` changes the key on which it depends.\n" +
           bind(defaults).markdown();
}

} // namespace asperity
