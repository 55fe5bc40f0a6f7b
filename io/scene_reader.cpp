// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Binding of keys to fields: what a value must be to be stored, what is said if it is not, and the
// fields as TOML, as JSON and as the reference page.
#include "io/scene_reader.hpp"

#include "io/error.hpp"
#include "io/json.hpp"
#include "io/terminal.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>

namespace asperity::io {

namespace {

using Key = Schema::Key;
using Words = Schema::Words;
using Choice = Schema::Choice;

/// Returns a choice as text for a scene; "every:" takes a number.
std::string quoted(const std::string& choice) {
    return fmt::format("\"{}{}\"", choice, choice.ends_with(':') ? "N" : "");
}

std::string quoted_choices(const Words& choices, const char* between = ", ",
                           const std::string& around = "") {
    std::string text;
    for (const std::string& choice : choices)
        text += (text.empty() ? "" : between) + around + quoted(choice) + around;
    return text;
}

Problem out_of_range(const Range& range, std::string_view unit, bool other_unit = false) {
    std::string fix = "give a value in that range";
    if (other_unit && !unit.empty())
        fix += fmt::format("; a number without a unit is in {}, another unit is written as in {}",
                           unit, example_of(unit));
    return {"", "is out of range", fmt::format("allowed: {}", range.text(unit)), std::move(fix)};
}

Problem no_such_choice(const std::string& word, const Words& choices) {
    const std::string near = nearest(word.substr(0, word.find(':') + 1), choices),
                      other = near.empty() ? nearest(word, choices) : near;
    return {"", "is none of its choices", "choices: " + quoted_choices(choices),
            other.empty() ? "take one of them"
            : other.ends_with(':')
                ? fmt::format("write a number from 1 on behind it: \"{}1000\"", other)
                : fmt::format("did you mean \"{}\"?", other)};
}

/// Returns true if a member of a list is one of the choices, or a choice ending in ':' with a
/// positive number behind it.
bool fits(const std::string& member, const Words& choices) {
    for (const std::string& choice : choices) {
        if (member == choice && !choice.ends_with(':')) return true;
        if (!choice.ends_with(':') || !member.starts_with(choice)) continue;
        const std::string count = member.substr(choice.size());
        if (count.empty() || count.size() > 15 || count[0] == '0') continue;
        if (count.find_first_not_of("0123456789") == std::string::npos) return true;
    }
    return choices.empty();
}

/// Sizes of numbers in the units of keys: powers and products of them neither overflow nor vanish.
const Range sizes = between(1e-30, 1e30);

/// Stores the value of a key in its field; tells what is wrong where it does not.
struct Store {
    const Key& key;
    const Schema::Value& value;

    template <class T>
    const T* as() const {
        return std::get_if<T>(&value);
    }

    Problem wrong_type(const std::string& needed, const std::string& example) const {
        static constexpr const char* types[] = {"a value of another form",
                                                "true or false",
                                                "a whole number",
                                                "a number",
                                                "a string",
                                                "a list of strings",
                                                "a list of lists of another length"};
        static_assert(std::size(types) == std::variant_size_v<Schema::Value>);
        return {
            "", "is of the wrong type",
            fmt::format("{} is needed, this is {}", needed, types[value.index()]),
            fmt::format("write, for example, {}", example) +
                (value.index() == 0 ? "; several values of a key are for `asperity sweep`" : "")};
    }

    Problem operator()(bool* field) const {
        if (!as<bool>()) return wrong_type("true or false", "true (no quotes)");
        *field = *as<bool>();
        return {};
    }

