// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/sweep_grid.hpp"

#include "engine/scene/scene.hpp"
#include "io/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

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

io::SceneError wrong(const std::string& where, std::string what, std::string why, std::string fix) {
    return io::SceneError(io::Problem{where, std::move(what), std::move(why), std::move(fix)});
}

/// "0.1:25:0.25" as its values; nothing if it is no range.
std::optional<std::vector<std::string>> range(const std::string& text, const std::string& where,
                                              bool whole) {
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() < 2 || !number(parts[0]) || !number(parts[1])) return std::nullopt;
    if (parts.size() != 3 || !number(parts[2]))
        throw wrong(where, "is no range", "a range is start:stop:step, three plain numbers",
                    "for example surface.rms=0.5:10:0.5");
    const double start = *number(parts[0]), stop = *number(parts[1]), step = *number(parts[2]);
    const double steps = (stop - start) / step;
    if (!(step != 0.0 && steps >= 0.0))
        throw wrong(where, "is a range without values",
                    fmt::format("steps of {:g} do not lead from {:g} to {:g}", step, start, stop),
                    "give start:stop:step with a step towards stop");
    if (!(steps < static_cast<double>(most_points)))
        throw wrong(where, fmt::format("asks for {:.3g} values", std::floor(steps) + 1.0),
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

/// "1,2,5" or "0.5:10:0.5" or both, as single values.
SweepAxis axis_of(const io::Schema::Key& key, const std::string& values, const std::string& where) {
    const std::string name = key.path();
    const bool whole = key.kind == io::Schema::Kind::integer;
    const bool counts = whole || key.kind == io::Schema::Kind::number;
    SweepAxis axis{name, {}, where};
    for (const std::string& part : split(values, ',')) {
        if (part.empty())
            throw wrong(where, "has an empty value", "values stand between commas",
                        fmt::format("for example --set {}=v1,v2", name));
        const auto several = counts ? range(part, where, whole) : std::nullopt;
        if (several)
            axis.values.insert(axis.values.end(), several->begin(), several->end());
        else
            axis.values.push_back(part);
    }
    return axis;
}

} // namespace

bool SweepAxis::is_seed() const { return key.ends_with(".seed"); }

std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& assignments,
                                  std::vector<std::string>& fixed,
                                  const std::vector<io::Variation>& of_scene) {
    Scene defaults;
    const io::Schema schema = bind(defaults);
    std::vector<SweepAxis> axes;
    std::vector<std::string> seen;
    const auto take = [&](SweepAxis axis) {
        if (axis.values.size() == 1)
            fixed.push_back(axis.key + "=" + axis.values.front());
        else
            axes.push_back(std::move(axis));
    };
    for (const std::string& assignment : assignments) {
        const std::string where = "--set " + assignment;
        const std::size_t equals = assignment.find('=');
        const std::string name = split(assignment.substr(0, equals), ' ').front();
        const io::Schema::Key* key = schema.find(name);
        if (equals == std::string::npos || !key || key->kind == io::Schema::Kind::list) {
            fixed.push_back(assignment); // a list has commas of its own; mistakes are found later
            continue;
        }
        if (std::find(seen.begin(), seen.end(), name) != seen.end())
            throw wrong(where, name + " is given twice", "every key is one axis of the sweep",
                        fmt::format("put its values into one list: --set {}=v1,v2", name));
        seen.push_back(name);
        take(axis_of(*key, assignment.substr(equals + 1), where));
    }
    for (const io::Variation& variation : of_scene) {
        if (std::find(seen.begin(), seen.end(), variation.key) != seen.end()) continue;
        const io::Schema::Key& key = *schema.find(variation.key);
        if (key.kind == io::Schema::Kind::list)
            throw wrong(variation.where, variation.key + " cannot be swept",
                        "its value is a list itself", "write one scene for each");
        take(axis_of(key, variation.values, variation.where));
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

} // namespace asperity
