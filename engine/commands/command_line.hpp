// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The command line: a list of commands, each with the options that it takes, and the arguments of a
// call.
//
//     const std::vector<Command> commands = {
//         {"theory", "the analytic theory of a scene", {takes::scene,
//         takes::out("results/<scene>")},
//          [](const Arguments& given, const Communicator& world) { ... return code; }}};
//     return carry_out(commands, argc, argv, world);
#pragma once

#include "engine/run/run.hpp"
#include "engine/scene/scene.hpp"

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace asperity {

class Communicator;

/// What was given, as it was written. Options that a command does not take have their defaults.
struct Arguments {
    std::vector<std::string> words; ///< the scene, and overrides that follow a --set
    std::vector<std::string> overrides;
    std::string out;
    std::string resume;
    bool restart = false;
    std::string wall_limit;
    std::string progress = "auto";
    int ranks = 0;      ///< to plan for; 0: as many as there are
    std::string points; ///< file with overrides, a line each
    bool markdown = false;
    bool plain = false;
    bool json = false;
    bool runnable = false;
    bool results = false;
};

/// The scene named by the words, read and checked with its overrides.
Scene scene_of(const Arguments& given);
/// The scene's file; the overrides among the words are added to the list: `--set a=1 b=2
/// scene.toml` means what it looks like.
std::string scene_file(const Arguments& given, std::vector<std::string>& overrides);
/// Throw io::SceneError, like those above.
RunOptions run_options(const Arguments& given);

using Option = std::function<void(CLI::App&, Arguments&)>;

struct Command {
    std::string name;
    std::string purpose; ///< one line
    std::vector<Option> options;
    std::function<int(const Arguments&, const Communicator&)> act; ///< returns the exit code
    std::string footer = {};                                       ///< below its options
    bool looks_at_signals = false; ///< ends by itself after a signal (stop_signals.hpp)
};

/// The options; where commands mean different things by one, it takes its words of explanation.
namespace takes {
void scene(CLI::App& command, Arguments& given); ///< and --set
void new_file(CLI::App& command, Arguments& given);
void resume(CLI::App& command, Arguments& given);
void restart(CLI::App& command, Arguments& given);
void progress(CLI::App& command, Arguments& given);
void ranks(CLI::App& command, Arguments& given);
void markdown(CLI::App& command, Arguments& given);
void plain(CLI::App& command, Arguments& given);
void json(CLI::App& command, Arguments& given);
void points(CLI::App& command, Arguments& given); ///< and --runnable
void results(CLI::App& command, Arguments& given);
Option out(const std::string& otherwise);
Option wall_limit(const std::string& explanation);
} // namespace takes

/// Reads the command line and carries out the command it names; --help and --version are answered.
/// Returns the exit code. Throws io::SceneError for a call that cannot be understood.
int carry_out(const std::vector<Command>& commands, int argc, char** argv,
              const Communicator& world);

} // namespace asperity
