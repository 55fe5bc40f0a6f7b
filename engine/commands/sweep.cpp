// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/sweep.hpp"

#include "engine/commands/sweep_output.hpp"
#include "engine/commands/sweep_plots.hpp"
#include "engine/run/theory_case.hpp"
#include "engine/setup/setup.hpp"
#include "io/error.hpp"
#include "io/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

namespace asperity {

namespace {

/// A scene and its points, read and checked.
struct Plan {
    Scene base;
    std::vector<SweepAxis> axes;
    std::vector<std::string> fixed; ///< "key=value", at every point
    std::vector<std::vector<std::string>> grid;
    std::vector<Scene> scenes; ///< one a point
    std::string note;
};

/// Without a --set of several values: 100 roughnesses to a good way past the end of adhesion.
SweepAxis default_axis(const Scene& scene) {
    double step = 0.1;
    try {
        const theory::CriticalRoughness end =
            theory::critical_roughness(theory_case(scene).contact);
        const double wanted = 1.4 * end.h_rms / 100.0;
        const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
        double best = decade;
        for (const double m : {1.0, 2.0, 2.5, 5.0, 10.0})
            if (std::abs(std::log(m * decade / wanted)) < std::abs(std::log(best / wanted)))
                best = m * decade;
        step = best;
    } catch (const std::exception&) { // no such end, or a scene without roughness
    }
    SweepAxis axis{"surface.rms", {}, "surface.rms"};
    for (int i = 1; i <= 100; ++i)
        axis.values.push_back(fmt::format("{:.12g}", i * step));
    return axis;
}

/// The scene of every point. What is wrong with several of them is said once, and where it stands.
std::vector<Scene> read_points(const std::string& file, const Plan& plan, bool to_be_run) {
    const std::string text = io::read_scene_file(file);
    std::vector<Scene> scenes;
    std::vector<io::Problem> problems;
    for (const auto& point : plan.grid) {
        std::vector<std::string> overrides = plan.fixed;
        overrides.insert(overrides.end(), point.begin(), point.end());
        try {
            scenes.push_back(read_scene_text(text, file, overrides));
            if (to_be_run) examine(scenes.back(), 1);
        } catch (const io::SceneError& error) {
            for (io::Problem problem : error.problems()) {
                for (const SweepAxis& axis : plan.axes)
                    if (problem.where.starts_with("--set " + axis.key + "="))
                        problem.where = axis.where;
                if (std::none_of(problems.begin(), problems.end(), [&](const io::Problem& known) {
                        return known.where == problem.where && known.what == problem.what;
                    }))
                    problems.push_back(problem);
            }
        }
    }
    if (!problems.empty()) throw io::SceneError(problems);
    return scenes;
}

Plan make_plan(const std::string& file, const SweepOptions& options) {
    Plan plan;
    plan.axes = sweep_axes(options.assignments, plan.fixed, read_scene(file, {}).sweep);
    // The theory of a target spectrum knows no seeds.
    if (options.theory_only && !theory_needs_surface(read_scene(file, plan.fixed)))
        std::erase_if(plan.axes, [](const SweepAxis& axis) { return axis.is_seed(); });
    plan.base = read_scene(file, plan.fixed);
    if (plan.axes.empty() && !options.theory_only)
        throw io::SceneError(
            io::Problem{file, "there is nothing to sweep",
                        "neither its [sweep] nor a --set gives several values",
                        "for example --set surface.rms=1,2,3; for a single run: asperity run"});
    if (plan.axes.empty()) {
        if (plan.base.surface.kind == SurfaceKind::flat)
            throw io::SceneError(io::Problem{
                "asperity sweep", "there is nothing to sweep",
                "no --set gives several values, and a flat surface has no roughness to vary",
                "for example --set drive.load=-100,0,100"});
        if (std::any_of(plan.fixed.begin(), plan.fixed.end(), [](const std::string& assignment) {
                return assignment.starts_with("surface.rms=");
            }))
            throw io::SceneError(io::Problem{
                "asperity sweep", "there is nothing to sweep", "no --set gives several values",
                "for example --set surface.rms=1,2,3 or surface.rms=0.1:10:0.1"});
        plan.axes.push_back(default_axis(plan.base));
        plan.note =
            fmt::format("no --set gives several values: sweeping surface.rms from {} to {} Å",
                        plan.axes.front().values.front(), plan.axes.front().values.back());
    }
    plan.grid = sweep_grid(plan.axes);
    plan.scenes = read_points(file, plan, !options.theory_only);
    return plan;
}

/// The theory of scenes, in their order. A surface is made anew only where more than its roughness
/// changes.
std::vector<SweepPoint> theory_of(const std::vector<Scene>& scenes,
                                  const std::vector<SweepAxis>& axes,
                                  std::vector<std::string>& notes) {
    std::vector<SweepPoint> points;
    std::optional<Surface> surface;
    std::string surface_keys;
    for (const Scene& scene : scenes) {
        if (theory_needs_surface(scene)) {
            io::JsonValue keys = *scene_json(scene).find("surface");
            if (scene.surface.kind == SurfaceKind::self_affine) keys["rms"] = "any";
            if (const std::string text = keys.dump(-1); !surface || text != surface_keys) {
                surface = scene_surface(scene);
                surface_keys = text;
            }
        }
        const TheoryCase what =
            theory_case(scene, theory_needs_surface(scene) ? &*surface : nullptr);
        for (const std::string& said : what.notes)
            if (std::find(notes.begin(), notes.end(), said) == notes.end()) notes.push_back(said);
        points.push_back(SweepPoint(scene, axes, what, solve_theory(what)));
    }
    return points;
}

/// The theory's curves between the points of a simulation: the same axes, without seeds and with
/// some hundred values along x.
std::vector<SweepPoint> theory_curves(const Plan& plan, const std::vector<SweepPoint>& points) {
    const auto plotted = plotted_axis(plan.axes, points);
    if (!plotted) return {};
    std::vector<SweepAxis> axes = plan.axes;
    SweepAxis& x = axes[*plotted];
    Scene defaults;
    if (bind(defaults).find(x.key)->kind == io::Schema::Kind::number) {
        double low = points.front().values[*plotted].number(), high = low;
        for (const SweepPoint& p : points) {
            low = std::min(low, p.values[*plotted].number());
            high = std::max(high, p.values[*plotted].number());
        }
        constexpr int steps = 60;
        x.values.clear();
        for (int i = 0; i <= steps; ++i)
            x.values.push_back(fmt::format("{:.12g}", low + (high - low) * i / steps));
    }
    for (SweepAxis& axis : axes)
        if (axis.is_seed()) axis.values.resize(1);
    Plan fine{plan.base, axes, plan.fixed, sweep_grid(axes), {}, ""};
    std::vector<std::string> notes;
    return theory_of(read_points(plan.base.file, fine, false), axes, notes);
}

/// Like io::choose_result_directory; what must not be written over here is sweep.json.
io::ResultPlace choose_place(const std::string& asked, const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code error;
    const auto taken = [&](const fs::path& p) { return fs::exists(p / "sweep.json", error); };
    if (!asked.empty()) {
        if (fs::exists(asked, error) && !fs::is_directory(asked, error))
            throw io::SceneError(io::Problem{"--out " + asked, "is not a directory",
                                             "a file of that name is there",
                                             "name another directory"});
        if (taken(asked))
            throw io::SceneError(io::Problem{"--out " + asked, "already holds a sweep",
                                             "results are not written over",
                                             "name another directory, or remove this one"});
        return {asked, ""};
    }
    const std::string first = (fs::path("results") / (name + "-theory-sweep")).string();
    std::string place = first;
    for (int i = 2; taken(place); ++i)
        place = fmt::format("{}-{}", first, i);
    return {place, place == first ? ""
                                  : fmt::format("{} already holds a sweep; this one goes to {}",
                                                first, place)};
}

/// The name of a point's directory: "rms=3,seed=1". Sections only where two keys share a name.
std::string point_name(const SweepPoint& point, const std::vector<SweepAxis>& axes) {
    const auto last = [](const std::string& key) { return key.substr(key.find('.') + 1); };
    std::string name;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const auto same = std::count_if(axes.begin(), axes.end(), [&](const SweepAxis& other) {
            return last(other.key) == last(axes[i].key);
        });
        name += fmt::format("{}{}={}", i == 0 ? "" : ",",
                            same > 1 ? axes[i].key : last(axes[i].key), shown(point.values[i]));
    }
    for (char& c : name)
        if (c == '/' || c == ' ') c = '_';
    return name;
}

/// Where the points of a scene go, and the table they fill.
struct Part {
    Plan plan;
    SweepTable table;
    std::string directory;
};

/// gamma.svg and the others into the directory; their paths.
std::vector<std::string> write_plots(const std::string& directory,
                                     const std::vector<SweepTable>& tables, std::string& note) {
    std::vector<std::string> written;
    for (const io::Plot& plot : sweep_plots(tables, note)) {
        written.push_back((std::filesystem::path(directory) / (plot.id + ".svg")).string());
        io::write_plot(written.back(), plot);
    }
    return written;
}

int simulate(std::vector<Part>& parts, const SweepOptions& options, const std::string& directory) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<SweepJob> jobs;
    std::set<std::string> directories;
    for (Part& part : parts)
        for (std::size_t i = 0; i < part.plan.scenes.size(); ++i) {
            SweepPoint& point = part.table.points[i];
            point.name = point_name(point, part.plan.axes);
            SweepJob job{parts.size() > 1 ? part.table.name + "/" + point.name : point.name,
                         part.directory + "/" + point.name, part.plan.fixed, part.plan.scenes[i]};
            job.overrides.insert(job.overrides.end(), part.plan.grid[i].begin(),
                                 part.plan.grid[i].end());
            if (!directories.insert(job.directory).second)
                throw io::SceneError(
                    io::Problem{"asperity sweep", "two points are the same: " + job.name,
                                "every point has a directory of its own", "give every value once"});
            jobs.push_back(std::move(job));
        }
    for (Part& part : parts)
        part.table.theory = theory_curves(part.plan, part.table.points);
    std::vector<PointOutcome> outcomes;
    for (const SweepJob& job : jobs)
        outcomes.push_back(look_at(job));
    const auto count = [&](PointState state) {
        return std::count_if(outcomes.begin(), outcomes.end(),
                             [&](const PointOutcome& o) { return o.state == state; });
    };
    const auto there = count(PointState::finished), failed = count(PointState::failed);
    fmt::print("{} points in {}", jobs.size(), directory);
    if (there > 0) fmt::print("; {} are there already", there);
    if (failed > 0) fmt::print("; {} failed before, and are left alone", failed);
    fmt::print("\n");
    std::fflush(stdout);

