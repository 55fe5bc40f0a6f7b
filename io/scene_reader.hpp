// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A TOML reader driven by a schema; it knows no physics.
//
// A Schema is a list of keys, each bound to a field of some plain struct. What the field holds
// before a scene is read is the key's default. Reading goes once through the text and once through
// the overrides (--set section.key=value), writes what is right into the fields and collects what
// is wrong; nothing is thrown before everything has been looked at. Where each value came from is
// kept in Positions, so that checks which need several keys, or the mesh, or the number of ranks,
// can still point to file:line:column.
//
// The same schema writes the struct back as TOML, as JSON and as the reference page in docs/.
#pragma once

#include "io/error.hpp"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace asperity::io {

/// Where every key that was set was set.
struct Positions {
    std::string file;
    std::map<std::string, std::string> keys; ///< "file:line:column" or "--set section.key=value"

    bool is_set(const std::string& key) const { return keys.contains(key); }
    /// The file's name where the key has its default.
    std::string where(const std::string& key) const { return is_set(key) ? keys.at(key) : file; }
};

/// Collects what is wrong with a scene; throws it together.
///     Problems problems(scene.positions);
///     problems.add("drive.timestep", "... is over the stability limit", "why", "fix");
///     problems.throw_if_any();
class Problems {
public:
    Problems() = default;
    explicit Problems(const Positions& positions) : positions_(positions) {}

    /// Points to the key's position; the message begins with the key's name.
    void add(const std::string& key, const std::string& what, std::string why = "",
             std::string fix = "");
    void add(Problem problem) { list_.push_back(std::move(problem)); }
    bool empty() const { return list_.empty(); }
    const std::vector<Problem>& list() const { return list_; }
    /// Throws SceneError with all of them.
    void throw_if_any() const;

private:
    Positions positions_;
    std::vector<Problem> list_;
};

/// Values a number may take.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false; ///< low itself is not allowed
    bool high_open = false;

    bool contains(double x) const;
    /// "> 0", "0 to 1", "4 or more", with the unit.
    std::string text(std::string_view unit) const;
};
inline Range any() { return {}; }
inline Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
inline Range at_least(double low) {
    return {low, std::numeric_limits<double>::infinity(), false, false};
}
inline Range between(double low, double high) { return {low, high, false, false}; }

/// A key and the values it takes one after the other, as they would stand behind --set key=.
struct Variation {
    std::string key;
    std::string values; ///< "1,2,5" or "0.5:10:0.5"
    std::string where;  ///< file:line:column
};

class Schema {
public:
    using Words = std::vector<std::string>;
    /// A number and a quantity each, the latter in the key's unit.
    using Pairs = std::vector<std::pair<double, double>>;
    /// Such a list as it stands in a scene.
    using RawPairs = std::vector<std::pair<double, std::variant<double, std::string>>>;

    /// A value as it stands in a scene, before it is bound. Empty: of a type no key has.
    using Value =
        std::variant<std::monostate, bool, long long, double, std::string, Words, RawPairs>;

    /// A field of some enumeration, by the number of its word.
    struct Choice {
        std::function<void(std::size_t)> set;
        std::function<std::size_t()> get;
    };
    using Field = std::variant<bool*, int*, long long*, std::optional<long long>*, double*,
                               std::optional<double>*, std::string*, Choice, Words*, Pairs*>;

    struct Key {
        std::string name;
        Field field;
        std::string doc;    ///< one line, for people
        std::string unit{}; ///< base unit of a quantity; empty: a bare number
        Range range{};
        std::string word{};    ///< the word that stands for an empty field, or for one that is 0
        Words choices{};       ///< of a choice, or of a list's members
        bool numerals = false; ///< a choice may be a whole number without quotes, too
        /// Of a bare number that was a quantity: the unit it had, and what to say to one in it.
        struct Was {
            std::string unit{}, why{}, fix{};
        };
        Was was{};
        std::optional<double>* length = nullptr; ///< of a count: where a length is stored, Å
        std::string section{};
        std::function<bool()> omitted{}; ///< set: true when writing the key back would change the
                                         ///< meaning

        std::string path() const { return section + "." + name; }
        std::string kind() const; ///< boolean, integer, number, text, choice, list or pairs
        bool written() const { return !omitted || !omitted(); }
        /// What is empty: stored; else what is wrong.
        Problem store(const Value& value) const;
        nlohmann::ordered_json load() const;
    };

