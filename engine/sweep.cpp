// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/sweep.hpp"

#include "engine/setup.hpp"
#include "engine/sweep_output.hpp"
#include "engine/theory_command.hpp"
#include "io/error.hpp"
#include "io/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

namespace asperity {

namespace {

constexpr std::size_t most_points = 10000;

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    for (std::string& part : parts) {
        part.erase(0, part.find_first_not_of(" \t"));
        part.erase(part.find_last_not_of(" \t") + 1);
    }
    return parts;
}

std::optional<double> number(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
    return value;
}

io::SceneError wrong(const std::string& assignment, std::string what, std::string why,
                     std::string fix) {
    return io::SceneError(
        io::Problem{"--set " + assignment, std::move(what), std::move(why), std::move(fix)});
}

/// "0.1:25:0.25" as its values; nothing if it is no range.
std::optional<std::vector<std::string>> range(const std::string& text,
                                              const std::string& assignment, bool whole) {
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() < 2 || !number(parts[0]) || !number(parts[1])) return std::nullopt;
    if (parts.size() != 3 || !number(parts[2]))
        throw wrong(assignment, "is no range", "a range is start:stop:step, three plain numbers",
                    "for example surface.rms=0.5:10:0.5");
    const double start = *number(parts[0]), stop = *number(parts[1]), step = *number(parts[2]);
    const double steps = (stop - start) / step;
    if (!(step != 0.0 && steps >= 0.0))
        throw wrong(assignment, "is a range without values",
                    fmt::format("steps of {:g} do not lead from {:g} to {:g}", step, start, stop),
                    "give start:stop:step with a step towards stop");
    if (!(steps < static_cast<double>(most_points)))
        throw wrong(assignment, fmt::format("asks for {:.3g} values", std::floor(steps) + 1.0),
                    fmt::format("a sweep has {} points at most", most_points), "take longer steps");
    std::vector<std::string> values;
    for (int i = 0; i <= static_cast<int>(std::floor(steps + 1e-9)); ++i) {
        const double value = start + i * step;
        // Twelve digits: 0.1 + 2 x 0.1 is 0.3. A key of real numbers takes "3" as well as "3.0".
        values.push_back(whole && value == std::round(value)
                             ? fmt::format("{:.0f}", value)
                             : fmt::format("{:.12g}", value == 0.0 ? 0.0 : value));
    }
    return values;
}

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
    SweepAxis axis{"surface.rms", {}};
    for (int i = 1; i <= 100; ++i)
        axis.values.push_back(fmt::format("{:.12g}", i * step));
    return axis;
}

/// Every point's scene. What is wrong with several of them is said once.
std::vector<Scene> read_points(const SweepOptions& options, const std::vector<std::string>& fixed,
                               const std::vector<std::vector<std::string>>& grid) {
    const std::string text = io::read_scene_file(options.scene);
    std::vector<Scene> scenes;
    std::vector<io::Problem> problems;
    for (const auto& point : grid) {
        std::vector<std::string> overrides = fixed;
        overrides.insert(overrides.end(), point.begin(), point.end());
        try {
            scenes.push_back(read_scene_text(text, options.scene, overrides));
        } catch (const io::SceneError& error) {
            for (const io::Problem& problem : error.problems())
                if (std::none_of(problems.begin(), problems.end(), [&](const io::Problem& known) {
                        return known.where == problem.where && known.what == problem.what;
                    }))
                    problems.push_back(problem);
        }
    }
    if (!problems.empty()) throw io::SceneError(problems);
    return scenes;
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
    const std::string first = (fs::path("results") / (name + "-sweep")).string();
    std::string place = first;
    for (int i = 2; taken(place); ++i)
        place = fmt::format("{}-{}", first, i);
    return {place, place == first ? ""
                                  : fmt::format("{} already holds a sweep; this one goes to {}",
                                                first, place)};
}

} // namespace

