// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/commands/stored_sweep.hpp"

#include "engine/commands/stored_run.hpp"
#include "io/error.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace asperity {

namespace {

namespace fs = std::filesystem;
using io::JsonValue;

double number(const JsonValue& object, const char* path) {
    const JsonValue* value = object.find(path);
    return value && value->is_number() ? value->number() : std::nan("");
}

std::string text(const JsonValue& object, const char* path) {
    const JsonValue* value = object.find(path);
    return value && value->is_text() ? value->text() : std::string();
}

/// "work_of_adhesion.approach" is one name in the table, and two steps in a result.json.
void put(JsonValue& result, const std::string& path, const JsonValue& value) {
    JsonValue* at = &result;
    std::size_t from = 0;
    for (std::size_t dot; (dot = path.find('.', from)) != std::string::npos; from = dot + 1)
        at = &(*at)[path.substr(from, dot - from)];
    (*at)[path.substr(from)] = value;
}

/// The values of the axes in their order; null where the point does not say.
std::vector<JsonValue> values_of(const JsonValue& point, const std::vector<SweepAxis>& axes) {
    std::vector<JsonValue> values(axes.size());
    if (const JsonValue* set = point.find("set"); set && set->is_object())
        for (const auto& [key, value] : set->members())
            for (std::size_t i = 0; i < axes.size(); ++i)
                if (axes[i].key == key) values[i] = value;
    return values;
}

SweepPoint read_point(const JsonValue& json, const std::vector<SweepAxis>& axes) {
    SweepPoint point;
    point.values = values_of(json, axes);
    point.what.flat = number(json, "delta_gamma");
    point.what.delta_gamma = number(json, "theory.delta_gamma");
    TheoryNumbers& n = point.numbers;
    n.h_rms = number(json, "theory.h_rms");
    n.rms_slope = number(json, "theory.rms_slope");
    n.gamma_eff = number(json, "theory.gamma_eff");
    n.gamma_full_contact = number(json, "theory.gamma_full_contact");
    RenormalisedNumbers renormalised;
    renormalised.gamma_eff = number(json, "theory.renormalised.gamma_eff");
    renormalised.gamma_eff_ratio = number(json, "theory.renormalised.gamma_eff_ratio");
    renormalised.contact_fraction = number(json, "theory.renormalised.contact_fraction");
    n.renormalised = RenormalisedResult{renormalised, ""};
    n.state.area = number(json, "theory.contact_fraction");
    n.state.gamma_ratio = n.gamma_eff / point.what.delta_gamma;
    const std::string status = text(json, "theory.status");
    for (const auto known :
         {theory::Status::adhesive, theory::Status::pressed, theory::Status::no_contact})
        if (status == theory::name(known)) n.state.status = known;
    point.name = text(json, "directory");
    point.outcome.state = text(json, "status") == "done"     ? PointState::finished
                          : text(json, "status") == "failed" ? PointState::failed
                                                             : PointState::waiting;
    point.outcome.reason = text(json, "failure.reason");
    if (const JsonValue* result = json.find("result"); result && result->is_object())
        for (const auto& [path, value] : result->members())
            put(point.outcome.result, path, value);
    return point;
}

std::vector<SweepPoint> read_points(const JsonValue& sweep, const char* name,
                                    const std::vector<SweepAxis>& axes) {
    std::vector<SweepPoint> points;
    if (const JsonValue* list = sweep.find(name); list && list->is_array())
        for (const JsonValue& point : list->items())
            if (point.is_object()) points.push_back(read_point(point, axes));
    return points;
}

StoredSweep read_sweep(const std::string& directory) {
    const std::string path = (fs::path(directory) / "sweep.json").string();
    StoredSweep stored{directory, JsonValue::parse(read_text(path), path), {}};
    const JsonValue& json = stored.json;
    if (!json.find("points") || !json.find("points")->is_array())
        throw io::FileError(path, "is no sweep", "it has no list of points",
                            "run the sweep again into another directory");
    SweepTable& table = stored.table;
    table.name = text(json, "name");
    if (table.name.empty()) table.name = directory_name(directory);
    if (const JsonValue* scene = json.find("scene")) table.scene = *scene;
    if (const JsonValue* axes = json.find("axes"); axes && axes->is_array())
        for (const JsonValue& axis : axes->items())
            if (axis.is_text()) table.axes.push_back({axis.text(), {}, ""});
    table.points = read_points(json, "points", table.axes);
    table.theory = read_points(json, "theory", table.axes);
    for (const SweepPoint& point : table.points) {
        table.simulated = table.simulated || !point.outcome.result.is_null() || !point.name.empty();
        for (std::size_t i = 0; i < table.axes.size(); ++i) {
            auto& values = table.axes[i].values;
            if (const std::string v = shown(point.values[i]);
                std::find(values.begin(), values.end(), v) == values.end())
                values.push_back(v);
        }
    }
    if (const JsonValue* notes = json.find("notes"); notes && notes->is_array())
        for (const JsonValue& note : notes->items())
            if (note.is_text()) table.notes.push_back(note.text());
    table.seconds = number(json, "run.wall_seconds");
    return stored;
}

} // namespace

std::vector<StoredSweep> read_sweeps(const std::string& directory) {
    std::error_code error;
    if (fs::exists(fs::path(directory) / "sweep.json", error)) return {read_sweep(directory)};
    std::vector<std::string> folders;
    for (const auto& entry : fs::directory_iterator(directory, error))
        if (fs::exists(entry.path() / "sweep.json", error))
            folders.push_back(entry.path().string());
    std::sort(folders.begin(), folders.end());
    std::vector<StoredSweep> list;
    for (const std::string& folder : folders)
        list.push_back(read_sweep(folder));
    return list;
}

} // namespace asperity
