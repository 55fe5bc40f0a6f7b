// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The one unit that includes nlohmann.
#include "io/json_value.hpp"

#include "io/error.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace asperity::io {

namespace {

using Json = nlohmann::ordered_json;

/// Of arrays and objects in one another. Results are six deep; copying and freeing are recursive.
constexpr int deepest = 64;

Json to_json(const JsonValue& value) {
    if (value.is_bool()) return value.boolean();
    if (value.is_integer()) return value.integer();
    if (value.is_number()) return value.number();
    if (value.is_text()) return value.text();
    if (value.is_array()) {
        Json array = Json::array();
        for (const JsonValue& item : value.items())
            array.push_back(to_json(item));
        return array;
    }
    if (value.is_object()) {
        Json object = Json::object();
        for (const auto& [name, member] : value.members())
            object[name] = to_json(member);
        return object;
    }
    return nullptr;
}

JsonValue from_json(const Json& json) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_unsigned() && json.get<std::uint64_t>() > INT64_MAX)
        return json.get<double>();
    if (json.is_number_integer()) return static_cast<long>(json.get<std::int64_t>());
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    if (json.is_array()) {
        JsonValue array = JsonValue::array();
        for (const Json& item : json)
            array.push_back(from_json(item));
        return array;
    }
    if (json.is_object()) {
        JsonValue object = JsonValue::object();
        for (const auto& [name, member] : json.items())
            object[name] = from_json(member);
        return object;
    }
    return {};
}

} // namespace

JsonValue& JsonValue::operator[](std::string_view name) {
    if (is_null()) value_ = Object{};
    Object& object = std::get<Object>(value_);
    for (auto& [key, member] : object)
        if (key == name) return member;
    return object.emplace_back(std::string(name), JsonValue()).second;
}

const JsonValue* JsonValue::find(std::string_view path) const {
    if (!is_object()) return nullptr;
    const std::size_t dot = path.find('.');
    for (const auto& [key, member] : members()) {
        if (key != path.substr(0, dot)) continue;
        return dot == std::string_view::npos ? &member : member.find(path.substr(dot + 1));
    }
    return nullptr;
}

void JsonValue::push_back(JsonValue value) {
    if (is_null()) value_ = Array{};
    std::get<Array>(value_).push_back(std::move(value));
}

bool JsonValue::is_number() const { return is_integer() || std::holds_alternative<double>(value_); }

double JsonValue::number() const {
    return is_integer() ? static_cast<double>(integer()) : std::get<double>(value_);
}

std::string JsonValue::dump(int indent) const {
    // A path on Linux may be any bytes; what is no UTF-8 is replaced rather than refused.
    return to_json(*this).dump(indent, ' ', false, Json::error_handler_t::replace);
}

JsonValue JsonValue::parse(std::string_view text, const std::string& file) {
    const auto limit = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > deepest)
            throw FileError(file, "this is no result",
                            fmt::format("its values are nested more than {} deep", deepest),
                            "run the scene again");
        return true;
    };
    try {
        return from_json(Json::parse(text, limit));
    } catch (const Json::exception& error) {
        throw FileError(file, "this is no JSON that can be read", error.what(),
                        "if the file was cut short, run the scene again");
    }
}

} // namespace asperity::io
