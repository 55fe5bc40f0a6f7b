// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// JSON whose objects keep the order of their members. Headers need its name alone, from
// <nlohmann/json_fwd.hpp>.
#pragma once

#include "io/error.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

using Json = nlohmann::ordered_json;

/// Returns the text of a value; indent < 0: on one line. NaN and infinity are written as null.
std::string json_text(const Json& value, int indent = -1);
/// Returns problems as an array of objects with the members where, what, why and fix.
Json problems_json(const std::vector<Problem>& problems);
/// Parses a text. Throws FileError with `file` and the place of the mistake.
Json parse_json(std::string_view text, const std::string& file);
/// Returns an object as the text of a file, whose last member `digest` is of all bytes before the
/// comma in front of it.
std::string sealed_json(const Json& object);
/// Returns true if a text ends in the digest of what is before it.
bool is_sealed_json(std::string_view text);
/// Returns a member by its path, find(json, "energy.residual"); nullptr if there is none.
const Json* find(const Json& object, std::string_view path);

} // namespace asperity::io
