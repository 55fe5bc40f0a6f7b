// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// JSON whose objects keep the order in which their members were put. Headers need its name alone,
// from <nlohmann/json_fwd.hpp>.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace asperity::io {

using Json = nlohmann::ordered_json;

/// indent < 0: one line. NaN and infinity are written as null.
std::string json_text(const Json& value, int indent = -1);
/// Throws FileError with the place of the mistake; `file` is named in it.
Json parse_json(std::string_view text, const std::string& file);
/// Returns an object as the text of a file, whose last member `digest` is of all bytes before the
/// comma in front of it.
std::string sealed_json(const Json& object);
/// Returns true if a text ends in the digest of what is before it.
bool is_sealed_json(std::string_view text);
/// A member by its path, find(json, "energy.residual"), or nullptr.
const Json* find(const Json& object, std::string_view path);

} // namespace asperity::io