    Problem whole(const Range& range, long long& into) const {
        const auto* text = as<std::string>();
        if (text && text->size() > 18 &&
            text->find_first_not_of("+-0123456789_") == std::string::npos)
            return out_of_range(range, ""); // the number does not fit into 64 bits
        const auto* integer = as<long long>();
        if (!integer) {
            const auto* number = as<double>();
            const std::string example = number && std::abs(*number) < 1e15
                                            ? fmt::format("{:.0f}", std::round(*number))
                                            : std::string("512");
            return wrong_type("a whole number", example + " (no quotes, no decimal point)");
        }
        if (!range.contains(static_cast<double>(*integer))) return out_of_range(range, "");
        into = *integer;
        return {};
    }
    /// Stores a number; its word stands for 0.
    template <class T>
    bool none(T* field) const {
        const auto* text = as<std::string>();
        if (key.word.empty() || !text || *text != key.word) return false;
        *field = 0;
        return true;
    }
    Problem or_none(Problem problem) const {
        if (!problem.what.empty() && !key.word.empty())
            problem.fix += fmt::format("; \"{}\" is allowed too", key.word);
        return problem;
    }
    Problem operator()(long long* field) const {
        if (none(field)) return {};
        return or_none(whole(key.range, *field));
    }
    Problem operator()(int* field) const {
        if (key.length) {
            key.length->reset();
            const auto* text = as<std::string>();
            if (text && text->find_first_not_of("+-0123456789_") != std::string::npos) {
                const ParsedQuantity parsed = parse_quantity(*text, "Å");
                if (!parsed.why.empty() || !(parsed.value > 0.0) || !std::isfinite(parsed.value))
                    return {"", "is neither a whole number nor a length",
                            parsed.why.empty() ? "a length is above 0 Å" : parsed.why,
                            "write, for example, 512 (no quotes) or \"133 nm\""};
                *key.length = parsed.value;
                return {};
            }
        }
        using Limits = std::numeric_limits<int>;
        Range range = key.range;
        range.low = std::max(range.low, static_cast<double>(Limits::min()));
        range.high = std::min(range.high, static_cast<double>(Limits::max()));
        long long number = *field;
        Problem problem = whole(range, number);
        *field = static_cast<int>(number);
        return problem;
    }

    Problem operator()(double* field) const {
        if (key.text) {
            const auto* text = as<std::string>();
            const bool named = text && !text->empty() && !begins_a_number(*text);
            *key.text = named ? *text : "";
            if (named) return {};
        }
        if (none(field)) return {};
        return or_none(quantity(field));
    }
    /// Returns true if a text begins with a digit, or with signs and a point before it.
    static bool begins_a_number(const std::string& text) {
        const std::size_t at = text.find_first_not_of(" +-.");
        return at == std::string::npos ||
               (std::isdigit(static_cast<unsigned char>(text[at])) && text.find('/') > at);
    }
    /// Stores the number in the base unit.
    Problem quantity(double* field) const {
        double number = 0.0;
        const auto* text = as<std::string>();
        if (key.other.value) key.other.value->reset();
        if (text) {
            const ParsedQuantity parsed = parse_quantity(*text, key.unit);
            if (key.other.value && !parsed.why.empty())
                if (const auto other = parse_quantity(*text, key.other.unit); other.why.empty()) {
                    *key.other.value = other.value;
                    return {};
                }
            if (!parsed.why.empty() && !key.was.unit.empty() &&
                parse_quantity(*text, key.was.unit).why.empty())
                return {"", "has a unit, and the key has none any more", key.was.why, key.was.fix};
            if (!parsed.why.empty())
                return {"", "cannot be read as a quantity", parsed.why, parsed.fix};
            number = parsed.value;
        } else if (as<double>()) {
            number = *as<double>();
        } else if (as<long long>()) {
            number = static_cast<double>(*as<long long>());
        } else if (key.unit.empty()) {
            return wrong_type("a number", "0.5");
        } else {
            return wrong_type("a number or a quantity in " + key.unit, example_of(key.unit));
        }
        if (!std::isfinite(number))
            return {"", "is not finite", "allowed: " + key.range.text(key.unit),
                    "give a finite number"};
        if (!key.range.contains(number))
            return out_of_range(key.range, key.unit, !text && number > key.range.high);
        if (const double size = std::abs(number); size != 0.0 && !sizes.contains(size))
            return {"", "is out of all proportion",
                    "numbers are computed with sizes " + sizes.text(key.unit) + ", and 0",
                    "correct the number or its unit"};
        *field = number;
        return {};
    }

    template <class T>
    Problem operator()(std::optional<T>* field) const {
        const auto* text = as<std::string>();
        if (text && *text == key.word) {
            field->reset();
            if (key.text) key.text->clear();
            return {};
        }
        T number = 0;
        Problem problem = (*this)(&number);
        if (problem.what.empty()) *field = number;
        return problem;
    }

    Problem operator()(std::string* field) const {
        const auto* text = as<std::string>();
        if (!text) return wrong_type("a string", "\"heights.h5\" (in quotes)");
        if (text->empty()) return {"", "is empty", "a string with something in it is needed", ""};
        *field = *text;
        return {};
    }

