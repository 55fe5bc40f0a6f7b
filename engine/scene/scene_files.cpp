// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/scene_files.hpp"

#include <array>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace asperity {

namespace {

/// Returns the places of a file: beside the scene, then in the working directory (in reverse order
/// if it was named on the command line).
std::array<std::filesystem::path, 2> places_of(const Scene& scene, const std::string& file,
                                               const std::string& key) {
    namespace fs = std::filesystem;
    std::array<fs::path, 2> places = {fs::path(scene.file).parent_path() / file, fs::path(file)};
    if (scene.positions.where(key).starts_with("--set")) std::swap(places[0], places[1]);
    return places;
}

} // namespace

std::string find_beside_scene(const Scene& scene, const std::string& file, const std::string& key) {
    std::error_code error;
    for (const auto& place : places_of(scene, file, key))
        if (std::filesystem::is_regular_file(place, error))
            return std::filesystem::absolute(place).lexically_normal().string();
    return {};
}

std::string places_looked_at(const Scene& scene, const std::string& file, const std::string& key) {
    const auto places = places_of(scene, file, key);
    if (places[0] == places[1]) return places[0].string();
    return places[0].string() + " and " + places[1].string();
}

void read_fit(Scene& scene, io::Problems& problems) {
    const std::string key = "block.prony", &file = scene.fit.file;
    scene.fit.found = find_beside_scene(scene, file, key);
    if (scene.fit.found.empty())
        return problems.add(io::Problem{
            scene.positions.where(key),
            fmt::format("{} = \"{}\": there is no such file", key, file),
            "looked for " + places_looked_at(scene, file, key),
            "give the path of a file that `asperity prony` made, relative to the scene or to the "
            "working directory, or a list of branches: [[9.0, \"1 ns\"]]"});
    struct {
        double young = 0.0, poisson = 0.0, rms_error = 0.0;
        std::vector<std::array<double, 2>> prony;
        std::string source;
    } read;
    io::Schema schema;
    schema.section("block", "");
    schema.number("young", read.young, "GPa", io::positive(), "");
    schema.number("poisson", read.poisson, "", {-1.0, 0.5, true, true}, "");
    schema.rows<2>("prony", read.prony,
                   {{{"modulus over young", "", io::positive(), "0.5"},
                     {"relaxation time", "ps", io::positive(), "\"1 ns\""}}},
                   "");
    schema.section("fit", "");
    schema.key("source", read.source, "");
    schema.number("rms_error", read.rms_error, "", io::at_least(0.0), "");
    io::Positions positions;
    const std::size_t before = problems.list().size();
    schema.read(io::read_scene_file(scene.fit.found), scene.fit.found, {}, positions, problems);
    if (problems.list().size() > before) return;
    for (const char* needed : {"block.young", "block.prony"})
        if (!positions.is_set(needed))
            return problems.add(io::Problem{
                scene.fit.found, fmt::format("has no {}", needed),
                fmt::format("{} names the file, which has the relaxed modulus, block.young, and "
                            "the branches",
                            key),
                "make the file anew by `asperity prony`"});
    scene.fit.young = read.young;
    scene.block.prony = std::move(read.prony);
    if (!scene.positions.is_set("block.young")) scene.block.young = read.young;
    if (positions.is_set("block.poisson") && !scene.positions.is_set("block.poisson"))
        scene.block.poisson = read.poisson;
    scene.fit.source = std::move(read.source);
    if (positions.is_set("fit.rms_error")) scene.fit.rms_error = read.rms_error;
}

} // namespace asperity
