// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// result.json: what a command computed.
//
// A Result holds values under the names of io/quantities.hpp, and the unit of each; what was not
// computed is left out of the file. A run that fails writes its result too, with the reason. The
// directory is chosen in io/result_directory.hpp.
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

class Result {
public:
    using Value = std::variant<bool, long long, double, std::string, std::vector<double>,
                               std::vector<long long>, std::vector<std::string>>;

    /// With what the program was built from (run.version, ...) and nothing else.
    Result();
    ~Result();
    Result(Result&&) noexcept;

    /// Sets a value; one that is set already is replaced. NaN and infinity are written as null.
    void set(Key key, Value value);
    /// Nothing where the optional is empty.
    template <class T>
    void set(Key key, const std::optional<T>& value) {
        if (value) set(key, Value(*value));
    }
    /// member: in place of the "*" of the key.
    void set(Key key, std::string_view member, Value value);
    /// element: in place of the "[]" of the key; elements before it must be there.
    void set(Key key, std::size_t element, Value value);
    /// An empty list and the units of its elements; list: a key that ends in "[]".
    void set_list(Key list);
    /// The scene and the units of its keys (Schema::json(), Schema::units()).
    void set_scene(nlohmann::ordered_json scene, nlohmann::ordered_json units);

    /// A number that was set (of a key without "*" and "[]"), or nothing.
    std::optional<double> number(Key key) const;

    /// Values in the order of result_quantities, then `scene` and `units`.
    nlohmann::ordered_json json() const;
    /// indent < 0: one line.
    std::string text(int indent = 2) const;

private:
    void put(Key key, const std::string& member, std::size_t element, Value&& value);

    std::unique_ptr<nlohmann::ordered_json> values_; ///< with `units` among them
};

/// Writes result.json, whole or not at all, with a last member `digest`: of all bytes before the
/// comma in front of it. Throws FileError.
void write_result(const Directory& directory, const Result& result);

} // namespace asperity::io