    Problem operator()(const Choice& field) const {
        std::string word;
        if (as<std::string>())
            word = *as<std::string>();
        else if (key.numerals && as<long long>())
            word = std::to_string(*as<long long>());
        else
            return wrong_type("one of " + quoted_choices(key.choices), quoted(key.choices[0]));
        const auto at = std::find(key.choices.begin(), key.choices.end(), word);
        if (at == key.choices.end()) return no_such_choice(word, key.choices);
        field.set(static_cast<std::size_t>(at - key.choices.begin()));
        return {};
    }

    Problem operator()(Words* field) const {
        const auto* list = as<Words>();
        if (!list)
            return wrong_type("a list of strings",
                              fmt::format("[\"{}\"]", key.choices.empty() ? "a" : key.choices[0]));
        for (const std::string& member : *list)
            if (!fits(member, key.choices)) {
                Problem problem = no_such_choice(member, key.choices);
                problem.what =
                    fmt::format("has a member \"{}\" that is none of its choices", member);
                return problem;
            }
        *field = *list;
        return {};
    }

    Problem operator()(const Schema::Rows& field) const {
        if (key.text) {
            const auto* text = as<std::string>();
            *key.text = text ? *text : "";
            if (text && !text->empty()) return {};
        }
        const auto* list = as<Schema::RawRows>();
        const auto* none = as<Words>(); // an empty list may be of anything
        const std::size_t columns = field.columns.size();
        const auto of_another_width = [&](const auto& row) { return row.size() != columns; };
        if ((!list && !(none && none->empty())) ||
            (list && std::any_of(list->begin(), list->end(), of_another_width))) {
            std::string names, example;
            for (const Schema::Column& column : field.columns) {
                names += (names.empty() ? "" : ", ") + column.name;
                example += (example.empty() ? "" : ", ") + column.example;
            }
            return wrong_type("a list of [" + names + "]" + (key.text ? ", or a file," : ""),
                              "[[" + example + "]]" +
                                  (key.text ? fmt::format(", or \"{}\"", key.example) : ""));
        }
        std::vector<std::vector<double>> rows;
        for (std::size_t i = 0; list && i < list->size(); ++i) {
            rows.emplace_back(columns);
            for (std::size_t c = 0; c < columns; ++c) {
                const Schema::Column& column = field.columns[c];
                double number = 0.0;
                const Key one{.name = key.name,
                              .field = &number,
                              .doc = {},
                              .unit = column.unit,
                              .range = column.range};
                const Schema::Value raw =
                    std::visit([](const auto& v) { return Schema::Value(v); }, (*list)[i][c]);
                Problem problem = Store{one, raw}(&number);
                if (!problem.what.empty()) {
                    problem.what =
                        fmt::format("in row {}, {}, {}", i + 1, column.name, problem.what);
                    return problem;
                }
                rows.back()[c] = number;
            }
        }
        field.set(rows);
        return {};
    }
};

struct Load {
    const Key& key;
    Json operator()(const Choice& field) const { return key.choices.at(field.get()); }
    Json operator()(const Schema::Rows& field) const { return field.get(); }
    template <class T>
    Json operator()(std::optional<T>* field) const {
        if (key.text && !key.text->empty()) return *key.text;
        return *field ? Json(**field) : Json(key.word);
    }
    template <class T>
    Json operator()(T* field) const {
        if (key.text && !key.text->empty()) return *key.text;
        if constexpr (std::is_arithmetic_v<T>)
            if (!key.word.empty() && *field == T{}) return key.word;
        return *field;
    }
};

/// Returns a value as it stands in a scene. Numbers have all digits, and a point, so that they stay
/// numbers.
std::string toml_value(const Json& value) {
    if (value.is_number_float()) {
        std::string text = fmt::format("{}", value.get<double>());
        if (text.find_first_of(".einf") == std::string::npos) text += ".0";
        return text;
    }
    if (!value.is_array()) return json_text(value);
    std::string text;
    for (const Json& item : value)
        text += (text.empty() ? "" : ", ") + toml_value(item);
    return "[" + text + "]";
}

/// Returns the allowed rows: each column's name and range.
std::string rows_allowed(const Schema::Rows& rows) {
    std::string text;
    for (const Schema::Column& column : rows.columns)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", column.name,
                            column.range.text(column.unit));
    return "list of [" + text + "]";
}

/// Returns the allowed values: a range with its unit, or choices, or a kind.
std::string allowed(const Key& key, const std::string& quote) {
    std::string text = quoted_choices(key.choices, " | ", quote);
    const std::string kind = key.kind();
    if (!text.empty()) return kind == "list" ? "list of " + text : text;
    const bool limited = std::isfinite(key.range.low) || std::isfinite(key.range.high);
    text = kind == "boolean"   ? "true | false"
           : kind == "number"  ? key.range.text(key.unit)
           : kind == "rows"    ? rows_allowed(std::get<Schema::Rows>(key.field))
           : kind != "integer" ? "text"
           : limited           ? "whole number, " + key.range.text("")
                               : "whole number";
    if (!key.word.empty()) text += " | " + quote + quoted(key.word) + quote;
    if (key.text) text += " | " + quote + quoted(key.example) + quote;
    if (key.length) text += " | a length";
    if (key.other.value) text += fmt::format(" | {} in {}", key.other.name, key.other.unit);
    return text;
}

std::string escaped_bars(std::string text) { // a bar would end the cell of a Markdown table
    for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
        text.insert(i, "\\");
    return text;
}

} // namespace

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
    const char* const above = low_open ? "above " : "";
    const char* const below = high_open ? "below " : "";
    if (has_low && has_high)
        return fmt::format("{}{} to {}{}{}", above, low, below, high, with_unit);
    if (has_low) return fmt::format("{}{}{}{}", above, low, with_unit, low_open ? "" : " or more");
    if (has_high)
        return fmt::format("{}{}{}{}", below, high, with_unit, high_open ? "" : " or less");
    return "any number" + (unit.empty() ? "" : " of" + with_unit);
}

