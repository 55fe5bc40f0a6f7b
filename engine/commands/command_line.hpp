// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The command line: a list of commands, each with the options that it takes, and the arguments of a
// call.
//
//     const std::vector<Command> commands = {
//         {"check", "look for mistakes in a scene", {takes::scene, takes::set, takes::json},
//          [](const Arguments& given, const Communicator& world) { ... return code; }}};
//     return carry_out(commands, argc, argv, world);
#pragma once

#include "engine/run/run.hpp"
#include "engine/setup/case.hpp"

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

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
    bool profile = false;
    bool results = false;
};

/// The case of the scene named by the words, with its overrides, for so many ranks.
Case case_of(const Arguments& given, int ranks);
/// The same for its surface alone: what is wrong with keys of other sections is left out.
Case surface_case_of(const Arguments& given, int ranks);
/// The scene's file; the overrides among the words are added to the list: `--set a=1 b=2
/// scene.toml` means what it looks like.
std::string scene_file(const Arguments& given, std::vector<std::string>& overrides);
/// Throw io::SceneError, like those above.
RunOptions run_options(const Arguments& given);

struct Option {
    std::string name;  ///< "--out"; without dashes: a word
    std::string value; ///< what stands behind it, for --help; empty: a flag
    std::string explanation;
    std::variant<bool Arguments::*, int Arguments::*, std::string Arguments::*,
                 std::vector<std::string> Arguments::*>
        into;
};

struct Command {
    std::string name;
    std::string purpose;         ///< one line
    std::vector<Option> options; ///< none of a command of the Python package, which has its own
    /// Returns the exit code. Empty: the Python package carries it out.
    std::function<int(const Arguments&, const Communicator&)> act = {};
    bool looks_at_signals = false; ///< ends by itself after a signal (stop_signals.hpp)
};

/// Options of several commands, or with a value that is checked.
namespace takes {
extern const Option scene, set, json, progress;
Option out(const std::string& otherwise);
} // namespace takes

/// If argv names a command of the Python package (python/asperity): replaces this process by
/// `python3 -m asperity`, which calls this program back through $ASPERITY_PROGRAM. Returns only if
/// argv names another command (nothing) or Python or the package was not found (the exit code; the
/// reason is printed). Before MPI is initialised.
std::optional<int> hand_over_to_python(const std::vector<Command>& commands, int argc, char** argv);

/// Reads the command line and carries out the command it names; --help and --version are answered.
/// Returns the exit code. Throws io::SceneError for a call that cannot be understood.
int carry_out(const std::vector<Command>& commands, int argc, char** argv,
              const Communicator& world);

} // namespace asperity
