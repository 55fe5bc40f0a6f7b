// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Reads TOML text and overrides into the keys of a schema. The one unit that includes toml++.
#include "io/scene_reader.hpp"

#include "io/error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace asperity::io {

namespace {

/// A scene is a few kB. What is larger, deeper or more often wrong is not one; without these limits
/// reading would take all memory, or the stack (a table is freed recursively).
constexpr std::size_t largest_scene = 4u << 20; ///< bytes
constexpr int deepest_key = 32;                 ///< parts of a dotted key
constexpr std::size_t most_problems = 50;       ///< number of problems that are reported one by one

/// Returns the line, from 1, of a key in the text with more parts than that, 0 if there is none.
int line_of_deep_key(std::string_view text) {
    int line = 1, dots = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"' || c == '\'') { // to the end of the string, or of the line if it has none
            const std::string_view three = c == '"' ? "\"\"\"" : "'''";
            const bool lines = text.substr(i).starts_with(three);
            for (i += lines ? 3 : 1; i < text.size(); ++i) {
                if (text[i] == '\n') ++line;
                if (c == '"' && text[i] == '\\')
                    ++i;
                else if (lines ? text.substr(i).starts_with(three)
                               : text[i] == c || text[i] == '\n')
                    break;
            }
            if (lines) i += 2;
            while (lines && i + 1 < text.size() && text[i + 1] == c)
                ++i; // """ may be preceded by two more quotes
        } else if (c == '#') {
            i = std::min(text.find('\n', i), text.size()) - 1;
        } else if (c == '.') {
            if (++dots >= deepest_key) return line;
        } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
            dots = 0;
            if (c == '\n') ++line;
        }
    }
    return 0;
}

/// A place in the text, or an override (line 0).
struct Position {
    std::string file;
    int line = 0, column = 0;

    std::string text() const {
        return line == 0 ? file : fmt::format("{}:{}:{}", file, line, column);
    }
    /// Returns the order of the text; overrides come last.
    std::tuple<bool, int, int> order() const { return {line == 0, line, column}; }
};

Schema::Value value_of(const toml::node& node) {
    if (const auto* boolean = node.as_boolean()) return boolean->get();
    if (const auto* integer = node.as_integer()) return static_cast<long long>(integer->get());
    if (const auto* number = node.as_floating_point()) return number->get();
    if (const auto* text = node.as_string()) return text->get();
    const auto* array = node.as_array();
    if (!array) return {};
    Schema::Words list;
    Schema::RawRows rows;
    for (const toml::node& member : *array) {
        if (const auto* text = member.as_string()) {
            list.push_back(text->get());
        } else if (const auto* row = member.as_array()) {
            rows.emplace_back();
            for (const toml::node& cell : *row) {
                if (const auto number = cell.value<double>(); number && cell.is_number())
                    rows.back().emplace_back(*number);
                else if (const auto* quantity = cell.as_string())
                    rows.back().emplace_back(quantity->get());
                else
                    return {};
            }
        }
    }
    if (list.size() == array->size()) return list;
    if (rows.size() == array->size()) return rows;
    return {};
}

std::string cut(std::string text) {
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
}

/// Returns the value approximately as the user wrote it.
std::string as_written(const toml::node& node) {
    std::ostringstream text;
    if (node.is_table())
        text << "{...}";
    else if (const auto* list = node.as_array()) {
        for (const toml::node& member : *list)
            text << (&member == &list->front() ? "" : ", ") << as_written(member);
        return "[" + text.str() + "]";
    } else
        node.visit([&](const auto& value) {
            if constexpr (toml::is_floating_point<decltype(value)>)
                text << fmt::format("{}", *value); // 0.6, of which TOML++ makes 0.59999999999999998
            else
                text << toml::toml_formatter{value, toml::format_flags::none};
        });
    std::string result = text.str();
    std::replace(result.begin(), result.end(), '\n', ' ');
    if (result.size() >= 2 && result.front() == '\'') result.front() = result.back() = '"';
    return result;
}

/// Returns the value approximately as the user wrote it, for messages; long ones are cut.
std::string shown(const toml::node& node) { return cut(as_written(node)); }

