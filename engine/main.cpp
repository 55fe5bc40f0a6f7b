// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The program: its commands, each with its options and its function;
// python/asperity/commands/table.txt lists all commands with their purpose. start.cpp is the
// program's main(); the Python module calls program() itself. The main loop of a run is follow() in
// engine/run/run.cpp. Every rank of mpirun runs this; how they end together is in
// engine/commands/exit_code.hpp.
#include "engine/commands/command_line.hpp"
#include "engine/commands/commands.hpp"
#include "engine/commands/exit_code.hpp"
#include "engine/commands/program.hpp"
#include "engine/commit.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/run.hpp"
#include "engine/run/stop_signals.hpp"

#include "decomposition/communicator.hpp"
#include "io/error.hpp"
#include "io/machine.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace asperity {
namespace {

/// Calls work on rank 0 for commands that need one process; the other ranks wait.
int on_root(const Communicator& world, const std::function<int()>& work) {
    int code = io::exit_code::done;
    world.on_root([&] { code = work(); });
    return code;
}

/// Returns the commands that this program carries out itself.
std::vector<Command> own_commands() {
    return {
        {"run",
         {takes::scene,
          takes::set,
          takes::out("results/<scene>"),
          {"--resume", "auto|FILE", "go on from a checkpoint: auto, or its file",
           &Arguments::resume},
          {"--restart", "", "throw away an unfinished run that the directory holds",
           &Arguments::restart},
          {"--wall-limit", "23h50m", "stop with a checkpoint before this time has passed (exit 75)",
           &Arguments::wall_limit},
          takes::progress,
          takes::quiet,
          takes::json},
         [](const Arguments& given, const Communicator& world) {
             const RunOptions options = run_options(given);
             const Case c = case_of(given, world.size(), world);
             require_memory(c, world);
             return run(c, options, world);
         },
         true},
        {"init",
         {{"FILE", "", "the scene file to be made (default: scene.toml)", &Arguments::words},
          {"--out", "FILE", "the same as an option", &Arguments::out, "-o"},
          takes::quiet,
          takes::json},
         [](const Arguments& given, const Communicator& world) {
             return init_command(given, world);
         }},
        {"check",
         {takes::scene, takes::set, takes::quiet, takes::json},
         [](const Arguments& given, const Communicator& world) {
             return check_command(case_of(given, world.size(), world), given, world);
         }},
        {"plan",
         {takes::scene,
          takes::set,
          {"--ranks", "N", "for so many ranks (default: as started)", &Arguments::ranks},
          {"--memory-per-node", "SIZE",
           "say how many ranks fit into a node of this memory, for example 256GB",
           &Arguments::memory_per_node},
          takes::quiet,
          takes::json},
         [](const Arguments& given, const Communicator& world) {
             return plan_command(case_of(given, given.ranks > 0 ? given.ranks : world.size()),
                                 given, world);
         }},
        {"surface",
         {takes::scene, takes::set, takes::out("results/<scene>-surface; with --json no files"),
          takes::quiet, takes::json},
         [](const Arguments& given, const Communicator& world) {
             return surface_command(surface_case_of(given, world.size()), given, world);
         }},
        {"theory-points",
         {takes::scene,
          takes::set,
          {"--points", "FILE",
           "the variations: a JSON array of overrides a line (-: standard input); a line of JSON "
           "for each",
           &Arguments::points},
          {"--runnable", "", "also check what a run would refuse", &Arguments::runnable},
          {"--profile", "", "also everything over magnification, and where adhesion ends",
           &Arguments::profile}},
         [](const Arguments& given, const Communicator& world) {
             TheoryPoints points{{}, {}, given.points, given.runnable, given.profile};
             points.scene = scene_file(given, points.overrides);
             return on_root(world, [&] { return theory_points_command(points); });
         }},
        {"stress-below",
         {takes::scene,
          takes::set,
          {"--points", "FILE", "the state: {\"file\": run.h5, \"state\": name, \"slid\": false}",
           &Arguments::points},
          {"--out", "FILE", "the file to write", &Arguments::out}},
         [](const Arguments& given, const Communicator& world) {
             return on_root(world, [&] { return stress_below_command(case_of(given, 1), given); });
         }},
        {"hold",
         {{.name = "DIR",
           .value = "",
           .explanation = "the directory",
           .into = &Arguments::out,
           .needed = true}},
         [](const Arguments& given, const Communicator& world) {
             return on_root(world, [&] { return hold_command(given.out); });
         }},
        {"defaults",
         {{"--markdown", "", "as the reference page docs/reference/scene.md", &Arguments::markdown},
          {"--plain", "", "without explanations", &Arguments::plain},
          takes::quiet,
          takes::json,
          {"--results", "",
           "every name of result.json and run.h5: the reference page docs/reference/result.md; "
           "with --json those of result.json",
           &Arguments::results}},
         [](const Arguments& given, const Communicator& world) {
             return given.json
                        ? schema_command(given.results, world)
                        : defaults_command(given.markdown, given.plain, given.results, world);
         }},
        {"info",
         {takes::quiet, takes::json},
         [](const Arguments& given, const Communicator& world) {
             return info_command(given.json, world);
         }},
    };
}

/// A row of python/asperity/commands/table.txt: a command, who carries it out (the program, the
/// Python package, or the script `asperity`), and its purpose.
struct Row {
    std::string_view name, by, purpose;
};
constexpr Row table[] = {
#include "commands_table.inc"
};

/// Returns the commands in the order of --help.
std::vector<Command> all_commands() {
    const std::vector<Command> own = own_commands();
    std::vector<Command> all;
    for (const Row& row : table) {
        if (row.by == "script") continue;
        Command command{.name = std::string(row.name)};
        for (const Command& one : own)
            if (row.by == "program" && one.name == row.name) command = one;
        command.purpose = row.purpose;
        all.push_back(std::move(command));
    }
    return all;
}

} // namespace

int program(int argc, char** argv) {
    const std::vector<Command> commands = all_commands();
    if (const auto failed = hand_over_to_python(commands, argc, argv)) return *failed;
        // Memory of fields goes back to the system when they go: else what a heap keeps between
        // them adds to the peak (a tenth in states without friction).
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 17);
#endif
    stop_signals::catch_all();
    io::set_commit(build_commit);
    const ParallelSession session(argc, argv);
    const Communicator& world = session.world();
    world.share_processors();
    return exit_code_of(world, is_for_programs(argc, argv), [&] {
        if (session.unconnected() > 0) return refuse_unconnected(session);
        return carry_out(commands, argc, argv, world);
    });
}

} // namespace asperity
