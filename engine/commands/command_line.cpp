// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/case/case.hpp"
#include "engine/commands/help.hpp"
#include "engine/run/stop_signals.hpp"
#include "io/error.hpp"
#include "io/machine.hpp"
#include "io/scene_reader.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace asperity {

namespace {

bool is_override(const std::string& word) {
    const std::size_t equals = word.find('='), dot = word.find('.');
    return equals != std::string::npos && dot < equals && word.find('/') >= equals &&
           !std::filesystem::exists(word);
}

} // namespace

std::string scene_file(const Arguments& given, std::vector<std::string>& overrides) {
    std::vector<std::string> files;
    overrides = given.overrides;
    for (const std::string& word : given.words)
        (is_override(word) ? overrides : files).push_back(word);
    const auto refuse = [](const std::string& what, const std::string& why) {
        return io::SceneError(io::Problem{"command line", what, why,
                                          "for example: asperity run scenes/first-contact.toml"});
    };
    if (files.empty()) throw refuse("no scene is given", "the command needs one");
    if (files.size() > 1 && !std::filesystem::exists(files[1]) && io::parse_unit(files[1]))
        throw io::SceneError(io::Problem{"command line", fmt::format("'{}' stands alone", files[1]),
                                         "a blank ends a word of the command line",
                                         "write the unit behind the number: 3nm"});
    if (files.size() > 1)
        throw refuse("more than one scene is given", fmt::format("{} and {}", files[0], files[1]));
    return files.front();
}

Case case_of(const Arguments& given, int ranks) { return case_of(given, ranks, Communicator()); }

Case case_of(const Arguments& given, int ranks, const Communicator& world) {
    std::vector<std::string> overrides;
    const std::string file = scene_file(given, overrides);
    return read_case(file, overrides, ranks, world);
}

int on_root(const Communicator& world, const std::function<int()>& work) {
    int code = io::exit_code::done;
    world.on_root([&] { code = work(); });
    return code;
}

namespace takes {

namespace {
constexpr const char *scene_name = "SCENE", *set_name = "--set", *json_name = "--json",
                     *progress_name = "--progress";
} // namespace

Option scene(Arguments& given) {
    return {.name = scene_name,
            .value = "",
            .explanation = "the scene file (TOML); - is the standard input",
            .into = &given.words,
            .needed = true};
}
Option set(Arguments& given) {
    return {set_name, "key=value", "override a key of the scene: section.key=value; repeatable",
            &given.overrides};
}
Option json(Arguments& given) {
    return {json_name, "", "print the result as one line of JSON, for programs", &given.json};
}
Option progress(Arguments& given) {
    return {progress_name, "MODE", "auto, bar, lines, off, or json for programs (default: auto)",
            &given.progress};
}
Option quiet(Arguments& given) {
    return {"--quiet", "", "print results and errors only", &given.quiet, "-q"};
}
Option out(Arguments& given, const std::string& otherwise) {
    return {"--out", "DIR", fmt::format("result directory (default: {})", otherwise), &given.out,
            "-o"};
}

} // namespace takes

namespace {

void add(CLI::App& command, const Option& option) {
    const auto add_to = [&](auto* field) -> CLI::Option* {
        using Field = std::remove_pointer_t<decltype(field)>;
        const std::string names =
            option.short_name.empty() ? option.name : option.short_name + "," + option.name;
        if constexpr (std::is_same_v<Field, bool>)
            return command.add_flag(names, *field);
        else
            return command.add_option(names, *field);
    };
    CLI::Option& added = *std::visit(add_to, option.into);
    if (option.needed) added.required();
    if (option.name == takes::set_name) added.allow_extra_args(false);
    if (std::holds_alternative<int*>(option.into)) added.check(CLI::Range(1, 1 << 20));
    // The empty value of a variable that is not set
    if (std::holds_alternative<std::string*>(option.into))
        added.check([](const std::string& text) { return text.empty() ? "is empty" : ""; });
}

} // namespace

namespace {

/// Spells `--set a.b=1 c.d=2` as `--set a.b=1 --set c.d=2`, so that the last value of a key counts.
std::vector<std::string> spelt_out(int argc, char** argv) {
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) {
        words.emplace_back(argv[i]);
        if (words.back() != takes::set_name || i + 1 == argc) continue;
        words.emplace_back(argv[++i]);
        for (; i + 1 < argc && is_override(argv[i + 1]); ++i) {
            words.emplace_back(takes::set_name);
            words.emplace_back(argv[i + 1]);
        }
    }
    return words;
}

} // namespace

bool is_for_programs(const std::vector<Command>& commands, int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i], progress = takes::progress_name;
        if (word == takes::json_name || word == progress + "=json" ||
            (i > 1 && argv[i - 1] == progress && word == "json"))
            return true;
    }
    return argc > 1 && std::ranges::any_of(commands, [&](const Command& command) {
               return command.for_programs && command.name == argv[1];
           });
}