/// Returns advice on the probable intention of a line with a syntax error.
std::string syntax_advice(std::string_view text, int line_number, const std::string& why) {
    if (why.find("array") != why.npos)
        return "a list stands in one pair of [brackets], its members between commas: one before "
               "this place is not closed";
    std::istringstream lines{std::string(text)};
    std::string line;
    for (int i = 0; i < line_number && std::getline(lines, line); ++i) {
    }
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) return "a line is [section], or key = value, or a # comment";
    std::string value = line.substr(equals + 1);
    if (const std::size_t hash = value.find('#'); hash != std::string::npos) value.resize(hash);
    const std::size_t first = value.find_first_not_of(" \t");
    if (first == std::string::npos) return "there is no value behind the =";
    value = value.substr(first, value.find_last_not_of(" \t\r") - first + 1);
    if (value.find_first_of("\"'[{,") == std::string::npos)
        return fmt::format("words, and numbers with a unit, stand in quotes: {}= \"{}\"",
                           line.substr(0, equals), value);
    return "strings stand in quotes, lists in [brackets], a key stands once in its section";
}

class Reading {
public:
    Reading(const Schema& schema, std::string file, Positions& positions)
        : schema_(schema), file_(std::move(file)), positions_(positions) {
        for (const Schema::Key& key : schema.keys()) {
            paths_.push_back(key.path());
            if (sections_.empty() || sections_.back() != key.section)
                sections_.push_back(key.section);
        }
        if (schema.variations().into) sections_.push_back(schema.variations().name);
    }

    void text(std::string_view text) {
        if (text.find('\0') != text.npos)
            return add({file_, 1, 1}, "this is no scene", "it is a binary file; a scene is text",
                       "of a map of heights: asperity adhesion MAP --young 100GPa --poisson 0.25 "
                       "--adhesion 200mJ/m2, or name the map in a scene (surface.file)");
        if (const int line = line_of_deep_key(text))
            return add({file_, line, 1}, "this is no scene",
                       fmt::format("a key has more than {} parts", deepest_key),
                       "the keys of a scene are section.name");
        toml::table root;
        try {
            root = toml::parse(text, file_);
        } catch (const toml::parse_error& error) {
            const Position at = place(error.source());
            const std::string why(error.description());
            add(at, "this is no TOML", why,
                why.find("redefine") != why.npos
                    ? "a section stands in one place, and a key once in it"
                    : syntax_advice(text, at.line, why));
            return;
        }
        for (const auto& [name, node] : root)
            section(std::string(name.str()), name.source(), node);
    }

    void override_with(const std::string& assignment) {
        const Position at{"--set " + assignment};
        const std::size_t equals = assignment.find('=');
        std::string path = assignment.substr(0, equals);
        std::erase_if(path, [](char c) { return c == ' ' || c == '\t'; });
        if (equals == std::string::npos || equals == 0)
            return add(at, equals == 0 ? "there is no key before the =" : "there is no =",
                       "an override is section.key=value", "for example --set surface.rms=1.5");
        const Schema::Key* key = schema_.find(path);
        if (!key) return unknown(path, at);
        // A path may have as many dots as it likes; a table or a second line may not.
        if (assignment.find_first_of("{\n") != std::string::npos && line_of_deep_key(assignment))
            return add(at, "this is no value of a key",
                       fmt::format("it has a key of more than {} parts", deepest_key),
                       "an override is section.key=value");
        std::string written = assignment.substr(equals + 1);
        // The shell has eaten the quotes: what is no TOML value is a string, and in a list key a
        // list of them.
        toml::table root;
        const toml::node* node = nullptr;
        try {
            root = toml::parse("v = " + written);
            node = root.size() == 1 ? root.get("v") : nullptr;
        } catch (const toml::parse_error&) {
        }
        if (!node || node->is_date() || node->is_time() || node->is_date_time() ||
            node->is_table()) {
            root = toml::table{{"v", written}};
            node = root.get("v");
        }
        Schema::Value value = value_of(*node);
        if (const auto* text = std::get_if<std::string>(&value); text && key->kind() == "list") {
            Schema::Words list;
            std::istringstream members(*text);
            for (std::string member; std::getline(members, member, ',');) {
                member.erase(0, member.find_first_not_of(" \t"));
                member.erase(member.find_last_not_of(" \t") + 1);
                list.push_back(member);
            }
            value = list;
        }
        store(*key, value, shown(*node), at);
    }

