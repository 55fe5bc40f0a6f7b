// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// A TOML reader driven by a schema, independent of physics.
//
// A Schema is a list of keys, each bound to a field of a plain struct. The value of the field
// before a scene is read is the key's default. Reading passes once over the text and once over the
// overrides (--set section.key=value), writes valid values to the fields and collects all mistakes;
// errors are thrown after everything has been read. Positions stores the origin of each value, so
// that later checks of several keys can also report file:line:column.
//
// The same schema writes the struct back as TOML, as JSON and as the reference page in docs/.
#pragma once

#include "io/error.hpp"

#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace asperity::io {

/// Place at which each key was set.
struct Positions {
    std::string file;
    std::map<std::string, std::string> keys; ///< "file:line:column" or "--set section.key=value"

    bool is_set(const std::string& key) const { return keys.contains(key); }
    /// Returns the place at which a key was set, or the file's name for a key that was not set.
    std::string where(const std::string& key) const { return is_set(key) ? keys.at(key) : file; }
};

/// Collector of the mistakes in a scene, which are thrown together:
///     Problems problems(scene.positions);
///     problems.add("drive.timestep", "... is over the stability limit", "why", "fix");
///     problems.throw_if_any();
class Problems {
public:
    Problems() = default;
    explicit Problems(const Positions& positions) : positions_(positions) {}

    /// Adds a problem at the key's position. The message is the key's name followed by `what`.
    void add(const std::string& key, const std::string& what, std::string why = "",
             std::string fix = "");
    /// Adds a problem.
    void add(Problem problem) { list_.push_back(std::move(problem)); }
    bool empty() const { return list_.empty(); }
    const std::vector<Problem>& list() const { return list_; }
    /// Throws SceneError with all problems, if there are any.
    void throw_if_any() const;

private:
    Positions positions_;
    std::vector<Problem> list_;
};

/// Interval of values that a number may take.
struct Range {
    double low = -HUGE_VAL;
    double high = HUGE_VAL;
    bool low_open = false; ///< low itself is not allowed
    bool high_open = false;

    bool contains(double x) const; ///< returns true for a value in the interval
    /// Returns the interval as text, with the unit: "> 0", "0 to 1", "4 or more".
    std::string text(std::string_view unit) const;
};
/// Returns the interval of all numbers.
inline Range any() { return {}; }
/// Returns the interval of numbers above zero.
inline Range positive() { return {0.0, HUGE_VAL, true, false}; }
/// Returns the interval of numbers from `low` on.
inline Range at_least(double low) { return {low, HUGE_VAL, false, false}; }
/// Returns the closed interval.
inline Range between(double low, double high) { return {low, high, false, false}; }

/// A key of [sweep] and its values, as text.
struct Variation {
    std::string key;
    std::string values; ///< "1,2,5" or "0.5:10:0.5"
    std::string where;  ///< file:line:column
};

/// Keys of a scene, each bound to a field.
class Schema {
public:
    using Words = std::vector<std::string>;
    /// List of rows of a scene before conversion: numbers, and quantities in quotes.
    using RawRows = std::vector<std::vector<std::variant<double, std::string>>>;

    /// Value of a scene before conversion; std::monostate for a type that no key has.
    using Value =
        std::variant<std::monostate, bool, long long, double, std::string, Words, RawRows>;

    /// Access to a field of an enumeration by the index of its word.
    struct Choice {
        std::function<void(std::size_t)> set;
        std::function<std::size_t()> get;
    };
    /// Column of a list of rows: name, unit ("": a bare number) and range of its quantity.
    struct Column {
        std::string name, unit;
        Range range;
        std::string example; ///< example of a value in a scene
    };
    /// Access to a list of rows with a value for each column, in the columns' units.
    struct Rows {
        std::vector<Column> columns;
        std::function<void(const std::vector<std::vector<double>>&)> set;
        std::function<std::vector<std::vector<double>>()> get;
    };
    using Field = std::variant<bool*, int*, long long*, std::optional<long long>*, double*,
                               std::optional<double>*, std::string*, Choice, Words*, Rows>;

    /// Condition on other keys without which a key has no effect, or is refused.
    struct Need {
        std::function<bool()> is_met;
        std::string otherwise; ///< text if not met: "surface.kind is not \"self-affine\""
        /// Message of a refusal; empty if the key is only without effect. A value other than the
        /// default is refused if the need is not met. `refused` follows the value in the message:
        /// "on a dynamic path".
        std::string refused{}, why{}, fix{};
        /// Remedy for a key that is only without effect, "take surface.kind = \"file\"", and the
        /// keys on which the need depends. Empty: such a key is noted in place of refused.
        std::string instead{};
        std::vector<std::string> deciding{};
    };

