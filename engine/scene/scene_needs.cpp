// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/scene/scene_needs.hpp"

#include "io/json.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace asperity {

namespace {

/// Returns the value of a key as a message shows it.
std::string shown(const io::Schema::Key& key) {
    const io::Json value = key.load();
    if (value.is_array()) return "[...]";
    const std::string unit = key.unit.empty() ? "" : " " + key.unit;
    if (value.is_number_float()) return fmt::format("{:.6g}{}", value.get<double>(), unit);
    return io::json_text(value);
}

/// A key that the scene sets, one of whose needs is not met.
struct IdleKey {
    std::string key, value; ///< the value as a message shows it
    io::Schema::Need need;
    /// The key is noted, not refused: it has its default, belongs to another kind of path, or is
    /// one of the file that --set has switched off.
    bool is_noted;
};

/// Returns the keys that the scene sets, that have no effect or are refused.
std::vector<IdleKey> idle_keys(const Scene& scene) {
    Scene copy = scene, defaults;
    const io::Schema schema = bind(copy), of_defaults = bind(defaults);
    const auto is_override = [&](const std::string& key) {
        return scene.positions.is_set(key) && scene.positions.where(key).starts_with("--set");
    };
    std::vector<IdleKey> idle;
    for (const io::Schema::Key& key : schema.keys()) {
        const io::Schema::Need* const need = key.unmet_need();
        if (!need || !scene.positions.is_set(key.path())) continue;
        const bool is_default = key.load() == of_defaults.find(key.path())->load();
        const bool refuses = !need->why.empty();
        const bool switched_off =
            !is_override(key.path()) &&
            std::any_of(need->deciding.begin(), need->deciding.end(), is_override);
        const bool is_noted = !refuses && (is_default || need->instead.empty() || switched_off);
        if (!refuses || !is_default) idle.push_back({key.path(), shown(key), *need, is_noted});
    }
    return idle;
}

} // namespace

void refuse_unmet_needs(const Scene& scene, io::Problems& problems) {
    for (const IdleKey& idle : idle_keys(scene)) {
        const io::Schema::Need& need = idle.need;
        if (idle.is_noted) continue;
        if (need.why.empty())
            problems.add(idle.key, "= " + idle.value + " has no effect", need.otherwise,
                         fmt::format("{}, or leave {} out", need.instead, idle.key));
        else
            problems.add(idle.key,
                         "= " + idle.value + (need.refused.empty() ? "" : " " + need.refused),
                         need.why, need.fix);
    }
}

std::vector<std::string> notes_on_idle_keys(const Scene& scene) {
    std::vector<std::pair<std::string, std::vector<std::string>>> noted; // by their reasons
    for (const IdleKey& idle : idle_keys(scene)) {
        if (!idle.is_noted) continue;
        auto of_reason = std::find_if(noted.begin(), noted.end(), [&](const auto& reason) {
            return reason.first == idle.need.otherwise;
        });
        if (of_reason == noted.end())
            of_reason = noted.insert(noted.end(), {idle.need.otherwise, {}});
        of_reason->second.push_back(idle.key);
    }
    std::vector<std::string> notes;
    notes.reserve(noted.size());
    for (const auto& [reason, keys] : noted)
        notes.push_back(keys.size() == 1
                            ? fmt::format("{} has no effect: {}", keys.front(), reason)
                            : fmt::format("{} and {} have no effect: {}",
                                          fmt::join(keys.begin(), keys.end() - 1, ", "),
                                          keys.back(), reason));
    return notes;
}

} // namespace asperity
