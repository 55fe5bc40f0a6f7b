// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The command line: a list of commands, each with its options. A command of the program has a file
// of its own, NAME.cpp, with a function that makes it, and a row in
// python/asperity/commands/table.txt:
//
//     Command check_command() {
//         const auto given = std::make_shared<Arguments>();
//         return {.options = {takes::scene(*given), takes::set(*given), takes::json(*given)},
//                 .act = [given](const Communicator& world) { ... return code; }};
//     }
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace asperity {

class Communicator;
struct Case;

/// Arguments that several commands take, as text.
struct Arguments {
    std::vector<std::string> words; ///< the scene, and overrides that follow a --set
    std::vector<std::string> overrides;
    std::string out;
    std::string progress; ///< mode; empty: "auto", or "off" with --quiet or --json
    bool json = false;
    bool quiet = false;
};

/// Reads the case of the scene that the words name, with its overrides, for a number of ranks.
/// Throws io::SceneError.
Case case_of(const Arguments& given, int ranks);
/// Reads the case like the other case_of(). world: as for resolve().
Case case_of(const Arguments& given, int ranks, const Communicator& world);
/// Returns the scene's file among the words and appends the other words to overrides, so that
/// `--set a=1 b=2 scene.toml` sets both keys. Throws io::SceneError.
std::string scene_file(const Arguments& given, std::vector<std::string>& overrides);
/// Calls work on rank 0 for commands that need one process; the other ranks wait. Returns the exit
/// code.
int on_root(const Communicator& world, const std::function<int()>& work);

/// An option of a command, and the variable that it sets.
struct Option {
    std::string name;  ///< "--out"; without dashes: a positional argument
    std::string value; ///< name of the value in --help; empty: a flag
    std::string explanation;
    std::variant<bool*, int*, std::string*, std::vector<std::string>*> into;
    std::string short_name = {}; ///< "-o"; empty: none
    bool needed = false;         ///< the argument is required
};

/// A command of the program, or of the Python package.
struct Command {
    std::string name = {};
    /// Options; empty for a command of the Python package, which defines its own.
    std::vector<Option> options = {};
    /// Carries out the command and returns the exit code; empty for a command of the Python
    /// package.
    std::function<int(const Communicator&)> act = {};
    bool looks_at_signals = false; ///< the command checks for signals itself (stop_signals.hpp)
    bool for_programs = false;     ///< errors are printed as JSON without --json
    std::string purpose = {};      ///< one line of python/asperity/commands/table.txt
};

/// Options that several commands take.
namespace takes {
/// Returns an option that sets a member of the arguments.
Option scene(Arguments& given);
Option set(Arguments& given);
Option json(Arguments& given);
Option progress(Arguments& given);
Option quiet(Arguments& given);
/// Returns the option --out. otherwise: explanation of the default.
Option out(Arguments& given, const std::string& otherwise);
} // namespace takes

/// Replaces this process by Python if argv names a command of the Python package (python/asperity),
/// which finds this program through $ASPERITY_PROGRAM. Python does not look for modules in the
/// current folder. Returns nothing if argv names another command. If Python or the package was not
/// found, prints the reason and returns the exit code. Must be called before MPI is initialised.
std::optional<int> hand_over_to_python(const std::vector<Command>& commands, int argc, char** argv);

/// Returns true for calls by programs, with --json, --progress json or a command for programs,
/// whose errors are printed as JSON.
bool is_for_programs(const std::vector<Command>& commands, int argc, char** argv);
/// Returns true if the call prints nothing but results (--quiet or --json).
inline bool only_results(const Arguments& given) { return given.quiet || given.json; }
/// Reads the command line, carries out the command, or prints help or version. of_script: commands
/// of the script `asperity` of the source tree, for messages. Returns the exit code. Throws
/// io::SceneError for a wrong command line.
int carry_out(const std::vector<Command>& commands, const std::vector<std::string>& of_script,
              int argc, char** argv, const Communicator& world);

} // namespace asperity