std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& assignments,
                                  std::vector<std::string>& fixed) {
    Scene defaults;
    const io::Schema schema = bind(defaults);
    std::vector<SweepAxis> axes;
    std::vector<std::string> seen;
    for (const std::string& assignment : assignments) {
        const std::size_t equals = assignment.find('=');
        const std::string name = split(assignment.substr(0, equals), ' ').front();
        const io::Schema::Key* key = schema.find(name);
        if (equals == std::string::npos || !key || key->kind == io::Schema::Kind::list) {
            fixed.push_back(assignment); // a list has commas of its own; mistakes are found later
            continue;
        }
        if (std::find(seen.begin(), seen.end(), name) != seen.end())
            throw wrong(assignment, name + " is given twice", "every key is one axis of the sweep",
                        fmt::format("put its values into one list: --set {}=v1,v2", name));
        seen.push_back(name);
        const bool whole = key->kind == io::Schema::Kind::integer;
        const bool counts = whole || key->kind == io::Schema::Kind::number;
        SweepAxis axis{name, {}};
        for (const std::string& part : split(assignment.substr(equals + 1), ',')) {
            if (part.empty())
                throw wrong(assignment, "has an empty value", "values stand between commas",
                            fmt::format("for example --set {}=v1,v2", name));
            const auto values = counts ? range(part, assignment, whole) : std::nullopt;
            if (values)
                axis.values.insert(axis.values.end(), values->begin(), values->end());
            else
                axis.values.push_back(part);
        }
        if (axis.values.size() == 1)
            fixed.push_back(name + "=" + axis.values.front());
        else
            axes.push_back(std::move(axis));
    }
    std::size_t points = 1;
    for (const SweepAxis& axis : axes) {
        points *= axis.values.size();
        if (points > most_points)
            throw io::SceneError(io::Problem{
                "sweep", fmt::format("the grid has {} points or more", points),
                fmt::format("{} are the most", most_points), "sweep fewer values or fewer keys"});
    }
    return axes;
}

std::vector<std::vector<std::string>> sweep_grid(const std::vector<SweepAxis>& axes) {
    std::vector<std::vector<std::string>> grid(1);
    for (const SweepAxis& axis : axes) {
        std::vector<std::vector<std::string>> next;
        for (const auto& point : grid)
            for (const std::string& value : axis.values) {
                next.push_back(point);
                next.back().push_back(axis.key + "=" + value);
            }
        grid = std::move(next);
    }
    return grid;
}

int sweep_command(const SweepOptions& options) {
    if (!options.theory_only)
        throw io::SceneError(io::Problem{
            "asperity sweep", "a sweep of simulations is not available yet",
            "this release sweeps the theory only",
            "add --theory-only; for simulations, one `asperity run --set key=value` a value"});
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::string> fixed;
    SweepTable table;
    table.axes = sweep_axes(options.assignments, fixed);
    const Scene base = read_scene(options.scene, fixed);
    std::string note;
    if (table.axes.empty()) {
        if (base.surface.kind == SurfaceKind::flat)
            throw io::SceneError(io::Problem{
                "asperity sweep", "there is nothing to sweep",
                "no --set gives several values, and a flat surface has no roughness to vary",
                "for example --set drive.load=-100,0,100"});
        if (std::any_of(fixed.begin(), fixed.end(), [](const std::string& assignment) {
                return assignment.starts_with("surface.rms=");
            }))
            throw io::SceneError(io::Problem{
                "asperity sweep", "there is nothing to sweep", "no --set gives several values",
                "for example --set surface.rms=1,2,3 or surface.rms=0.1:10:0.1"});
        table.axes.push_back(default_axis(base));
        note = fmt::format("no --set gives several values: sweeping surface.rms from {} to {} Å",
                           table.axes.front().values.front(), table.axes.front().values.back());
    }
    const auto grid = sweep_grid(table.axes);
    const std::vector<Scene> scenes = read_points(options, fixed, grid);
    const io::ResultPlace place = choose_place(options.out, base.name);
    if (!note.empty()) fmt::print("note: {}\n", note);
    if (!place.note.empty()) fmt::print("note: {}\n", place.note);

    // A surface is made anew only where more than its roughness changes.
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
            if (std::find(table.notes.begin(), table.notes.end(), said) == table.notes.end())
                table.notes.push_back(said);
        table.points.push_back(SweepPoint(scene, table.axes, what, solve_theory(what)));
    }
    table.scene = scene_json(base);
    table.name = base.name;
    table.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    io::make_directory(place.directory);
    write_sweep(place.directory, table);
    return io::exit_code::done;
}

} // namespace asperity
