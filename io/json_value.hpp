// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A JSON value for those who fill results without seeing a JSON library: null, bool, number,
// string, array, or an object that keeps the order in which its members were put. Text and parsing
// are in json_value.cpp, the one unit that includes nlohmann.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace asperity::io {

class JsonValue {
public:
    using Array = std::vector<JsonValue>;
    using Object = std::vector<std::pair<std::string, JsonValue>>;

    JsonValue() = default; ///< null
    JsonValue(bool value) : value_(value) {}
    JsonValue(int value) : value_(static_cast<std::int64_t>(value)) {}
    JsonValue(long value) : value_(static_cast<std::int64_t>(value)) {}
    JsonValue(long long value) : value_(static_cast<std::int64_t>(value)) {}
    JsonValue(double value)
        : value_(value) {} ///< written with all digits; NaN and infinity as null
    JsonValue(const char* value) : value_(std::string(value)) {}
    JsonValue(std::string value) : value_(std::move(value)) {}
    JsonValue(Array value) : value_(std::move(value)) {}
    JsonValue(Object value) : value_(std::move(value)) {}
    template <class T>
    JsonValue(const std::optional<T>& value) {
        if (value) *this = JsonValue(*value);
    }

    static JsonValue object() { return JsonValue(Object{}); }
    static JsonValue array() { return JsonValue(Array{}); }

    /// Member of an object, made if it is not there; null becomes an object.
    JsonValue& operator[](std::string_view name);
    /// Member, or nullptr. Dots lead deeper: find("energy.residual").
    const JsonValue* find(std::string_view path) const;
    /// Appends to an array; null becomes an array.
    void push_back(JsonValue value);
    /// Puts a member if the optional holds something.
    template <class T>
    void put(std::string_view name, const std::optional<T>& value) {
        if (value) (*this)[name] = JsonValue(*value);
    }

    bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
    bool is_bool() const { return std::holds_alternative<bool>(value_); }
    bool is_number() const;
    bool is_text() const { return std::holds_alternative<std::string>(value_); }
    bool is_array() const { return std::holds_alternative<Array>(value_); }
    bool is_object() const { return std::holds_alternative<Object>(value_); }
    bool boolean() const { return std::get<bool>(value_); }
    double number() const; ///< of an integer too
    std::int64_t integer() const { return std::get<std::int64_t>(value_); }
    bool is_integer() const { return std::holds_alternative<std::int64_t>(value_); }
    const std::string& text() const { return std::get<std::string>(value_); }
    const Array& items() const { return std::get<Array>(value_); }
    const Object& members() const { return std::get<Object>(value_); }

    /// JSON text; indent < 0: one line.
    std::string dump(int indent = 2) const;
    /// Throws FileError with the place of the mistake.
    static JsonValue parse(std::string_view text, const std::string& file);

private:
    std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Object> value_;
};

} // namespace asperity::io
