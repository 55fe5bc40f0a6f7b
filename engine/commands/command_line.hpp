// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The command line: a list of commands, each with its options, and the arguments of a call.
//
//     const std::vector<Command> commands = {
//         {"check", {takes::scene, takes::set, takes::json},
//          [](const Arguments& given, const Communicator& world) { ... return code; }}};
//     return carry_out(commands, argc, argv, world);
#pragma once

#include "decomposition/communicator.hpp"
#include "engine/case/case.hpp"
#include "engine/run/run.hpp"

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace asperity {

/// Arguments of a call, as text. Options that a command does not take keep their defaults.
struct Arguments {
    std::vector<std::string> words; ///< the scene, and overrides that follow a --set
    std::vector<std::string> overrides;
    std::string out;
    std::string resume;
    bool restart = false;
    std::string wall_limit;
    std::string progress;        ///< mode; empty: "auto", or "off" with --quiet or --json
    int ranks = 0;               ///< number of ranks to plan for; 0: the ranks of this call
    std::string memory_per_node; ///< memory of a node to plan for; empty: none
    std::string points;          ///< file with overrides, one line each
    bool markdown = false;
    bool plain = false;
    bool json = false;
    bool runnable = false;
    bool profile = false;
    bool results = false;
    bool quiet = false;
};

/// Reads the case of the scene that the words name, with its overrides, for a number of ranks.
/// Throws io::SceneError.
Case case_of(const Arguments& given, int ranks, const Communicator& world = Communicator());
/// Reads the case like case_of(), but ignores mistakes in keys that the surface does not need.
/// Throws io::SceneError.
Case surface_case_of(const Arguments& given, int ranks);
/// Returns the scene's file among the words and appends the other words to overrides, so that
/// `--set a=1 b=2 scene.toml` sets both keys. Throws io::SceneError.
std::string scene_file(const Arguments& given, std::vector<std::string>& overrides);
/// Returns the options of a run. Throws io::SceneError.
RunOptions run_options(const Arguments& given);

/// An option of a command, and the argument that it sets.
struct Option {
    std::string name;  ///< "--out"; without dashes: a positional argument
    std::string value; ///< name of the value in --help; empty: a flag
    std::string explanation;
    std::variant<bool Arguments::*, int Arguments::*, std::string Arguments::*,
                 std::vector<std::string> Arguments::*>
        into;
    std::string short_name = {}; ///< "-o"; empty: none
    bool needed = false;         ///< the argument is required
};

/// A command of the program, or of the Python package.
struct Command {
    std::string name;
    /// Options; empty for a command of the Python package, which defines its own.
    std::vector<Option> options = {};
    /// Carries out the command and returns the exit code; empty for a command of the Python
    /// package.
    std::function<int(const Arguments&, const Communicator&)> act = {};
    bool looks_at_signals = false; ///< the command checks for signals itself (stop_signals.hpp)
    std::string purpose = {};      ///< one line of python/asperity/commands/table.txt
};

/// Options that several commands take.
namespace takes {
extern const Option scene, set, json, progress, quiet;
/// Returns the option --out. otherwise: explanation of the default.
Option out(const std::string& otherwise);
} // namespace takes

/// Replaces this process by Python if argv names a command of the Python package (python/asperity),
/// which finds this program through $ASPERITY_PROGRAM. Python does not look for modules in the
/// current folder. Returns nothing if argv names another command. If Python or the package was not
/// found, prints the reason and returns the exit code. Must be called before MPI is initialised.
std::optional<int> hand_over_to_python(const std::vector<Command>& commands, int argc, char** argv);

/// Returns true for calls by programs, with --json, --progress json, `theory-points`,
/// `stress-below` or `hold`, whose errors are printed as JSON.
bool is_for_programs(int argc, char** argv);
/// Returns true if the call prints nothing but results (--quiet or --json).
inline bool only_results(const Arguments& given) { return given.quiet || given.json; }
/// Reads the command line, carries out the command, or prints help or version. Returns the exit
/// code. Throws io::SceneError for a wrong command line.
int carry_out(const std::vector<Command>& commands, int argc, char** argv,
              const Communicator& world);

} // namespace asperity
