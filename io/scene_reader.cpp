// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Binding of keys to fields: what a value must be to be stored, and what is said if it is not.
#include "io/scene_reader.hpp"

#include "io/json.hpp"
#include "io/spelling.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

namespace asperity::io {

namespace {

using Value = Schema::Value;
using Key = Schema::Key;

std::string quoted_choices(const std::vector<std::string>& choices) {
    std::string text;
    for (const std::string& choice : choices) {
        if (!text.empty()) text += ", ";
        text += '"' + choice + (choice.ends_with(':') ? "N\"" : "\"");
    }
    return text;
}

std::string type_of(const Value& value) {
    if (value.boolean) return "true or false";
    if (value.integer) return "a whole number";
    if (value.number) return "a number";
    if (value.text) return "a string";
    if (value.list) return "a list of strings";
    return "of a type no key has";
}

Problem wrong_type(std::string needed, const Value& value, std::string example) {
    return {"", "is of the wrong type",
            fmt::format("{} is needed, this is {}", needed, type_of(value)),
            example.empty() ? "" : fmt::format("write, for example, {}", example)};
}

Problem out_of_range(const Range& range, std::string_view unit, bool other_unit = false) {
    std::string fix = "give a value in that range";
    if (other_unit && !unit.empty())
        fix += fmt::format("; a number without a unit is in {}, another unit is written as in {}",
                           unit, example_of(unit));
    return {"", "is out of range", fmt::format("allowed: {}", range.text(unit)), std::move(fix)};
}

Problem no_such_choice(const std::string& word, const std::vector<std::string>& choices) {
    const std::string near = nearest(word, choices);
    return {"", "is none of its choices", "choices: " + quoted_choices(choices),
            near.empty() ? "take one of them" : fmt::format("did you mean \"{}\"?", near)};
}

/// The number a value means, in the base unit.
Problem read_number(const Value& value, const std::string& unit, const Range& range, double& into) {
    double number = 0.0;
    if (value.text) {
        const ParsedQuantity parsed = parse_quantity(*value.text, unit);
        if (!parsed.why.empty())
            return {"", "cannot be read as a quantity", parsed.why, parsed.fix};
        number = parsed.value;
    } else if (value.number) {
        number = *value.number;
    } else if (value.integer) {
        number = static_cast<double>(*value.integer);
    } else {
        return wrong_type(unit.empty() ? "a number"
                                       : fmt::format("a number or a quantity in {}", unit),
                          value, unit.empty() ? "0.5" : example_of(unit));
    }
    if (!std::isfinite(number))
        return {"", "is not finite", "allowed: " + range.text(unit), "give a finite number"};
    if (!range.contains(number))
        return out_of_range(range, unit, !value.text && number > range.high);
    into = number;
    return {};
}

Problem read_integer(const Value& value, const Range& range, long long& into) {
    if (value.text && value.text->size() > 18 &&
        value.text->find_first_not_of("+-0123456789_") == std::string::npos)
        return out_of_range(range, ""); // it does not fit into 64 bits
    if (!value.integer) {
        const std::string example = value.number && std::abs(*value.number) < 1e15
                                        ? fmt::format("{:.0f}", std::round(*value.number))
                                        : std::string("512");
        return wrong_type("a whole number", value, example + " (no quotes, no decimal point)");
    }
    if (!range.contains(static_cast<double>(*value.integer))) return out_of_range(range, "");
    into = *value.integer;
    return {};
}

Problem with_word(Problem problem, const std::string& word) {
    if (!problem.what.empty()) problem.fix += fmt::format("; \"{}\" is allowed too", word);
    return problem;
}

Range within_int(Range range) {
    range.low = std::max(range.low, static_cast<double>(std::numeric_limits<int>::min()));
    if (range.high > static_cast<double>(std::numeric_limits<int>::max()))
        range.high = static_cast<double>(std::numeric_limits<int>::max());
    return range;
}

/// A key that is written back as the field is.
template <class T>
Key make_key(std::string name, Schema::Kind kind, std::string doc, const T& field) {
    Key key;
    key.name = std::move(name);
    key.kind = kind;
    key.doc = std::move(doc);
    key.load = [&field] { return Json(field); };
    return key;
}

/// The same with a word that stands for an empty field; read(value, number) reads any other value.
template <class T, class Read>
Key make_key_or(std::string name, Schema::Kind kind, std::string doc, std::optional<T>& field,
                const std::string& word, const Read& read) {
    Key key;
    key.name = std::move(name);
    key.kind = kind;
    key.doc = std::move(doc);
    key.word = word;
    key.store = [&field, word, read](const Value& value) -> Problem {
        if (value.text && *value.text == word) {
            field.reset();
            return {};
        }
        T number = 0;
        Problem problem = read(value, number);
        if (problem.what.empty()) field = number;
        return with_word(std::move(problem), word);
    };
    key.load = [&field, word] { return field ? Json(*field) : Json(word); };
    return key;
}

/// A member of a list: one of the choices, or a choice ending in ':' with a positive number behind
/// it.
bool fits(const std::string& member, const std::vector<std::string>& choices) {
    for (const std::string& choice : choices) {
        if (member == choice && !choice.ends_with(':')) return true;
        if (!choice.ends_with(':') || !member.starts_with(choice)) continue;
        const std::string count = member.substr(choice.size());
        if (count.empty() || count.size() > 15 || count[0] == '0') continue;
        if (std::all_of(count.begin(), count.end(), [](char c) { return c >= '0' && c <= '9'; }))
            return true;
    }
    return choices.empty();
}

} // namespace

std::string format(const Position& position) {
    if (position.line == 0) return position.file;
    return fmt::format("{}:{}:{}", position.file, position.line, position.column);
}

std::string Positions::where(const std::string& key) const {
    const auto at = at_.find(key);
    return at == at_.end() ? file_ : format(at->second);
}

void Problems::add(const std::string& key, const std::string& what, std::string why,
                   std::string fix) {
    add(Problem{positions_.where(key), key + (what.starts_with(":") ? "" : " ") + what,
                std::move(why), std::move(fix)});
}

void Problems::throw_if_any() const {
    if (!empty()) throw SceneError(list_);
}

bool Range::contains(double x) const {
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
}

std::string Range::text(std::string_view unit) const {
    const std::string with_unit = unit.empty() ? "" : " " + std::string(unit);
    const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
    if (has_low && has_high) {
        const char* const left = low_open ? "above " : "";
        const char* const right = high_open ? "below " : "";
        return fmt::format("{}{} to {}{}{}", left, low, right, high, with_unit);
    }
    if (has_low)
        return low_open ? fmt::format("above {}{}", low, with_unit)
                        : fmt::format("{}{} or more", low, with_unit);
    if (has_high)
        return high_open ? fmt::format("below {}{}", high, with_unit)
                         : fmt::format("{}{} or less", high, with_unit);
    return "any number" + (unit.empty() ? "" : " of" + with_unit);
}

Schema& Schema::section(std::string name, std::string doc) {
    sections_.emplace_back(std::move(name), std::move(doc));
    return *this;
}

Key& Schema::boolean(std::string name, bool& field, std::string doc) {
    Key key = make_key(std::move(name), Kind::boolean, std::move(doc), field);
    key.store = [&field](const Value& value) -> Problem {
        if (!value.boolean) return wrong_type("true or false", value, "true (no quotes)");
        field = *value.boolean;
        return {};
    };
    return add(std::move(key));
}

Schema& Schema::removed(Removed what) {
    removed_.push_back(std::move(what));
    return *this;
}

const Schema::Removed* Schema::find_removed(std::string_view key, std::string_view word) const {
    for (const Removed& gone : removed_)
        if (gone.key == key && gone.word == word) return &gone;
    return nullptr;
}

Schema& Schema::variations(std::string name, std::string doc, std::string example,
                           std::vector<Variation>& into) {
    variations_ = {std::move(name), std::move(doc), std::move(example), &into};
    return *this;
}

Key& Schema::integer(std::string name, int& field, Range range, std::string doc) {
    Key key = make_key(std::move(name), Kind::integer, std::move(doc), field);
    key.range = range;
    key.store = [&field, range](const Value& value) {
        long long number = field;
        Problem problem = read_integer(value, within_int(range), number);
        field = static_cast<int>(number);
        return problem;
    };
    return add(std::move(key));
}

Key& Schema::integer(std::string name, long long& field, Range range, std::string doc) {
    Key key = make_key(std::move(name), Kind::integer, std::move(doc), field);
    key.range = range;
    key.store = [&field, range](const Value& value) { return read_integer(value, range, field); };
    return add(std::move(key));
}

Key& Schema::number(std::string name, double& field, std::string unit, Range range,
                    std::string doc) {
    Key key = make_key(std::move(name), Kind::number, std::move(doc), field);
    key.unit = unit;
    key.range = range;
    key.store = [&field, unit, range](const Value& value) {
        return read_number(value, unit, range, field);
    };
    return add(std::move(key));
}

Key& Schema::number_or(std::string name, std::optional<double>& field, std::string word,
                       std::string unit, Range range, std::string doc) {
    Key key = make_key_or(std::move(name), Kind::number, std::move(doc), field, word,
                          [unit, range](const Value& value, double& number) {
                              return read_number(value, unit, range, number);
                          });
    key.unit = unit;
    key.range = range;
    return add(std::move(key));
}

Key& Schema::integer_or(std::string name, std::optional<long long>& field, std::string word,
                        Range range, std::string doc) {
    Key key = make_key_or(std::move(name), Kind::integer, std::move(doc), field, word,
                          [range](const Value& value, long long& number) {
                              return read_integer(value, range, number);
                          });
    key.range = range;
    return add(std::move(key));
}

Key& Schema::text(std::string name, std::string& field, std::string doc) {
    Key key = make_key(std::move(name), Kind::text, std::move(doc), field);
    key.store = [&field](const Value& value) -> Problem {
        if (!value.text) return wrong_type("a string", value, "\"heights.h5\" (in quotes)");
        if (value.text->empty())
            return {"", "is empty", "a string with something in it is needed", ""};
        field = *value.text;
        return {};
    };
    return add(std::move(key));
}

Key& Schema::choice_of(std::string name, std::vector<std::string> words,
                       std::function<void(std::size_t)> set, std::function<std::size_t()> get,
                       std::string doc) {
    Key key;
    key.name = std::move(name);
    key.kind = Kind::choice;
    key.choices = words;
    key.doc = std::move(doc);
    key.store = [words, set](const Value& value) -> Problem {
        if (!value.text)
            return wrong_type("one of " + quoted_choices(words), value, '"' + words.front() + '"');
        const auto at = std::find(words.begin(), words.end(), *value.text);
        if (at == words.end()) return no_such_choice(*value.text, words);
        set(static_cast<std::size_t>(at - words.begin()));
        return {};
    };
    key.load = [words, get] { return Json(words.at(get())); };
    return add(std::move(key));
}

Key& Schema::list(std::string name, std::vector<std::string>& field,
                  std::vector<std::string> choices, std::string doc) {
    return list_with(
        std::move(name), std::move(choices),
        [&field](const std::vector<std::string>& list) { field = list; },
        [&field] { return field; }, std::move(doc));
}

Key& Schema::list_with(std::string name, std::vector<std::string> choices,
                       std::function<void(const std::vector<std::string>&)> set,
                       std::function<std::vector<std::string>()> get, std::string doc) {
    Key key;
    key.name = std::move(name);
    key.kind = Kind::list;
    key.choices = choices;
    key.doc = std::move(doc);
    key.store = [set, choices](const Value& value) -> Problem {
        if (!value.list)
            return wrong_type("a list of strings", value,
                              fmt::format("[\"{}\"]", choices.empty() ? "a" : choices.front()));
        for (const std::string& member : *value.list)
            if (!fits(member, choices)) {
                Problem problem = no_such_choice(member, choices);
                problem.what =
                    fmt::format("has a member \"{}\" that is none of its choices", member);
                return problem;
            }
        set(*value.list);
        return {};
    };
    key.load = [get] { return Json(get()); };
    return add(std::move(key));
}

const Key* Schema::find(std::string_view path) const {
    for (const Key& key : keys_)
        if (key.path() == path) return &key;
    return nullptr;
}

} // namespace asperity::io