    const auto fill_in = [&] {
        std::size_t i = 0;
        for (Part& part : parts)
            for (SweepPoint& point : part.table.points)
                point.outcome = outcomes[i++];
        for (Part& part : parts) {
            part.table.seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            write_tables(part.directory, part.table);
        }
    };
    SweepRunOptions how;
    how.at_once = options.jobs;
    how.launcher = options.launcher;
    how.wall_limit = options.wall_limit;
    how.progress = options.progress;
    const bool all = run_points(jobs, outcomes, how, [&](std::size_t) { fill_in(); });
    fill_in();

    std::vector<SweepTable> tables;
    for (const Part& part : parts)
        tables.push_back(part.table);
    std::string note;
    const std::vector<std::string> plots = write_plots(directory, tables, note);
    for (const SweepTable& table : tables) {
        fmt::print("\n");
        print_table(table);
        for (const std::string& said : table.notes)
            fmt::print("note: {}\n", said);
    }
    if (!note.empty()) fmt::print("note: {}\n", note);
    int code = io::exit_code::done;
    for (std::size_t i = 0; i < jobs.size(); ++i)
        if (outcomes[i].state == PointState::failed) {
            fmt::print("failed: {} (exit {}): {}\n", jobs[i].name, outcomes[i].exit_code,
                       outcomes[i].reason);
            if (code == io::exit_code::done) code = outcomes[i].exit_code;
        }
    fmt::print("{} of {} points are done, in {}\n", count(PointState::finished), jobs.size(),
               directory);
    fmt::print("tables: sweep.csv, sweep.json, sweep.h5; plots:");
    for (const std::string& plot : plots)
        fmt::print(" {}", std::filesystem::path(plot).filename().string());
    fmt::print("\n");
    if (!all) {
        fmt::print("Stopped early: the same command goes on from here.\n");
        return io::exit_code::stopped;
    }
    return code;
}

} // namespace

