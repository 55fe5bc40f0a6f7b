// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// JSON whose objects keep the order of their members. Headers that need only the type include
// <nlohmann/json_fwd.hpp>.
#pragma once

#include "io/error.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::io {

using Json = nlohmann::ordered_json;

/// Returns a value as text. indent: spaces of a level, < 0: on one line. NaN and infinity become
/// null.
std::string json_text(const Json& value, int indent = -1);
/// Returns problems as an array of objects with the members where, what, why and fix.
Json problems_json(const std::vector<Problem>& problems);
/// Parses a text. Throws FileError with `file` and the place of the mistake.
Json parse_json(std::string_view text, const std::string& file);
/// Returns an object as the text of a file, with a last member `digest`: the digest of all bytes
/// before the comma in front of it.
std::string sealed_json(const Json& object);
/// Returns the text of a file of an object of texts, as the member of an object with a digest.
std::string sealed_texts(const std::string& member,
                         const std::map<std::string, std::string>& texts);
/// Returns the object of texts that is such a member; nothing if the text is no such file or was
/// changed.
std::optional<std::map<std::string, std::string>> sealed_texts(const std::string& text,
                                                               const std::string& member);
/// Returns true if a text of sealed_json() is unchanged.
bool is_sealed_json(std::string_view text);
/// Returns a member by its path, find(json, "energy.residual"); nullptr if there is none.
const Json* find(const Json& object, std::string_view path);

} // namespace asperity::io