    /// Adds what was found, in the order of the text.
    void finish(Problems& problems) {
        for (auto& [order, problem] : found_)
            problems.add(std::move(problem));
        if (untold_ > 0)
            problems.add(Problem{file_, fmt::format("has {} more problems", untold_),
                                 fmt::format("the first {} found are told", most_problems),
                                 "is it a scene?"});
    }

private:
    Position place(const toml::source_region& region) const {
        return {file_, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
    }

    /// Returns true if enough problems were found; further ones are only counted.
    bool full() {
        if (found_.size() < most_problems) return false;
        ++untold_;
        return true;
    }

    void add(const Position& at, std::string what, std::string why, std::string fix) {
        if (full()) return;
        found_.emplace(at.order(),
                       Problem{at.text(), std::move(what), std::move(why), std::move(fix)});
    }

    void section(const std::string& name, const toml::source_region& where,
                 const toml::node& node) {
        const Position at = place(where);
        const auto* table = node.as_table();
        if (!table) {
            if (node.is_array_of_tables())
                return add(at, fmt::format("[[{}]] is a list of sections", name),
                           "every section stands once", fmt::format("write [{}]", name));
            return unknown(name, at);
        }
        if (std::find(sections_.begin(), sections_.end(), name) == sections_.end()) {
            const std::string near = nearest(name, sections_);
            return add(at, fmt::format("[{}] is no section of a scene", name),
                       "sections: " + fmt::format("{}", fmt::join(sections_, ", ")),
                       near.empty() ? "take one of them" : fmt::format("did you mean [{}]?", near));
        }
        if (name == schema_.variations().name) return variations(*table, "");
        for (const auto& [key_name, value] : *table) {
            const std::string path = name + "." + std::string(key_name.str());
            const Schema::Key* key = schema_.find(path);
            if (!key) {
                unknown(path, place(key_name.source()));
                continue;
            }
            store(*key, value_of(value), shown(value), place(value.source()));
        }
    }

    /// Reads `surface.rms = [1, 2]` (a table in a table), or "surface.rms" = "0.5:10:0.5".
    void variations(const toml::table& table, const std::string& above) {
        for (const auto& [name, node] : table) {
            const std::string path = above + std::string(name.str());
            const Position at = place(node.source());
            if (const auto* inner = node.as_table()) {
                variations(*inner, path + ".");
                continue;
            }
            if (!schema_.find(path)) {
                unknown(path, place(name.source()));
                continue;
            }
            std::string values;
            if (const auto* array = node.as_array()) {
                for (const toml::node& member : *array)
                    values += (values.empty() ? "" : ",") + as_override(member);
            } else {
                values = as_override(node);
            }
            schema_.variations().into->push_back({path, values, at.text()});
        }
    }

    /// Returns a value as it would stand behind --set key=: strings without their quotes.
    static std::string as_override(const toml::node& node) {
        if (const auto* text = node.as_string()) return text->get();
        return shown(node);
    }

    void store(const Schema::Key& key, const Schema::Value& value, const std::string& text,
               const Position& at) {
        positions_.keys[key.path()] = at.text();
        const auto* word = std::get_if<std::string>(&value);
        if (const auto* gone = schema_.find_removed(key.path(), word ? *word : ""))
            return add(at, fmt::format("{} = {} is not a choice any more", key.path(), text),
                       gone->why, gone->fix);
        if (const auto* list = std::get_if<Schema::Words>(&value))
            for (const std::string& member : *list) {
                // "after:N" was a choice "after:".
                const std::string choice = member.substr(0, member.find(':') + 1);
                const auto* gone =
                    schema_.find_removed(key.path(), choice.empty() ? member : choice);
                if (gone)
                    return add(at,
                               fmt::format("{} has \"{}\", which is not a choice any more",
                                           key.path(), member),
                               gone->why, gone->fix);
            }
        const Problem problem = key.store(value);
        if (!problem.what.empty())
            add(at, fmt::format("{} = {} {}", key.path(), text, problem.what), problem.why,
                problem.fix);
    }

    void unknown(const std::string& path, const Position& at) {
        if (full()) return; // before names are compared
        if (const auto* gone = schema_.find_removed(path))
            return add(at, path + " is not a key any more", gone->why, gone->fix);
        const std::size_t dot = path.find('.');
        const std::string section = dot == std::string::npos ? "" : path.substr(0, dot);
        const std::string name = path.substr(dot + 1); // npos + 1 is 0
        std::vector<std::string> here, everywhere;
        std::map<std::string, std::string> path_of; // path of each name, the last one
        for (const Schema::Key& key : schema_.keys()) {
            if (key.section == section) here.push_back(key.name);
            everywhere.push_back(key.name);
            path_of[key.name] = key.path();
        }
        std::string meant = path_of.contains(name) ? path_of[name] : "";
        if (const std::string near = nearest(name, here); meant.empty() && !near.empty())
            meant = section + "." + near;
        if (meant.empty()) meant = nearest(path, paths_);
        if (meant.empty()) meant = path_of[nearest(name, everywhere)];
        add(at, cut(path) + " is no key of a scene",
            section.empty() ? "every key stands in a [section]"
            : here.empty()  ? fmt::format("there is no section [{}]", section)
                            : fmt::format("[{}] has: {}", section, fmt::join(here, ", ")),
            meant.empty() ? "`asperity defaults` lists every key"
                          : fmt::format("did you mean {}?", meant));
    }

    const Schema& schema_;
    std::string file_;
    Positions& positions_;
    std::vector<std::string> paths_, sections_;
    std::multimap<std::tuple<bool, int, int>, Problem> found_;
    std::size_t untold_ = 0;
};

} // namespace