int sweep_command(const SweepOptions& options) {
    if (!options.theory_only && std::getenv("OMPI_COMM_WORLD_SIZE"))
        throw io::SceneError(io::Problem{
            "asperity sweep", "a sweep of simulations is not started under mpirun",
            "it starts its points itself, each as a run of its own",
            "asperity sweep SCENE --launch \"mpirun -n 2\" gives every point two ranks"});
    const auto start = std::chrono::steady_clock::now();
    std::vector<Part> parts;
    std::string name;
    for (const std::string& file : options.scenes) {
        Part part{make_plan(file, options), {}, ""};
        part.table.name = part.plan.base.name;
        name += (name.empty() ? "" : "+") + part.table.name;
        for (const Part& other : parts)
            if (other.table.name == part.table.name)
                throw io::SceneError(io::Problem{file, "has the name of another scene of the sweep",
                                                 "the points of a scene go to a folder of its name",
                                                 "rename one of the files"});
        part.table.axes = part.plan.axes;
        part.table.scene = scene_json(part.plan.base);
        part.table.points = theory_of(part.plan.scenes, part.plan.axes, part.table.notes);
        part.table.simulated = !options.theory_only;
        parts.push_back(std::move(part));
    }
    for (const Part& part : parts)
        if (!part.plan.note.empty()) fmt::print("note: {}\n", part.plan.note);
    if (!options.theory_only) {
        const std::string place = options.out.empty() ? "results/" + name + "-sweep" : options.out;
        for (Part& part : parts)
            part.directory = parts.size() > 1 ? place + "/" + part.table.name : place;
        return simulate(parts, options, place);
    }
    const io::ResultPlace place = choose_place(options.out, name);
    if (!place.note.empty()) fmt::print("note: {}\n", place.note);
    std::vector<SweepTable> tables;
    std::vector<std::string> written;
    for (Part& part : parts) {
        part.table.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        part.directory =
            parts.size() > 1 ? place.directory + "/" + part.table.name : place.directory;
        const auto files = write_tables(part.directory, part.table);
        written.insert(written.end(), files.begin(), files.end());
        tables.push_back(std::move(part.table));
    }
    std::string note;
    const auto plots = write_plots(place.directory, tables, note);
    written.insert(written.end(), plots.begin(), plots.end());
    std::size_t points = 0;
    for (const SweepTable& table : tables) {
        print_table(table);
        points += table.points.size();
        for (const std::string& said : table.notes)
            fmt::print("note: {}\n", said);
    }
    if (!note.empty()) fmt::print("note: {}\n", note);
    fmt::print("{} points in {:.2f} s; written:\n", points, tables.front().seconds);
    for (const std::string& path : written)
        fmt::print("  {}\n", path);
    return io::exit_code::done;
}

} // namespace asperity
