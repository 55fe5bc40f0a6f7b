// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The program: a table of commands, each with its description, its options and its function.
// start.cpp is the program's main(); the Python module calls program() itself.
// The main loop of a run is follow() in engine/run/run.cpp.
// Every rank of mpirun runs this; how they end together is in engine/commands/exit_code.hpp.
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

/// Returns the commands in the order of --help.
std::vector<Command> all_commands() {
    return {
        {"run",
         "simulate a scene",
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
             const Case c = case_of(given, world.size());
             require_memory(c, world);
             return run(c, options, world);
         },
         true},
        {"init",
         "write a commented scene to start from; never over a file",
         {{"FILE", "", "the scene file to be made (default: scene.toml)", &Arguments::words},
          {"--out", "FILE", "the same as an option", &Arguments::out, "-o"},
          takes::quiet,
          takes::json},
         [](const Arguments& given, const Communicator& world) {
             return init_command(given, world);
         }},
        {"check",
         "look for mistakes in a scene without running it",
         {takes::scene, takes::set, takes::quiet, takes::json},
         [](const Arguments& given, const Communicator& world) {
             return check_command(case_of(given, world.size()), given, world);
         }},
        {"plan",
         "what a scene will simulate and what not, and what it will cost; runs nothing",
         {takes::scene,
          takes::set,
          {"--ranks", "N", "for so many ranks (default: as started)", &Arguments::ranks},
          takes::quiet,
          takes::json},
         [](const Arguments& given, const Communicator& world) {
             return plan_command(case_of(given, given.ranks > 0 ? given.ranks : world.size()),
                                 given, world);
         }},
        {"surface",
         "make or read the surface, print and write its statistics and heights",
         {takes::scene, takes::set, takes::out("results/<scene>-surface; with --json no files"),
          takes::quiet, takes::json},
         [](const Arguments& given, const Communicator& world) {
             return surface_command(surface_case_of(given, world.size()), given, world);
         }},
        {"theory", "the theories of a scene, without simulating it", {}},
        {"theory-points",
         "for programs: Persson's theory of many variations of a scene, as JSON",
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
         "for programs: the stresses below a state of a run, as HDF5",
         {takes::scene,
          takes::set,
          {"--points", "FILE", "the state: {\"file\": run.h5, \"state\": name, \"slid\": false}",
           &Arguments::points},
          {"--out", "FILE", "the file to write", &Arguments::out}},
         [](const Arguments& given, const Communicator& world) {
             return on_root(world, [&] { return stress_below_command(case_of(given, 1), given); });
         }},
        {"hold",
         "for programs: the lock of a result directory, sent through the socket that is the "
         "standard input",
         {{.name = "DIR",
           .value = "",
           .explanation = "the directory",
           .into = &Arguments::out,
           .needed = true}},
         [](const Arguments& given, const Communicator& world) {
             return on_root(world, [&] { return hold_command(given.out); });
         }},
        {"sweep", "a scene over several values of its keys: runs, theory, one table", {}},
        {"cost",
         "what accuracy costs in run time: a scene with each of its numerical settings varied",
         {}},
        {"estimate",
         "the numbers of a scene with their errors, from runs with one setting varied at a time",
         {}},
        {"adhesion", "from a measured map of heights to its adhesion with an error", {}},
        {"tip", "the force curve of a tip on a sample, with an error", {}},
        {"states", "the stable states of a contact under its load", {}},
        {"stress", "the stresses below the surface of a run, and the largest with an error", {}},
        {"report", "a run or a sweep as one self-contained HTML page", {}},
        {"export", "maps and trajectory of a run for OVITO, ParaView, or as PNG", {}},
        {"convert", "a map of heights or a substrate's atoms as the HDF5 that a scene names", {}},
        {"prony", "branches of a viscoelastic block from a master curve of a rubber", {}},
        {"scenes", "copy the scenes and examples that come with the program, and list them", {}},
        {"defaults",
         "every key of a scene with its default, as TOML",
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
         "what this program was built from and runs on",
         {takes::quiet, takes::json},
         [](const Arguments& given, const Communicator& world) {
             return info_command(given.json, world);
         }},
    };
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
