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

} // namespace

void refuse_unmet_needs(const Scene& scene, io::Problems& problems) {
    Scene copy = scene, defaults;
    const io::Schema schema = bind(copy), of_defaults = bind(defaults);
    for (const io::Schema::Key& key : schema.keys()) {
        const io::Schema::Need* const need = key.unmet_need();
        if (!need || need->why.empty() || !scene.positions.is_set(key.path())) continue;
        if (key.load() == of_defaults.find(key.path())->load()) continue;
        const std::string with = need->refused.empty() ? "" : " " + need->refused;
        problems.add(key.path(), "= " + shown(key) + with, need->why, need->fix);
    }
}

std::vector<std::string> notes_on_idle_keys(const Scene& scene) {
    Scene copy = scene;
    const io::Schema schema = bind(copy);
    std::vector<std::pair<std::string, std::vector<std::string>>> idle; // by their reasons
    for (const io::Schema::Key& key : schema.keys()) {
        const io::Schema::Need* const need = key.unmet_need();
        if (!need || !need->why.empty() || !scene.positions.is_set(key.path())) continue;
        auto of_reason = std::find_if(idle.begin(), idle.end(), [&](const auto& reason) {
            return reason.first == need->otherwise;
        });
        if (of_reason == idle.end()) of_reason = idle.insert(idle.end(), {need->otherwise, {}});
        of_reason->second.push_back(key.path());
    }
    std::vector<std::string> notes;
    notes.reserve(idle.size());
    for (const auto& [reason, keys] : idle)
        notes.push_back(keys.size() == 1
                            ? fmt::format("{} has no effect: {}", keys.front(), reason)
                            : fmt::format("{} and {} have no effect: {}",
                                          fmt::join(keys.begin(), keys.end() - 1, ", "),
                                          keys.back(), reason));
    return notes;
}

} // namespace asperity
