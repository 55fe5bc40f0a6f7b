// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// The schema's other direction: fields back to TOML, to JSON, and to the reference page.
#include "io/json.hpp"
#include "io/scene_reader.hpp"

#include <cmath>

#include <fmt/format.h>

namespace asperity::io {

namespace {

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            result += fmt::format("\\u{:04X}", static_cast<int>(c));
        else
            result += c;
    }
    return result + '"';
}

/// As it stands in a scene. Numbers have all digits, and a point, so that they stay numbers.
std::string toml_value(const Json& value) {
    if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
    if (value.is_number_integer()) return fmt::format("{}", value.get<long long>());
    if (value.is_number()) {
        std::string text = fmt::format("{}", value.get<double>());
        if (text.find_first_of(".einf") == std::string::npos) text += ".0";
        return text;
    }
    if (value.is_string()) return quoted(value.get<std::string>());
    std::string text;
    for (const Json& item : value)
        text += (text.empty() ? "" : ", ") + toml_value(item);
    return "[" + text + "]";
}

/// What may stand there: a range with its unit, or choices, or a kind.
std::string allowed(const Schema::Key& key, const char* quote) {
    std::string text;
    for (const std::string& choice : key.choices) {
        if (!text.empty()) text += " | ";
        text += fmt::format("{0}\"{1}{2}\"{0}", quote, choice, choice.ends_with(':') ? "N" : "");
    }
    if (!text.empty()) return key.kind == Schema::Kind::list ? "list of " + text : text;
    switch (key.kind) {
    case Schema::Kind::boolean:
        text = "true | false";
        break;
    case Schema::Kind::integer:
        text = std::isfinite(key.range.low) || std::isfinite(key.range.high)
                   ? "whole number, " + key.range.text("")
                   : "whole number";
        break;
    case Schema::Kind::number:
        text = key.range.text(key.unit);
        break;
    default:
        text = "text";
        break;
    }
    if (!key.word.empty()) text += fmt::format(" | {0}\"{1}\"{0}", quote, key.word);
    return text;
}

std::string escaped_bars(std::string text) { // a bar would end the cell of a Markdown table
    for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
        text.insert(i, "\\");
    return text;
}

} // namespace

Schema::Key& Schema::add(Key key) {
    key.section = sections_.empty() ? "" : sections_.back().first;
    key.default_toml = toml_value(key.load());
    return keys_.emplace_back(std::move(key));
}

std::string Schema::toml(bool with_docs) const {
    std::string text;
    for (const auto& [section, section_doc] : sections_) {
        if (!text.empty()) text += '\n';
        if (with_docs) text += "# " + section_doc + "\n";
        text += "[" + section + "]\n";
        for (const Key& key : keys_) {
            if (key.section != section) continue;
            if (key.omitted && key.omitted()) continue;
            std::string line = key.name + " = " + toml_value(key.load());
            if (with_docs) line = fmt::format("{:<36} # {}: {}", line, allowed(key, ""), key.doc);
            text += line + '\n';
        }
    }
    if (with_docs && !variations_.name.empty())
        text += fmt::format("\n# {}\n# [{}]\n# {}\n", variations_.doc, variations_.name,
                            variations_.example);
    return text;
}

Json Schema::json() const {
    Json root = Json::object();
    for (const Key& key : keys_)
        if (!key.omitted || !key.omitted()) root[key.section][key.name] = key.load();
    return root;
}

Json Schema::units() const {
    Json root = Json::object();
    for (const Key& key : keys_) {
        if (key.omitted && key.omitted()) continue;
        const bool number = key.kind == Kind::number || key.kind == Kind::integer;
        root[key.section][key.name] = !number ? "" : key.unit.empty() ? "1" : key.unit;
    }
    return root;
}

std::string Schema::markdown() const {
    std::string text;
    for (const auto& [section, section_doc] : sections_) {
        text += fmt::format(
            "\n## [{}]\n\n{}\n\n| key | default | allowed | meaning |\n|---|---|---|---|\n",
            section, section_doc);
        for (const Key& key : keys_)
            if (key.section == section)
                text += fmt::format("| `{}` | `{}` | {} | {} |\n", key.name, key.default_toml,
                                    escaped_bars(allowed(key, "`")), escaped_bars(key.doc));
    }
    if (!variations_.name.empty())
        text += fmt::format("\n## [{}]\n\n{}\n\n    {}\n", variations_.name, variations_.doc,
                            variations_.example);
    return text;
}

} // namespace asperity::io
