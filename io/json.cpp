// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/json.hpp"

#include "io/files.hpp"

#include <fmt/format.h>

#include <span>

namespace asperity::io {

namespace {

/// Largest depth of arrays and objects. Results are six deep; copying and freeing are recursive.
constexpr int deepest = 64;
/// Largest number of members of all objects. A result has some hundreds; an object compares a new
/// name with all names before it.
constexpr int most_members = 20000;

} // namespace

std::string json_text(const Json& value, int indent) {
    // A path on Linux may be any bytes; what is no UTF-8 is replaced rather than refused.
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json problems_json(const std::vector<Problem>& problems) {
    Json all = Json::array();
    for (const Problem& one : problems)
        all.push_back(
            {{"where", one.where}, {"what", one.what}, {"why", one.why}, {"fix", one.fix}});
    return all;
}

Json parse_json(std::string_view text, const std::string& file) {
    int members = 0;
    const auto limit = [&](int depth, Json::parse_event_t event, Json&) {
        members += event == Json::parse_event_t::key ? 1 : 0;
        if (depth > deepest || members > most_members)
            throw FileError(file, "this is no result",
                            depth > deepest
                                ? fmt::format("its values are nested more than {} deep", deepest)
                                : fmt::format("it has more than {} members", most_members),
                            "run the scene again");
        return true;
    };
    try {
        return Json::parse(text, limit);
    } catch (const Json::exception& error) {
        throw FileError(file, "this is no JSON that can be read", error.what(),
                        "if the file was cut short, run the scene again");
    }
}

namespace {

/// Appends the digest of the text to the text.
std::string sealed(std::string text) {
    return text + fmt::format(",\n  \"digest\": \"{}\"\n}}\n",
                              digest_text(digest_of(std::as_bytes(std::span(text)))));
}

} // namespace

std::string sealed_json(const Json& object) {
    std::string text = json_text(object, 2);
    text.resize(text.rfind("\n}"));
    return sealed(std::move(text));
}

std::optional<std::map<std::string, std::string>> sealed_texts(const std::string& text,
                                                               const std::string& member) {
    // An object of this kind finds a name in a tree, so that many names take no longer each.
    using Tree = nlohmann::json;
    const auto limit = [](int depth, Tree::parse_event_t, Tree&) {
        if (depth > 2) throw FileError("", "this is no object of texts", "");
        return true;
    };
    if (!is_sealed_json(text)) return std::nullopt;
    try {
        return Tree::parse(text, limit).at(member).get<std::map<std::string, std::string>>();
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

std::string sealed_texts(const std::string& member,
                         const std::map<std::string, std::string>& texts) {
    const nlohmann::json object = {{member, texts}};
    std::string text = object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    text.resize(text.rfind("\n}"));
    return sealed(std::move(text));
}

bool is_sealed_json(std::string_view text) {
    return text == sealed(std::string(text.substr(0, text.rfind(",\n  \"digest\": "))));
}

const Json* find(const Json& object, std::string_view path) {
    const Json* at = &object;
    for (;;) {
        const std::size_t dot = path.find('.');
        const auto member = at->find(std::string(path.substr(0, dot)));
        if (member == at->end()) return nullptr;
        at = &*member;
        if (dot == std::string_view::npos) return at;
        path.remove_prefix(dot + 1);
    }
}

} // namespace asperity::io