    /// A key of a scene: its name, field, documentation, allowed values and needs.
    struct Key {
        std::string name;
        Field field;
        std::string doc;    ///< one line of documentation
        std::string unit{}; ///< base unit of a quantity; empty: a bare number
        Range range{};
        std::string word{};    ///< word for an empty field, or for a field that is 0
        Words choices{};       ///< words of a choice, or of a list's members
        bool numerals = false; ///< a choice may also be a whole number without quotes
        /// Former unit of the key, which is now a bare number, and the message for values that
        /// still have the unit.
        struct Was {
            std::string unit{}, why{}, fix{};
        };
        Was was{};
        /// Name of a file that may replace a number or rows; empty text if the key has numbers.
        /// nullptr: numbers only.
        std::string* text = nullptr;
        std::string example{}; ///< example of the text
        /// Length from which a count is derived, Å; nullptr: counts only.
        std::optional<double>* length = nullptr;
        /// Quantity of another dimension from which the number is derived: unit, name and field;
        /// nullptr: none.
        struct Other {
            std::string unit{}, name{};
            std::optional<double>* value = nullptr;
        };
        Other other{};
        std::string section{};
        /// Returns true if the key must not be written back, because it would change the meaning;
        /// empty: always written.
        std::function<bool()> omitted{};
        /// Conditions on other keys; the first that is not met decides.
        std::vector<Need> needs{};

        std::string path() const { return section + "." + name; }
        std::string kind() const; ///< returns boolean, integer, number, text, choice, list or rows
        bool written() const { return !omitted || !omitted(); }
        /// Returns the first need that is not met; nullptr if all are.
        const Need* unmet_need() const;
        /// Converts a value and stores it in the field. Returns the problem with the value; `what`
        /// is empty on success.
        Problem store(const Value& value) const;
        nlohmann::ordered_json load() const; ///< returns the field's value
    };

    /// Begins a section, to which the following keys belong.
    void section(std::string name, std::string doc) {
        sections_.emplace_back(std::move(name), std::move(doc));
    }

    /// Adds a boolean or a text.
    template <class T>
    Key& key(std::string name, T& field, std::string doc) {
        return add({std::move(name), &field, std::move(doc)});
    }
    /// Adds an integer.
    template <class T>
    Key& integer(std::string name, T& field, Range range, std::string doc) {
        return add(
            {.name = std::move(name), .field = &field, .doc = std::move(doc), .range = range});
    }
    /// Adds a quantity: a number in the unit, or a string with any unit of that dimension; unit "":
    /// a bare number.
    Key& number(std::string name, double& field, std::string unit, Range range, std::string doc) {
        return add({std::move(name), &field, std::move(doc), std::move(unit), range});
    }
    /// Adds a quantity that may also be a text that does not begin like a number: adhesion =
    /// "map.npy".
    Key& number_or_text(std::string name, double& field, std::string& text, std::string unit,
                        Range range, std::string example, std::string doc) {
        return add({.name = std::move(name),
                    .field = &field,
                    .doc = std::move(doc),
                    .unit = std::move(unit),
                    .range = range,
                    .text = &text,
                    .example = std::move(example)});
    }
    /// Adds such a number that may also be a word, for an empty field.
    Key& number_or_text(std::string name, std::optional<double>& field, std::string& text,
                        std::string word, std::string unit, Range range, std::string example,
                        std::string doc) {
        return add({.name = std::move(name),
                    .field = &field,
                    .doc = std::move(doc),
                    .unit = std::move(unit),
                    .range = range,
                    .word = std::move(word),
                    .text = &text,
                    .example = std::move(example)});
    }
    /// Adds a quantity, or an integer without unit, that may also be a word: radius = "none".
    template <class T>
    Key& number_or(std::string name, std::optional<T>& field, std::string word, std::string unit,
                   Range range, std::string doc) {
        return add(
            {std::move(name), &field, std::move(doc), std::move(unit), range, std::move(word)});
    }
    /// Adds a quantity or an integer whose field is 0 for the word "none": max_steps = "none".
    template <class T>
    Key& number_or_none(std::string name, T& field, std::string unit, Range range,
                        std::string doc) {
        return add({std::move(name), &field, std::move(doc), std::move(unit), range, "none"});
    }
    /// Adds an integer that may also be a length, from which the caller derives the number: sites =
    /// "133 nm".
    Key& count_or_length(std::string name, int& field, std::optional<double>& length, Range range,
                         std::string doc) {
        return add({.name = std::move(name),
                    .field = &field,
                    .doc = std::move(doc),
                    .range = range,
                    .length = &length});
    }
    /// Adds a quantity that may also be one of another dimension, from which the caller derives the
    /// number: load = "20 nN".
    Key& quantity_or(std::string name, double& field, std::string unit, Key::Other other,
                     std::string doc) {
        return add({.name = std::move(name),
                    .field = &field,
                    .doc = std::move(doc),
                    .unit = std::move(unit),
                    .other = std::move(other)});
    }
    /// Adds a list of strings. A member is valid if it equals a choice, or if it is a choice that
    /// ends in ':' followed by a positive integer ("every:1000"). Without choices every member is
    /// valid.
    Key& list(std::string name, Words& field, Words choices, std::string doc) {
        return add({.name = std::move(name),
                    .field = &field,
                    .doc = std::move(doc),
                    .choices = std::move(choices)});
    }
    /// Adds a list of rows of quantities: layers = [["2 nm", "10 GPa", 0.3]]. With Key::text the
    /// value may also be the name of a file, from which the caller fills in the rows.
    template <std::size_t N>
    Key& rows(std::string name, std::vector<std::array<double, N>>& field,
              const std::array<Column, N>& columns, std::string doc) {
        const auto set = [&field](const std::vector<std::vector<double>>& rows) {
            field.resize(rows.size());
            for (std::size_t i = 0; i < rows.size(); ++i)
                std::copy(rows[i].begin(), rows[i].end(), field[i].begin());
        };
        const auto get = [&field] {
            std::vector<std::vector<double>> rows;
            rows.reserve(field.size());
            for (const std::array<double, N>& row : field)
                rows.emplace_back(row.begin(), row.end());
            return rows;
        };
        return add(
            {std::move(name), Rows{{columns.begin(), columns.end()}, set, get}, std::move(doc)});
    }
    /// Adds an enumeration. names: word and value of each choice.
    template <class E>
    Key& choice(std::string name, E& field, std::vector<std::pair<std::string, E>> names,
                std::string doc) {
        Words words;
        words.reserve(names.size());
        for (const auto& [word, value] : names)
            words.push_back(word);
        const Choice choice{[&field, names](std::size_t i) { field = names[i].second; },
                            [&field, names] {
                                std::size_t i = 0;
                                while (i < names.size() && names[i].second != field)
                                    ++i;
                                return i;
                            }};
        return add({.name = std::move(name),
                    .field = choice,
                    .doc = std::move(doc),
                    .choices = std::move(words)});
    }

