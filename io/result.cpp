// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/result.hpp"

#include "io/build_info.hpp"

#include <utility>

namespace asperity::io {

namespace {

void put_path(JsonValue& root, std::string_view path, const JsonValue& value) {
    const std::size_t dot = path.find('.');
    if (dot == std::string_view::npos)
        root[path] = value;
    else
        put_path(root[path.substr(0, dot)], path.substr(dot + 1), value);
}

/// An object of those quantities that are there; null if none is.
JsonValue group(std::initializer_list<std::pair<const char*, Quantity>> members) {
    JsonValue object;
    for (const auto& [name, value] : members)
        object.put(name, value);
    return object;
}

void put_group(JsonValue& root, const char* name, JsonValue object) {
    if (!object.is_null()) root[name] = std::move(object);
}

} // namespace

JsonValue result_json(const ResultRecord& record) {
    JsonValue root = JsonValue::object();
    if (!record.name.empty()) root["name"] = record.name;
    if (!record.scene.is_null()) root["scene"] = record.scene;
    const auto& s = record.surface;
    put_group(root, "surface",
              group({{"rms", s.rms}, {"rms_slope", s.rms_slope}, {"min", s.min}, {"max", s.max}}));
    if (!s.origin.empty()) root["surface"]["origin"] = s.origin;
    root.put("delta_gamma", record.delta_gamma);
    root.put("binding_energy", record.binding_energy);
    const auto& w = record.work_of_adhesion;
    put_group(
        root, "work_of_adhesion",
        group({{"approach", w.approach}, {"pull_off", w.pull_off}, {"pairwise", w.pairwise}}));
    root.put("contact_fraction", record.contact_fraction);
    root.put("pushed_fraction", record.pushed_fraction);
    root.put("pull_off_force", record.pull_off_force);
    put_group(root, "jkr", group({{"in", record.jkr.in}, {"out", record.jkr.out}}));
    const auto& t = record.theory;
    put_group(root, "theory",
              group({{"gamma_eff", t.gamma_eff},
                     {"contact_fraction", t.contact_fraction},
                     {"gamma_full_contact", t.gamma_full_contact}}));
    const auto& e = record.energy;
    put_group(root, "energy",
              group({{"residual", e.residual},
                     {"work", e.work},
                     {"kinetic", e.kinetic},
                     {"elastic", e.elastic},
                     {"interface", e.interface},
                     {"damped", e.damped}}));

    JsonValue& run = root["run"];
    run.put("wall_seconds", record.run.wall_seconds);
    run.put("steps", record.run.steps);
    run.put("iterations", record.run.iterations);
    run.put("ranks", record.run.ranks);
    run.put("threads", record.run.threads);
    JsonValue phases = JsonValue::object();
    for (const ResultRecord::Phase& phase : record.run.phases) {
        phases[phase.name]["seconds"] = phase.seconds;
        phases[phase.name]["calls"] = phase.calls;
    }
    run["phases"] = std::move(phases);
    if (!record.run.stopped.empty()) run["stopped"] = record.run.stopped;
    const BuildInfo build = build_info();
    run["version"] = build.version;
    run["git"] = build.git;
    run["compiler"] = build.compiler;
    run["flags"] = build.flags;
    run["machine"] = machine();

    if (record.failure.exit_code != 0 || !record.failure.reason.empty()) {
        root["failure"]["exit_code"] = record.failure.exit_code;
        root["failure"]["reason"] = record.failure.reason;
    }
    for (const auto& [path, value] : record.extra)
        put_path(root, path, value);
    return root;
}

void write_result(const Directory& directory, const ResultRecord& record) {
    write_whole({directory, "result.json"}, result_json(record).dump() + "\n");
}

} // namespace asperity::io
