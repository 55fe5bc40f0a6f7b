// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// result.json: the numbers that a command computed.
//
// A Result holds values under the names of io/quantities.hpp, with their units; the file omits
// values that were not computed. A failed run writes a result too, with the reason.
// io/result_directory.hpp chooses the directory.
#pragma once

#include "io/files.hpp"
#include "io/quantities.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace asperity::io {

/// Values of result.json.
class Result {
public:
    using Value = std::variant<bool, long long, double, std::string, std::vector<double>,
                               std::vector<long long>, std::vector<std::string>>;

    /// Makes a result with version, compiler and machine (run.version, ...) only.
    Result();
    ~Result();
    Result(Result&&) noexcept;

    /// Sets or replaces a value. NaN and infinity are written as null.
    void set(Key key, Value value);
    /// Sets a value unless the optional is empty.
    template <class T>
    void set(Key key, const std::optional<T>& value) {
        if (value) set(key, Value(*value));
    }
    /// Sets a value. member: name that replaces the "*" of the key.
    void set(Key key, std::string_view member, Value value);
    /// Sets a value. element: index that replaces the "[]" of the key; earlier elements must exist.
    void set(Key key, std::size_t element, Value value);
    /// Sets an empty list and the units of its elements. list: a key that ends in "[]".
    void set_list(Key list);
    /// Sets the scene and the units of its keys (Schema::json(), Schema::units()).
    void set_scene(nlohmann::ordered_json scene, nlohmann::ordered_json units);

    /// Returns a number, for a key without "*" and "[]"; nothing if the number was not set.
    std::optional<double> number(Key key) const;

    /// Returns the values in the order of result_quantities, then `scene` and `units`.
    nlohmann::ordered_json json() const;
    /// Returns json() as text. indent: spaces of a level, < 0: on one line.
    std::string text(int indent = 2) const;

private:
    void put(Key key, const std::string& member, std::size_t element, Value&& value);

    /// Values, and their units in the member `units`.
    std::unique_ptr<nlohmann::ordered_json> values_;
};

/// Writes result.json through OutputFile, with a last member `digest` (sealed_json()). Throws
/// FileError.
void write_result(const Directory& directory, const Result& result);

} // namespace asperity::io