    /// Key or value of earlier releases that this release refuses.
    struct Removed {
        std::string key; ///< section.key
        /// Removed value of the key, or removed member of its list; empty if the whole key is
        /// removed.
        std::string word;
        std::string why, fix;
    };
    /// Adds a removed key or value.
    void removed(Removed what) { removed_.push_back(std::move(what)); }

    /// Section [sweep], whose members are keys of other sections, each with a list or range of
    /// values. Reading checks only the names of these keys.
    struct Variations {
        std::string name, doc, example;
        std::vector<Variation>* into = nullptr;
    };
    /// Sets the section of variations.
    void variations(Variations section) { variations_ = std::move(section); }

    /// Keeps an object, to which closures of the keys refer, alive as long as the schema.
    void own(std::shared_ptr<const void> object) { owned_ = std::move(object); }

    const std::vector<Key>& keys() const { return keys_; }
    const Variations& variations() const { return variations_; }
    const Key* find(std::string_view path) const; ///< returns a key; nullptr if there is none
    /// Returns the description of a removed key or value; nullptr if it is not listed as removed.
    const Removed* find_removed(std::string_view key, std::string_view word = "") const;

    /// Reads a text and overrides ("section.key=value") into the fields. file: name shown in
    /// messages. Fills in positions. Adds mistakes to problems; throws nothing.
    void read(std::string_view text, const std::string& file,
              const std::vector<std::string>& overrides, Positions& positions,
              Problems& problems) const;

    /// Returns the fields as a scene in TOML. with_docs: with a comment for each key.
    std::string toml(bool with_docs) const;
    /// Returns the values of the fields: {section: {key: value}}.
    nlohmann::ordered_json json() const;
    /// Returns the unit of each value of json(), in the same form: "1" for a pure number, "" for
    /// other values.
    nlohmann::ordered_json units() const;
    /// Returns the reference page of the keys.
    std::string markdown() const;

private:
    Key& add(Key key);

    std::vector<Key> keys_;
    std::vector<Removed> removed_;
    std::vector<std::pair<std::string, std::string>> sections_; ///< name and doc, in order
    Variations variations_;
    std::shared_ptr<const void> owned_;
};

/// File name that stands for the standard input on a command line.
inline constexpr std::string_view standard_input = "-";
/// Reads a file, or the standard input. Throws SceneError if it cannot be read.
std::string read_scene_file(const std::string& file);

} // namespace asperity::io