namespace {

/// Returns true for the words of a call that name the standard input as the scene.
bool is_standard_input(const Option& option) {
    return option.name == takes::scene_name &&
           std::ranges::find(*std::get<std::vector<std::string>*>(option.into),
                             io::standard_input) !=
               std::get<std::vector<std::string>*>(option.into)->end();
}

/// Returns true for a call of --help or -h, of the program or of a command.
bool asks_for_help(int argc, char** argv) {
    return std::any_of(argv + std::min(1, argc), argv + argc,
                       [](const char* word) {
                           return std::string_view(word) == "--help" ||
                                  std::string_view(word) == "-h";
                       }) ||
           (argc > 1 && std::string_view(argv[1]) == "help");
}

/// Returns the error of a command line that the library does not understand, with the option that
/// was meant.
io::SceneError not_understood(const CLI::ParseError& error, const std::vector<Command>& commands,
                              int argc, char** argv) {
    const std::string command = argc > 1 ? argv[1] : "";
    const auto of = std::find_if(commands.begin(), commands.end(),
                                 [&](const Command& one) { return one.name == command; });
    if (of == commands.end())
        return io::SceneError(
            io::Problem{"command line", "no command is given", "", "asperity --help"});
    std::vector<std::string> names{"--help"};
    for (const Option& option : of->options)
        if (option.name.starts_with("-")) names.push_back(option.name);
    std::string fix = fmt::format("asperity {} --help", command);
    for (int i = 2; i < argc; ++i) {
        const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
        if (word == "-j")
            return io::SceneError(io::Problem{
                "command line", fmt::format("-j is no option of {}", command),
                "it is of commands that make several runs; threads are those of the environment, "
                "ranks those of mpirun",
                fmt::format("OMP_NUM_THREADS=2 asperity {0} ..., or mpirun -n 2 asperity {0} ...",
                            command)});
        if (!word.starts_with("--") || std::ranges::find(names, word) != names.end()) continue;
        std::vector<std::string> words; // without dashes, which all have
        words.reserve(names.size());
        for (const std::string& name : names)
            words.push_back(name.substr(2));
        const std::string near = io::nearest(word.substr(2), words);
        if (!near.empty()) fix = fmt::format("did you mean --{}?", near);
        return io::SceneError(
            io::Problem{"command line", fmt::format("{} is no option of {}", word, command),
                        fmt::format("its options are {}", fmt::join(names, ", ")), fix});
    }
    const bool lacks = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (lacks && error.what() == std::string(takes::scene_name) + " is required")
        return io::SceneError(io::Problem{
            "command line", "no scene is given", "the command needs one",
            fmt::format("for example: asperity {} scenes/first-contact.toml", command)});
    return io::SceneError(io::Problem{"command line", error.what(), "", fix});
}

} // namespace

int carry_out(const std::vector<Command>& commands, const std::vector<std::string>& of_script,
              int argc, char** argv, const Communicator& world) {
    CLI::App app("", "asperity");
    app.require_subcommand(1);
    app.set_help_flag();
    app.set_version_flag("--version", "asperity " + io::build_info().version);
    app.failure_message(CLI::FailureMessage::simple);
    if (asks_for_help(argc, argv)) {
        const auto of = std::find_if(commands.begin(), commands.end(),
                                     [&](const Command& one) { return one.name == argv[1]; });
        if (world.root())
            fmt::print("{}", of == commands.end() ? overview_of(commands) : help_of(*of));
        return io::exit_code::done;
    }

    std::vector<std::string> names;
    for (const Command& command : commands) {
        CLI::App& entry = *app.add_subcommand(command.name, command.purpose);
        entry.set_help_flag();
        for (const Option& option : command.options)
            add(entry, option);
        names.push_back(command.name);
    }

    // The library would only say that a command is missing.
    if (argc > 1 && argv[1][0] != '-' &&
        std::find(names.begin(), names.end(), argv[1]) == names.end()) {
        std::vector<std::string> all = names;
        all.insert(all.end(), of_script.begin(), of_script.end());
        const std::string near = io::nearest(argv[1], all);
        const bool script = std::ranges::find(of_script, near) != of_script.end();
        throw io::SceneError(io::Problem{
            "command line", fmt::format("'{}' is no command", argv[1]),
            fmt::format("the commands are {}; the script ./asperity of the source tree also has {}",
                        fmt::join(names, ", "), fmt::join(of_script, ", ")),
            near.empty() ? "asperity --help"
                         : fmt::format("did you mean `{}asperity {}`?", script ? "./" : "", near)});
    }
    try {
        std::vector<std::string> words = spelt_out(argc, argv);
        std::reverse(words.begin(), words.end()); // in the order that the library wants
        app.parse(words);
    } catch (const CLI::Success& asked) { // --version
        return world.root() ? app.exit(asked) : 0;
    } catch (const CLI::ParseError& error) {
        throw not_understood(error, commands, argc, argv);
    }
    for (const Command& command : commands)
        if (app.got_subcommand(command.name)) {
            if (world.size() > 1 && std::ranges::any_of(command.options, is_standard_input))
                throw io::SceneError(io::Problem{"stdin", "the scene cannot be read",
                                                 "only rank 0 would have it",
                                                 "write the scene to a file and name that"});
            if (!command.looks_at_signals) stop_signals::release();
            return command.act(world);
        }
    return io::exit_code::internal;
}

} // namespace asperity