const Schema::Removed* Schema::find_removed(std::string_view key, std::string_view word) const {
    for (const Removed& gone : removed_)
        if (gone.key == key && gone.word == word) return &gone;
    return nullptr;
}

const Key* Schema::find(std::string_view path) const {
    for (const Key& key : keys_)
        if (key.path() == path) return &key;
    return nullptr;
}

std::string Key::kind() const {
    static constexpr const char* kinds[] = {"boolean", "integer", "integer", "integer", "number",
                                            "number",  "text",    "choice",  "list",    "rows"};
    static_assert(std::size(kinds) == std::variant_size_v<Schema::Field>);
    return kinds[field.index()];
}

Problem Key::store(const Schema::Value& value) const {
    return std::visit(Store{*this, value}, field);
}

Json Key::load() const { return std::visit(Load{*this}, field); }

const Schema::Need* Key::unmet_need() const {
    const auto unmet =
        std::find_if(needs.begin(), needs.end(), [](const Schema::Need& n) { return !n.is_met(); });
    return unmet == needs.end() ? nullptr : &*unmet;
}

Key& Schema::add(Key key) {
    key.section = sections_.empty() ? "" : sections_.back().first;
    return keys_.emplace_back(std::move(key));
}

std::string Schema::toml(bool with_docs) const {
    std::string text;
    const auto comment = [&](const std::string& words, const std::string& sign) {
        for (const std::string& line : wrapped(words, text_columns - visible_width(sign)))
            if (with_docs) text += sign + line + '\n';
    };
    for (const auto& [section, section_doc] : sections_) {
        if (!text.empty()) text += '\n';
        comment(section_doc, "# ");
        text += "[" + section + "]\n";
        for (const Key& key : keys_) {
            if (key.section != section || !key.written()) continue;
            comment(fmt::format("{}: {}", allowed(key, ""), key.doc), "#   ");
            text += key.name + " = " + toml_value(key.load()) + '\n';
        }
    }
    if (with_docs && !variations_.name.empty()) {
        text += '\n';
        comment(variations_.doc, "# ");
        text += fmt::format("# [{}]\n# {}\n", variations_.name, variations_.example);
    }
    return text;
}

Json Schema::json() const {
    Json root = Json::object();
    for (const Key& key : keys_)
        if (key.written()) root[key.section][key.name] = key.load();
    return root;
}

Json Schema::units() const {
    Json root = Json::object();
    for (const Key& key : keys_) {
        const bool number = key.kind() == "number" || key.kind() == "integer";
        if (key.written())
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
                text += fmt::format("| `{}` | `{}` | {} | {} |\n", key.name, toml_value(key.load()),
                                    escaped_bars(allowed(key, "`")), escaped_bars(key.doc));
    }
    if (!variations_.name.empty())
        text += fmt::format("\n## [{}]\n\n{}\n\n    {}\n", variations_.name, variations_.doc,
                            variations_.example);
    return text;
}

} // namespace asperity::io
