// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The command line. Everything that prints to the terminal, and every exit, is here or called from
// here.
//
// Under mpirun every rank runs this; rank 0 alone speaks. A scene that is wrong is met by all ranks
// alike, or by rank 0 for all of them: they agree on the code and end in order. Any other error
// ends them all at once (abort), because the others may be waiting for this one.
#include "engine/commands/cost.hpp"
#include "engine/commands/export.hpp"
#include "engine/commands/report.hpp"
#include "engine/commands/sweep.hpp"
#include "engine/run/plan.hpp"
#include "engine/run/run.hpp"
#include "engine/run/theory_command.hpp"
#include "engine/scene/scene.hpp"
#include "engine/setup/setup.hpp"

#include "decomposition/communicator.hpp"
#include "io/build_info.hpp"
#include "io/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/height_map.hpp"
#include "io/result.hpp"
#include "io/table.hpp"
#include "kernels/variant.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <span>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fftw3.h>
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

namespace asperity {
namespace {

/// What a command that takes a scene is given.
struct SceneArguments {
    std::vector<std::string> words; ///< the scene, and overrides that follow a --set
    std::vector<std::string> overrides;
    std::string out;
    std::string resume;
    std::string wall_limit;
    std::string progress = "auto";
    int ranks = 0; ///< to plan for; 0: as many as there are
    bool markdown = false;
    bool plain = false;
    bool theory_only = false;
    int jobs = 1;
    std::string launch;
    std::vector<std::string> knobs;
};

void add_scene(CLI::App& command, SceneArguments& arguments) {
    command.add_option("SCENE", arguments.words, "the scene file (TOML)")
        ->required()
        ->type_name("");
    command
        .add_option("--set", arguments.overrides,
                    "override a key of the scene: section.key=value; repeatable")
        ->type_name("key=value")
        ->allow_extra_args(false);
}

bool is_override(const std::string& word) {
    const std::size_t equals = word.find('='), dot = word.find('.');
    return equals != std::string::npos && dot < equals && word.find('/') >= equals &&
           !std::filesystem::exists(word);
}

/// `--set a=1 b=2 scene.toml` means what it looks like: the scene's file; the overrides are added.
std::vector<std::string> scene_files(const SceneArguments& arguments,
                                     std::vector<std::string>& overrides) {
    std::vector<std::string> files;
    overrides = arguments.overrides;
    for (const std::string& word : arguments.words)
        (is_override(word) ? overrides : files).push_back(word);
    if (files.empty())
        throw io::SceneError(io::Problem{"command line", "no scene is given",
                                         "the command needs one",
                                         "for example: asperity run scenes/first-contact.toml"});
    return files;
}

std::string scene_file(const SceneArguments& arguments, std::vector<std::string>& overrides) {
    const std::vector<std::string> files = scene_files(arguments, overrides);
    if (files.size() > 1)
        throw io::SceneError(io::Problem{"command line", "more than one scene is given",
                                         fmt::format("{} and {}", files[0], files[1]),
                                         "for example: asperity run scenes/first-contact.toml"});
    return files.front();
}

Scene scene_of(const SceneArguments& arguments) {
    std::vector<std::string> overrides;
    const std::string file = scene_file(arguments, overrides);
    return read_scene(file, overrides);
}

RunOptions run_options(const SceneArguments& arguments) {
    RunOptions options;
    options.out = arguments.out;
    options.resume = arguments.resume;
    io::Problems problems;
    if (!arguments.wall_limit.empty()) {
        options.wall_limit = io::parse_duration(arguments.wall_limit);
        if (!options.wall_limit)
            problems.add(io::Problem{"--wall-limit " + arguments.wall_limit, "is no length of time",
                                     "", "for example 23h50m, 45m or 90s"});
    }
    if (const auto mode = io::progress_mode(arguments.progress))
        options.progress = *mode;
    else
        problems.add(io::Problem{"--progress " + arguments.progress, "is none of its choices",
                                 "choices: auto, bar, lines, off", ""});
    if (options.resuming() && options.resume != "auto" && !std::filesystem::exists(options.resume))
        problems.add(io::Problem{"--resume " + options.resume, "there is no such file",
                                 "a checkpoint file or the word auto is needed",
                                 "--resume auto takes the checkpoint in the result directory"});
    problems.throw_if_any();
    return options;
}

int command_run(const SceneArguments& arguments, const Communicator& world) {
    const RunOptions options = run_options(arguments);
    const Scene scene = scene_of(arguments);
    io::Problems problems = scene.problems();
    not_yet(scene, problems);
    problems.throw_if_any();
    return run(scene, options, world);
}

int command_check(const SceneArguments& arguments, const Communicator& world) {
    const Scene scene = scene_of(arguments);
    const Setup setup = examine(scene, world.size());
    if (!world.root()) return io::exit_code::done;
    fmt::print("{}: nothing wrong\n", scene.file);
    fmt::print("  {0} x {0} sites, box {1:.6g} Å, {2} layers in {3} level{4}\n",
               scene.surface.sites, scene.edge(), scene.block.thickness, setup.levels.size(),
               setup.levels.size() == 1 ? "" : "s");
    if (scene.has(PathPart::approach) || scene.has(PathPart::pull_off))
        fmt::print("  time step {:.4g} fs, stable up to {:.4g} fs\n", scene.drive.timestep,
                   setup.longest_timestep);
    for (const std::string& note : setup.notes)
        fmt::print("  note: {}\n", note);
    return io::exit_code::done;
}

int command_plan(const SceneArguments& arguments, const Communicator& world) {
    const Scene scene = scene_of(arguments);
    const int ranks = arguments.ranks > 0 ? arguments.ranks : world.size();
    examine(scene, ranks);
    const int cores = omp_get_max_threads() * world.size();
    world.on_root(
        [&] { print_plan(stdout, scene, make_plan(scene, ranks, std::max(1, cores / ranks))); });
    return io::exit_code::done;
}

int command_surface(const SceneArguments& arguments, const Communicator& world) {
    const Scene scene = scene_of(arguments);
    const Surface surface = scene_surface(scene);
    if (!world.root()) return io::exit_code::done;
    const io::ResultPlace place =
        io::choose_result_directory(arguments.out, scene.name + "-surface", false);
    io::make_directory(place.directory);

    const SurfaceStatistics& statistics = surface.statistics;
    const std::string map = (std::filesystem::path(place.directory) / "heights.h5").string();
    io::write_height_map(map, {surface.sites, surface.height, surface.length, "Å", ""});
    io::Hdf5File file(map, io::Hdf5File::Mode::edit);
    std::vector<double> q, realised, target;
    for (const SpectrumBin& bin : statistics.spectrum) {
        q.push_back(bin.q);
        realised.push_back(bin.realised);
        target.push_back(bin.target);
    }
    const auto column = [&](const std::string& name, const std::string& unit, const auto& values) {
        file.write<double>("/spectrum/" + name, {values.size()}, values);
        file.write_attribute("/spectrum/" + name, "unit", unit);
    };
    column("q", "1/Å", q);
    column("realised", "Å^4", realised);
    column("target", "Å^4", target);
    file.close();

    io::ResultRecord record;
    record.scene = scene_json(scene);
    record.surface = {statistics.rms, statistics.rms_slope, statistics.lowest, statistics.highest};
    io::write_result(place.directory, record);

    io::Table table({"surface", "", ""});
    table.align_left(2);
    table.row({"atoms", fmt::format("{0} x {0}", surface.sites), ""});
    table.row({"edge", io::cell(surface.length, 6), "Å"});
    table.row({"pixel", io::cell(surface.length / surface.sites), "Å"});
    table.row({"rms height", io::cell(statistics.rms), "Å"});
    table.row({"rms slope", io::cell(statistics.rms_slope), ""});
    table.row({"lowest", io::cell(statistics.lowest), "Å"});
    table.row({"highest", io::cell(statistics.highest), "Å"});
    table.print(stdout);
    for (const std::string& note : surface.notes)
        fmt::print("note: {}\n", note);
    if (!place.note.empty()) fmt::print("note: {}\n", place.note);
    fmt::print("heights and spectrum in {}\n", map);
    return io::exit_code::done;
}

int command_theory(const SceneArguments& arguments, const Communicator& world) {
    const Scene scene = scene_of(arguments);
    int code = io::exit_code::done;
    world.on_root([&] { code = theory_command(scene, arguments.out); });
    return code;
}

int command_sweep(const SceneArguments& arguments, const Communicator& world) {
    SweepOptions options;
    options.scenes = scene_files(arguments, options.assignments);
    options.theory_only = arguments.theory_only;
    options.jobs = arguments.jobs;
    std::istringstream words(arguments.launch);
    for (std::string word; words >> word;)
        options.launcher.push_back(word);
    const RunOptions common = run_options(arguments);
    options.wall_limit = common.wall_limit;
    options.progress = common.progress;
    options.out = arguments.out;
    int code = io::exit_code::done;
    world.on_root([&] { code = sweep_command(options); });
    return code;
}

int command_cost(const SceneArguments& arguments, const Communicator& world) {
    CostOptions options;
    options.scene = scene_file(arguments, options.overrides);
    options.knobs = arguments.knobs;
    options.jobs = arguments.jobs;
    options.progress = run_options(arguments).progress;
    options.out = arguments.out;
    int code = io::exit_code::done;
    world.on_root([&] { code = cost_command(options); });
    return code;
}

int command_report(const std::string& directory, const Communicator& world) {
    int code = io::exit_code::done;
    world.on_root([&] { code = report_command(directory); });
    return code;
}

int command_export(const std::string& directory, const std::string& format,
                   const Communicator& world) {
    int code = io::exit_code::done;
    world.on_root([&] { code = export_command(directory, format); });
    return code;
}

int command_defaults(const SceneArguments& arguments, const Communicator& world) {
    if (!world.root()) return io::exit_code::done;
    if (arguments.markdown)
        fmt::print("{}", scene_markdown());
    else
        fmt::print("{}", scene_toml(Scene{}, !arguments.plain));
    return io::exit_code::done;
}

int command_info(const Communicator& world) {
    if (!world.root()) return io::exit_code::done;
    const io::BuildInfo build = io::build_info();
    io::Table table({"", ""});
    table.align_left(1);
    table.row({"version", build.version});
    table.row({"git", build.git});
    table.row({"compiler", build.compiler});
    table.row({"flags", build.flags});
    table.row({"MPI", ParallelSession::library()});
    table.row({"HDF5", build.hdf5});
    table.row({"FFTW", fftw_version});
    table.row({"ranks", std::to_string(world.size())});
    table.row({"threads", fmt::format("{} a rank", omp_get_max_threads())});
    table.row({"processor", fmt::format("kernels for {}, interface in double or mixed precision",
                                        name(processor_level()))});
    fmt::print("asperity {}\n", build.version);
    table.print(stdout);
    return io::exit_code::done;
}

/// Says what went wrong, on rank 0, and with which code to end.
int report(const std::exception& error, const Communicator& world) {
    int code = io::exit_code::internal;
    std::string text = error.what();
    if (const auto* known = dynamic_cast<const io::Error*>(&error)) {
        code = known->code();
        const std::size_t count = known->problems().size();
        if (code == io::exit_code::scene)
            text +=
                fmt::format("\n{} problem{}; nothing was written", count, count == 1 ? "" : "s");
    } else {
        text = "asperity: internal error: " + text +
               "\n    why: the program met a state it does not expect"
               "\n    fix: please report this, with the scene";
    }
    if (world.root()) {
        std::fflush(stdout);
        fmt::print(stderr, "{}\n", text);
        std::fflush(stderr);
    }
    return code;
}

/// The root's exit code (or the only one there is), on every rank. Collective.
int agreed(int code, const Communicator& world) {
    double greatest = code;
    world.max(std::span<double>(&greatest, 1));
    return static_cast<int>(greatest);
}

/// An error inside a run of several ranks. Those that are not rank 0 give it time to speak first;
/// if it does not, the error is theirs alone.
[[noreturn]] void end_together(const std::exception& error, const Communicator& world) {
    const int code = report(error, world);
    if (!world.root()) {
        std::this_thread::sleep_for(std::chrono::seconds(5));
        fmt::print(stderr, "rank {}: {}\n", world.rank(), error.what());
        std::fflush(stderr);
    }
    world.abort(code);
}

/// Threads of this rank, where nobody chose them: the processors it may use, shared with the ranks
/// beside it unless the launcher has bound each to processors of its own.
void choose_threads() {
    if (std::getenv("OMP_NUM_THREADS")) return;
    const char* beside = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    const int ranks = beside ? std::max(1, std::atoi(beside)) : 1;
    const int mine = omp_get_num_procs();
    const bool bound = mine < static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
    omp_set_num_threads(bound ? mine : std::max(1, mine / ranks));
}

int command_line(int argc, char** argv, const Communicator& world) {
    CLI::App app("Adhesion between randomly rough elastic solids, from the atoms up", "asperity");
    app.require_subcommand(1);
    app.set_version_flag("--version", "asperity " + io::build_info().version);
    app.failure_message(CLI::FailureMessage::simple);
    app.footer("Exit codes: 0 done, 1 internal error, 2 usage or scene, 3 physics guard, 4 files, "
               "75 stopped "
               "early.\nStart here: asperity run scenes/first-contact.toml");

    SceneArguments arguments;
    CLI::App& run = *app.add_subcommand("run", "simulate a scene");
    add_scene(run, arguments);
    run.add_option("--out", arguments.out, "result directory (default: results/<scene>)")
        ->type_name("DIR");
    run.add_option("--resume", arguments.resume, "go on from a checkpoint: auto, or its file")
        ->type_name("auto|FILE");
    run.add_option("--wall-limit", arguments.wall_limit,
                   "stop with a checkpoint before this time has passed (exit 75)")
        ->type_name("23h50m");
    run.add_option("--progress", arguments.progress, "auto, bar, lines or off")->type_name("MODE");
    CLI::App& check =
        *app.add_subcommand("check", "look for mistakes in a scene without running it");
    add_scene(check, arguments);
    CLI::App& plan = *app.add_subcommand(
        "plan", "what a scene will simulate and what not, and what it will cost; runs nothing");
    add_scene(plan, arguments);
    plan.add_option("--ranks", arguments.ranks, "for so many ranks (default: as started)")
        ->type_name("N")
        ->check(CLI::PositiveNumber);
    CLI::App& surface = *app.add_subcommand(
        "surface", "make or read the surface, print and write its statistics and heights");
    add_scene(surface, arguments);
    surface
        .add_option("--out", arguments.out, "result directory (default: results/<scene>-surface)")
        ->type_name("DIR");
    CLI::App& theory =
        *app.add_subcommand("theory", "the analytic theory of a scene, without simulating it");
    add_scene(theory, arguments);
    theory.add_option("--out", arguments.out, "result directory (default: results/<scene>-theory)")
        ->type_name("DIR");
    CLI::App& sweep = *app.add_subcommand(
        "sweep", "a scene over several values of its keys: runs, theory, one table");
    add_scene(sweep, arguments);
    sweep.add_option("--jobs", arguments.jobs, "points side by side")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    sweep
        .add_option("--launch", arguments.launch,
                    "what to put before the program for every point: \"mpirun -n 2\"")
        ->type_name("WORDS");
    sweep
        .add_option("--wall-limit", arguments.wall_limit,
                    "stop with checkpoints when this time has passed (exit 75)")
        ->type_name("23h50m");
    sweep.add_option("--progress", arguments.progress, "auto, bar, lines or off")
        ->type_name("MODE");
    sweep.add_flag("--theory-only", arguments.theory_only, "the theory alone, no simulation");
    sweep.add_option("--out", arguments.out, "result directory (default: results/<scene>-sweep)")
        ->type_name("DIR");
    sweep.footer(
        "--set key=v1,v2,... or key=start:stop:step sweeps a key, beside those of the "
        "scene's [sweep]; with several, every combination.\nThe same command goes on where "
        "a sweep stopped. Several scenes share one set of plots.");
    CLI::App& cost =
        *app.add_subcommand("cost", "what accuracy costs in time: a scene with each of its "
                                    "numerical settings varied");
    add_scene(cost, arguments);
    cost.add_option("--knobs", arguments.knobs, "only these: timestep,cutoff,layers,...")
        ->delimiter(',')
        ->type_name("NAMES");
    cost.add_option("--jobs", arguments.jobs, "runs side by side, one thread each")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    cost.add_option("--progress", arguments.progress, "auto, bar, lines or off")->type_name("MODE");
    cost.add_option("--out", arguments.out, "result directory (default: results/<scene>-cost)")
        ->type_name("DIR");
    cost.footer("The same command goes on where it stopped.");
    std::string directory, format;
    CLI::App& report =
        *app.add_subcommand("report", "a run or a sweep as one self-contained HTML page");
    report.add_option("DIR", directory, "the result directory")->required()->type_name("");
    CLI::App& to_others = *app.add_subcommand(
        "export", "maps and trajectory of a run for OVITO, ParaView, or as PNG");
    to_others.add_option("DIR", directory, "the result directory")->required()->type_name("");
    to_others.add_option("--to", format, "xyz, lammps, xdmf or png")
        ->required()
        ->type_name("FORMAT");
    CLI::App& defaults =
        *app.add_subcommand("defaults", "every key of a scene with its default, as TOML");
    defaults.add_flag("--markdown", arguments.markdown, "as the reference page docs/scene.md");
    defaults.add_flag("--plain", arguments.plain, "without explanations");
    CLI::App& info = *app.add_subcommand("info", "what this program was built from and runs on");

    // The library would only say that a command is missing.
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands({}))
        commands.push_back(command->get_name());
    if (argc > 1 && argv[1][0] != '-' &&
        std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
        const std::string near = io::nearest(argv[1], commands);
        throw io::SceneError(io::Problem{
            "command line", fmt::format("'{}' is no command", argv[1]),
            fmt::format("commands: {}", fmt::join(commands, ", ")),
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
    if (run.parsed()) return command_run(arguments, world);
    if (check.parsed()) return command_check(arguments, world);
    if (plan.parsed()) return command_plan(arguments, world);
    if (surface.parsed()) return command_surface(arguments, world);
    if (theory.parsed()) return command_theory(arguments, world);
    if (sweep.parsed()) return command_sweep(arguments, world);
    if (cost.parsed()) return command_cost(arguments, world);
    if (report.parsed()) return command_report(directory, world);
    if (to_others.parsed()) return command_export(directory, format, world);
    if (defaults.parsed()) return command_defaults(arguments, world);
    if (info.parsed()) return command_info(world);
    return io::exit_code::internal;
}

} // namespace
} // namespace asperity

int main(int argc, char** argv) {
    using namespace asperity;
    const ParallelSession session(argc, argv);
    const Communicator& world = session.world();
    choose_threads();
    try {
        return command_line(argc, argv, world);
    } catch (const io::SceneError& error) { // on every rank, or on the root for all of them
        return agreed(report(error, world), world);
    } catch (const io::PhysicsError& error) { // guards judge global numbers: on every rank
        return agreed(report(error, world), world);
    } catch (const RootFailure&) { // the root has the reason and the code
        return agreed(io::exit_code::done, world);
    } catch (const std::exception& error) {
        if (world.size() > 1) end_together(error, world);
        return report(error, world);
    }
}