void Schema::read(std::string_view text, const std::string& file,
                  const std::vector<std::string>& overrides, Positions& positions,
                  Problems& problems) const {
    positions.file = file;
    Reading reading(*this, file, positions);
    reading.text(text);
    for (const std::string& assignment : overrides)
        reading.override_with(assignment);
    reading.finish(problems);
}

namespace {

/// Returns the scene of a folder that a name without a file may mean: with .toml, or spelt
/// alike; "": none.
std::string scene_meant(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::path with_ending = file;
    if (std::filesystem::is_regular_file(with_ending += ".toml", error)) return with_ending;
    std::vector<std::string> names;
    const std::filesystem::path folder = file.parent_path();
    for (const auto& entry :
         std::filesystem::directory_iterator(folder.empty() ? "." : folder, error))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
    const std::string near = nearest(file.stem().string(), names);
    return near.empty() ? "" : (folder / (near + ".toml")).string();
}

} // namespace

std::string read_scene_file(const std::string& file) {
    const auto cannot = [&](std::string why, std::string fix) {
        return SceneError(
            Problem{file, "the scene cannot be read", std::move(why), std::move(fix)});
    };
    std::error_code error;
    const bool piped = file == standard_input;
    if (!piped && !std::filesystem::exists(file, error)) {
        const std::string meant = scene_meant(file);
        throw cannot("there is no such file",
                     meant.empty() ? "check the path; `asperity init` writes a scene to start from"
                                   : fmt::format("did you mean {}?", meant));
    }
    if (std::filesystem::is_directory(file, error))
        throw cannot("it is a directory", "name a .toml file in it");
    std::ifstream stream(piped ? "/dev/stdin" : file, std::ios::binary);
    if (!stream) throw cannot(std::strerror(errno), "check its permissions");
    std::string text(largest_scene + 1, '\0'); // instead of the file's size: a pipe has none
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad()) throw cannot(std::strerror(errno), "check its permissions");
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest_scene)
        throw cannot(fmt::format("it is larger than {} MB", largest_scene >> 20),
                     "name a scene: a text of a few kB");
    return text;
}

} // namespace asperity::io
