// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/result.hpp"

#include "io/files.hpp"
#include "io/json.hpp"
#include "io/machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace asperity::io {

namespace {

/// Returns the place of a name in a tree, which is created. "*" stands for member and "[]" for
/// element; the tree of units has one entry for all elements.
Json& place(Json& root, std::string_view name, const std::string& member, std::size_t element,
            bool units) {
    Json* at = &root;
    while (!name.empty()) {
        const std::size_t dot = std::min(name.find('.'), name.size());
        std::string_view part = name.substr(0, dot);
        name.remove_prefix(std::min(dot + 1, name.size()));
        const bool list = part.ends_with("[]");
        if (list) part.remove_suffix(2);
        at = &(*at)[part == "*" ? member : std::string(part)];
        if (list && !units) at = &(*at)[element];
    }
    return *at;
}

} // namespace

Result::Result() : values_(std::make_unique<Json>(Json::object())) {
    // Members appear in the order in which they are made.
    for (const Quantity& q : result_quantities())
        (*values_)[std::string(q.name.substr(0, q.name.find('.')))];
    (*values_)["scene"];
    (*values_)["units"];
    const BuildInfo build = build_info();
    set("run.version", build.version);
    set("run.git", build.git);
    set("run.compiler", build.compiler);
    set("run.flags", build.flags);
    set("run.machine", machine());
}
Result::~Result() = default;
Result::Result(Result&&) noexcept = default;

void Result::put(Key key, const std::string& member, std::size_t element, Value&& value) {
    const Quantity& q = result_quantity(key.name);
    std::visit([&](auto v) { place(*values_, q.name, member, element, false) = std::move(v); },
               std::move(value));
    place((*values_)["units"], q.name, member, element, true) = std::string(q.unit);
}

void Result::set(Key key, Value value) { put(key, {}, 0, std::move(value)); }
void Result::set(Key key, std::string_view member, Value value) {
    put(key, std::string(member), 0, std::move(value));
}
void Result::set(Key key, std::size_t element, Value value) {
    put(key, {}, element, std::move(value));
}

void Result::set_list(Key list) {
    const std::string_view name = list.name.substr(0, list.name.size() - 2);
    place(*values_, name, {}, 0, false) = Json::array();
    for (const Quantity& q : result_quantities())
        if (q.name.starts_with(name) && q.name.substr(name.size()).starts_with("[]."))
            place((*values_)["units"], q.name, {}, 0, true) = std::string(q.unit);
}

void Result::set_scene(Json scene, Json units) {
    (*values_)["scene"] = std::move(scene);
    (*values_)["units"]["scene"] = std::move(units);
}

std::optional<double> Result::number(Key key) const {
    const Json* value = find(*values_, key.name);
    return value && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

Json Result::json() const {
    Json all = Json::object();
    for (const auto& [name, value] : values_->items())
        if (!value.is_null()) all[name] = value;
    all["units"]["digest"] = ""; // the digest that sealed_json adds
    return all;
}

std::string Result::text(int indent) const { return json_text(json(), indent) + "\n"; }

void write_result(const Directory& directory, const Result& result) {
    write_whole({directory, "result.json"}, sealed_json(result.json()));
}

} // namespace asperity::io