    /// Keys that follow belong to this section.
    void section(std::string name, std::string doc) {
        sections_.emplace_back(std::move(name), std::move(doc));
    }

    /// True or false, or a text.
    template <class T>
    Key& key(std::string name, T& field, std::string doc) {
        return add({name, &field, doc});
    }
    template <class T>
    Key& integer(std::string name, T& field, Range range, std::string doc) {
        return add({.name = name, .field = &field, .doc = doc, .range = range});
    }
    /// A quantity (number in the unit, or string with any unit of that dimension); unit "" : a bare
    /// number.
    Key& number(std::string name, double& field, std::string unit, Range range, std::string doc) {
        return add({name, &field, doc, unit, range});
    }
    /// A quantity, or a whole number without unit, or a word: radius = "none".
    template <class T>
    Key& number_or(std::string name, std::optional<T>& field, std::string word, std::string unit,
                   Range range, std::string doc) {
        return add({name, &field, doc, unit, range, word});
    }
    /// The same for a field that is 0 where there is none: max_steps = "none".
    template <class T>
    Key& number_or_none(std::string name, T& field, std::string unit, Range range,
                        std::string doc) {
        return add({name, &field, doc, unit, range, "none"});
    }
    /// A whole number, or a length of which the reader's user makes one: sites = "133 nm".
    Key& count_or_length(std::string name, int& field, std::optional<double>& length, Range range,
                         std::string doc) {
        return add({.name = name, .field = &field, .doc = doc, .range = range, .length = &length});
    }
    /// A list of strings. A member is right if it equals a choice, or starts with a choice that
    /// ends in ':' and goes on with a positive whole number ("every:1000"). No choices: anything.
    Key& list(std::string name, Words& field, Words choices, std::string doc) {
        return add({.name = name, .field = &field, .doc = doc, .choices = choices});
    }
    /// A list of pairs [number, quantity]; the range is that of both.
    Key& pairs(std::string name, Pairs& field, std::string unit, Range range, std::string doc) {
        return add({name, &field, doc, unit, range});
    }
    /// An enumeration, by its names.
    template <class E>
    Key& choice(std::string name, E& field, std::vector<std::pair<std::string, E>> names,
                std::string doc) {
        Words words;
        for (const auto& [word, value] : names)
            words.push_back(word);
        const Choice choice{[&field, names](std::size_t i) { field = names[i].second; },
                            [&field, names] {
                                std::size_t i = 0;
                                while (i < names.size() && names[i].second != field)
                                    ++i;
                                return i;
                            }};
        return add({.name = name, .field = choice, .doc = doc, .choices = words});
    }

    /// What scenes of earlier releases have and this one refuses.
    struct Removed {
        std::string key; ///< section.key
        /// The value that the key no longer takes, or a member of its list; empty: the whole key is
        /// gone.
        std::string word;
        std::string why, fix;
    };
    void removed(Removed what) { removed_.push_back(std::move(what)); }

    /// A section without keys of its own: keys of the others, each with a list or range of values.
    /// Only their names are looked at here.
    struct Variations {
        std::string name, doc, example;
        std::vector<Variation>* into = nullptr;
    };
    void variations(Variations section) { variations_ = std::move(section); }

    const std::vector<Key>& keys() const { return keys_; }
    const Variations& variations() const { return variations_; }
    const Key* find(std::string_view path) const;
    /// Null: that was never there, or still is.
    const Removed* find_removed(std::string_view key, std::string_view word = "") const;

    /// Reads text (the contents of file) and overrides ("section.key=value"). Problems are added,
    /// not thrown.
    void read(std::string_view text, const std::string& file,
              const std::vector<std::string>& overrides, Positions& positions,
              Problems& problems) const;

    /// The fields as a scene; with docs, each key has its line of explanation.
    std::string toml(bool with_docs) const;
    nlohmann::ordered_json json() const;
    /// The unit of each value of json(): "1" for a pure number, "" for what is no number.
    nlohmann::ordered_json units() const;
    /// The reference page.
    std::string markdown() const;

private:
    Key& add(Key key);

    std::vector<Key> keys_;
    std::vector<Removed> removed_;
    std::vector<std::pair<std::string, std::string>> sections_; ///< name and doc, in order
    Variations variations_;
};

/// The name by which a command line asks for it.
inline constexpr std::string_view standard_input = "-";
/// Contents of a file, or of the standard input; SceneError if it cannot be read.
std::string read_scene_file(const std::string& file);

} // namespace asperity::io
