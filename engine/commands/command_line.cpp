// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/run/stop_signals.hpp"
#include "io/build_info.hpp"
#include "io/error.hpp"
#include "io/spelling.hpp"

#include <algorithm>
#include <filesystem>

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
    if (files.size() > 1)
        throw refuse("more than one scene is given", fmt::format("{} and {}", files[0], files[1]));
    return files.front();
}

Scene scene_of(const Arguments& given) {
    std::vector<std::string> overrides;
    const std::string file = scene_file(given, overrides);
    return read_scene(file, overrides);
}

RunOptions run_options(const Arguments& given) {
    RunOptions options;
    options.out = given.out;
    options.resume = given.resume;
    options.restart = given.restart;
    io::Problems problems;
    if (options.restart && options.resuming())
        problems.add(io::Problem{"--restart", "and --resume exclude each other",
                                 "one throws an unfinished run away, the other goes on with it",
                                 "give one of them"});
    if (!given.wall_limit.empty()) {
        options.wall_limit = io::parse_duration(given.wall_limit);
        if (!options.wall_limit)
            problems.add(io::Problem{"--wall-limit " + given.wall_limit, "is no length of time", "",
                                     "for example 23h50m, 45m or 90s"});
    }
    if (const auto mode = io::progress_mode(given.progress))
        options.progress = *mode;
    else
        problems.add(io::Problem{"--progress " + given.progress, "is none of its choices",
                                 "choices: auto, bar, lines, off", ""});
    if (options.resuming() && options.resume != "auto" && !std::filesystem::exists(options.resume))
        problems.add(io::Problem{"--resume " + options.resume, "there is no such file",
                                 "a checkpoint file or the word auto is needed",
                                 "--resume auto takes the checkpoint in the result directory"});
    problems.throw_if_any();
    return options;
}

namespace takes {

void scene(CLI::App& command, Arguments& given) {
    command.add_option("SCENE", given.words, "the scene file (TOML); - is the standard input")
        ->required()
        ->type_name("");
    command
        .add_option("--set", given.overrides,
                    "override a key of the scene: section.key=value; repeatable")
        ->type_name("key=value")
        ->allow_extra_args(false);
}

void new_file(CLI::App& command, Arguments& given) {
    command.add_option("FILE", given.out, "the scene file to be made (default: scene.toml)")
        ->type_name("");
}

void resume(CLI::App& command, Arguments& given) {
    command.add_option("--resume", given.resume, "go on from a checkpoint: auto, or its file")
        ->type_name("auto|FILE");
}

void restart(CLI::App& command, Arguments& given) {
    command.add_flag("--restart", given.restart,
                     "throw away an unfinished run that the directory holds");
}

void progress(CLI::App& command, Arguments& given) {
    command.add_option("--progress", given.progress, "auto, bar, lines or off")->type_name("MODE");
}

void ranks(CLI::App& command, Arguments& given) {
    command.add_option("--ranks", given.ranks, "for so many ranks (default: as started)")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
}

void markdown(CLI::App& command, Arguments& given) {
    command.add_flag("--markdown", given.markdown, "as the reference page docs/scene.md");
}

void results(CLI::App& command, Arguments& given) {
    command.add_flag(
        "--results", given.results,
        "every name of result.json and run.h5: the reference page docs/result.md; with "
        "--json those of result.json");
}

void plain(CLI::App& command, Arguments& given) {
    command.add_flag("--plain", given.plain, "without explanations");
}

void json(CLI::App& command, Arguments& given) {
    command.add_flag("--json", given.json, "one line of JSON for programs; writes no files");
}

void points(CLI::App& command, Arguments& given) {
    command
        .add_option("--points", given.points,
                    "many variations in one call: a JSON array of overrides a line (-: standard "
                    "input), a line of JSON for each")
        ->type_name("FILE");
    command.add_flag("--runnable", given.runnable,
                     "with --points: also check what a run would refuse");
}

Option out(const std::string& otherwise) {
    return [otherwise](CLI::App& command, Arguments& given) {
        command
            .add_option("--out", given.out,
                        fmt::format("result directory (default: {})", otherwise))
            ->type_name("DIR");
    };
}

Option wall_limit(const std::string& explanation) {
    return [explanation](CLI::App& command, Arguments& given) {
        command.add_option("--wall-limit", given.wall_limit, explanation)->type_name("23h50m");
    };
}

} // namespace takes

int carry_out(const std::vector<Command>& commands, int argc, char** argv,
              const Communicator& world) {
    CLI::App app("Adhesion between randomly rough elastic solids, from the atoms up", "asperity");
    app.require_subcommand(1);
    app.set_version_flag("--version", "asperity " + io::build_info().version);
    app.failure_message(CLI::FailureMessage::simple);
    app.footer("Exit codes: 0 done, 1 internal error, 2 usage or scene, 3 physics guard, 4 files, "
               "75 stopped "
               "early.\nStart here: asperity init, then asperity run scene.toml");

    Arguments given;
    std::vector<std::string> names;
    for (const Command& command : commands) {
        CLI::App& entry = *app.add_subcommand(command.name, command.purpose);
        for (const Option& option : command.options)
            option(entry, given);
        if (!command.footer.empty()) entry.footer(command.footer);
        names.push_back(command.name);
    }

    // The library would only say that a command is missing.
    if (argc > 1 && argv[1][0] != '-' &&
        std::find(names.begin(), names.end(), argv[1]) == names.end()) {
        const std::string near = io::nearest(argv[1], names);
        throw io::SceneError(io::Problem{
            "command line", fmt::format("'{}' is no command", argv[1]),
            fmt::format("commands: {}", fmt::join(names, ", ")),
            near.empty() ? "asperity --help" : fmt::format("did you mean `asperity {}`?", near)});
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) { // --help, --version
        return world.root() ? app.exit(asked) : 0;
    } catch (const CLI::ParseError& error) {
        throw io::SceneError(io::Problem{"command line", error.what(), "",
                                         "asperity --help, or asperity COMMAND --help"});
    }
    for (const Command& command : commands)
        if (app.got_subcommand(command.name)) {
            if (!command.looks_at_signals) stop_signals::release();
            return command.act(given, world);
        }
    return io::exit_code::internal;
}

} // namespace asperity
