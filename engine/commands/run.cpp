// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/command_line.hpp"

#include "decomposition/communicator.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/run.hpp"
#include "io/error.hpp"
#include "io/terminal.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace asperity {

namespace {

struct RunArguments : Arguments {
    std::string resume;
    bool restart = false;
    std::string wall_limit;
};

/// Returns the options of a run. Throws io::SceneError.
RunOptions options_of(const RunArguments& given) {
    RunOptions options;
    options.out = given.out;
    options.resume = given.resume;
    options.restart = given.restart;
    io::Problems problems;
    if (options.restart && options.resuming())
        problems.add(io::Problem{"--restart", "and --resume exclude each other",
                                 "--restart deletes an unfinished run, --resume continues it",
                                 "give one of them"});
    if (!given.wall_limit.empty()) {
        options.wall_limit = io::parse_duration(given.wall_limit);
        if (!options.wall_limit)
            problems.add(io::Problem{"--wall-limit " + given.wall_limit, "is no length of time", "",
                                     "for example 23h50m, 45m or 90s"});
    }
    options.quiet = given.quiet;
    options.json = given.json;
    const std::string progress = !given.progress.empty() ? given.progress
                                 : only_results(given)   ? "off"
                                                         : "auto";
    if (const auto mode = io::progress_mode(progress))
        options.progress = *mode;
    else
        problems.add(io::Problem{"--progress " + given.progress, "is none of its choices",
                                 "the choices are auto, bar, lines, json and off",
                                 "give one of them"});
    if (options.resuming() && options.resume != "auto" && !std::filesystem::exists(options.resume))
        problems.add(io::Problem{"--resume " + options.resume, "there is no such file",
                                 "a checkpoint file or the word auto is needed",
                                 "--resume auto takes the checkpoint in the result directory"});
    problems.throw_if_any();
    return options;
}

int run_scene(const RunArguments& given, const Communicator& world) {
    const RunOptions options = options_of(given);
    const Case c = case_of(given, world.size(), world);
    require_memory(c, world);
    return run(c, options, world);
}

} // namespace

Command run_command() {
    const auto given = std::make_shared<RunArguments>();
    return {.options = {takes::scene(*given),
                        takes::set(*given),
                        takes::out(*given, "results/<scene>"),
                        {"--resume", "auto|FILE", "go on from a checkpoint: auto, or its file",
                         &given->resume},
                        {"--restart", "", "throw away an unfinished run that the directory holds",
                         &given->restart},
                        {"--wall-limit", "23h50m",
                         "stop with a checkpoint before this time has passed (exit 75)",
                         &given->wall_limit},
                        takes::progress(*given),
                        takes::quiet(*given),
                        takes::json(*given)},
            .act = [given](const Communicator& world) { return run_scene(*given, world); },
            .looks_at_signals = true};
}

} // namespace asperity
