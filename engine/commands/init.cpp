// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/scene/scene.hpp"
#include "io/error.hpp"
#include "io/files.hpp"
#include "io/json.hpp"
#include "io/terminal.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace asperity {

namespace {

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

int make_scene(const Arguments& given, const Communicator& world) {
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

} // namespace

Command init_command() {
    const auto given = std::make_shared<Arguments>();
    return {
        .options = {{"FILE", "", "the scene file to be made (default: scene.toml)", &given->words},
                    {"--out", "FILE", "the same as an option", &given->out, "-o"},
                    takes::quiet(*given),
                    takes::json(*given)},
        .act = [given](const Communicator& world) { return make_scene(*given, world); }};
}

} // namespace asperity
